// SPDX-License-Identifier: Apache-2.0
// Lines inside a GERBS surface that is no spline where it may be torn or have a crease.
#include <algorithm>
#include <limits>

#include "patchproof/join/certify.h"
#include "patchproof/join/gerbs_join.h"
#include "patchproof/scalar/ball.h"

namespace patchproof {
namespace {

using Surface = GerbsSurface<Rational, 4>;
using Local = LocalSurface<Rational, 4>;

// Rows p of local surfaces that count on both sides of u = x (or columns, of v = x).
struct Rows {
  int first, last;
  bool centre = false;  // the only row, and the B-function has order 1 or more there
};

Rows rows_at(const Surface& surface, Direction d, const Rational& x) {
  const KnotVector<Rational>& knots = surface.knots(d);
  const int left = knots.find_span(x, Side::left), right = knots.find_span(x, Side::right);
  if (left == right) return {left - 1, left};
  const bool flat = surface.b_function().order().value_or(1) >= 1;
  if (right == left + 1 && flat) return {left, left, true};
  return {left - 1, right};
}

const Local& local_in(const Surface& surface, Direction d, int row, int k) {
  return d == Direction::u ? surface.local(row, k) : surface.local(k, row);
}

bool may_be_kinked(const Local& local, Direction d, const Rational& x) {
  const KnotVector<Rational>* knots = local.basis(d).knots();
  if (!knots) return false;
  const Rational at = x - local.shift(d);
  return knots->domain_begin() < at && at < knots->domain_end() && knots->multiplicity(at) >= knots->degree();
}

Join<Rational> line_at(Direction d, const Rational& x, const KnotVector<Rational>& along) {
  Join<Rational> join;
  join.kind = JoinKind::knot_line;
  join.line_a = {d, x, Side::left};
  join.line_b = {d, x, Side::right};
  join.pairing.a = join.pairing.b = {along.domain_begin(), along.domain_end()};
  return join;
}

// Exact classes of local surfaces across the line. Empty: one cannot be told.
struct Across {
  bool c1 = true;
  std::optional<std::string> ratio;  // one for all, where they are G1
};
std::optional<Across> across(const Surface& surface, Direction d, const Rational& x, const Rows& rows,
                             const Request& request) {
  Across out;
  std::vector<const Local*> seen;
  for (int row = rows.first; row <= rows.last; ++row)
    for (int k = 0; k < surface.knots(other(d)).control_count(); ++k) {
      const Local& local = local_in(surface, d, row, k);
      if (std::any_of(seen.begin(), seen.end(), [&](const Local* s) { return *s == local; })) continue;
      seen.push_back(&local);
      const bool kinked = may_be_kinked(local, d, x);
      if (kinked && local.is_trigonometric()) return std::nullopt;
      std::string ratio = "1";
      if (kinked) {
        const auto patch = local.patch();
        const Certificate c =
            certify_join(patch, patch, line_at(d, x - local.shift(d), patch.knots(other(d))), request);
        if (c.g1.verdict != Verdict::proven || !c.ratio) return std::nullopt;
        ratio = *c.ratio;
        out.c1 = out.c1 && c.c1.verdict == Verdict::proven;
      }
      if (out.ratio && *out.ratio != ratio) return std::nullopt;
      out.ratio = ratio;
    }
  return out;
}

// What some places show: limits from both sides that certainly differ.
void refute_at_places(const Surface& surface, Direction d, const Rational& x, Certificate& out) {
  constexpr int kPlaces = 33;
  const KnotVector<Rational>& along = surface.knots(other(d));
  for (int k = 0; k < kPlaces; ++k) {
    const Rational y = along.domain_begin() +
                       (along.domain_end() - along.domain_begin()) * Rational(2 * k + 1) / Rational(2 * kPlaces);
    const std::array<Rational, 2> at = d == Direction::u ? std::array{x, y} : std::array{y, x};
    const auto limit = [&](Side side) {
      std::array<Side, 2> sides{Side::right, Side::right};
      sides[d == Direction::u ? 0 : 1] = side;
      return partial_derivatives_at<Ball>(surface, at, sides, Ball(at[0]), Ball(at[1]), 1, 1);
    };
    const auto a = limit(Side::left), b = limit(Side::right);
    const auto length = [](const Vec<Ball, 3>& v) { return sqrt(dot(v, v)); };
    Place place;
    for (int i = 0; i < 2; ++i) place.a[i] = place.b[i] = nearest_double(at[i]);
    for (int c = 0; c < 3; ++c) place.point[c] = a.at(0, 0)[c].to_interval().inf();
    if (const double gap = length(a.at(0, 0) - b.at(0, 0)).to_interval().inf(); gap > out.gap.lower) {
      out.gap.lower = gap;
      out.gap.at = place;
    }
    const Vec<Ball, 3> m = cross(a.at(1, 0), a.at(0, 1)), n = cross(b.at(1, 0), b.at(0, 1));
    const Ball sine = length(cross(m, n)), cosine = dot(m, n);
    if (cosine.sign() != Sign::positive || !(sine.to_interval().inf() > 0)) continue;
    const double angle = (atan(sine / cosine) * Ball(180) / Ball::pi()).to_interval().inf();
    if (angle > out.angle.lower) {
      out.angle.lower = out.plane_angle.lower = angle;
      out.angle.at = out.plane_angle.at = place;
    }
  }
}

}  // namespace

std::vector<InnerLine> certify_inner_lines(const Surface& surface, const Request& request) {
  std::vector<InnerLine> out;
  for (const Direction d : {Direction::u, Direction::v}) {
    const KnotVector<Rational>& along = surface.knots(other(d));
    const std::vector<Rational> breaks = surface.breaks(d);
    for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
      const Rational& x = breaks[i];
      const Rows rows = rows_at(surface, d, x);
      const bool is_knot = surface.knots(d).multiplicity(x) > 0;
      bool kinked = is_knot && !rows.centre;  // torn, or a B-function of order 0
      for (int row = rows.first; row <= rows.last && !kinked; ++row)
        for (int k = 0; k < along.control_count() && !kinked; ++k)
          kinked = may_be_kinked(local_in(surface, d, row, k), d, x);
      if (!kinked) continue;
      const std::optional<Across> exact = is_knot && !rows.centre ? std::nullopt : across(surface, d, x, rows, request);
      if (exact && exact->c1) continue;  // as smooth there as a line without a knot
      Certificate c;
      c.rung = "taylor";
      c.gap = {0, std::numeric_limits<double>::infinity(), {}, false};
      c.angle = {0, 180, {}, false};
      c.plane_angle = {0, 90, {}, false};
      for (ExactClass* of : {&c.c0, &c.c1, &c.c2, &c.g1})
        of->reason = "a line inside a GERBS surface is looked at in places only";
      if (exact && rows.centre) {  // S_u from the left is a multiple of that from the right, as for the local surfaces
        c.c0 = c.g1 = {Verdict::proven, "so are the local surfaces along it", std::nullopt};
        c.ratio = exact->ratio;
        c.gap = c.angle = c.plane_angle = {0, 0, {}, true};
        c.orientation = Orientation::smooth;
      } else {
        refute_at_places(surface, d, x, c);
        const auto refute = [](ExactClass& of, const char* why) { of = {Verdict::refuted, why, std::nullopt}; };
        if (c.gap.lower > 0) refute(c.c0, "the limits from both sides differ, enclosed");
        if (c.gap.lower > 0 || c.angle.lower > 0)
          for (ExactClass* of : {&c.c1, &c.c2, &c.g1}) refute(*of, "limits from both sides differ, enclosed");
      }
      out.push_back({line_at(d, x, along), std::move(c)});
    }
  }
  return out;
}

}  // namespace patchproof
