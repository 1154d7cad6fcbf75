// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/smoothness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/reparametrize.h"
#include "support/curves.h"
#include "support/lar_curves.h"

namespace patchproof::test {
namespace {

using Point = Vec<Rational, 2>;
using Conic = BsplineCurve<Rational, 3>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Point at(const Rational& x, const Rational& y) { return {{x, y}}; }

// The curve with weights 1.
Conic with_unit_weights(const PlaneCurve& c) {
  return Conic(c.knots(), to_homogeneous(c.points(), std::vector<Rational>(c.points().size(), q(1))));
}

// Positive weights, so that the denominator never vanishes.
Conic random_rational(RandomRationals& random, const PlaneCurve& c) {
  std::vector<Rational> weights;
  for (std::size_t i = 0; i < c.points().size(); ++i) weights.push_back(q(random.integer(1, 9)));
  return Conic(c.knots(), to_homogeneous(c.points(), weights));
}

// Figures worked out independently: curve, t, multiplicity, nominal, actual, jump of order actual + 1, zero speed.
TEST(Smoothness, Law1And2_KnownBreaks) {
  const char* const rows[] = {
      "test08a 1 1 2 2 14 1 0",        "test08a 2 1 2 2 3 1 0",        "test08a 3 1 2 2 -5/2 -9 0",
      "test08a 4 1 2 2 -7/2 10 0",     "test08a 5 1 2 2 27/4 -17/2 0", "test08a 6 1 2 2 -9/2 -23 0",
      "test08b 1 1 1 1 1 2 0",         "test08b 2 1 1 1 0 -1 0",       "test08b 3 1 1 1 0 -1 0",
      "test08b 4 1 1 1 1 2 0",         "test10b 1 1 2 2 -18 6 0",      "test10c 1 1 2 2 -39/4 -36 1",
      "test10c 2 1 2 2 -3 36 0",       "test11a 1 1 1 1 -2 -1 0",      "test11a 2 1 1 1 -1 -2 0",
      "test11b 3 1 1 1 -2 0 0",        "test11b 4 1 1 1 0 -2 0",       "test11c_closed 3 1 1 1 -2 0 0",
      "test11c_closed 4 1 1 1 0 -2 0", "test11c_closed 5 1 1 1 2 0 0", "test12_b1 1 1 1 1 -5 -1 0",
      "test12_b1 2 1 1 1 -1 2 0",      "test12_b1 3 1 1 1 3 4 0",      "test12_b1 4 1 1 1 2 -6 0",
      "test12_b2 1 2 0 0 -2 -6 0",     "test12_b2 2 1 1 1 4 3 0",      "test12_b2 3 1 1 1 2 -6 0",
      "test12_b3 1 3 -1 -1 1 -1 0",    "test12_b3 2 1 1 1 1 -8 0",     "test12_b4 1 4 -1 -1 0 -3 0",
  };
  std::string last;
  std::size_t next = 0, count = 0;
  for (const std::string row : rows) {
    SCOPED_TRACE(row);
    std::istringstream in(row);
    std::string name, t, x, y;
    int multiplicity, nominal, actual;
    bool stops;
    in >> name >> t >> multiplicity >> nominal >> actual >> x >> y >> stops;
    if (name != last) {
      EXPECT_EQ(next, count) << "more breaks than rows before";
      next = 0;
    }
    last = name;
    const auto all = smoothness(lar_curve(name));
    count = all.size();
    ASSERT_LT(next, count);
    const auto& one = all[next++];
    EXPECT_EQ(one.t, Rational(t));
    EXPECT_EQ(one.multiplicity, multiplicity);
    EXPECT_EQ(one.nominal, nominal);
    EXPECT_EQ(one.actual.order, actual);
    EXPECT_EQ(one.actual.jump, at(Rational(x), Rational(y)));
    EXPECT_EQ(one.actual.has_zero_speed, stops);
  }
  EXPECT_EQ(next, count);
  EXPECT_TRUE(smoothness(lar_curve("test09")).empty());
  EXPECT_TRUE(smoothness(lar_curve("test10a")).empty());
}

// The affine circle is C¹; its homogeneous points are only continuous.
TEST(Smoothness, Law2And3_CircleWithRootTwo) {
  const auto circle = lar_circle();
  const auto affine = smoothness_rational(circle);
  const auto homogeneous = smoothness(circle);
  const Quadratic o(0), jump = in_root_two("-4", "4");
  const Vec<Quadratic, 2> jumps[] = {{{jump, o}}, {{o, -jump}}, {{-jump, o}}};
  ASSERT_EQ(affine.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(affine[i].t == Quadratic(i + 1));
    EXPECT_EQ(affine[i].multiplicity, 2);
    EXPECT_EQ(affine[i].nominal, 0);
    EXPECT_EQ(affine[i].actual.order, 1);
    EXPECT_TRUE(affine[i].actual.jump == jumps[i]);
    EXPECT_FALSE(affine[i].actual.has_zero_speed);
    EXPECT_TRUE(affine[i].actual.has_tangent);
    EXPECT_EQ(homogeneous[i].actual.order, 0);
    EXPECT_TRUE(homogeneous[i].actual.jump[2] == in_root_two("-4", "2"));  // W' from 2 − √2 to √2 − 2
  }
  EXPECT_EQ(closing_smoothness_rational(circle).order, 1);
  EXPECT_EQ(closing_smoothness(circle).order, 0);
}

TEST(Smoothness, Law2And6_CircleInRationalNumbers) {
  const auto affine = smoothness_rational(rational_circle());
  ASSERT_EQ(affine.size(), 3u);
  EXPECT_EQ(affine[0].actual.order, 1);
  EXPECT_EQ(affine[0].actual.jump, at(q(-2), q(0)));
  // From 1 to 3 it runs through x = −(1 − s²)/(1 + s²), y = −2s/(1 + s²), s = t − 2: no break at 2, nor at the seam.
  EXPECT_TRUE(affine[1].actual.is_one_function());
  EXPECT_EQ(affine[1].nominal, 0);
  EXPECT_EQ(affine[2].actual.order, 1);
  EXPECT_EQ(affine[2].actual.jump, at(q(2), q(0)));
  const auto seam = closing_smoothness_rational(rational_circle());
  EXPECT_TRUE(seam.is_one_function());
  EXPECT_TRUE(seam.has_tangent);
  // Negative control: a circle cut short is closed no more.
  EXPECT_EQ(closing_smoothness_rational(restrict(rational_circle(), q(0), q(3))).order, -1);
}

TEST(Smoothness, Law6_SeamsOfClosedCurves) {
  const auto seam = closing_smoothness(lar_curve("test11c_closed"));
  EXPECT_EQ(seam.order, 1);
  EXPECT_EQ(seam.jump, at(q(0), q(2)));
  // Repeating only the first control point does not close the curve.
  const auto open = closing_smoothness(lar_curve("test11b"));
  EXPECT_EQ(open.order, -1);
  EXPECT_EQ(open.jump, at(q(-1, 2), q(-1, 2)));
  EXPECT_FALSE(open.has_tangent);
  // A clamped curve closed by its end points alone: closed, with a corner.
  const auto corner = closing_smoothness(lar_curve("test11a"));
  EXPECT_EQ(corner.order, 0);
  EXPECT_EQ(corner.jump, at(q(2), q(-2)));
  EXPECT_FALSE(corner.has_tangent);
  const auto periodic = make_periodic<Rational, 1, Rational>(3, numbers_of("0 2 3 7 8 10"),
                                                             {{{q(0)}}, {{q(3)}}, {{q(1)}}, {{q(4)}}, {{q(2)}}});
  ASSERT_TRUE(periodic.has_value());
  EXPECT_EQ(closing_smoothness(*periodic).order, 2);
  // A constant curve closes as one function, but has no tangent.
  const auto constant = closing_smoothness(plane_curve(2, "0 0 0 1 1 1", "3 4  3 4  3 4"));
  EXPECT_TRUE(constant.is_one_function());
  EXPECT_TRUE(constant.has_zero_speed);
  EXPECT_FALSE(constant.has_tangent);
}

TEST(Smoothness, Law2_DerivativesAgreeUpToTheOrderAndThenJump) {
  RandomRationals random;
  for (const NamedCurve& named : awkward_curves(random)) {
    SCOPED_TRACE(named.name);
    const Conic rational = random_rational(random, named.curve);
    for (const auto& b : smoothness(named.curve)) {
      EXPECT_GE(b.actual.order, b.nominal);
      ASSERT_LT(b.actual.order, named.curve.degree());
      const auto left = derivatives(named.curve, b.t, b.actual.order + 1, Side::left),
                 right = derivatives(named.curve, b.t, b.actual.order + 1, Side::right);
      for (int k = 0; k <= b.actual.order; ++k) EXPECT_EQ(left[k], right[k]);
      EXPECT_EQ(right.back() - left.back(), b.actual.jump);
      EXPECT_NE(b.actual.jump, Point());
    }
    const auto homogeneous = smoothness(rational);
    const auto affine = smoothness_rational(rational);
    ASSERT_EQ(affine.size(), homogeneous.size());
    for (std::size_t i = 0; i < affine.size(); ++i) {
      const auto& b = affine[i];
      EXPECT_GE(b.actual.order, homogeneous[i].actual.order);
      const auto left = rational_derivatives(rational, b.t, b.actual.order + 1, Side::left),
                 right = rational_derivatives(rational, b.t, b.actual.order + 1, Side::right);
      for (int k = 0; k <= b.actual.order; ++k) EXPECT_EQ(left[k], right[k]);
      EXPECT_EQ(right.back() - left.back(), b.actual.jump);
      EXPECT_NE(b.actual.jump, Point());
    }
  }
}

// Two quotients of degree p that differ may agree up to order 2p − 1.
TEST(Smoothness, Law2_RationalPiecesMayAgreeBeyondTheirDegree) {
  // Two of Padé's approximants of exp: (2 + x)/(2 − x) agrees with (12 + 6x + x²)/(12 − 6x + x²) up to x² and not in x³.
  using Line = BsplineCurve<Rational, 2>;
  // Bézier points on [−1, 0] and [0, 1] from the power form a + b x + c x².
  const auto bezier_right = [](const Rational& a, const Rational& b, const Rational& c) {
    return std::vector<Rational>{a, Rational(a + b / 2), Rational(a + b + c)};
  };
  const auto bezier_left = [&](const Rational& a, const Rational& b, const Rational& c) {
    auto r = bezier_right(a, Rational(-b), c);
    return std::vector<Rational>(r.rbegin(), r.rend());
  };
  const auto join = [&](std::vector<Rational> a1, std::vector<Rational> w1, std::vector<Rational> a2,
                        std::vector<Rational> w2) {
    std::vector<Vec<Rational, 2>> points;
    for (int i = 0; i < 3; ++i) points.push_back({{a1[i], w1[i]}});
    for (int i = 0; i < 3; ++i) points.push_back({{a2[i], w2[i]}});
    return smoothness_rational(
               Line(KnotVector<Rational>::make(2, numbers_of("-1 -1 -1 0 0 0 1 1 1")).value(), points))[0]
        .actual;
  };
  const auto pade = join(bezier_left(q(2), q(1), q(0)), bezier_left(q(2), q(-1), q(0)), bezier_right(q(12), q(6), q(1)),
                         bezier_right(q(12), q(-6), q(1)));
  EXPECT_EQ(pade.order, 2);
  EXPECT_EQ(pade.jump[0], q(1) - q(3, 2));  // third derivatives: 3! (1/6) on the right, 3! (1/4) on the left
  // (1 + x²)/(1 + x²) is 1, in other clothes; and against (1 + x²)/(1 + x²/2) the second derivative jumps.
  const auto one = join(bezier_left(q(1), q(0), q(1)), bezier_left(q(1), q(0), q(1)), bezier_right(q(3), q(1), q(0)),
                        bezier_right(q(3), q(1), q(0)));
  EXPECT_TRUE(one.is_one_function());
  EXPECT_EQ(one.jump[0], 0);
  const auto second = join(bezier_left(q(1), q(0), q(1)), bezier_left(q(1), q(0), q(1)), bezier_right(q(1), q(0), q(1)),
                           bezier_right(q(1), q(0), q(1, 2)));
  EXPECT_EQ(second.order, 1);
  EXPECT_EQ(second.jump[0], q(1));
  // 1/(1 + x²) and 1 − x² agree to x³: an order above the degree 2.
  const auto third = join(bezier_left(q(1), q(0), q(0)), bezier_left(q(1), q(0), q(1)), bezier_right(q(1), q(0), q(-1)),
                          bezier_right(q(1), q(0), q(0)));
  EXPECT_EQ(third.order, 3);
  EXPECT_EQ(third.jump[0], q(-24));
}

TEST(Smoothness, Law4_InsertedKnotsAreInvisible) {
  RandomRationals random;
  for (const NamedCurve& named : awkward_curves(random)) {
    if (named.curve.degree() == 0) continue;
    SCOPED_TRACE(named.name);
    const KnotVector<Rational>& knots = named.curve.knots();
    const Rational t = (knots.domain_begin() * 5 + knots.domain_end() * 2) / 7;
    ASSERT_EQ(knots.multiplicity(t), 0);
    for (const int multiplicity : {1, named.curve.degree()}) {
      const auto before = smoothness(named.curve), after = smoothness(raise_multiplicity(named.curve, t, multiplicity));
      ASSERT_EQ(after.size(), before.size() + 1);
      std::size_t i = 0;
      for (const auto& b : after) {
        if (b.t == t) {
          EXPECT_TRUE(b.actual.is_one_function());
          EXPECT_EQ(b.nominal, named.curve.degree() - multiplicity);
          EXPECT_EQ(b.actual.jump, Point());
          continue;
        }
        EXPECT_EQ(b.actual.order, before[i].actual.order);
        EXPECT_EQ(b.actual.jump, before[i].actual.jump);
        ++i;
      }
    }
    // The same for the affine curve.
    const Conic conic = raise_multiplicity(random_rational(random, named.curve), t, 1);
    for (const auto& b : smoothness_rational(conic)) EXPECT_EQ(b.actual.is_one_function(), b.t == t);
  }
}

TEST(Smoothness, Law4_ReversalAndScaledWeights) {
  RandomRationals random;
  for (const NamedCurve& named : awkward_curves(random)) {
    SCOPED_TRACE(named.name);
    const auto before = smoothness(named.curve), after = smoothness(reverse(named.curve));
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto &a = before[i].actual, &b = after[after.size() - 1 - i].actual;
      EXPECT_EQ(a.order, b.order);
      EXPECT_EQ(a.has_tangent, b.has_tangent);
      EXPECT_EQ(a.has_zero_speed, b.has_zero_speed);
      EXPECT_EQ(b.jump, a.order % 2 == 0 ? a.jump : -a.jump);  // derivatives of order + 1
    }
    const Conic unit = with_unit_weights(named.curve);
    auto scaled_points = unit.points();
    for (auto& p : scaled_points) p = q(-7, 3) * p;
    const auto affine = smoothness_rational(Conic(unit.knots(), scaled_points));
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(affine[i].actual.order, before[i].actual.order);
      EXPECT_EQ(affine[i].actual.jump, before[i].actual.jump);
      EXPECT_EQ(affine[i].actual.has_tangent, before[i].actual.has_tangent);
    }
  }
}

