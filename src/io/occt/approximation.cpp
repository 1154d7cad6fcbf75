// SPDX-License-Identifier: Apache-2.0
#include "approximation.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <vector>

namespace patchproof::occt {
namespace {

using SurfaceHandle = opencascade::handle<Geom_Surface>;
using SplineHandle = opencascade::handle<Geom_BSplineSurface>;

// Five parameters of each span, none of them a knot: there the approximation interpolates.
template <class Knots>
std::vector<double> parameters(const Knots& knots) {
  std::vector<double> out;
  for (int i = knots.Lower(); i < knots.Upper(); ++i)
    for (const double at : {0.02, 0.25, 0.5, 0.75, 0.98}) out.push_back(knots(i) + at * (knots(i + 1) - knots(i)));
  constexpr std::size_t kMost = 200;
  const std::size_t step = 1 + out.size() / kMost;
  std::vector<double> some;
  for (std::size_t i = 0; i < out.size(); i += step) some.push_back(out[i]);
  return some;
}

void compare(Approximation& out, const SurfaceHandle& original, const SplineHandle& spline, double u, double v) {
  gp_Pnt p, q;
  gp_Vec pu, pv, qu, qv;
  original->D1(u, v, p, pu, pv);
  spline->D1(u, v, q, qu, qv);
  out.length = std::max(out.length, p.Distance(q));
  const gp_Vec n = pu.Crossed(pv), m = qu.Crossed(qv);
  // Near poles normals have no direction in double.
  if (n.Magnitude() > 1e-9 * pu.Magnitude() * pv.Magnitude() && m.Magnitude() > 1e-9 * qu.Magnitude() * qv.Magnitude())
    out.degrees = std::max(out.degrees, std::atan2(n.Crossed(m).Magnitude(), n.Dot(m)) * 180 / M_PI);
}

bool same(const SplineHandle& a, const SplineHandle& b) {
  if (a.IsNull() || a->NbUPoles() != b->NbUPoles() || a->NbVPoles() != b->NbVPoles()) return false;
  for (int i = 1; i <= a->NbUPoles(); ++i)
    for (int j = 1; j <= a->NbVPoles(); ++j)
      if (a->Pole(i, j).Distance(b->Pole(i, j)) > 1e-9) return false;
  return true;
}

// Open CASCADE's figure, when approximating again gives the same surface.
double figure(const SurfaceHandle& original, const SplineHandle& spline) {
  constexpr double kTolerance = 1e-4;  // that of its conversion, as are the others
  constexpr int kDegree = 14;
  double u0, u1, v0, v1;
  spline->Bounds(u0, u1, v0, v1);
  const SurfaceHandle part = new Geom_RectangularTrimmedSurface(original, u0, u1, v0, v1);
  const GeomAdaptor_Surface adaptor(part);
  const int segments = 4 * (adaptor.NbUIntervals(GeomAbs_CN) + 1) * (adaptor.NbVIntervals(GeomAbs_CN) + 1);
  for (const GeomAbs_Shape smooth : {GeomAbs_C2, GeomAbs_C1, GeomAbs_C0}) {
    const GeomConvert_ApproxSurface again(part, kTolerance, smooth, smooth, kDegree, kDegree, segments, 1);
    if (again.HasResult() && same(again.Surface(), spline)) return again.MaxError();
  }
  return 0;
}

}  // namespace

SurfaceApproximation approximation_of(const TopoDS_Face& before, const TopoDS_Face& after) {
  const SurfaceHandle original = BRep_Tool::Surface(before);
  const SplineHandle spline = SplineHandle::DownCast(BRep_Tool::Surface(after));
  if (original.IsNull() || spline.IsNull()) return {};
  SurfaceApproximation out;
  for (const double u : parameters(spline->UKnots()))
    for (const double v : parameters(spline->VKnots())) compare(out.whole, original, spline, u, v);
  try {
    out.figure = figure(original, spline);
  } catch (const Standard_Failure&) {  // the samples remain
  }
  out.whole.length = std::max(out.whole.length, out.figure);
  return out;
}

Approximation approximation_along(const TopoDS_Edge& edge, const TopoDS_Face& before, const TopoDS_Face& after,
                                  double figure) {
  const SurfaceHandle original = BRep_Tool::Surface(before);
  const SplineHandle spline = SplineHandle::DownCast(BRep_Tool::Surface(after));
  double first = 0, last = 0;
  const auto curve = BRep_Tool::CurveOnSurface(edge, after, first, last);
  if (original.IsNull() || spline.IsNull() || curve.IsNull()) return {};
  Approximation out;
  constexpr int kSamples = 256;
  for (int i = 0; i <= kSamples; ++i) {
    const gp_Pnt2d at = curve->Value(first + (last - first) * i / kSamples);
    compare(out, original, spline, at.X(), at.Y());
  }
  out.length = std::max(out.length, figure);
  return out;
}

}  // namespace patchproof::occt
