// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/rational.h"

#include <gtest/gtest.h>

#include <cfenv>

#include "patchproof/contract.h"
#include "patchproof/scalar/interval.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

TEST(RationalLaws, Law1_ArithmeticIsExact) {
  EXPECT_EQ(Rational(1) / Rational(3) + Rational(1) / Rational(6), Rational(1) / Rational(2));
  WildNumbers random;
  for (int i = 0; i < 300; ++i) {
    const Rational a = random.rational(), b = random.rational(), c = random.rational();
    EXPECT_EQ((a + b) + c, a + (b + c));
    EXPECT_EQ(a * (b + c), a * b + a * c);
    EXPECT_EQ((a - b) + b, a);
    if (b != 0) {
      EXPECT_EQ((a / b) * b, a);
    }
    EXPECT_EQ(gcd(numerator(a), denominator(a)), 1) << "lowest terms";
    EXPECT_GT(denominator(a), 0);
  }
}

TEST(RationalLaws, Law2_FromDoubleIsExact) {
  EXPECT_EQ(from_double(0.1), Rational("3602879701896397/36028797018963968"));
  EXPECT_EQ(from_double(kTiniest), power_of_two(-1074));
  EXPECT_EQ(from_double(-kLargest), scaled(Rational(1) - power_of_two(53), 971));
  EXPECT_EQ(from_double(-0.0), Rational(0));
  EXPECT_THROW(from_double(kInfinity), contract_error);
  EXPECT_THROW(from_double(-kInfinity), contract_error);
  EXPECT_THROW(from_double(std::nan("")), contract_error);
}

// What "nearest, ties to even" means, said without MPFR: no neighbour is nearer, and of two equally near the even one.
void expect_nearest(const Rational& x) {
  const double d = nearest_double(x);
  const Rational beyond = power_of_two(1024);  // where the double after the largest would be
  const auto value = [&](double y) { return std::isfinite(y) ? from_double(y) : y > 0 ? beyond : Rational(-beyond); };
  const Rational error = abs(Rational(value(d) - x));
  for (double neighbour : {std::nextafter(d, kInfinity), std::nextafter(d, -kInfinity)}) {
    const Rational other = abs(Rational(value(neighbour) - x));
    EXPECT_LE(error, other) << x;
    if (error == other && neighbour != d) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(d) & 1, 0u) << "tie not to even: " << x;
    }
  }
}

TEST(RationalLaws, Law3_NearestDoubleIsCorrectlyRounded) {
  for (double x : edge_doubles()) {
    EXPECT_EQ(nearest_double(from_double(x)), x);
    const Rational gap = from_double(x) - from_double(std::nextafter(x, 0.0));
    const Rational crumb = scaled(gap, -200);
    for (int k = -8; k <= 8; ++k)  // quarters of a unit in the last place, and a little beside them
      for (const Rational& aside : {Rational(0), crumb, Rational(-crumb)})
        expect_nearest(from_double(x) + scaled(gap * Rational(k), -2) + aside);
  }
  for (int e = -1080; e < -1060; ++e)
    for (int m : {1, 3, 5, 7, 9, 11}) expect_nearest(scaled(Rational(m), e));
  WildNumbers random;
  for (int i = 0; i < 2000; ++i) {
    expect_nearest(random.rational(100));
    expect_nearest(scaled(random.rational(60), random.below(2300) - 1150));
  }
}

TEST(RationalLaws, Law3_BeyondTheRange) {
  const Rational largest = from_double(kLargest), half_gap = power_of_two(970);
  EXPECT_EQ(nearest_double(largest + half_gap), kInfinity) << "a tie with the even 2^1024";
  EXPECT_EQ(nearest_double(largest + half_gap - power_of_two(-5000)), kLargest);
  EXPECT_EQ(nearest_double(-power_of_two(100000)), -kInfinity);
  EXPECT_EQ(nearest_double(power_of_two(-100000)), 0);
  EXPECT_EQ(nearest_double(power_of_two(-1075)), 0) << "a tie with the even 0";
  EXPECT_EQ(nearest_double(power_of_two(-1075) + power_of_two(-5000)), kTiniest);
}

TEST(RationalLaws, Law3_WhateverTheRoundingMode) {
  const Rational third = Rational(1) / Rational(3), subnormal = power_of_two(-1074) * Rational(7) / Rational(3);
  const double a = nearest_double(third), b = nearest_double(subnormal), c = nearest_double(-third);
  const RoundingGuard guard;
  EXPECT_EQ(nearest_double(third), a);
  EXPECT_EQ(nearest_double(subnormal), b);
  EXPECT_EQ(nearest_double(-third), c);
}

TEST(RationalSign, AlwaysAnswers) {
  EXPECT_EQ(scalar_traits<Rational>::sign(Rational(-1) / power_of_two(9000)), Sign::negative);
  EXPECT_EQ(scalar_traits<Rational>::sign(power_of_two(-9000)), Sign::positive);
  EXPECT_EQ(scalar_traits<Rational>::sign(power_of_two(-9000) - power_of_two(-9000)), Sign::zero);
}

}  // namespace
}  // namespace patchproof::test
