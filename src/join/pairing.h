// SPDX-License-Identifier: Apache-2.0
// Which point of one edge belongs to which point of another, as exact data.
#pragma once

#include <optional>

#include "join/edge_curve.h"
#include "patchproof/join/continuity.h"
#include "patchproof/join/pieces.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof {

// The exact parameter of the edge at `unit` of its range [begin, end] (0 and 1 are the ends themselves).
template <ExactField T>
T at_unit(const T& begin, const T& end, const T& unit) {
  return begin + unit * (end - begin);
}

// The fraction of smallest denominator in [low, high], by continued fractions. REQUIRES 0 <= low <= high.
inline Rational simplest_between(const Rational& low, const Rational& high) {
  const Rational whole{Integer(numerator(low) / denominator(low))};
  if (whole == low) return whole;
  if (whole + Rational(1) <= high) return whole + Rational(1);
  const Rational one(1);
  return whole + one / simplest_between(one / (high - whole), one / (low - whole));
}

// The simplest fraction within `radius` of x. REQUIRES 0 <= x <= 1.
inline Rational simplest_fraction(double x, double radius) {
  return simplest_between(from_double(std::max(0.0, x - radius)), from_double(std::min(1.0, x + radius)));
}

// A pairing of the ranges [a0, a1] and [b0, b1] (b1 < b0 when reversed): affine.
template <ExactField T>
Pairing<T> affine_pairing(const T& a0, const T& a1, const T& b0, const T& b1) {
  const T da = a1 - a0, db = b1 < b0 ? b0 - b1 : b1 - b0;
  return {da == db ? PairingKind::identity : PairingKind::affine, {a0, a1}, {b0, b1}, T(1)};
}

// If the edges are one curve under y = r x/(1 − x + r x): that pairing. Both must be single Bézier pieces.
// The weights then satisfy w_B,i r^i = λ w_A,i after bringing both to one degree, which gives r; the rest is checked exactly.
template <ExactField T>
std::optional<Pairing<T>> rational_linear_pairing(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b,
                                                  const Join<T>& join) {
  const std::vector<JoinPiece<T>> pieces = join_pieces(a, b, join);
  if (pieces.size() != 1) return std::nullopt;
  std::vector<Vec<T, 4>> x = pieces[0].a[0], y = pieces[0].b[0];
  while (x.size() < y.size()) x = elevate_degree(std::move(x));
  while (y.size() < x.size()) y = elevate_degree(std::move(y));
  if (x.size() < 2) return std::nullopt;
  for (int i : {0, 1})
    for (const auto& p : {x[i], y[i]})
      if (*scalar_traits<T>::sign(p[3]) == Sign::zero) return std::nullopt;
  const T r = x[1][3] * y[0][3] / (x[0][3] * y[1][3]);
  if (*scalar_traits<T>::sign(r) != Sign::positive || r == T(1)) return std::nullopt;
  Join<T> candidate = join;
  candidate.pairing.kind = PairingKind::rational_linear;
  candidate.pairing.ratio = r;
  const std::vector<JoinPiece<T>> paired = join_pieces(a, b, candidate);
  return is_c0(join_forms<proof_ring_t<T>>(paired[0])) ? std::optional(candidate.pairing) : std::nullopt;
}

