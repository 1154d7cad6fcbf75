// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/trimmed_join.h"

#include <gtest/gtest.h>

#include <cmath>

#include "patchproof/join/certify.h"
#include "patchproof/patch/affine.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/rational_patch.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Patch = BsplinePatch<Rational, 4>;
using Curve = BsplineCurve<Rational, 3>;

Rational q(int n, int d = 1) { return Rational(n) / Rational(d); }
Vec<Rational, 3> uv(const Rational& u, const Rational& v, const Rational& w = Rational(1)) {
  return {{w * u, w * v, w}};
}

// A bicubic B-spline surface with knots at 1/3 and 2/3, a wavy sheet about 50 wide.
Patch sheet(RandomRationals& random, bool rational = false) {
  const auto k =
      KnotVector<Rational>::make(3, {q(0), q(0), q(0), q(0), q(1, 3), q(2, 3), q(1), q(1), q(1), q(1)}).value();
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto d = random.point<3>();
      const Rational w = rational ? q(20) + d[0] : q(1);
      net.push_back({{w * (q(10 * i) + d[0] / 10), w * (q(10 * j) + d[1] / 10), w * (d[2] / 4), w}});
    }
  return Patch(k, k, net);
}

// Curves that cross the knot lines several times.
Curve winding() {
  return Curve::bezier({uv(q(1, 10), q(1, 10)), uv(q(9, 10), q(1, 5)), uv(q(1, 2), q(9, 10)), uv(q(19, 20), q(9, 10))});
}
Curve rational_arc() {
  return Curve::bezier({uv(q(1, 5), q(1, 5)), uv(q(3, 4), q(1, 5), q(2)), uv(q(3, 4), q(3, 4), q(1, 2))});
}

struct Values {
  double gap, angle;
};
// In double, from exact points and normals.
Values at(const TrimmedJoin& join, const Rational& t) {
  Vec<Rational, 3> point[2], normals[2];
  const TrimmedSide* const sides[2] = {&join.a, &join.b};
  for (int s = 0; s < 2; ++s) {
    const auto c = evaluate_rational(sides[s]->parameters, t);
    point[s] = evaluate_rational(*sides[s]->surface, c[0], c[1]);
    normals[s] = normal(*sides[s]->surface, c[0], c[1]);
    if (sides[s]->flipped) normals[s] = -normals[s];
  }
  const Vec<Rational, 3> d = point[0] - point[1], n = cross(normals[0], normals[1]);
  return {std::sqrt(nearest_double(dot(d, d))),
          std::atan2(std::sqrt(nearest_double(dot(n, n))), nearest_double(dot(normals[0], normals[1]))) * 180 / M_PI};
}

// No sample above the upper bounds, and the lower bounds are attained where they say.
void expect_encloses(const TrimmedJoin& join, const TrimmedBounds& bounds) {
  constexpr double kSlack = 1e-12;  // of the doubles in `at`
  const auto& k = join.a.parameters.knots();
  for (int i = 0; i <= 64; ++i) {
    const Values x = at(join, k.domain_begin() + (k.domain_end() - k.domain_begin()) * q(i, 64));
    EXPECT_LE(x.gap, bounds.gap.upper * (1 + kSlack));
    EXPECT_LE(x.angle, bounds.angle.upper + 1e-5);  // an angle near 0 or 180 from atan2 of a rounded root
    EXPECT_LE(std::min(x.angle, 180 - x.angle), bounds.plane_angle.upper + 1e-5);
  }
  EXPECT_GE(at(join, bounds.gap.t).gap, bounds.gap.lower * (1 - kSlack));
  EXPECT_GE(at(join, bounds.angle.t).angle, bounds.angle.lower * (1 - kSlack) - 1e-5);
}

class TrimmedJoins : public ::testing::Test {
 private:
  RoundingGuard guard_;
};

TEST_F(TrimmedJoins, Law1_GapAndAngleAreEnclosedTightly) {
  RandomRationals random;
  for (const bool rational : {false, true}) {
    const Patch a = sheet(random, rational), b = sheet(random, rational);
    for (const Curve& c : {winding(), rational_arc()}) {
      const TrimmedJoin join{{&a, c, false}, {&b, c, true}};
      const TrimmedBounds bounds = bound_trimmed(join);
      expect_encloses(join, bounds);
      EXPECT_TRUE(bounds.gap.converged && bounds.gap.lower > 0);
      EXPECT_TRUE(bounds.angle.converged && bounds.angle.lower > 90);
      EXPECT_EQ(bounds.outside, 0);
    }
  }
}