// C² with a corner: the velocity is zero, the pieces lie on two lines.
TEST(Smoothness, Law5_ParametricSmoothnessIsNoTangent) {
  const auto corner = smoothness(lar_curve("test10c"))[0];
  EXPECT_EQ(corner.actual.order, 2);
  EXPECT_TRUE(corner.actual.has_zero_speed);
  EXPECT_FALSE(corner.actual.has_tangent);
  EXPECT_TRUE(smoothness(lar_curve("test10c"))[1].actual.has_tangent);
  // The same double points on one line go straight on.
  const auto straight = smoothness(plane_curve(3, "0 0 0 0 1 2 3 3 3 3", "0 0  1 1  1 1  1 1  2 2  5 5"))[0].actual;
  EXPECT_TRUE(straight.has_zero_speed);
  EXPECT_TRUE(straight.has_tangent);
  // The cusp (x³, x²) is one polynomial that comes in against the way it leaves: inserted at 0, C^∞ and no tangent.
  const auto cusp =
      smoothness(raise_multiplicity(plane_curve(3, "-1 -1 -1 -1 1 1 1 1", "-1 1  1 -1/3  -1 -1/3  1 1"), q(0), 1))[0]
          .actual;
  EXPECT_TRUE(cusp.is_one_function());
  EXPECT_TRUE(cusp.has_zero_speed);
  EXPECT_FALSE(cusp.has_tangent);
  // Only C⁰ in the parameter, but one tangent: G¹.
  const auto kink = smoothness(plane_curve(1, "0 0 1 2 2", "0 0  1 1  4 4"))[0].actual;
  EXPECT_EQ(kink.order, 0);
  EXPECT_TRUE(kink.has_tangent);
  // Back the way it came: parallel is not enough.
  EXPECT_FALSE(smoothness(plane_curve(1, "0 0 1 2 2", "0 0  1 1  0 0"))[0].actual.has_tangent);
}

