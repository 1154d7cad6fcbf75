// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/double_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wild_numbers.h"

namespace patchproof {
namespace {

Rational exact(const DoubleDouble& x) { return from_double(x.high()) + from_double(x.low()); }

// Does x enclose `truth` within its error, and is high the double nearest to high + low?
void expect_encloses(const DoubleDouble& x, const Rational& truth, const char* what) {
  if (!std::isfinite(x.error())) return;
  ASSERT_LE(abs(exact(x) - truth), from_double(x.error())) << what;
  ASSERT_EQ(nearest_double(exact(x)), x.high()) << what;
}

// Pairs of doubles of every size, and sums of such.
std::vector<DoubleDouble> numbers(std::mt19937_64& random, int count) {
  std::vector<DoubleDouble> out = {DoubleDouble(0), DoubleDouble(1), DoubleDouble(-3), DoubleDouble(0x1p-1074),
                                   DoubleDouble(0x1.fffffffffffffp1000)};
  std::uniform_int_distribution<int> exponent(-300, 300), near(-60, -50);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  for (int i = 0; i < count; ++i) {
    const double high = std::ldexp(mantissa(random), i % 3 == 0 ? exponent(random) : exponent(random) / 100);
    out.push_back(DoubleDouble(high) + DoubleDouble(high * std::ldexp(mantissa(random), near(random))));
  }
  return out;
}

TEST(DoubleDouble, Law1ResultsLieWithinTheirErrors) {
  std::mt19937_64 random(11);
  const auto xs = numbers(random, 60);
  int quotients = 0;
  for (const DoubleDouble& a : xs)
    for (const DoubleDouble& b : xs) {
      // Inputs with errors of their own: the truth is some number within them.
      for (const double share : {0.0, 1.0, -1.0}) {
        const DoubleDouble a2(a.high(), a.low(), std::fabs(a.high()) * 0x1p-80 + a.error());
        const Rational ta = exact(a2) + from_double(a2.error()) * from_double(share);
        const Rational tb = exact(b) - from_double(b.error()) * from_double(share);
        expect_encloses(a2 + b, ta + tb, "sum");
        expect_encloses(a2 - b, ta - tb, "difference");
        expect_encloses(a2 * b, ta * tb, "product");
        if (tb != Rational(0) && std::isfinite((a2 / b).error())) {
          expect_encloses(a2 / b, ta / tb, "quotient");
          ++quotients;
        }
      }
    }
  EXPECT_GT(quotients, 5000);
}

TEST(DoubleDouble, Law2ErrorsAreAsSmallAsStated) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> d(1, 2);
  const auto ratio = [](const DoubleDouble& x) { return x.error() / std::fabs(x.high()); };
  for (int i = 0; i < 1000; ++i) {
    const DoubleDouble a(d(random)), b(-d(random) / 4);  // no errors to propagate
    const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
    EXPECT_LE(ratio(a + b), 0x1.1p-104);
    EXPECT_LE(ratio(a * b), 0x1.1p-103);
    EXPECT_LE(ratio(a / b), 0x1.1p-102);
    EXPECT_LE(ratio(third), 0x1.1p-102);
  }
  EXPECT_EQ((DoubleDouble(5) - DoubleDouble(5)).error(), 0);
}

TEST(DoubleDouble, Law3SumsAndProductsOfTwoDoublesAreExactInValue) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> d(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double a = d(random), b = std::ldexp(d(random), i % 100 - 50);
    EXPECT_EQ(exact(DoubleDouble::product(a, b)), from_double(a) * from_double(b));
    EXPECT_EQ(exact(DoubleDouble(a) + DoubleDouble(b)), from_double(a) + from_double(b));
  }
}

TEST(DoubleDouble, DivisionByWhatMayBeZeroAndOverflowKnowNothing) {
  EXPECT_TRUE(std::isinf((DoubleDouble(1) / DoubleDouble(0)).error()));
  EXPECT_TRUE(std::isinf((DoubleDouble(1) / DoubleDouble(1e-20, 0, 1e-19)).error()));
  EXPECT_TRUE(std::isinf((DoubleDouble(1e200) * DoubleDouble(1e200)).error()));
  EXPECT_EQ(scalar_traits<DoubleDouble>::sign(DoubleDouble(1e-20, 0, 1e-19)), std::nullopt);
  EXPECT_EQ(scalar_traits<DoubleDouble>::sign(DoubleDouble(-1e-20, 0, 1e-30)), Sign::negative);
  EXPECT_EQ(scalar_traits<DoubleDouble>::sign(DoubleDouble(0)), Sign::zero);
}

}  // namespace
}  // namespace patchproof
