// SPDX-License-Identifier: Apache-2.0
// Open CASCADE: Geom_… D0, D1, D2, and GeomAdaptor_… with its cache of the last cell. (Its normal is made of D1, as its
// own tools do.) Surfaces and curves that are one Bézier patch over [0, 1] are given to it as such.
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TColGeom_Array2OfBezierSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

struct KnotsAndMultiplicities {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
};

KnotsAndMultiplicities grouped(std::span<const double> knots) {
  std::vector<double> distinct;
  std::vector<int> times;
  for (const double k : knots) {
    if (distinct.empty() || distinct.back() != k) {
      distinct.push_back(k);
      times.push_back(0);
    }
    ++times.back();
  }
  KnotsAndMultiplicities out{TColStd_Array1OfReal(1, static_cast<int>(distinct.size())),
                             TColStd_Array1OfInteger(1, static_cast<int>(distinct.size()))};
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    out.knots(static_cast<int>(i) + 1) = distinct[i];
    out.multiplicities(static_cast<int>(i) + 1) = times[i];
  }
  return out;
}

bool is_unit_bezier(int degree, std::span<const double> knots) {
  return knots.size() == 2 * (static_cast<std::size_t>(degree) + 1) && knots.front() == 0 && knots[degree] == 0 &&
         knots[degree + 1] == 1 && knots.back() == 1;
}

template <class Triple>
double* put(double* to, const Triple& p) {
  to[0] = p.X();
  to[1] = p.Y();
  to[2] = p.Z();
  return to + 3;
}

template <class Surface>
double* evaluate_at(const Surface& s, double u, double v, Quantities what, double* to) {
  gp_Pnt p;
  if (what == Quantities::points) {
    s.D0(u, v, p);
    return put(to, p);
  }
  gp_Vec du, dv;
  if (what == Quantities::second) {
    gp_Vec duu, dvv, duv;
    s.D2(u, v, p, du, dv, duu, dvv, duv);
    return put(put(put(put(put(put(to, p), du), dv), duu), duv), dvv);
  }
  s.D1(u, v, p, du, dv);
  to = put(put(put(to, p), du), dv);
  if (what == Quantities::normals) {
    const gp_Vec n = du.Crossed(dv);
    const double length = n.Magnitude();
    to = put(to, length > 0 ? n / length : n);
  }
  return to;
}

template <class Curve>
double* evaluate_at(const Curve& c, double t, Quantities what, double* to) {
  gp_Pnt p;
  if (what == Quantities::points) {
    c.D0(t, p);
    return put(to, p);
  }
  gp_Vec first;
  if (what == Quantities::second) {
    gp_Vec second;
    c.D2(t, p, first, second);
    return put(put(put(to, p), first), second);
  }
  c.D1(t, p, first);
  return put(put(to, p), first);
}

class OcctSurface : public PreparedSurface {
 public:
  OcctSurface(const SurfaceData& d, bool adaptor) : is_adaptor_(adaptor) {
    const int count_v = static_cast<int>(d.knots_v.size()) - d.degree_v - 1;
    const int count_u = static_cast<int>(d.points.size() / 3) / count_v;
    TColgp_Array2OfPnt points(1, count_u, 1, count_v);
    TColStd_Array2OfReal weights(1, count_u, 1, count_v);
    for (int i = 0; i < count_u; ++i)
      for (int j = 0; j < count_v; ++j) {
        const std::size_t k = static_cast<std::size_t>(i) * count_v + j;
        points(i + 1, j + 1) = gp_Pnt(d.points[3 * k], d.points[3 * k + 1], d.points[3 * k + 2]);
        weights(i + 1, j + 1) = d.weights.empty() ? 1 : d.weights[k];
      }
    if (is_unit_bezier(d.degree_u, d.knots_u) && is_unit_bezier(d.degree_v, d.knots_v)) {
      surface_ = d.weights.empty() ? new Geom_BezierSurface(points) : new Geom_BezierSurface(points, weights);
    } else {
      const auto u = grouped(d.knots_u), v = grouped(d.knots_v);
      spline_ = d.weights.empty() ? new Geom_BSplineSurface(points, u.knots, v.knots, u.multiplicities,
                                                            v.multiplicities, d.degree_u, d.degree_v)
                                  : new Geom_BSplineSurface(points, weights, u.knots, v.knots, u.multiplicities,
                                                            v.multiplicities, d.degree_u, d.degree_v);
      surface_ = spline_;
    }
    if (adaptor) adaptor_.Load(surface_);
  }

  std::optional<Placed> evaluate(std::span<const double> u, std::span<const double> v, Quantities what,
                                 std::span<double> room) override {
    double* to = room.data();
    for (std::size_t i = 0; i < u.size(); ++i) to = at(u[i], v[i], what, to);
    return Placed::records(room.data(), surface_vectors(what));
  }

