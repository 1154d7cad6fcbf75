// SPDX-License-Identifier: Apache-2.0
#include "splines.h"

#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "exact_knots.h"
#include "patchproof/patch/denominator.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/reparametrize.h"

namespace patchproof::occt {
namespace {

using SurfaceHandle = opencascade::handle<Geom_BSplineSurface>;
using CurveHandle = opencascade::handle<Geom2d_BSplineCurve>;
using Patch = BsplinePatch<Rational, 4>;

// Of the parameters that a face's edges run through, in double.
struct Ranges {
  double from[2] = {1e300, 1e300}, to[2] = {-1e300, -1e300};
};
Ranges sampled_ranges(const TopoDS_Face& face) {
  Ranges out;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double first = 0, last = 0;
    const auto curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, first, last);
    if (curve.IsNull()) continue;
    for (int i = 0; i <= 32; ++i) {
      const gp_Pnt2d at = curve->Value(first + (last - first) * i / 32);
      for (int c = 0; c < 2; ++c) {
        out.from[c] = std::min(out.from[c], at.Coord(c + 1));
        out.to[c] = std::max(out.to[c], at.Coord(c + 1));
      }
    }
  }
  return out;
}

// A surface that is periodic in u, clamped over one period, over the whole periods that hold [from, to].
Patch unrolled(const Patch& patch, double from, double to) {
  const KnotVector<Rational>& k = patch.knots(Direction::u);
  const int p = k.degree(), rows = k.control_count(), columns = patch.count(Direction::v);
  const Rational period = k.domain_end() - k.domain_begin();
  const double begin = nearest_double(k.domain_begin()), length = nearest_double(period);
  const double slack = length * 0x1p-30;  // rounding
  constexpr int kMost = 8;
  int first = 0, last = 1;
  while (begin + first * length > from + slack && first > -kMost) --first;
  while (begin + last * length < to - slack && last < kMost) ++last;
  if (last - first == 1) return patch;
  std::vector<Rational> knots;
  std::vector<Vec<Rational, 4>> net;
  for (int copy = first; copy < last; ++copy) {
    const int skipped = copy == first ? 0 : 1;  // the row and the p + 1 knots at the joint stand once, p times
    if (skipped) knots.pop_back();
    for (int i = skipped * (p + 1); i < rows + p + 1; ++i) knots.push_back(k[i] + Rational(copy) * period);
    net.insert(net.end(), patch.net().begin() + skipped * columns, patch.net().end());
  }
  return Patch(KnotVector<Rational>::make_unchecked(p, std::move(knots)), patch.knots(Direction::v), std::move(net));
}

}  // namespace

Result<Patch> surface_of(const TopoDS_Face& face) {
  const auto bad = [](ErrorCode code, std::string message) { return Error{code, "", std::move(message), ""}; };
  auto any = BRep_Tool::Surface(face);
  if (any.IsNull()) return bad(ErrorCode::unsupported, "it has no surface");
  while (any->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
    any = opencascade::handle<Geom_RectangularTrimmedSurface>::DownCast(any)->BasisSurface();
  const SurfaceHandle given = SurfaceHandle::DownCast(any);
  if (given.IsNull()) return bad(ErrorCode::unsupported, "Open CASCADE's conversion to B-splines left another surface");
  const SurfaceHandle s = SurfaceHandle::DownCast(given->Copy());
  const bool periodic[2] = {s->IsUPeriodic(), s->IsVPeriodic()};
  if (periodic[0]) s->SetUNotPeriodic();
  if (periodic[1]) s->SetVNotPeriodic();
  auto u = knots_of(s->UDegree(), s->UKnots(), s->UMultiplicities());
  auto v = knots_of(s->VDegree(), s->VKnots(), s->VMultiplicities());
  if (!u) return bad(u.error().code, "its knots along u: " + u.error().message);
  if (!v) return bad(v.error().code, "its knots along v: " + v.error().message);
  const bool rational = s->IsURational() || s->IsVRational();  // else the weights may be anything
  std::vector<Vec<Rational, 4>> net;
  for (int i = 1; i <= s->NbUPoles(); ++i)
    for (int j = 1; j <= s->NbVPoles(); ++j) {
      const gp_Pnt p = s->Pole(i, j);
      const auto x = exact(p.X()), y = exact(p.Y()), z = exact(p.Z()), w = exact(rational ? s->Weight(i, j) : 1);
      if (!x || !y || !z || !w)
        return bad(ErrorCode::bad_number, fmt::format("control point ({}, {}) of its surface is not finite", i, j));
      net.push_back(to_homogeneous(Vec<Rational, 3>{{*x, *y, *z}}, *w));
    }
  Result<Patch> patch = Patch::make(*u, *v, std::move(net));
  if (!patch) return bad(patch.error().code, patch.error().message);
  if (!certify_denominator(*patch).is_nonzero())
    return bad(ErrorCode::vanishing_weight, "the denominator of its surface has a zero, or none could be excluded");
  if (!periodic[0] && !periodic[1]) return patch;
  const Ranges used = sampled_ranges(face);
  Patch whole = std::move(*patch);
  if (periodic[0]) whole = unrolled(whole, used.from[0], used.to[0]);
  if (periodic[1]) whole = swap_directions(unrolled(swap_directions(whole), used.from[1], used.to[1]));
  return whole;
}

Result<BsplineCurve<Rational, 3>> parameters_of(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  const auto bad = [](std::string message) { return Error{ErrorCode::unsupported, "", std::move(message), ""}; };
  double first = 0, last = 0;
  const auto any = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (any.IsNull()) return bad("it has no parameter curve on a face");
  const auto begin = exact(first), end = exact(last);
  if (!begin || !end || !(*begin < *end)) return bad("its range is empty or infinite");
  CurveHandle curve = CurveHandle::DownCast(any);
  if (curve.IsNull()) curve = Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(any, first, last));
  if (curve.IsNull()) return bad("its parameter curve is no B-spline");
  curve = CurveHandle::DownCast(curve->Copy());
  if (curve->IsPeriodic()) curve->SetNotPeriodic();
  const auto knots = knots_of(curve->Degree(), curve->Knots(), curve->Multiplicities());
  if (!knots) return bad("the knots of its parameter curve: " + knots.error().message);
  std::vector<Vec<Rational, 3>> points;
  for (int i = 1; i <= curve->NbPoles(); ++i) {
    const gp_Pnt2d p = curve->Pole(i);
    const auto u = exact(p.X()), v = exact(p.Y()), w = exact(curve->Weight(i));
    if (!u || !v || !w) return bad("a control point of its parameter curve is not finite");
    if (!(Rational(0) < *w)) return bad("its parameter curve has a weight that is not positive");
    points.push_back(to_homogeneous(Vec<Rational, 2>{{*u, *v}}, *w));
  }
  Result<BsplineCurve<Rational, 3>> made = BsplineCurve<Rational, 3>::make(*knots, std::move(points));
  if (!made) return bad(made.error().message);
  // The last digits of the range and of the knots may differ.
  const Rational from = std::max(*begin, knots->domain_begin()), to = std::min(*end, knots->domain_end());
  const Rational slack = (*end - *begin) / Rational(1000000);
  if (from - *begin > slack || *end - to > slack || !(from < to))
    return bad("its parameter curve does not cover its range");
  const BsplineCurve<Rational, 3> part = restrict(*made, from, to);
  // Both curves of a join run over the same numbers: a range that was cut by rounding is stretched back.
  return from == *begin && to == *end ? part : map_domain(part, *begin, *end);
}

}  // namespace patchproof::occt
