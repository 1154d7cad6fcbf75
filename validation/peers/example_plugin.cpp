// SPDX-License-Identifier: Apache-2.0
// A plug-in to copy: the library's own templates, run in double one parameter at a time.
//
//   g++ -std=c++20 -O2 -ffp-contract=off -shared -fPIC -I. -Iinclude validation/peers/example_plugin.cpp -o template.so -lgmp
//   build/release/patchproof_peers --plugin ./template.so
#include "patchproof/patch/rational_patch.h"
#include "patchproof/spline/homogeneous.h"
#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

std::vector<Vec<double, 4>> homogeneous(std::span<const double> points, std::span<const double> weights) {
  std::vector<Vec<double, 4>> out;
  for (std::size_t i = 0; 3 * i < points.size(); ++i)
    out.push_back(to_homogeneous(Vec<double, 3>{{points[3 * i], points[3 * i + 1], points[3 * i + 2]}},
                                 weights.empty() ? 1.0 : weights[i]));
  return out;
}

KnotVector<double> knot_vector(int degree, std::span<const double> knots) {
  return KnotVector<double>::make(degree, {knots.begin(), knots.end()}).value();
}

class TemplateSurface : public PreparedSurface {
 public:
  explicit TemplateSurface(const SurfaceData& d)
      : patch_(knot_vector(d.degree_u, d.knots_u), knot_vector(d.degree_v, d.knots_v),
               homogeneous(d.points, d.weights)) {}

  std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                 std::span<double> room) override {
    if (what == Quantities::normals) return {};
    const int order = what == Quantities::points ? 0 : what == Quantities::first ? 1 : 2;
    double* to = room.data();
    for (std::size_t i = 0; i < u.size(); ++i) {
      const PartialDerivatives<double, 3> s = rational_derivatives(patch_, u[i], v[i], order, order);
      for (int total = 0; total <= order; ++total)
        for (int l = 0; l <= total; ++l)
          for (const double x : s.at(total - l, l).c) *to++ = x;
    }
    return Placed::records(room.data(), surface_vectors(what));
  }

 private:
  BsplinePatch<double, 4> patch_;
};

class TemplateCurve : public PreparedCurve {
 public:
  explicit TemplateCurve(const CurveData& d)
      : curve_(knot_vector(d.degree, d.knots), homogeneous(d.points, d.weights)) {}

  std::optional<Placed> evaluate(std::span<const double> t, bool, Quantities what, std::span<double> room) override {
    double* to = room.data();
    for (const double x : t)
      for (const Vec<double, 3>& c : rational_derivatives(curve_, x, curve_vectors(what) - 1))
        for (const double y : c.c) *to++ = y;
    return Placed::records(room.data(), curve_vectors(what));
  }

 private:
  BsplineCurve<double, 4> curve_;
};

class Template : public Peer {
 public:
  std::string name() const override { return "template"; }
  std::vector<std::string> variants() const override { return {"double"}; }
  std::unique_ptr<PreparedSurface> prepare(const SurfaceData& d, int) const override {
    return std::make_unique<TemplateSurface>(d);
  }
  std::unique_ptr<PreparedCurve> prepare(const CurveData& d, int) const override {
    return std::make_unique<TemplateCurve>(d);
  }
};

}  // namespace
}  // namespace patchproof::peers

extern "C" patchproof::peers::Peer* patchproof_peer() { return new patchproof::peers::Template; }
