// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include "patchproof/deadline.h"
#include "patchproof/join/certify.h"
#include "patchproof/join/trimmed_join.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/parse_scalar.h"
#include "trimmed_distance.h"

namespace patchproof {
namespace {

using Parameters = Vec<Rational, 2>;

Parameters parameters_at(const TrimmedSide& side, const Rational& t) { return evaluate_rational(side.parameters, t); }

// Where a parameter curve leaves the domain, the surface's outermost polynomials go on, as in the bounds.
Vec<Rational, 3> point_at(const TrimmedSide& side, const Parameters& at) {
  Parameters inside;
  int spans[2];
  for (const Direction d : {Direction::u, Direction::v}) {
    const KnotVector<Rational>& k = side.surface->knots(d);
    const int i = d == Direction::u ? 0 : 1;
    inside[i] = std::clamp(at[i], k.domain_begin(), k.domain_end());
    spans[i] = k.find_span(inside[i]);
  }
  const Vec<Rational, 4> h = evaluate_in_span<Rational>(*side.surface, spans[0], spans[1], at[0], at[1]);
  // Only within the domain is the denominator certified.
  return h[3] == Rational(0) ? evaluate_rational(*side.surface, inside[0], inside[1]) : project(h);
}

// The nearest doubles; about these, where there is no time left for an exact point.
Vec<double, 3> place_at(const TrimmedSide& side, const Parameters& at) {
  try {
    check_deadline();
    const Vec<Rational, 3> point = point_at(side, at);
    return {{nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])}};
  } catch (const deadline_passed&) {
    const KnotVector<Rational>&k = side.surface->knots(Direction::u), &l = side.surface->knots(Direction::v);
    const Rational u = std::clamp(at[0], k.domain_begin(), k.domain_end()),
                   v = std::clamp(at[1], l.domain_begin(), l.domain_end());
    return project(
        evaluate_in_span<double>(*side.surface, k.find_span(u), l.find_span(v), nearest_double(u), nearest_double(v)));
  }
}

EnclosedMaximum enclosed(const TrimmedJoin& join, const TrimmedBound& bound) {
  EnclosedMaximum out{bound.lower, bound.upper, {}, bound.converged};
  const Parameters a = parameters_at(join.a, bound.t), b = parameters_at(join.b, bound.t);
  const Vec<double, 3> point = place_at(join.a, a);
  for (int i = 0; i < 2; ++i) out.at.a[i] = nearest_double(a[i]), out.at.b[i] = nearest_double(b[i]);
  for (int c = 0; c < 3; ++c) out.at.point[c] = point[c];
  return out;
}

Witness gap_witness(const TrimmedJoin& join, const Rational& t) {
  const Parameters a = parameters_at(join.a, t), b = parameters_at(join.b, t);
  const Vec<Rational, 3> difference = point_at(join.a, a) - point_at(join.b, b);
  return {"x - y",
          {to_text(a[0]), to_text(a[1])},
          {to_text(b[0]), to_text(b[1])},
          {to_text(difference[0]), to_text(difference[1]), to_text(difference[2])}};
}

// A tolerance is exceeded when a point of one edge is farther than that from the whole of the other, not when two points
// that belong to one parameter are: parameter curves that a reader had to make up pair points along the edge, too.
void hold_against_whole_edges(EnclosedMaximum& gap, const TrimmedJoin& join, const Rational& t, double tolerance) {
  try {
    const Vec<Rational, 3> a = point_at(join.a, parameters_at(join.a, t)),
                           b = point_at(join.b, parameters_at(join.b, t));
    const double apart = std::max(distance_from_edge(a, join.b, tolerance), distance_from_edge(b, join.a, tolerance));
    if (apart > tolerance) return;
    gap.lower = std::min(gap.lower, apart);
  } catch (const deadline_passed&) {
    gap.lower = 0;
  }
  gap.converged = false;
}

}  // namespace

Certificate certify_trimmed(const TrimmedJoin& join, const Request& request) {
  const Rational slack = from_double(0x1p-40);
  if (const auto lines = to_isoparametric(join, slack))
    return certify_join(*join.a.surface, *join.b.surface, *lines, request);
  const RoundingGuard guard;
  // Some of the time is kept for the exact values of witnesses.
  const DeadlineScope scope(seconds_from_now(request.seconds_per_join));
  Budget budget;
  budget.nodes = 500;
  budget.deadline = seconds_from_now(0.9 * request.seconds_per_join);
  const TrimmedBounds bounds = bound_trimmed(join, budget);
  Certificate out;
  out.rung = "taylor";
  out.gap = enclosed(join, bounds.gap);
  const bool has_gap = out.gap.lower > 0;
  if (request.gap_tolerance && out.gap.lower > *request.gap_tolerance)
    hold_against_whole_edges(out.gap, join, bounds.gap.t, *request.gap_tolerance);
  out.angle = enclosed(join, bounds.angle);
  out.plane_angle = enclosed(join, bounds.plane_angle);
  for (const TrimmedPole& pole : bounds.poles)
    out.degenerate.push_back({pole.side, nearest_double(pole.begin), nearest_double(pole.end),
                              pole.left_out ? "the normal is rounding errors; left out of the angle"
                                            : "the normal vanishes; its limit is used"});
  out.orientation = out.angle.upper < 90   ? Orientation::smooth
                    : out.angle.lower > 90 ? Orientation::mixed  // somewhere above 90°; a cusp only if everywhere
                                           : Orientation::unknown;
  if (has_gap) {
    try {
      out.c0 = {Verdict::refuted, "the edge curves differ", gap_witness(join, bounds.gap.t)};
      for (ExactClass* c : {&out.c1, &out.c2, &out.g1}) *c = {Verdict::refuted, "not C0", std::nullopt};
    } catch (const deadline_passed&) {
      for (ExactClass* c : {&out.c0, &out.c1, &out.c2, &out.g1})
        *c = {Verdict::undecided, "there is a gap, but no time for a witness", std::nullopt};
    }
  } else {
    for (ExactClass* c : {&out.c0, &out.c1, &out.c2, &out.g1})
      *c = {Verdict::undecided, "a trimmed edge is bounded, not decided", std::nullopt};
  }
  return out;
}

}  // namespace patchproof
