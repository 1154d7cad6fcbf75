// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/function_basis.h"

#include <gtest/gtest.h>

#include "support/polynomial.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Basis = FunctionBasis<Rational>;

const std::vector<Rational> kKnots{0, 0, 0, 1, 1, "3/2"_q, 2, 4, 4, 4};

TEST(FunctionBasis, Law1_SplinesAndTheirDerivatives) {
  const Basis basis(KnotVector<Rational>::make(2, kKnots).value());
  EXPECT_FALSE(basis.is_trigonometric());
  EXPECT_EQ(basis.count(), 7);
  const std::vector<Rational> at{0, "1/3"_q, 1, "5/4"_q, "3/2"_q, 2, 3, 4};
  for (const Rational& t : at)
    for (const Side side : {Side::left, Side::right}) {
      const auto live = live_functions<Rational>(basis, t, side, t, 4);
      ASSERT_EQ(live.values.size(), 5u);
      const int span = basis.knots()->find_span(t, side);
      EXPECT_EQ(live.first, span - 2);
      for (int r = 0; r <= 4; ++r)
        for (int l = 0; l <= 2; ++l)
          EXPECT_EQ(live.values[r][l], bspline_piece(kKnots, live.first + l, 2, span).derivative(r)(t))
              << "derivative " << r << " of function " << live.first + l << " at " << t;
    }
}

TEST(FunctionBasis, Law1_TheSideNamesThePieceAlsoBesideIt) {
  const Basis basis(KnotVector<Rational>::make(2, kKnots).value());
  // The piece left of 1, continued to 5/4.
  const auto live = live_functions<Rational>(basis, Rational(1), Side::left, Rational("5/4"_q), 1);
  EXPECT_EQ(live.first, 0);
  EXPECT_EQ(live.values[0][0], "1/16"_q);
  EXPECT_EQ(live.values[0][2], "25/16"_q);
}

TEST(FunctionBasis, Law1_TrigonometricDerivativesRunThroughTheirCycle) {
  const Basis basis(TrigonometricFunctions{3});
  EXPECT_TRUE(basis.is_trigonometric());
  EXPECT_EQ(basis.count(), 7);
  EXPECT_EQ(Basis(TrigonometricFunctions{0}).count(), 1);
  const auto live = live_functions<Ball>(basis, Rational(0), Side::right, Ball("2/7"_q), 6);
  EXPECT_EQ(live.first, 0);
  for (int r = 0; r <= 6; ++r) {
    EXPECT_TRUE(live.values[r][0].contains(r == 0 ? 1 : 0));
    for (int k = 1; k <= 3; ++k) {
      // cos^(r)(x) = cos(x + rπ/2), sin^(r)(x) = sin(x + rπ/2)
      const auto turned = cos_sin_pi(Ball(Rational(Rational(k) * "2/7"_q + Rational(r) / Rational(2))));
      Ball factor(1);
      for (int i = 0; i < r; ++i) factor = factor * Ball(k) * Ball::pi();
      for (const int which : {0, 1}) {
        const Ball difference = live.values[r][2 * k - 1 + which] - factor * turned[which];
        EXPECT_TRUE(difference.contains(0)) << r << " " << k << " " << which;
        EXPECT_LT(difference.to_interval().sup(), 1e-28);
      }
    }
  }
}

// Interval and TaylorModel contain what Ball knows to 30 digits; double is near.
TEST(FunctionBasis, Law2_TrigonometricFunctionsAreEnclosed) {
  const RoundingGuard guard;
  using Model = TaylorModel<4>;
  const Basis basis(TrigonometricFunctions{2});
  const Rational centre = "1/3"_q, radius = "1/64"_q;
  const auto model = live_functions<Model>(basis, centre, Side::right,
                                           Model::variable(embed<Interval>(centre), embed<Interval>(radius)), 2);
  const auto wide = live_functions<Interval>(
      basis, centre, Side::right, embed<Interval>(centre) + Interval(-1.0, 1.0) * embed<Interval>(radius), 2);
  for (const Rational& s : {Rational(-1), "-1/2"_q, Rational(0), "3/4"_q, Rational(1)}) {
    const Rational t = centre + radius * s;
    const auto truth = live_functions<Ball>(basis, t, Side::right, Ball(t), 2);
    const auto point = live_functions<Interval>(basis, t, Side::right, embed<Interval>(t), 2);
    for (int r = 0; r <= 2; ++r)
      for (int l = 0; l < 5; ++l) {
        const Interval exact = truth.values[r][l].to_interval(),
                       by_model = model.values[r][l].value(embed<Interval>(s));
        EXPECT_TRUE(by_model.inf() <= exact.inf() && exact.sup() <= by_model.sup());
        EXPECT_LE(model.values[r][l].remainder().sup(), 1e-3);
        EXPECT_TRUE(point.values[r][l].inf() <= exact.sup() && exact.inf() <= point.values[r][l].sup());
        EXPECT_LE(point.values[r][l].sup() - point.values[r][l].inf(), 1e-12);
        EXPECT_TRUE(wide.values[r][l].inf() <= exact.inf() && exact.sup() <= wide.values[r][l].sup());
      }
  }
}

TEST(FunctionBasis, Law2_QuarterTurnsAreExactInDoubles) {
  const FunctionBasis<double> basis(TrigonometricFunctions{2});
  const auto live = live_functions<double>(basis, 0.5, Side::right, 0.5, 0);
  EXPECT_EQ(live.values[0], (std::vector<double>{1, 0, 1, -1, 0}));
}

TEST(FunctionBasis, Law2_ExactScalarsHaveNoTrigonometricValues) {
  const Basis basis(TrigonometricFunctions{1});
  EXPECT_THROW((void)live_functions<Rational>(basis, Rational(0), Side::right, Rational(0), 0), contract_error);
  EXPECT_THROW(Basis(TrigonometricFunctions{-1}), contract_error);
}

TEST(FunctionBasis, Law3_CoversWhereThereAreValues) {
  const Basis splines(KnotVector<Rational>::make(1, {-1, 0, 1, 1, 3, 5}).value()), turns(TrigonometricFunctions{1});
  EXPECT_TRUE(splines.covers(0, 3));
  EXPECT_TRUE(splines.covers("1/2"_q, 2));
  EXPECT_FALSE(splines.covers("-1/1000000000000"_q, 3));
  EXPECT_FALSE(splines.covers(0, "3000000000001/1000000000000"_q));
  EXPECT_TRUE(turns.covers(-1000, 1000));
  EXPECT_EQ(splines.breaks_between(0, 3), (std::vector<Rational>{1}));
  EXPECT_EQ(splines.breaks_between(1, 3), (std::vector<Rational>{}));
  EXPECT_EQ(turns.breaks_between(0, 3), (std::vector<Rational>{}));
}

}  // namespace
}  // namespace patchproof::test