TEST_F(TrimmedJoins, Law1_ATinyShiftIsMeasured) {
  RandomRationals random;
  const Patch a = sheet(random);
  for (const Rational& shift : {q(1, 1000), q(1, 100000000)}) {
    const Patch b = apply(translation(Vec<Rational, 3>{{q(0), q(0), shift}}), a);
    const TrimmedBounds bounds = bound_trimmed({{&a, winding(), false}, {&b, winding(), false}});
    EXPECT_LE(bounds.gap.lower, nearest_double(shift));
    EXPECT_GE(bounds.gap.upper, nearest_double(shift));
    EXPECT_LE(bounds.gap.upper - bounds.gap.lower, bounds.gap.upper / 100);
    EXPECT_LE(bounds.angle.upper, 1e-9);
  }
}

// An angle of 1e-7 degrees along a whole curve, with a width below 1 %.
TEST_F(TrimmedJoins, Law1_ATinyAngleIsMeasured) {
  const auto k = KnotVector<Rational>::bezier(1);
  const auto plane = [&](const Rational& slope) {
    return Patch(k, k,
                 {{{q(0), q(0), q(0), q(1)}},
                  {{q(0), q(1), slope, q(1)}},
                  {{q(1), q(0), q(0), q(1)}},
                  {{q(1), q(1), slope, q(1)}}});
  };
  const Rational slope = Rational(1745329252) / Rational(1000000000LL) / Rational(1000000000LL);  // tan 1e-7°
  const Patch a = plane(q(0)), b = plane(slope);
  const TrimmedBounds bounds = bound_trimmed({{&a, rational_arc(), false}, {&b, rational_arc(), false}});
  EXPECT_NEAR(bounds.angle.lower, 1e-7, 1e-9);
  EXPECT_NEAR(bounds.angle.upper, 1e-7, 1e-9);
  EXPECT_TRUE(bounds.angle.converged);
}

TEST_F(TrimmedJoins, Law2_EqualEdgesAreBoundedByRoundingErrors) {
  RandomRationals random;
  const Patch a = sheet(random);
  const Patch b = elevate_degree(insert_knot(a, Direction::u, q(2, 5)), Direction::v, 1);
  const TrimmedBounds bounds = bound_trimmed({{&a, winding(), false}, {&b, winding(), false}});
  EXPECT_EQ(bounds.gap.lower, 0);
  EXPECT_LE(bounds.gap.upper, 100 * 0x1p-36);  // of an edge less than 100 long
  EXPECT_TRUE(bounds.gap.converged && bounds.angle.converged);
  EXPECT_LE(bounds.angle.upper, 1e-9);
  const TrimmedBounds back = bound_trimmed({{&a, winding(), false}, {&b, winding(), true}});
  EXPECT_GE(back.angle.upper, 180 - 1e-12);
  EXPECT_GE(back.angle.lower, 180 - 1e-6);  // opposite faces
  EXPECT_LE(back.plane_angle.upper, 1e-9);
}

TEST_F(TrimmedJoins, Law3_SwappingAndReversing) {
  RandomRationals random;
  const Patch a = sheet(random), b = sheet(random);
  const auto backwards = [](const Curve& c) {
    std::vector<Vec<Rational, 3>> points(c.points().rbegin(), c.points().rend());
    return Curve(c.knots(), points);
  };
  const TrimmedBounds one = bound_trimmed({{&a, winding(), false}, {&b, winding(), true}});
  const TrimmedBounds swapped = bound_trimmed({{&b, winding(), true}, {&a, winding(), false}});
  const TrimmedBounds reversed = bound_trimmed({{&a, backwards(winding()), false}, {&b, backwards(winding()), true}});
  for (const TrimmedBounds& other : {swapped, reversed}) {
    EXPECT_TRUE(one.gap.lower <= other.gap.upper && other.gap.lower <= one.gap.upper);
    EXPECT_TRUE(one.angle.lower <= other.angle.upper && other.angle.lower <= one.angle.upper);
    EXPECT_NEAR(one.gap.upper, other.gap.upper, one.gap.upper / 100);
    EXPECT_NEAR(one.angle.upper, other.angle.upper, one.angle.upper / 100);
  }
}

// Far from the origin the coordinates are as large as 1e6, the differences as small as before.
TEST_F(TrimmedJoins, Law3_FarAway) {
  RandomRationals random;
  const Patch a = sheet(random);
  const Patch b = apply(translation(Vec<Rational, 3>{{q(0), q(0), q(1, 1000000)}}), a);
  const auto far = translation(Vec<Rational, 3>{{q(1000000), q(-1000000), q(1000000)}});
  const Patch c = apply(far, a), d = apply(far, b);
  const TrimmedBounds near = bound_trimmed({{&a, winding(), false}, {&b, winding(), false}});
  const TrimmedBounds there = bound_trimmed({{&c, winding(), false}, {&d, winding(), false}});
  EXPECT_EQ(near.gap.upper, there.gap.upper);
  EXPECT_EQ(near.gap.lower, there.gap.lower);
}

