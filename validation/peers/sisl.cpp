// SPDX-License-Identifier: Apache-2.0
// SISL: s1421 (point, derivatives and normal; its usual evaluator) and s1424 (chosen derivatives) for scattered points,
// s1506 for grids, s1227 and s1221 for curves (derivatives from the left or the right of a knot: the right is asked for),
// s1025 refines, s1731 extracts.
#include <cmath>

#include "validation/peers/peer.h"

extern "C" {
#include <sisl.h>
}

namespace patchproof::peers {
namespace {

struct FreeSurface {
  void operator()(SISLSurf* s) const { freeSurf(s); }
};
struct FreeCurve {
  void operator()(SISLCurve* c) const { freeCurve(c); }
};

constexpr int kPolynomial = 1, kRational = 2, kCopy = 1;

// SISL's surfaces have u running fastest; rational points are homogeneous.
void append(std::vector<double>& to, const double* point, const double* weight) {
  for (int c = 0; c < 3; ++c) to.push_back(weight ? *weight * point[c] : point[c]);
  if (weight) to.push_back(*weight);
}

class SislSurface : public PreparedSurface {
 public:
  SislSurface(const SurfaceData& d, bool chosen) : chosen_(chosen) {
    const int count_v = static_cast<int>(d.knots_v.size()) - d.degree_v - 1;
    const int count_u = static_cast<int>(d.points.size() / 3) / count_v;
    std::vector<double> net;
    for (int j = 0; j < count_v; ++j)
      for (int i = 0; i < count_u; ++i) {
        const std::size_t k = static_cast<std::size_t>(i) * count_v + j;
        append(net, &d.points[3 * k], d.weights.empty() ? nullptr : &d.weights[k]);
      }
    surface_.reset(newSurf(count_u, count_v, d.degree_u + 1, d.degree_v + 1, const_cast<double*>(d.knots_u.data()),
                           const_cast<double*>(d.knots_v.data()), net.data(),
                           d.weights.empty() ? kPolynomial : kRational, 3, kCopy));
  }
  bool exists() const { return surface_ != nullptr; }

  std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                 std::span<double> room) override {
    const int vectors = surface_vectors(what), orders = what == Quantities::points   ? 0
                                                        : what == Quantities::second ? 2
                                                                                     : 1;
    if (chosen_ && orders == 2) return {};  // s1424 computes all S^(k,l) with k, l ≤ 2: s1421 is the faster one
    if (chosen_ && what == Quantities::normals) return {};
    int left_u = 0, left_v = 0, status = 0;
    double normal[3], all[12];
    double* to = room.data();
    for (std::size_t i = 0; i < u.size(); ++i, to += 3 * vectors) {
      double at[2] = {u[i], v[i]};
      if (!chosen_) {
        s1421(surface_.get(), orders, at, &left_u, &left_v, to, normal, &status);
        if (what == Quantities::normals) {
          const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
          for (int c = 0; c < 3; ++c) to[9 + c] = length > 0 ? normal[c] / length : 0;
        }
      } else {  // with orders (1, 1): S, S_u, S_v, S_uv
        double* const direct = orders == 0 ? to : all;
        s1424(surface_.get(), orders, orders, at, &left_u, &left_v, direct, &status);
        for (int k = 0; orders == 1 && k < 9; ++k) to[k] = all[k];
      }
      if (status < 0) return {};
    }
    return Placed::records(room.data(), vectors);
  }

  std::optional<Placed> evaluate_grid(std::span<const double> u, std::span<const double> v, Quantities what,
                                      std::span<double> room) override {
    if (chosen_ || what == Quantities::normals) return {};
    const int orders = what == Quantities::points ? 0 : what == Quantities::first ? 1 : 2;
    normals_.resize(orders > 0 ? 3 * u.size() * v.size() : 0);
    int status = 0;
    s1506(surface_.get(), orders, static_cast<int>(u.size()), const_cast<double*>(u.data()), static_cast<int>(v.size()),
          const_cast<double*>(v.data()), room.data(), orders > 0 ? normals_.data() : nullptr, &status);
    if (status < 0) return {};
    Placed placed = Placed::records(room.data(), surface_vectors(what));
    placed.u_fastest = true;
    return placed;
  }