// What the multiplicities 1 … p + 2 of a knot do to one curve.
TEST(Smoothness, Law1And3_MultiplicitiesAtAGlance) {
  const std::vector<Point> points = lar_curve("test12_b1").points();
  EXPECT_EQ(evaluate(lar_curve("test12_b2"), q(1)), points[2]);  // p: the control point
  EXPECT_EQ(evaluate(lar_curve("test12_b3"), q(1), Side::left), points[2]);
  EXPECT_EQ(evaluate(lar_curve("test12_b3"), q(1), Side::right), points[3]);  // p + 1: from one point to the next
  EXPECT_EQ(evaluate(lar_curve("test12_b4"), q(1), Side::left), points[2]);
  EXPECT_EQ(evaluate(lar_curve("test12_b4"), q(1), Side::right), points[4]);  // p + 2: the point between is dead
  EXPECT_EQ(evaluate(lar_curve("test08a"), q(0)), lar_curve("test08a").points().front());
  EXPECT_EQ(evaluate(lar_curve("test08a"), q(7)), lar_curve("test08a").points().back());
  EXPECT_EQ(evaluate(lar_curve("over_clamped"), q(1)), lar_curve("over_clamped").points()[2]);
  EXPECT_EQ(evaluate(lar_curve("partially_clamped"), q(3)), at(q(6), q(1)));  // an end of multiplicity p
  // test10c: the first piece lies on the line of its first two points, the second on that of its last two.
  const auto pieces = extract_bezier(lar_curve("test10c"));
  const auto on_line = [](const std::vector<Point>& piece, const Point& a, const Point& b) {
    return std::all_of(piece.begin(), piece.end(),
                       [&](const Point& x) { return (b[0] - a[0]) * (x[1] - a[1]) == (b[1] - a[1]) * (x[0] - a[0]); });
  };
  EXPECT_TRUE(on_line(pieces[0].points, at(q(0), q(0)), at(q(5, 2), q(5))));
  EXPECT_TRUE(on_line(pieces[1].points, at(q(5, 2), q(5)), at(q(6), q(1))));
  EXPECT_FALSE(on_line(pieces[2].points, at(q(5, 2), q(5)), at(q(6), q(1))));
}

TEST(Smoothness, Contracts) {
  const Conic bad(KnotVector<Rational>::make(1, numbers_of("0 0 1 2 2")).value(),
                  {{{q(0), q(0), q(1)}}, {{q(1), q(1), q(0)}}, {{q(1), q(0), q(1)}}});
  EXPECT_THROW(smoothness_rational(bad), contract_error);
  EXPECT_NO_THROW(smoothness(bad));
  EXPECT_TRUE(smoothness_at_rational(bad, q(1, 2)).is_one_function());
  EXPECT_THROW(smoothness_at(bad, q(0)), contract_error);
  EXPECT_THROW(smoothness_at_rational(bad, q(2)), contract_error);
  EXPECT_EQ(smoothness(lar_curve("deg0"))[0].actual.order, -1);
  EXPECT_EQ(smoothness(plane_curve(0, "0 1 2", "3 3  3 3"))[0].nominal, -1);
  EXPECT_TRUE(smoothness(plane_curve(0, "0 1 2", "3 3  3 3"))[0].actual.is_one_function());
}

}  // namespace
}  // namespace patchproof::test
