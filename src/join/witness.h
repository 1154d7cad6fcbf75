// SPDX-License-Identifier: Apache-2.0
// Exact values of a join at exact parameters: the witnesses of refutations and the places of bounds.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/join/pieces.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof {

enum class Quantity { point_difference, first_derivative, second_derivative, coplanarity, normal_product };

template <ExactField T>
class WitnessFinder {
 public:
  // REQUIRES both outlive the finder.
  WitnessFinder(const Join<T>& join, const std::vector<JoinPiece<T>>& pieces) : join_(join), pieces_(pieces) {}

  Place place(int piece, const T& t) const {
    const auto [a, b] = parameters(piece, t);
    const Jet jet = affine_jet(pieces_[piece].a, t);
    Place out;
    for (int i = 0; i < 2; ++i) out.a[i] = nearest_double(a[i]), out.b[i] = nearest_double(b[i]);
    for (int c = 0; c < 3; ++c) out.point[c] = nearest_double(jet.x[c]);
    return out;
  }

  // A parameter where the quantity refutes: not zero (normal_product: positive). The preferred place is tried first; then
  // enough others that a polynomial quantity of the degrees at hand cannot vanish at all of them.
  std::optional<Witness> find(Quantity quantity, const std::pair<int, T>& preferred) const {
    if (auto witness = try_at(quantity, preferred.first, preferred.second)) return witness;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const int degree = static_cast<int>(pieces_[i].a[0].size() + pieces_[i].b[0].size());
      const int count = 4 * degree + 1;
      for (int k = 0; k <= count; ++k) {
        check_deadline();
        if (auto witness = try_at(quantity, static_cast<int>(i), T(T(k) / T(count)))) return witness;
      }
    }
    return std::nullopt;
  }

 private:
  // The point and its derivatives: x_t along the line (common local parameter), x_s and x_ss across it.
  struct Jet {
    Vec<T, 3> x, xt, xs, xss;
  };

  static Jet affine_jet(const SideRows<T>& rows, const T& t) {
    std::array<Vec<T, 4>, 3> h;
    for (int k = 0; k < 3; ++k) h[k] = de_casteljau(rows[k], t);
    const Vec<T, 4> ht = rows[0].size() > 1 ? derivative(rows[0], t, 1) : Vec<T, 4>{};
    const T w = h[0][3];
    Jet jet;
    for (int c = 0; c < 3; ++c) {
      jet.x[c] = h[0][c] / w;
      jet.xt[c] = (ht[c] - ht[3] * jet.x[c]) / w;
      jet.xs[c] = (h[1][c] - h[1][3] * jet.x[c]) / w;
      jet.xss[c] = (h[2][c] - T(2) * h[1][3] * jet.xs[c] - h[2][3] * jet.x[c]) / w;
    }
    return jet;
  }

  std::optional<Witness> try_at(Quantity quantity, int piece, const T& t) const {
    Jet x = affine_jet(pieces_[piece].a, t), y = affine_jet(pieces_[piece].b, t);
    // x_t, y_t by the parameter of line A, so that a reader needs nothing but the patches and the pairing.
    const T speed = T(1) / (pieces_[piece].a_end - pieces_[piece].a_begin);
    x.xt = speed * x.xt, y.xt = speed * y.xt;
    std::vector<T> values;
    std::string name;
    const auto vector = [&](const char* what, const Vec<T, 3>& v) {
      name = what;
      values.assign(v.c.begin(), v.c.end());
    };
    switch (quantity) {
      case Quantity::point_difference: vector("x - y", x.x - y.x); break;
      case Quantity::first_derivative: vector("x_s + y_s", x.xs + y.xs); break;
      case Quantity::second_derivative: vector("x_ss - y_ss", x.xss - y.xss); break;
      case Quantity::coplanarity:
        name = "det(x_t, x_s, y_s)";
        values = {dot(x.xt, cross(x.xs, y.xs))};
        break;
      case Quantity::normal_product:
        name = "(x_t × x_s) · (y_t × y_s)";
        values = {dot(cross(x.xt, x.xs), cross(y.xt, y.xs))};
        break;
    }
    bool refutes = false;
    for (const T& v : values) {
      const Sign sign = *scalar_traits<T>::sign(v);
      refutes = refutes || (quantity == Quantity::normal_product ? sign == Sign::positive : sign != Sign::zero);
    }
    if (!refutes) return std::nullopt;
    const auto [a, b] = parameters(piece, t);
    Witness witness{name, {to_text(a[0]), to_text(a[1])}, {to_text(b[0]), to_text(b[1])}, {}};
    for (const T& v : values) witness.values.push_back(to_text(v));
    return witness;
  }

  // (u, v) on both patches at the local parameter t of a piece.
  std::pair<std::array<T, 2>, std::array<T, 2>> parameters(int piece, const T& t) const {
    const JoinPiece<T>& p = pieces_[piece];
    T y = t;
    if (join_.pairing.kind == PairingKind::rational_linear) {
      const T r = join_.pairing.ratio;
      y = r * t / (T(1) - t + r * t);
    }
    const auto on = [](const IsoLine<T>& line, const T& along) {
      return line.constant == Direction::u ? std::array<T, 2>{line.value, along} : std::array<T, 2>{along, line.value};
    };
    return {on(join_.line_a, p.a_begin + t * (p.a_end - p.a_begin)),
            on(join_.line_b, p.b_begin + y * (p.b_end - p.b_begin))};
  }

  const Join<T>& join_;
  const std::vector<JoinPiece<T>>& pieces_;
};

}  // namespace patchproof