  bool refine(std::span<const double> u, std::span<const double> v, std::span<double> room) override {
    SISLSurf* refined = nullptr;
    int status = 0;
    if (chosen_) return false;
    s1025(surface_.get(), const_cast<double*>(u.data()), static_cast<int>(u.size()), const_cast<double*>(v.data()),
          static_cast<int>(v.size()), &refined, &status);
    const std::unique_ptr<SISLSurf, FreeSurface> owner(refined);
    if (status < 0) return false;
    double* to = room.data();
    if (!room.empty())
      for (int i = 0; i < refined->in1; ++i)
        for (int j = 0; j < refined->in2; ++j) to = put_point(*refined, i, j, to);
    return true;
  }

  bool extract_bezier(std::span<double> room) override {
    SISLSurf* pieces = nullptr;
    int status = 0;
    if (chosen_) return false;
    s1731(surface_.get(), &pieces, &status);
    const std::unique_ptr<SISLSurf, FreeSurface> owner(pieces);
    if (status < 0) return false;
    double* to = room.data();
    if (!room.empty())
      for (int a = 0; a < pieces->in1; a += pieces->ik1)
        for (int b = 0; b < pieces->in2; b += pieces->ik2)
          for (int i = 0; i < pieces->ik1; ++i)
            for (int j = 0; j < pieces->ik2; ++j) to = put_point(*pieces, a + i, b + j, to);
    return true;
  }

 private:
  static double* put_point(const SISLSurf& s, int i, int j, double* to) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j) * s.in1 + i;
    const double* h = s.ikind == kRational ? s.rcoef + 4 * at : s.ecoef + 3 * at;
    for (int c = 0; c < 3; ++c) *to++ = s.ikind == kRational ? h[c] / h[3] : h[c];
    return to;
  }

  bool chosen_;
  std::unique_ptr<SISLSurf, FreeSurface> surface_;
  std::vector<double> normals_;
};

class SislCurve : public PreparedCurve {
 public:
  SislCurve(const CurveData& d, bool from_right) : from_right_(from_right) {
    std::vector<double> points;
    const int count = static_cast<int>(d.points.size() / 3);
    for (int i = 0; i < count; ++i) append(points, &d.points[3 * i], d.weights.empty() ? nullptr : &d.weights[i]);
    curve_.reset(newCurve(count, d.degree + 1, const_cast<double*>(d.knots.data()), points.data(),
                          d.weights.empty() ? kPolynomial : kRational, 3, kCopy));
  }
  bool exists() const { return curve_ != nullptr; }

  std::optional<Placed> evaluate(std::span<const double> t, bool, Quantities what, std::span<double> room) override {
    const int vectors = curve_vectors(what);
    int left = 0, status = 0;
    double* to = room.data();
    for (const double x : t) {
      (from_right_ ? s1221 : s1227)(curve_.get(), vectors - 1, x, &left, to, &status);
      if (status < 0) return {};
      to += 3 * vectors;
    }
    return Placed::records(room.data(), vectors);
  }

 private:
  bool from_right_;
  std::unique_ptr<SISLCurve, FreeCurve> curve_;
};

class Sisl : public Peer {
 public:
  std::string name() const override { return "SISL"; }
  std::vector<std::string> variants() const override { return {"s1421 s1221", "s1424 s1227"}; }
  std::unique_ptr<PreparedSurface> prepare(const SurfaceData& d, int variant) const override {
    auto s = std::make_unique<SislSurface>(d, variant == 1);
    if (!s->exists()) return nullptr;
    return s;
  }
  std::unique_ptr<PreparedCurve> prepare(const CurveData& d, int variant) const override {
    auto c = std::make_unique<SislCurve>(d, variant == 0);
    if (!c->exists()) return nullptr;
    return c;
  }
};

const bool kRegistered = register_peer(std::make_unique<Sisl>());

}  // namespace
}  // namespace patchproof::peers
