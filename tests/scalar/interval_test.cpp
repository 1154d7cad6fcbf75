// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/interval.h"

#include <gtest/gtest.h>

#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

bool contains(const Interval& interval, const Rational& x) {
  return (interval.inf() == -kInfinity || from_double(interval.inf()) <= x) &&
         (interval.sup() == kInfinity || x <= from_double(interval.sup()));
}

// An interval around or beside x, and a rational number inside it.
struct Inside {
  Interval interval;
  Rational x;
};
Inside random_inside(WildNumbers& random) {
  const double a = random.below(4) == 0 ? random.finite() : random.moderate();
  const double b = random.below(3) == 0 ? a : random.below(2) == 0 ? std::nextafter(a, kInfinity) : random.moderate();
  if (!std::isfinite(b)) return {Interval(a), from_double(a)};
  const double lower = std::min(a, b), upper = std::max(a, b);
  const Rational weight = Rational(random.below(5)) / Rational(4);
  return {Interval(lower, upper), from_double(lower) + weight * (from_double(upper) - from_double(lower))};
}

TEST(IntervalLaws, Law1_ContainsTheExactResult) {
  WildNumbers random;
  const RoundingGuard guard;
  for (int i = 0; i < 5000; ++i) {
    const auto [a, x] = random_inside(random);
    const auto [b, y] = random_inside(random);
    const Interval sum = a + b, difference = a - b, product = a * b, quotient = a / b;
    EXPECT_TRUE(contains(sum, x + y)) << x << " + " << y;
    EXPECT_TRUE(contains(difference, x - y)) << x << " - " << y;
    EXPECT_TRUE(contains(product, x * y)) << x << " * " << y;
    if (y != 0) {
      EXPECT_TRUE(contains(quotient, x / y)) << x << " / " << y;
    }
    EXPECT_TRUE(contains(-a, -x));
    Interval square = a;
    square *= square;
    EXPECT_TRUE(contains(square, x * x)) << "aliased";
    if (x >= 0) {
      const Interval root = sqrt(a);  // lower² ≤ x ≤ upper²
      EXPECT_GE(root.inf(), 0);
      EXPECT_LE(from_double(root.inf()) * from_double(root.inf()), x);
      EXPECT_TRUE(root.sup() == kInfinity || from_double(root.sup()) * from_double(root.sup()) >= x);
    }
  }
}

TEST(IntervalLaws, Law1_ResultsAreTight) {
  const RoundingGuard guard;
  const Interval third = Interval(1) / Interval(3);
  EXPECT_EQ(std::nextafter(third.inf(), 1.0), third.sup());
  const Interval tenth(0.1), sum = tenth + Interval(0.2);
  EXPECT_EQ(std::nextafter(sum.inf(), 1.0), sum.sup());
  EXPECT_TRUE((Interval(3) * Interval(7) - Interval(21)).is_point());
}

TEST(IntervalLaws, Law1_UnboundedOperands) {
  const RoundingGuard guard;
  const Interval all(-kInfinity, kInfinity), large(kLargest, kInfinity), zero(0);
  for (const Interval& a : {all, large, -large}) {
    for (const Interval& b : {all, large, -large, zero, Interval(1), Interval(-1, 2)}) {
      for (const Interval& r : {a + b, b - a, a - b, a * b, b * a, b / a, a / b}) {
        EXPECT_FALSE(std::isnan(r.inf()) || std::isnan(r.sup()));
        EXPECT_LE(r.inf(), r.sup());
      }
    }
    EXPECT_TRUE(contains(a * zero, Rational(0)));
    EXPECT_TRUE(contains(large - large, Rational(0)));
  }
}