// A monotone piecewise linear pairing by nearest points, for edges that lie on each other but run differently.
// REQUIRES the ends already belong together. Refined until the paired points between the nodes are within `length`, or
// 1024 pieces.
template <ExactField T>
Pairing<T> nearest_point_pairing(const EdgeCurve& a, const EdgeCurve& b, const T& a0, const T& a1, const T& b0,
                                 const T& b1, double length) {
  const bool reversed = b1 < b0;
  const auto on_b = [&](double unit) { return b(reversed ? 1 - unit : unit); };
  // The nearest place within `reach` of the last one; farther when it lies at the end of the reach.
  const auto next_unit = [&](const Point3& q, double from, double reach) {
    while (true) {
      const double to = std::min(1.0, from + reach);
      const double found = reversed ? 1 - b.nearest(q, 1 - to, 1 - from).first : b.nearest(q, from, to).first;
      if (to == 1 || found < from + 0.9 * reach) return found;
      reach *= 2;
    }
  };
  std::vector<double> units;
  for (int pieces = 16; pieces <= 1024; pieces *= 2) {
    units.assign(1, 0.0);
    for (int i = 1; i < pieces; ++i) {
      const Point3 q = a(double(i) / pieces);
      const double from = units.back(), found = next_unit(q, from, 8.0 / pieces);
      // Strictly monotone, leaving room for the nodes that follow.
      units.push_back(std::clamp(found, from + 1e-3 / pieces, 1 - 1e-3 * (pieces - i) / pieces));
    }
    units.push_back(1);
    double worst = 0;
    for (int i = 0; i < pieces; ++i)
      worst = std::max(worst, distance(a((i + 0.5) / pieces), on_b((units[i] + units[i + 1]) / 2)));
    if (worst <= length) break;
  }
  Pairing<T> pairing;
  pairing.kind = PairingKind::piecewise_linear;
  const int pieces = static_cast<int>(units.size()) - 1;
  for (int i = 0; i <= pieces; ++i) {
    pairing.a.push_back(at_unit(a0, a1, T(T(i) / T(pieces))));
    pairing.b.push_back(at_unit(b0, b1, embed<T>(from_double(units[i]))));
  }
  return pairing;
}

// The parameter inside the curve's span around `unit` at which it passes exactly through the point, if that is a rational
// function of the data: the common root of X_c p_w − p_c w, found as their common divisor.
template <ExactField T>
std::optional<T> parameter_of_point(const BsplineCurve<T, 4>& row, const Vec<T, 4>& point, double unit) {
  const T &begin = row.knots().domain_begin(), &end = row.knots().domain_end();
  const int span = row.knots().find_span(at_unit(begin, end, embed<T>(from_double(std::clamp(unit, 0.0, 1.0)))));
  const T &a = row.knots()[span], &b = row.knots()[span + 1];
  const std::vector<Vec<T, 4>> piece = bezier_coefficients(row, a, b);
  BinaryForm<T> common;
  for (int c = 0; c < 3; ++c) {
    std::vector<T> difference;
    for (const Vec<T, 4>& p : piece) difference.push_back(p[c] * point[3] - point[c] * p[3]);
    common = gcd(common, BinaryForm<T>::from_bernstein(std::move(difference)));
  }
  if (common.degree() > 1) {
    const BinaryForm<T> multiple = gcd(common, common.derivative());
    if (multiple.degree() > 0) common = divide_exactly(common, multiple);
  }
  if (common.degree() != 1) return std::nullopt;
  const T slope = common[1] - common[0];  // a0 (1 − t) + a1 t = 0
  if (*scalar_traits<T>::sign(slope) == Sign::zero) return std::nullopt;
  const T t = -common[0] / slope;
  if (t < T(0) || T(1) < t) return std::nullopt;
  return at_unit(a, b, t);
}

// The exact parameter, near `unit`, of the place of a curve where another edge ends at `point`: the place itself when it is
// on the curve, else a knot, a simple fraction or the double found, whichever comes closest.
template <ExactField T>
T exact_parameter(const BsplineCurve<T, 4>& row, const Vec<T, 4>& point, double unit) {
  if (const std::optional<T> exactly = parameter_of_point(row, point, unit)) return *exactly;
  const T &begin = row.knots().domain_begin(), &stop = row.knots().domain_end();
  std::vector<T> candidates;
  for (const T& k : row.knots().breaks())
    if (std::abs(nearest_double(T((k - begin) / (stop - begin))) - unit) < 1e-5) candidates.push_back(k);
  for (const double radius : {1e-5, 1e-7, 1e-9, 1e-11, 1e-13})
    candidates.push_back(at_unit(begin, stop, embed<T>(simplest_fraction(unit, radius))));
  candidates.push_back(at_unit(begin, stop, embed<T>(from_double(std::clamp(unit, 0.0, 1.0)))));
  std::optional<T> best_square;
  T best = candidates.front();
  for (const T& t : candidates) {
    const Vec<T, 4> h = evaluate(row, t);
    T square(0);
    for (int c = 0; c < 3; ++c) {
      const T d = h[c] / h[3] - point[c] / point[3];
      square += d * d;
    }
    if (!best_square || square < *best_square) best_square = square, best = t;
  }
  return best;
}

}  // namespace patchproof