// Along a knot line where the surface has a kink, and in a curve that only touches one.
TEST_F(TrimmedJoins, Law1_FollowingAKnotLine) {
  const auto k = KnotVector<Rational>::make(1, {q(0), q(0), q(1, 2), q(1), q(1)}).value();
  const auto l = KnotVector<Rational>::bezier(1);
  const auto roof = [&](const Rational& height) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 2; ++j) net.push_back({{q(i), q(j), i == 1 ? height : q(0), q(1)}});
    return Patch(k, l, net);
  };
  const Patch flat = roof(q(0)), bent = roof(q(1));
  const Curve on_ridge = Curve::bezier({uv(q(1, 2), q(0)), uv(q(1, 2), q(1))});
  // Which side of the ridge the face lies on cannot be told from the curve: both are covered, 45° each.
  const TrimmedBounds bounds = bound_trimmed({{&bent, on_ridge, false}, {&flat, on_ridge, false}});
  EXPECT_NEAR(bounds.angle.upper, 45, 1e-9);
  EXPECT_NEAR(bounds.gap.upper, 1, 1e-9);
  const Curve touching = Curve::bezier({uv(q(0), q(0)), uv(q(1), q(1, 2)), uv(q(0), q(1))});
  const TrimmedJoin join{{&bent, touching, false}, {&flat, touching, false}};
  expect_encloses(join, bound_trimmed(join));
}

TEST_F(TrimmedJoins, ACurveOutsideTheDomainIsSaid) {
  RandomRationals random;
  const Patch a = sheet(random);
  const Curve beyond = Curve::bezier({uv(q(1, 2), q(1, 2)), uv(q(101, 100), q(1, 2))});
  EXPECT_EQ(bound_trimmed({{&a, beyond, false}, {&a, beyond, false}}).outside, 0.01);
  const Curve other(KnotVector<Rational>::bezier(1, q(0), q(2)), {uv(q(0), q(0)), uv(q(1), q(0))});
  EXPECT_THROW(bound_trimmed({{&a, beyond, false}, {&a, other, false}}), contract_error);
}

TEST_F(TrimmedJoins, Law4_WholeEdgesGoTheExactWay) {
  RandomRationals random;
  const Patch whole = sheet(random);
  const auto [a, b] = split(whole, Direction::u, q(2, 5));
  const Curve on_a = Curve::bezier({uv(q(2, 5), q(0)), uv(q(2, 5), q(1))}),
              on_b = Curve::bezier({uv(q(2, 5), q(0)), uv(q(2, 5), q(1, 2)), uv(q(2, 5), q(1))});
  const TrimmedJoin join{{&a, on_a, false}, {&b, on_b, false}};
  const auto lines = to_isoparametric(join);
  ASSERT_TRUE(lines);
  EXPECT_EQ(lines->pairing.kind, PairingKind::identity);
  const Certificate certificate = certify_join(a, b, *lines);
  EXPECT_EQ(certificate.c2.verdict, Verdict::proven);
  EXPECT_EQ(certificate.g1.verdict, Verdict::proven);
  const TrimmedBounds bounds = bound_trimmed(join);
  EXPECT_EQ(bounds.gap.lower, 0);
  EXPECT_LE(bounds.angle.upper, 1e-9);

  // With another surface the classes are refuted, and the two enclosures overlap.
  const Patch lifted = apply(translation(Vec<Rational, 3>{{q(0), q(0), q(1, 3)}}), b);
  const TrimmedJoin apart{{&a, on_a, false}, {&lifted, on_b, false}};
  const Certificate refuted = certify_join(a, lifted, to_isoparametric(apart).value());
  const TrimmedBounds apart_bounds = bound_trimmed(apart);
  EXPECT_EQ(refuted.c0.verdict, Verdict::refuted);
  EXPECT_TRUE(apart_bounds.gap.lower <= refuted.gap.upper && refuted.gap.lower <= apart_bounds.gap.upper);

  // Not straight, not at constant speed, not on an edge of the domain: no isoparametric join.
  const Curve slow = Curve::bezier({uv(q(2, 5), q(0)), uv(q(2, 5), q(1, 3)), uv(q(2, 5), q(1))});
  const Curve inner = Curve::bezier({uv(q(1, 5), q(0)), uv(q(1, 5), q(1))});
  for (const Curve& c : {slow, inner, winding()}) EXPECT_FALSE(to_isoparametric({{&a, on_a, false}, {&b, c, false}}));
  EXPECT_FALSE(to_isoparametric({{&a, inner, false}, {&b, on_b, false}}));
}

