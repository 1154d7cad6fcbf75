// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gerbs_expand.h"

#include <gtest/gtest.h>

#include "patchproof/patch/rational_patch.h"
#include "support/gerbs_surfaces.h"

namespace patchproof::test {
namespace {

const std::vector<Rational> kU{0, 1, 3}, kV{-1, 0, "1/2"_q};
const char* const kSomeB[] = {"polynomial(0)", "polynomial(1)", "beta(2,1)", "rational(1)"};

int degree_of(const BFunction& b) {
  return static_cast<int>(std::max(b.numerator().size(), b.denominator().size())) - 1;
}

TEST(GerbsExpand, Law1_2_TheSameSurfaceOfTheDegreesPromised) {
  RandomRationals random;
  for (const char* name : kSomeB)
    for (const Weights weights : {Weights::one, Weights::common}) {
      SCOPED_TRACE(name);
      const Surface s = random_surface(random, b_function(name), kU, weights == Weights::one, kV, false, weights, true);
      const auto patch = to_patch(s).value();
      EXPECT_EQ(patch.knots(Direction::u).degree(), 2 + degree_of(s.b_function()));
      EXPECT_EQ(patch.knots(Direction::v).degree(), 1 + degree_of(s.b_function()));
      const SurfaceLocal whole(patch);
      // Third derivatives at one place of each box, and the values on all sides of the breaks.
      for (const Place& at : sided_places(s)) {
        const int order = at.side_u == Side::right && at.side_v == Side::right ? 3 : 0;
        EXPECT_EQ(partials<Rational>(whole, at, order, order), reference_derivatives<Rational>(s, at, order, order));
      }
    }
}

TEST(GerbsExpand, Law1_CommonWeightsThatVary) {
  RandomRationals random;
  const SurfaceLocal model(random_patch(random, {0, 3, -1, "1/2"_q}, true, Weights::different));
  std::vector<SurfaceLocal> locals;
  for (int i = 0; i < 9; ++i)
    locals.push_back(model.map_points([i](Vec<Rational, 4> p) {
      p[i % 3] += Rational(i) * p[3];
      return p;
    }));
  const Surface s =
      Surface::make(BFunction(), {gerbs_knots(kU, false).value()}, {gerbs_knots(kV, false).value()}, locals).value();
  const SurfaceLocal whole(to_patch(s).value());
  for (const Place& at : sided_places(s))
    EXPECT_EQ(partials<Rational>(whole, at, 1, 1), reference_derivatives<Rational>(s, at, 1, 1));
}

TEST(GerbsExpand, Law3_KnotsAreAsFewAsThePiecesNeed) {
  RandomRationals random;
  for (int n = 0; n <= 2; ++n) {
    const Surface s = random_surface(random, BFunction::polynomial(n).value(), kU, false, kV, false);
    const auto patch = to_patch(s).value();
    // C^n and no more across a knot.
    EXPECT_EQ(patch.knots(Direction::u).multiplicity(1), 2 * n + 3 - n);
    EXPECT_EQ(patch.knots(Direction::v).multiplicity(0), 2 * n + 2 - n);
  }
  const auto g = random_patch(random, {0, 3, -1, "1/2"_q}, false, Weights::one);
  const Surface one = Surface::make(BFunction(), {gerbs_knots(kU, false).value()}, {gerbs_knots(kV, false).value()},
                                    std::vector<SurfaceLocal>(9, g))
                          .value();
  const auto patch = to_patch(one).value();
  EXPECT_EQ(patch.knots(Direction::u).breaks(), (std::vector<Rational>{0, 3}));
  EXPECT_EQ(patch.knots(Direction::v).breaks(), (std::vector<Rational>{-1, "1/2"_q}));
}

TEST(GerbsExpand, WhatIsNoPatchIsRefused) {
  RandomRationals random;
  const auto flat = to_patch(random_surface(random, b_function("logistic"), kU, false, kV, false));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::unsupported);
  EXPECT_EQ(flat.error().values, "logistic");
  const auto weights = to_patch(random_surface(random, BFunction(), kU, false, kV, false, Weights::different));
  ASSERT_FALSE(weights);
  EXPECT_EQ(weights.error().code, ErrorCode::unsupported);
  EXPECT_EQ(weights.error().values, "u 0 … 1, v -1 … 0");
}

}  // namespace
}  // namespace patchproof::test
