// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/power_form.h"

#include <gtest/gtest.h>

#include "patchproof/scalar/double_double.h"
#include "patchproof/spline/bspline_basis.h"
#include "support/scalars.h"

namespace patchproof {
namespace {

TEST(PowerForm, Laws1And2TheSeriesAreTheBasisFunctionsAndSumToOne) {
  test::RandomRationals random(21);
  for (int p = 0; p <= 6; ++p)
    for (int round = 0; round < 6; ++round) {
      const auto knots = *KnotVector<Rational>::make(p, random.knots(p, p + 4));
      for (int span = p; span < knots.control_count(); ++span) {
        if (!(knots[span] < knots[span + 1])) continue;
        const Rational centre = random(), scale = random() + Rational(1000);
        const auto m = basis_power_form<Rational>(knots, span, centre, scale);
        for (int i = 0; i <= p; ++i) {
          Rational sum(0);
          for (int j = 0; j <= p; ++j) sum += m[i * (p + 1) + j];
          EXPECT_EQ(sum, Rational(i == 0 ? 1 : 0));
        }
        for (const Rational& t : {knots[span], knots[span + 1], random()}) {
          const auto basis = basis_derivatives_in_span<Rational>(knots, span, t, 0)[0];
          const Rational s = (t - centre) * scale;
          for (int j = 0; j <= p; ++j) {
            Rational value(0);
            for (int i = p; i >= 0; --i) value = value * s + m[i * (p + 1) + j];
            EXPECT_EQ(value, basis[j]);
          }
        }
      }
    }
}

TEST(PowerForm, InDoubledPrecisionTheExactCoefficientsLieWithinTheirErrors) {
  for (int p = 1; p <= 9; ++p) {
    std::vector<double> knots(p + 1, 1e6);
    for (int i = 1; i < 8; ++i) knots.push_back(1e6 + i * 0.1 + (i % 3 == 0 ? 1e-9 : 0));
    knots.resize(knots.size() + p + 1, 1e6 + 1);
    std::vector<Rational> exact_knots;
    for (const double t : knots) exact_knots.push_back(from_double(t));
    const auto in_double = *KnotVector<double>::make(p, knots);
    const auto exact = *KnotVector<Rational>::make(p, exact_knots);
    for (int span = p; span < in_double.control_count(); ++span) {
      const double centre = knots[span] + (knots[span + 1] - knots[span]) / 2;
      const auto computed = basis_power_form<DoubleDouble>(in_double, span, centre, 16.0);
      const auto truth = basis_power_form<Rational>(exact, span, from_double(centre), Rational(16));
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rational error = abs(from_double(computed[i].high()) + from_double(computed[i].low()) - truth[i]);
        ASSERT_LE(error, from_double(computed[i].error()));
        ASSERT_LE(computed[i].error(), 1e-24);  // and the errors are small
      }
    }
  }
}

TEST(PowerForm, EmptySpansAreRefused) {
  const auto knots = *KnotVector<Rational>::make(1, {0, 0, 1, 1, 2, 2});
  EXPECT_THROW(basis_power_form<Rational>(knots, 2, Rational(0), Rational(1)), contract_error);
}

}  // namespace
}  // namespace patchproof
