// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/transfinite_expand.h"

#include <gtest/gtest.h>

#include "support/transfinite.h"

namespace patchproof::test {
namespace {

TEST(TransfiniteExpand, Law1_ThePatchIsTheMap) {
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Surface s = random_surface(random, 3, "-2"_q, "5/3"_q);
    const BsplinePatch<Rational, 3> patch = to_bspline_patch(s);
    if (s.dependence(0) && s.dependence(1)) {
      EXPECT_TRUE(identical(patch_over<2>(0, 1, patch), s)) << round;
    }
    // The two sides of every knot as well, which `identical` compares piece by piece.
    for (const Rational& t : breaks(s, 0))
      for (const Side side : {Side::left, Side::right})
        EXPECT_EQ(evaluate(patch, t, patch.domain().v_begin, side, side),
                  evaluate(s, ParameterPlace<Rational, 2>({t, patch.domain().v_begin}, side)));
  }
}

TEST(TransfiniteExpand, Law1_ACurveOfOneParameter) {
  using Curve = TransfiniteMap<Rational, 1, 2>;
  RandomRationals random;
  for (int round = 0; round < 10; ++round) {
    const int degree = random.integer(1, 3), n = degree + 1 + random.integer(0, 4);
    const BsplineCurve<Rational, 2> c(knots_of(degree, random.knots(degree, n)), random.points<2>(n));
    const Curve map = curve_along<1>(0, c);
    const auto t = coordinate_function<Rational, 1>(0, map.domain_begin(0), map.domain_end(0));
    const Curve product_map = product(product(t, t), map) - map;
    EXPECT_TRUE(identical(curve_along<1>(0, to_bspline_curve(product_map)), product_map));
    EXPECT_EQ(to_bspline_curve(product_map).degree(), degree + 2);
  }
}

TEST(TransfiniteExpand, Law2_DegreesAndKnots) {
  const auto patch = to_bspline_patch(four_curves());
  EXPECT_EQ(patch.degree(Direction::u), 3);
  EXPECT_EQ(patch.degree(Direction::v), 3);
  EXPECT_EQ(patch.count(Direction::u), 4);
  // A simple knot of degree 1 beside curves of degree 2 in the same coordinate: continuous only, degree 3.
  const Surface inner = bezier(0, {p(0, 0, 0), p(1, 1, 0), p(0, 2, 1)});
  const Surface s = Surface::blend(0, knots_of(1, {0, 0, "1/2"_q, 1, 1}), {inner, p(1, 0, 0), inner}).value();
  EXPECT_EQ(spline_knots(s, 0).degree(), 3);
  EXPECT_EQ(spline_knots(s, 0).multiplicity("1/2"_q), 3);
  EXPECT_EQ(spline_knots(s, 1), KnotVector<Rational>::bezier(1));  // no dependence: degree 1, never 0
}

// Degree reduction of the expansion finds that nothing was lost or added.
TEST(TransfiniteExpand, Law1_AJumpStaysAJump) {
  const Surface s =
      Surface::blend(1, knots_of(1, {0, 0, "1/2"_q, "1/2"_q, 1, 1}),
                     {bezier(0, {p(0, 0, 0), p(1, 0, 0)}), p(0, 1, 0), p(0, 1, 5), bezier(0, {p(0, 2, 0), p(1, 2, 0)})})
          .value();
  const auto patch = to_bspline_patch(s);
  EXPECT_EQ(evaluate(patch, "1/2"_q, "1/2"_q, Side::left, Side::left), p(0, 1, 0));
  EXPECT_EQ(evaluate(patch, "1/2"_q, "1/2"_q), p(0, 1, 5));
}

}  // namespace
}  // namespace patchproof::test