// The sphere about 0, 2v (1 − u², 2u) and 1 − v² over (1 + u²)(1 + v²): a pole at v = 0, whose control points `slip` moves
// apart.
Patch sphere_with_pole(const Rational& slip = Rational(0)) {
  using Power = std::array<int, 3>;  // coefficients of 1, u, u²
  const auto bernstein = [](const Power& a) {
    return std::array<Rational, 3>{q(a[0]), q(a[0]) + q(a[1], 2), q(a[0] + a[1] + a[2])};
  };
  const auto c = bernstein({1, 0, -1}), s = bernstein({0, 2, 0}), w = bernstein({1, 0, 1}), r = bernstein({0, 2, 0});
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) net.push_back({{c[i] * r[j], s[i] * r[j], w[i] * c[j], w[i] * w[j]}});
  net[0] = net[0] + Vec<Rational, 4>{{slip, q(0), -slip, q(0)}};
  const auto k = KnotVector<Rational>::bezier(2);
  return Patch(k, k, net);
}

// From the pole along u = 1/2, at v = (t + t²)/2: the face's normal stays in the meridian's plane.
const Curve& meridian() {
  static const Curve curve = Curve::bezier({uv(q(1, 2), q(0)), uv(q(1, 2), q(1, 4)), uv(q(1, 2), q(1))});
  return curve;
}

TEST_F(TrimmedJoins, Law1_AtAPoleTheLimitIsTaken) {
  const Patch sphere = sphere_with_pole(), other = elevate_degree(sphere, Direction::u, 1);
  const auto k = KnotVector<Rational>::bezier(1);
  const Patch plane(k, k,  // of the meridian: perpendicular to the sphere
                    {{{q(0), q(0), q(0), q(1)}},
                     {{q(0), q(0), q(1), q(1)}},
                     {{q(3, 5), q(4, 5), q(0), q(1)}},
                     {{q(3, 5), q(4, 5), q(1), q(1)}}});
  const Curve across = Curve::bezier({uv(q(0), q(1)), uv(q(1), q(0))});
  const TrimmedBounds smooth = bound_trimmed({{&sphere, meridian(), false}, {&other, meridian(), false}});
  // Beside the pole a normal shrinks, but not its rounding errors: they leave about √2⁻⁵², 1e-6°.
  EXPECT_LE(smooth.angle.upper, 1e-5);
  ASSERT_EQ(smooth.poles.size(), 2u);
  for (const TrimmedPole& pole : smooth.poles) {
    EXPECT_FALSE(pole.left_out);
    EXPECT_TRUE(pole.begin == q(0) && pole.end == q(0));
  }
  const TrimmedBounds sharp = bound_trimmed({{&sphere, meridian(), false}, {&plane, across, false}});
  EXPECT_LE(sharp.angle.lower, 90);
  EXPECT_GE(sharp.angle.lower, 89.9);
  EXPECT_GE(sharp.angle.upper, 90);
  EXPECT_LE(sharp.angle.upper, 90.9);
  ASSERT_EQ(sharp.poles.size(), 1u);
  EXPECT_EQ(sharp.poles[0].side, 'a');
}

// In files the points of a pole are a rounding error apart: exactly at the pole the normal points anywhere.
TEST_F(TrimmedJoins, APoleHiddenByRoundingIsLeftOutAndSaid) {
  const Patch sphere = sphere_with_pole(), slipped = sphere_with_pole(from_double(0x1p-52));
  std::vector<Vec<Rational, 3>> points(meridian().points().rbegin(), meridian().points().rend());
  const Curve backwards(meridian().knots(), points);
  for (const bool reversed : {false, true}) {
    const Curve& curve = reversed ? backwards : meridian();
    const TrimmedJoin join{{&slipped, curve, false}, {&sphere, curve, false}};
    const TrimmedBounds bounds = bound_trimmed(join);
    EXPECT_LE(bounds.angle.upper, 1e-4);
    ASSERT_EQ(bounds.poles.size(), 2u);
    for (const TrimmedPole& pole : bounds.poles) {
      EXPECT_TRUE(pole.left_out);
      EXPECT_EQ(pole.end - pole.begin, from_double(0x1p-24));
      EXPECT_EQ(reversed ? pole.end : pole.begin, reversed ? q(1) : q(0));
    }
    const Certificate certificate = certify_trimmed(join);
    ASSERT_EQ(certificate.degenerate.size(), 2u);
    EXPECT_EQ(certificate.degenerate[0].what, "the normal is rounding errors; left out of the angle");
    // Just beside what is left out, exact normals are as near as the bounds say.
    const Rational beside = reversed ? Rational(q(1) - from_double(0x1p-23)) : from_double(0x1p-23);
    EXPECT_LE(at(join, beside).angle, bounds.angle.upper + 1e-5);
  }
}

}  // namespace
}  // namespace patchproof::test