TEST(IntervalLaws, Law2_EncloseContainsAndIsTight) {
  const auto expect_enclosed = [](const Rational& x) {
    const Interval e = enclose(x);
    EXPECT_TRUE(contains(e, x)) << x;
    EXPECT_TRUE(e.is_point() || std::nextafter(e.inf(), kInfinity) == e.sup()) << x;
  };
  WildNumbers random;
  for (double x : edge_doubles()) {
    EXPECT_TRUE(enclose(from_double(x)).is_point());
    EXPECT_EQ(enclose(from_double(x)).inf(), x);
    for (long e : {-3000L, -1100L, -60L}) expect_enclosed(from_double(x) + power_of_two(e));
    for (long e : {-3000L, -1100L, -60L}) expect_enclosed(from_double(x) - power_of_two(e));
    expect_enclosed(from_double(x) / Rational(3));
  }
  for (int i = 0; i < 2000; ++i) {
    const double x = random.finite();
    EXPECT_TRUE(enclose(from_double(x)).is_point()) << x;
    expect_enclosed(random.rational(120));
    expect_enclosed(scaled(random.rational(60), random.below(2300) - 1150));
    expect_enclosed(Rational(random.integer(random.below(900) + 1)));
  }
  for (const Rational& x : {from_double(kLargest) + Rational(1), power_of_two(1024), power_of_two(100000)}) {
    EXPECT_EQ(enclose(x).inf(), kLargest);
    EXPECT_EQ(enclose(x).sup(), kInfinity);
    EXPECT_EQ(enclose(-x).inf(), -kInfinity);
    EXPECT_EQ(enclose(-x).sup(), -kLargest);
  }
  EXPECT_EQ(enclose(power_of_two(-100000)).inf(), 0);
  EXPECT_EQ(enclose(power_of_two(-100000)).sup(), kTiniest);
}

TEST(IntervalLaws, Law2_EncloseWhateverTheRoundingMode) {
  WildNumbers random;
  for (int i = 0; i < 500; ++i) {
    const Rational x = scaled(random.rational(60), random.below(2300) - 1150);
    const Interval outside = enclose(x);
    const RoundingGuard guard;
    const Interval inside = enclose(x);
    EXPECT_TRUE(contains(inside, x) && inside.inf() == outside.inf() && inside.sup() == outside.sup()) << x;
  }
}

TEST(IntervalLaws, Law3_SignOnlyWhenCertain) {
  using traits = scalar_traits<Interval>;
  EXPECT_EQ(traits::sign(Interval(kTiniest, 1.0)), Sign::positive);
  EXPECT_EQ(traits::sign(Interval(-1.0, -kTiniest)), Sign::negative);
  EXPECT_EQ(traits::sign(Interval(0.0)), Sign::zero);
  EXPECT_EQ(traits::sign(Interval(-0.0, 0.0)), Sign::zero);
  EXPECT_EQ(traits::sign(Interval(0.0, 1.0)), std::nullopt);
  EXPECT_EQ(traits::sign(Interval(-1.0, 0.0)), std::nullopt);
  EXPECT_EQ(traits::sign(Interval(-kTiniest, kTiniest)), std::nullopt);
}

TEST(IntervalLaws, Law4_DefaultIsZeroAndDivisionByZeroIsEverything) {
  EXPECT_EQ(Interval().inf(), 0);
  EXPECT_EQ(Interval().sup(), 0);
  const RoundingGuard guard;
  for (const Interval& b : {Interval(0), Interval(-1, 1)}) {
    for (const Interval& a : {Interval(0), Interval(1), Interval(-1, 2)}) {
      EXPECT_EQ((a / b).inf(), -kInfinity);
      EXPECT_EQ((a / b).sup(), kInfinity);
    }
  }
}

TEST(Interval, RefusesWhatIsNoInterval) {
  EXPECT_THROW(Interval(std::nan("")), contract_error);
  EXPECT_THROW(Interval{kInfinity}, contract_error);
  EXPECT_THROW(Interval(1.0, 0.0), contract_error);
  EXPECT_THROW(Interval(std::nan(""), 1.0), contract_error);
  EXPECT_THROW(Interval(0.0, std::nan("")), contract_error);
  EXPECT_THROW(Interval(kInfinity, kInfinity), contract_error);
  EXPECT_THROW(Interval(-kInfinity, -kInfinity), contract_error);
  const RoundingGuard guard;
  EXPECT_THROW(sqrt(Interval(-2, -1)), contract_error);
}

#ifndef NDEBUG  // only these builds check it
TEST(Interval, ArithmeticNeedsAGuard) {
  EXPECT_THROW(Interval(1) + Interval(2), contract_error);
  EXPECT_THROW(sqrt(Interval(2)), contract_error);
  const RoundingGuard guard;
  EXPECT_NO_THROW(Interval(1) + Interval(2));
}
#endif

