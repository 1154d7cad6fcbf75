// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/gerbs_join.h"

#include <algorithm>

#include "patchproof/deadline.h"
#include "patchproof/join/trimmed_join.h"
#include "patchproof/parallel.h"
#include "patchproof/spline/gerbs_spline.h"

namespace patchproof {
namespace {

using Curve = GerbsCurve<Rational, 4>;
using Surface = GerbsSurface<Rational, 4>;

// The edge's parameters on one side as a curve over those of side a.
BsplineCurve<Rational, 3> parameter_curve(const Join<Rational>& join, bool of_b) {
  const Pairing<Rational>& pairing = join.pairing;
  const IsoLine<Rational>& line = of_b ? join.line_b : join.line_a;
  std::vector<Rational> knots = pairing.a;
  knots.insert(knots.begin(), knots.front());
  knots.push_back(knots.back());
  std::vector<Vec<Rational, 3>> points;
  for (const Rational& t : of_b ? pairing.b : pairing.a) {
    // y = r x/(1 − x + r x): the weights 1 and r.
    const Rational w =
        of_b && pairing.kind == PairingKind::rational_linear && !points.empty() ? pairing.ratio : Rational(1);
    const Rational value = w * line.value, along = w * t;
    points.push_back(line.constant == Direction::u ? Vec<Rational, 3>{{value, along, w}}
                                                   : Vec<Rational, 3>{{along, value, w}});
  }
  return {KnotVector<Rational>::make_unchecked(1, std::move(knots)), std::move(points)};
}

// Whether t × s, with s into the patch and t along side a's edge, is −S_u × S_v.
bool is_against_normal(const IsoLine<Rational>& line, bool backwards) {
  return ((line.constant == Direction::u) != backwards) != (line.side == Side::left);
}

TrimmedSide trimmed_side(const BlendedSide& side, const Join<Rational>& join, bool of_b) {
  const bool against = is_against_normal(of_b ? join.line_b : join.line_a, of_b && join.pairing.reversed());
  return {side.surface, parameter_curve(join, of_b), against != of_b, side.gerbs};
}

// Whether f(t) = g(t + shift) on [begin, end]; false also where that cannot be told.
bool are_equal(const LocalCurve<Rational, 4>& f, const LocalCurve<Rational, 4>& g, const Rational& shift,
               const Rational& begin, const Rational& end) {
  const LocalCurve<Rational, 4> moved = g.shifted(-shift);
  if (f == moved) return true;
  if (f.basis().is_trigonometric() || g.basis().is_trigonometric()) return false;
  const auto part = [&](const LocalCurve<Rational, 4>& c) {
    return window(Piecewise<Rational, 4>(extract_bezier(c.spline())), begin, end);
  };
  return detail::are_equal(part(f), part(moved));
}

// The same, of GERBS curves made alike.
bool are_equal(const Curve& f, const Curve& g) {
  const KnotVector<Rational>&of_f = f.knots(), &of_g = g.knots();
  if (!(f.b_function() == g.b_function()) || of_f.control_count() != of_g.control_count()) return false;
  const Rational shift = of_g.domain_begin() - of_f.domain_begin();
  for (int i = 1; i <= of_f.control_count(); ++i)
    if (!(of_g[i] - of_f[i] == shift)) return false;
  for (int i = 0; i < of_f.control_count(); ++i) {
    const auto [begin, end] = detail::used_on(of_f, i);
    if (!are_equal(f.locals()[i], g.locals()[i], shift, begin, end)) return false;
  }
  return true;
}

std::optional<EdgeName> edge_at(const Surface& surface, const IsoLine<Rational>& line) {
  const KnotVector<Rational>& k = surface.knots(line.constant);
  const bool of_u = line.constant == Direction::u;
  if (line.value == k.domain_begin()) return of_u ? EdgeName::u_min : EdgeName::v_min;
  if (line.value == k.domain_end()) return of_u ? EdgeName::u_max : EdgeName::v_max;
  return std::nullopt;
}

// How many derivatives agree, proved; −1: not even the values, or nothing is proved.
struct Proved {
  int order = -1;
  const char* how = "";
  std::optional<Rational> ratio = std::nullopt;  // λ > 0 with y_s = −λ x_s: tangent planes agree
};

// A seam of a closed direction, run through in one direction.
Proved proved_by_closing(const BlendedSide& a, const BlendedSide& b, const Join<Rational>& join) {
  if (!a.gerbs || a.gerbs != b.gerbs || join.line_a.constant != join.line_b.constant ||
      join.line_a.value == join.line_b.value)
    return {};
  const Direction d = join.line_a.constant;
  if (!a.gerbs->axis(d).closed || !edge_at(*a.gerbs, join.line_a) || !edge_at(*a.gerbs, join.line_b)) return {};
  if (join.pairing.kind != PairingKind::identity || !(join.pairing.a == join.pairing.b)) return {};
  const Rational& seam = a.gerbs->knots(d).domain_begin();
  int order = a.gerbs->b_function().order().value_or(kOneFunction);
  for (int k = 0; k < a.gerbs->knots(other(d)).control_count(); ++k) {
    const LocalSurface<Rational, 4>& local = d == Direction::u ? a.gerbs->local(0, k) : a.gerbs->local(k, 0);
    if (const KnotVector<Rational>* knots = local.basis(d).knots()) {
      const Rational at = seam - local.shift(d);
      if (knots->domain_begin() < at && at < knots->domain_end() && knots->multiplicity(at) > 0)
        order = std::min(order, knots->degree() - knots->multiplicity(at));
    }
  }
  return {order, "the surface closes here"};
}

// How much longer f is than g where they begin, with its sign; 0 where g is zero there, nothing where values are transcendental.
std::optional<Rational> speed_ratio(const Curve& f, const Curve& g) {
  const auto begin = [](const Curve& c) {
    const Rational& t = c.knots().domain_begin();
    return derivatives_at<Rational>(c.locals().front(), t, Side::right, t, 0)[0];
  };
  if (f.locals().front().basis().is_trigonometric() || g.locals().front().basis().is_trigonometric())
    return Rational(1);
  const Vec<Rational, 3> of_f = begin(f), of_g = begin(g);
  for (int c = 0; c < 3; ++c)
    if (!(of_g[c] == Rational(0))) return of_f[c] / of_g[c];
  return Rational(0);
}

// Edges made alike, run through in one direction at one speed.
Proved proved_by_make(const BlendedSide& a, const BlendedSide& b, const Join<Rational>& join) {
  if (!a.gerbs || !b.gerbs || join.pairing.kind != PairingKind::identity || join.pairing.reversed()) return {};
  const auto of_a = edge_at(*a.gerbs, join.line_a), of_b = edge_at(*b.gerbs, join.line_b);
  if (!of_a || !of_b) return {};
  const auto splines_across = [](const Surface& s, EdgeName name) {
    const Direction d = name == EdgeName::u_min || name == EdgeName::u_max ? Direction::u : Direction::v;
    bool plain = true;  // not both rational and trigonometric
    for (int p = 0; p < s.knots(Direction::u).control_count(); ++p)
      for (int q = 0; q < s.knots(Direction::v).control_count(); ++q) {
        if (s.local(p, q).basis(d).is_trigonometric()) return -1;
        plain = plain && (s.local(p, q).has_unit_weights() || !s.local(p, q).is_trigonometric());
      }
    return plain && s.b_function().order().value_or(1) >= 1 ? 1 : 0;
  };
  const int most = std::min(splines_across(*a.gerbs, *of_a), splines_across(*b.gerbs, *of_b));
  Proved out{-1, "the edges are made alike"};
  if (most >= 0 && are_equal(edge(*a.gerbs, *of_a), edge(*b.gerbs, *of_b))) out.order = 0;
  if (out.order < 0 || most < 1) return out;
  // The derivatives across point the same way in both parameters where one edge begins what the other ends.
  const Rational sign(join.line_a.side == join.line_b.side ? -1 : 1);
  const Curve across = edge(*a.gerbs, *of_a, 1);
  const std::optional<Rational> speed = speed_ratio(across, edge(*b.gerbs, *of_b, 1));
  const Rational factor = speed ? Rational(sign * *speed) : Rational(1);
  if (!(Rational(0) < factor)) return out;
  const Surface scaled = b.gerbs->map_locals([&](const auto& c) {
    return c.map_points([&](Vec<Rational, 4> p) {
      for (int i = 0; i < 3; ++i) p[i] = sign * factor * p[i];
      return p;
    });
  });
  if (!are_equal(across, edge(scaled, *of_b, 1))) return out;
  out.ratio = Rational(1) / factor;
  if (factor == Rational(1)) out.order = 1;
  return out;
}

Vec<double, 3> point_at(const BlendedSide& side, const Vec<Rational, 2>& at) {
  std::array<Rational, 2> inside;
  for (const Direction d : {Direction::u, Direction::v}) {
    const int i = d == Direction::u ? 0 : 1;
    const KnotVector<Rational>& k = side.surface->knots(d);
    inside[i] = std::clamp(at[i], k.domain_begin(), k.domain_end());
  }
  const double u = nearest_double(at[0]), v = nearest_double(at[1]);
  if (side.gerbs)
    return partial_derivatives_at<double>(*side.gerbs, inside, {Side::right, Side::right}, u, v, 0, 0).at(0, 0);
  const int span_u = side.surface->knots(Direction::u).find_span(inside[0]),
            span_v = side.surface->knots(Direction::v).find_span(inside[1]);
  return project(evaluate_in_span<double>(*side.surface, span_u, span_v, u, v));
}

EnclosedMaximum located(const TrimmedJoin& trimmed, const BlendedSide& a, const TrimmedBound& bound) {
  EnclosedMaximum out{bound.lower, bound.upper, {}, bound.converged};
  const Vec<Rational, 2> of_a = evaluate_rational(trimmed.a.parameters, bound.t),
                         of_b = evaluate_rational(trimmed.b.parameters, bound.t);
  const Vec<double, 3> point = point_at(a, of_a);
  for (int i = 0; i < 2; ++i) out.at.a[i] = nearest_double(of_a[i]), out.at.b[i] = nearest_double(of_b[i]);
  for (int c = 0; c < 3; ++c) out.at.point[c] = point[c];
  return out;
}

}  // namespace

Certificate certify_blended_join(const BlendedSide& a, const BlendedSide& b, const Join<Rational>& join,
                                 const Request& request) {
  const TrimmedJoin trimmed{trimmed_side(a, join, false), trimmed_side(b, join, true)};
  Budget budget;
  budget.nodes = 500;
  budget.deadline = seconds_from_now(request.seconds_per_join);
  const TrimmedBounds bounds = [&] {  // what follows in doubles is rounded to nearest
    const RoundingGuard guard;
    return bound_trimmed(trimmed, budget);
  }();
  Proved proved = proved_by_closing(a, b, join);
  if (proved.order < 1)
    if (const Proved also = proved_by_make(a, b, join); also.order >= proved.order) proved = also;

  Certificate out;
  out.rung = "taylor";
  out.gap = located(trimmed, a, bounds.gap);
  out.angle = located(trimmed, a, bounds.angle);
  out.plane_angle = located(trimmed, a, bounds.plane_angle);
  if (join.pairing.kind == PairingKind::piecewise_linear)
    out.gap.lower = 0;  // found numerically: says nothing about the curves
  const bool regular = out.angle.upper < 90;
  if (proved.order >= 0) out.gap = {0, 0, out.gap.at, true};
  if ((proved.order >= 1 || proved.ratio) && regular)
    for (EnclosedMaximum* angle : {&out.angle, &out.plane_angle}) *angle = {0, 0, angle->at, true};
  const auto up_to = [&](int order, bool also = true) -> ExactClass {
    if (proved.order >= order && also) return {Verdict::proven, proved.how, std::nullopt};
    return {Verdict::undecided, "the edge is bounded, not decided", std::nullopt};
  };
  out.c0 = up_to(0);
  out.c1 = up_to(1);
  out.c2 = up_to(2);
  out.g1 = up_to(proved.ratio ? 0 : 1, regular);
  if (out.g1.verdict == Verdict::proven) out.ratio = proved.ratio ? to_text(*proved.ratio) : "1";
  if (out.gap.lower > 0) {
    out.c0 = {Verdict::refuted, "the edges are apart by more than 0, enclosed", std::nullopt};
    for (ExactClass* c : {&out.c1, &out.c2, &out.g1}) *c = {Verdict::refuted, "not C0", std::nullopt};
  } else if (out.plane_angle.lower > 0) {
    for (ExactClass* c : {&out.c1, &out.c2, &out.g1})
      *c = {Verdict::refuted, "the normals enclose an angle above 0, enclosed", std::nullopt};
  }
  out.orientation = regular ? Orientation::smooth : out.angle.lower > 90 ? Orientation::mixed : Orientation::unknown;
  return out;
}

std::vector<Certificate> certify_blended_joins(const std::vector<BlendedSide>& surfaces,
                                               const std::vector<Join<Rational>>& joins, const Request& request,
                                               int jobs) {
  std::vector<Certificate> out(joins.size());
  for_each_item(jobs, joins.size(), [&](std::size_t i) {
    out[i] = certify_blended_join(surfaces[joins[i].patch_a], surfaces[joins[i].patch_b], joins[i], request);
  });
  return out;
}

}  // namespace patchproof
