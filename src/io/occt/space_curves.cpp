// SPDX-License-Identifier: Apache-2.0
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>

#include "exact_knots.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/curve_denominator.h"
#include "patchproof/spline/homogeneous.h"
#include "splines.h"

namespace patchproof::occt {
namespace {

using Curve = BsplineCurve<Rational, 4>;
using CurveHandle = opencascade::handle<Geom_Curve>;
using SplineHandle = opencascade::handle<Geom_BSplineCurve>;

const char* kind_of(const CurveHandle& curve) {
  switch (GeomAdaptor_Curve(curve).GetType()) {
    case GeomAbs_Line: return "line";
    case GeomAbs_Circle: return "circle";
    case GeomAbs_Ellipse: return "ellipse";
    case GeomAbs_Hyperbola: return "hyperbola";
    case GeomAbs_Parabola: return "parabola";
    case GeomAbs_BezierCurve: return "bezier";
    case GeomAbs_BSplineCurve: return "bspline";
    case GeomAbs_OffsetCurve: return "offset";
    default: return "other";
  }
}

Error bad(ErrorCode code, std::string message) { return {code, "", std::move(message), ""}; }

// The homogeneous control point; nothing when a number is not finite.
std::optional<Vec<Rational, 4>> control_point(const gp_Pnt& p, double weight) {
  const auto x = exact(p.X()), y = exact(p.Y()), z = exact(p.Z()), w = exact(weight);
  if (!x || !y || !z || !w) return std::nullopt;
  return to_homogeneous(Vec<Rational, 3>{{*x, *y, *z}}, *w);
}

template <class Handle>
Result<std::vector<Vec<Rational, 4>>> net_of(const Handle& curve) {
  std::vector<Vec<Rational, 4>> net;
  for (int i = 1; i <= curve->NbPoles(); ++i) {
    // Without IsRational() the weights may be anything.
    const auto p = control_point(curve->Pole(i), curve->IsRational() ? curve->Weight(i) : 1);
    if (!p) return bad(ErrorCode::bad_number, "control point " + std::to_string(i) + " of its curve is not finite");
    net.push_back(*p);
  }
  return net;
}

Result<Curve> spline_of(const CurveHandle& curve) {
  if (const auto bezier = opencascade::handle<Geom_BezierCurve>::DownCast(curve); !bezier.IsNull()) {
    auto net = net_of(bezier);
    if (!net) return net.error();
    return Curve::bezier(std::move(*net));
  }
  const SplineHandle spline = SplineHandle::DownCast(curve);
  if (spline.IsNull()) return bad(ErrorCode::unsupported, "its curve is no B-spline");
  auto net = net_of(spline);
  if (!net) return net.error();
  auto knots = knots_of(spline->Degree(), spline->Knots(), spline->Multiplicities());
  if (!knots) return bad(knots.error().code, "the knots of its curve: " + knots.error().message);
  return Curve::make(std::move(*knots), std::move(*net));
}

// P + t D for t in [first, last].
Result<Curve> segment_of(const opencascade::handle<Geom_Line>& line, const Rational& first, const Rational& last) {
  const gp_Lin l = line->Lin();
  const auto p = control_point(l.Location(), 1), d = control_point(gp_Pnt(l.Direction().XYZ()), 1);
  if (!p || !d) return bad(ErrorCode::bad_number, "its line is not finite");
  std::vector<Vec<Rational, 4>> ends;
  for (const Rational& t : {first, last})
    ends.push_back({{(*p)[0] + t * (*d)[0], (*p)[1] + t * (*d)[1], (*p)[2] + t * (*d)[2], Rational(1)}});
  return Curve(KnotVector<Rational>::bezier(1, first, last), std::move(ends));
}

}  // namespace

Result<SpaceCurve> curve_of(const TopoDS_Edge& edge) {
  double first = 0, last = 0;
  CurveHandle any = BRep_Tool::Curve(edge, first, last);
  if (any.IsNull()) return bad(ErrorCode::unsupported, "no face uses it, and it has no curve in space");
  // Beyond ±1e100 Open CASCADE means infinity.
  const auto begin = exact(first), end = exact(last);
  if (!begin || !end || !(*begin < *end) || first < -1e99 || last > 1e99)
    return bad(ErrorCode::unsupported, "no face uses it, and its range is empty or infinite");
  while (any->IsKind(STANDARD_TYPE(Geom_TrimmedCurve)))
    any = opencascade::handle<Geom_TrimmedCurve>::DownCast(any)->BasisCurve();
  const char* kind = kind_of(any);
  if (const auto line = opencascade::handle<Geom_Line>::DownCast(any); !line.IsNull()) {
    const Result<Curve> segment = segment_of(line, *begin, *end);
    if (!segment) return segment.error();
    return SpaceCurve{*segment, kind};
  }
  if (auto spline = SplineHandle::DownCast(any); !spline.IsNull() && spline->IsPeriodic()) {
    spline = SplineHandle::DownCast(spline->Copy());
    spline->SetNotPeriodic();
    any = spline;
  }
  const auto covers = [&](const Curve& c) {
    // The last digits of the range and of the knots may differ.
    const Rational slack = (*end - *begin) / Rational(1000000);
    return c.knots().domain_begin() - *begin <= slack && *end - c.knots().domain_end() <= slack;
  };
  const bool is_spline =
      !SplineHandle::DownCast(any).IsNull() || !opencascade::handle<Geom_BezierCurve>::DownCast(any).IsNull();
  std::optional<Result<Curve>> spline;
  if (is_spline) spline.emplace(spline_of(any));
  bool converted = false;
  if (!spline || (*spline && !covers(**spline))) {
    // What is no spline, or runs over the end of a period.
    const auto made =
        GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(BRep_Tool::Curve(edge, first, last), first, last));
    if (made.IsNull()) return bad(ErrorCode::unsupported, "its curve is no B-spline");
    if (made->IsPeriodic()) made->SetNotPeriodic();
    spline.emplace(spline_of(made));
    converted = true;
  }
  if (!*spline) return spline->error();
  const Curve& whole = **spline;
  if (!covers(whole)) return bad(ErrorCode::unsupported, "its curve does not cover its range");
  if (!certify_denominator(whole).is_nonzero())
    return bad(ErrorCode::vanishing_weight, "the denominator of its curve has a zero");
  const Rational from = std::max(*begin, whole.knots().domain_begin()), to = std::min(*end, whole.knots().domain_end());
  if (!(from < to)) return bad(ErrorCode::unsupported, "its curve does not cover its range");
  return SpaceCurve{restrict(whole, from, to), kind, converted};
}

}  // namespace patchproof::occt