void expect_scaled_enclosure(const ScaledInterval& s, const Rational& x) {
  const Rational lower = scaled(from_double(s.mantissa.inf()), s.exponent);
  const Rational upper = scaled(from_double(s.mantissa.sup()), s.exponent);
  EXPECT_TRUE(lower <= x && x <= upper);
  if (x == 0) {
    EXPECT_TRUE(s.mantissa.is_point());
    return;
  }
  for (double end : {s.mantissa.inf(), s.mantissa.sup()}) {
    EXPECT_GE(std::fabs(end), 0.5);
    EXPECT_LE(std::fabs(end), 1.0);
  }
  EXPECT_LE(s.mantissa.sup() - s.mantissa.inf(), 0x1p-53) << "one unit in the last place";
}

TEST(Interval, EncloseScaledOfLongNumbers) {
  WildNumbers random;
  for (int i = 0; i < 200; ++i) {
    const Integer p = random.integer(10000), q = random.integer(1 + random.below(10000));
    expect_scaled_enclosure(enclose_scaled(p), Rational(p));
    expect_scaled_enclosure(enclose_scaled(Rational(p)), Rational(p));
    if (q != 0) {
      expect_scaled_enclosure(enclose_scaled(Rational(p) / Rational(q)), Rational(p) / Rational(q));
    }
  }
}

TEST(Interval, EncloseScaledNearPowersOfTwo) {
  const Integer power = Integer(1) << 9999;
  for (const Integer& p : {power, Integer(power - 1), Integer(power + 1), Integer(1), Integer(0), Integer(3)}) {
    for (const Integer& signed_p : {p, Integer(-p)}) {
      const Rational x(signed_p), inverse = p == 0 ? x : Rational(1) / x;
      expect_scaled_enclosure(enclose_scaled(signed_p), x);
      expect_scaled_enclosure(enclose_scaled(x), x);
      expect_scaled_enclosure(enclose_scaled(inverse), inverse);
    }
  }
  EXPECT_TRUE(enclose_scaled(power).mantissa.is_point());
  EXPECT_TRUE(enclose_scaled(Rational(power)).mantissa.is_point());
}

TEST(Interval, ScaleByPowerOfTwoRoundsOutward) {
  WildNumbers random;
  for (int i = 0; i < 3000; ++i) {
    const auto [a, x] = random_inside(random);
    const long e = random.below(5000) - 2500;
    EXPECT_TRUE(contains(scale_by_power_of_two(a, e), scaled(x, e))) << x << " * 2^" << e;
  }
  const Interval exact = scale_by_power_of_two(Interval(-3.0, 5.0), 1000);
  EXPECT_EQ(exact.inf(), -3 * 0x1p1000);
  EXPECT_EQ(exact.sup(), 5 * 0x1p1000);
  EXPECT_TRUE(scale_by_power_of_two(Interval(0.0), 1000000).is_point());
}

TEST(Interval, ScaleByPowerOfTwoSaturates) {
  for (long e : {1100L, 5000L, 1000000L, std::numeric_limits<long>::max()}) {
    EXPECT_EQ(scale_by_power_of_two(Interval(1.0), e).inf(), kLargest);
    EXPECT_EQ(scale_by_power_of_two(Interval(1.0), e).sup(), kInfinity);
    EXPECT_EQ(scale_by_power_of_two(Interval(-2.0, 0.0), e).inf(), -kInfinity);
    EXPECT_EQ(scale_by_power_of_two(Interval(-2.0, 0.0), e).sup(), 0);
  }
  for (long e : {-1200L, -5000L, -1000000L, std::numeric_limits<long>::min()}) {
    const Interval tiny = scale_by_power_of_two(Interval(-1.0, 1.0), e),
                   right = scale_by_power_of_two(Interval(1.0), e);
    EXPECT_EQ(tiny.inf(), -kTiniest);
    EXPECT_EQ(tiny.sup(), kTiniest);
    EXPECT_TRUE(right.inf() >= -kTiniest && right.inf() <= 0 && right.sup() == kTiniest);
  }
  // Unbounded ends stay unbounded, and the finite end is scaled.
  EXPECT_EQ(scale_by_power_of_two(Interval(1.0, kInfinity), -5).sup(), kInfinity);
  EXPECT_EQ(scale_by_power_of_two(Interval(1.0, kInfinity), -5).inf(), 0x1p-5);
  EXPECT_EQ(scale_by_power_of_two(Interval(-kInfinity, 8.0), 5).inf(), -kInfinity);
}

}  // namespace
}  // namespace patchproof::test