  std::optional<Placed> evaluate_grid(std::span<const double> u, std::span<const double> v, Quantities what,
                                      std::span<double> room) override {
    double* to = room.data();
    for (const double x : u)
      for (const double y : v) to = at(x, y, what, to);
    return Placed::records(room.data(), surface_vectors(what));
  }

  bool refine(std::span<const double> u, std::span<const double> v, std::span<double> room) override {
    if (spline_.IsNull() || is_adaptor_) return false;
    const Handle(Geom_BSplineSurface) s = Handle(Geom_BSplineSurface)::DownCast(spline_->Copy());
    const auto insert = [](std::span<const double> knots, auto&& into) {
      const auto k = grouped(knots);
      into(k.knots, k.multiplicities);
    };
    insert(u, [&](const auto& k, const auto& m) { s->InsertUKnots(k, m, 0.0, Standard_True); });
    insert(v, [&](const auto& k, const auto& m) { s->InsertVKnots(k, m, 0.0, Standard_True); });
    double* to = room.data();
    if (!room.empty())
      for (int i = 1; i <= s->NbUPoles(); ++i)
        for (int j = 1; j <= s->NbVPoles(); ++j) to = put(to, s->Pole(i, j));
    return true;
  }

  bool extract_bezier(std::span<double> room) override {
    if (spline_.IsNull() || is_adaptor_) return false;
    GeomConvert_BSplineSurfaceToBezierSurface convert(spline_);
    TColGeom_Array2OfBezierSurface patches(1, convert.NbUPatches(), 1, convert.NbVPatches());
    convert.Patches(patches);
    double* to = room.data();
    if (!room.empty())
      for (int a = 1; a <= convert.NbUPatches(); ++a)
        for (int b = 1; b <= convert.NbVPatches(); ++b)
          for (int i = 1; i <= patches(a, b)->NbUPoles(); ++i)
            for (int j = 1; j <= patches(a, b)->NbVPoles(); ++j) to = put(to, patches(a, b)->Pole(i, j));
    return true;
  }

 private:
  double* at(double u, double v, Quantities what, double* to) const {
    return is_adaptor_ ? evaluate_at(adaptor_, u, v, what, to) : evaluate_at(*surface_, u, v, what, to);
  }

  bool is_adaptor_;
  Handle(Geom_Surface) surface_;
  Handle(Geom_BSplineSurface) spline_;
  GeomAdaptor_Surface adaptor_;
};

class OcctCurve : public PreparedCurve {
 public:
  OcctCurve(const CurveData& d, bool adaptor) : is_adaptor_(adaptor) {
    const int count = static_cast<int>(d.points.size() / 3);
    TColgp_Array1OfPnt points(1, count);
    TColStd_Array1OfReal weights(1, count);
    for (int i = 0; i < count; ++i) {
      points(i + 1) = gp_Pnt(d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2]);
      weights(i + 1) = d.weights.empty() ? 1 : d.weights[i];
    }
    if (is_unit_bezier(d.degree, d.knots)) {
      curve_ = d.weights.empty() ? new Geom_BezierCurve(points) : new Geom_BezierCurve(points, weights);
    } else {
      const auto k = grouped(d.knots);
      curve_ = d.weights.empty() ? new Geom_BSplineCurve(points, k.knots, k.multiplicities, d.degree)
                                 : new Geom_BSplineCurve(points, weights, k.knots, k.multiplicities, d.degree);
    }
    if (adaptor) adaptor_.Load(curve_);
  }

  std::optional<Placed> evaluate(std::span<const double> t, bool, Quantities what, std::span<double> room) override {
    double* to = room.data();
    if (is_adaptor_)
      for (const double x : t) to = evaluate_at(adaptor_, x, what, to);
    else
      for (const double x : t) to = evaluate_at(*curve_, x, what, to);
    return Placed::records(room.data(), curve_vectors(what));
  }

 private:
  bool is_adaptor_;
  Handle(Geom_Curve) curve_;
  GeomAdaptor_Curve adaptor_;
};

class Occt : public Peer {
 public:
  std::string name() const override { return "OCCT " OCC_VERSION_STRING_EXT; }
  std::vector<std::string> variants() const override { return {"Geom", "GeomAdaptor"}; }
  std::unique_ptr<PreparedSurface> prepare(const SurfaceData& d, int variant) const override {
    return unless_refused([&] { return std::make_unique<OcctSurface>(d, variant == 1); });
  }
  std::unique_ptr<PreparedCurve> prepare(const CurveData& d, int variant) const override {
    return unless_refused([&] { return std::make_unique<OcctCurve>(d, variant == 1); });
  }

 private:
  template <class Make>
  static auto unless_refused(Make make) -> decltype(make()) {
    try {
      return make();
    } catch (const Standard_Failure&) {  // e.g. a weight that is not positive, knots that it takes for equal
      return nullptr;
    }
  }
};

const bool kRegistered = register_peer(std::make_unique<Occt>());

}  // namespace
}  // namespace patchproof::peers
