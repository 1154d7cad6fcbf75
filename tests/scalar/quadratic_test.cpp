// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/quadratic.h"

#include <gtest/gtest.h>

#include "patchproof/scalar/ball.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

Quadratic root(int d) { return Quadratic(Rational(0), Rational(1), d); }

// a + b√2, rational one time in eight.
Quadratic random_quadratic(WildNumbers& random, int bits = 30) {
  const Rational a = random.rational(bits);
  return random.below(8) == 0 ? Quadratic(a) : Quadratic(a, random.rational(bits), 2);
}

TEST(QuadraticLaws, Law1_FieldAxioms) {
  WildNumbers random;
  const Quadratic zero, one(1);
  for (int i = 0; i < 300; ++i) {
    const Quadratic a = random_quadratic(random), b = random_quadratic(random), c = random_quadratic(random);
    EXPECT_TRUE((a + b) + c == a + (b + c));
    EXPECT_TRUE((a * b) * c == a * (b * c));
    EXPECT_TRUE(a + b == b + a && a * b == b * a);
    EXPECT_TRUE(a * (b + c) == a * b + a * c);
    EXPECT_TRUE(a + zero == a && a * one == a && a + (-a) == zero && a - b == a + (-b));
    if (!(b == zero)) {
      EXPECT_TRUE((a / b) * b == a && b / b == one);
    }
    Quadratic sum = a;
    sum += sum;
    EXPECT_TRUE(sum == a * Quadratic(2)) << "aliased";
  }
}

TEST(QuadraticLaws, Law1_OrderAgreesWithEnclosures) {
  WildNumbers random;
  for (int i = 0; i < 300; ++i) {
    const Quadratic a = random_quadratic(random), b = random_quadratic(random);
    const auto exact = a <=> b;
    EXPECT_EQ(exact == 0, a == b);
    const auto ball = [](const Quadratic& x) {
      return Ball(x.rational_part()) + Ball(x.root_coefficient()) * sqrt(Ball(2));
    };
    const auto sign = (ball(a) - ball(b)).sign();
    if (sign) {
      EXPECT_EQ(exact > 0, *sign == Sign::positive);
    }
    EXPECT_EQ(exact > 0, (b <=> a) < 0);
  }
}

TEST(QuadraticLaws, Law2_SignNearCancellation) {
  const auto sign = [](long a, long b, int d) { return Quadratic(Rational(a), Rational(b), d).sign(); };
  EXPECT_EQ(sign(665857, -470832, 2), Sign::positive);  // 665857² − 2·470832² = 1
  EXPECT_EQ(sign(-665857, 470832, 2), Sign::negative);
  EXPECT_EQ(sign(275807, -195025, 2), Sign::negative);  // … = −1
  EXPECT_EQ(sign(0, -1, 3), Sign::negative);
  EXPECT_EQ(sign(0, 0, 3), Sign::zero);
  EXPECT_EQ(sign(-5, 0, 3), Sign::negative);
  EXPECT_EQ(sign(-1, 1, 2147483647), Sign::positive);
  // (√2 − 1)^n shrinks as 0.41^n with ever longer coefficients, and its conjugate alternates.
  Quadratic shrinking(1), conjugate(1);
  for (int n = 1; n <= 400; ++n) {
    shrinking = shrinking * (root(2) - Quadratic(1));
    conjugate = conjugate * (-root(2) - Quadratic(1));
    EXPECT_EQ(shrinking.sign(), Sign::positive);
    EXPECT_EQ(conjugate.sign(), n % 2 == 0 ? Sign::positive : Sign::negative);
  }
}

TEST(Quadratic, SquaresLeaveTheRoot) {
  EXPECT_TRUE(root(8) == Quadratic(2) * root(2));
  EXPECT_EQ(root(8).root(), 2);
  EXPECT_EQ(root(2 * 3 * 3 * 5 * 5).root_coefficient(), Rational(15));
  EXPECT_EQ(root(2147395602).root(), 2147395602) << "2·3·357899267 has no square";
  EXPECT_TRUE(root(8) * root(2) == Quadratic(4));
  EXPECT_TRUE((root(2) * root(2)).is_rational());
}

TEST(Quadratic, MixedRootsBreakTheContract) {
  EXPECT_THROW(root(2) + root(3), contract_error);
  EXPECT_THROW(root(2) - root(3), contract_error);
  EXPECT_THROW(root(2) * root(3), contract_error);
  EXPECT_THROW(root(2) / root(3), contract_error);
  EXPECT_THROW((void)(root(2) == root(3)), contract_error);
  EXPECT_THROW((void)(root(2) < root(3)), contract_error);
  for (int d : {-2, 0, 1, 4, 9, 2147395600}) EXPECT_THROW(root(d), contract_error) << d;
  EXPECT_THROW(root(2) / Quadratic(0), contract_error);
  EXPECT_THROW(root(2) / (root(2) - root(2)), contract_error);
}

TEST(Quadratic, ARationalResultForgetsItsRoot) {
  const Quadratic cancelled = (Quadratic(1) + root(2)) - root(2);
  EXPECT_TRUE(cancelled.is_rational());
  EXPECT_EQ(cancelled.root(), 1);
  EXPECT_TRUE(cancelled + root(3) == Quadratic(1) + root(3));
  EXPECT_TRUE((root(2) * Quadratic(0)) + root(3) == root(3));
  EXPECT_TRUE(Quadratic(Rational(1), Rational(0), 2) + root(3) == Quadratic(1) + root(3));
  EXPECT_EQ(Quadratic(Rational(3), Rational(0), 5).root_coefficient(), Rational(0));
}

// x as (Quadratic − y).sign(), the exact comparison that enclosures must respect.
void expect_encloses(const ScaledInterval& s, const Quadratic& x) {
  const Quadratic lower(scaled(from_double(s.mantissa.inf()), s.exponent));
  const Quadratic upper(scaled(from_double(s.mantissa.sup()), s.exponent));
  EXPECT_TRUE(lower <= x && x <= upper);
  EXPECT_LE(s.mantissa.sup() - s.mantissa.inf(), 0x1p-51);
  EXPECT_GE(std::max(std::fabs(s.mantissa.inf()), std::fabs(s.mantissa.sup())), 0.5);
  EXPECT_LE(std::max(std::fabs(s.mantissa.inf()), std::fabs(s.mantissa.sup())), 1.0);
}

TEST(Quadratic, EnclosuresStayTightUnderCancellation) {
  WildNumbers random;
  Quadratic tiny(1);
  for (int i = 0; i < 200; ++i) {
    tiny = tiny * (i % 3 == 0 ? Quadratic(1) - root(2) : root(2) - Quadratic(1));
    expect_encloses(enclose_scaled(tiny), tiny);
    const Interval narrow = enclose(tiny);
    EXPECT_TRUE(Quadratic(from_double(narrow.inf())) <= tiny && tiny <= Quadratic(from_double(narrow.sup())));
    EXPECT_LE(narrow.sup() - narrow.inf(), 2 * kTiniest + std::fabs(narrow.inf()) * 0x1p-52);
    const Quadratic wild = random_quadratic(random, 200);
    if (wild.sign() != Sign::zero) expect_encloses(enclose_scaled(wild), wild);
  }
  const Quadratic huge = Quadratic(power_of_two(20000)) * root(2);
  expect_encloses(enclose_scaled(huge), huge);
  EXPECT_EQ(enclose(huge).inf(), kLargest);
  EXPECT_EQ(enclose(huge).sup(), kInfinity);
}

TEST(Quadratic, NearestDoubleIsCorrectlyRounded) {
  EXPECT_EQ(nearest_double(root(2)), std::sqrt(2.0));
  EXPECT_EQ(nearest_double(-root(3)), -std::sqrt(3.0));
  EXPECT_EQ(nearest_double(Quadratic(1)), 1.0);
  WildNumbers random;
  const auto expect_nearest = [](const Quadratic& x) {
    const double d = nearest_double(x);
    for (double neighbour : {std::nextafter(d, kInfinity), std::nextafter(d, -kInfinity)}) {
      if (!std::isfinite(neighbour)) continue;
      const Quadratic middle((from_double(d) + from_double(neighbour)) / Rational(2));
      EXPECT_TRUE(neighbour > d ? x <= middle : middle <= x);
    }
  };
  for (int i = 0; i < 300; ++i) {
    expect_nearest(random_quadratic(random, 60));
    // Near the middle of two doubles, and among subnormals.
    const Rational middle = (from_double(1.25) + from_double(std::nextafter(1.25, 2.0))) / Rational(2);
    expect_nearest(Quadratic(middle, scaled(random.rational(20), -200), 2));
    expect_nearest(Quadratic(power_of_two(-1074)) * random_quadratic(random, 4));
  }
  const Quadratic below_largest(from_double(kLargest), -power_of_two(900), 2);
  EXPECT_EQ(nearest_double(below_largest), kLargest);
  EXPECT_EQ(nearest_double(Quadratic(from_double(kLargest), power_of_two(900), 2)), kLargest);
  EXPECT_EQ(nearest_double(Quadratic(from_double(kLargest), power_of_two(970), 2)), kInfinity);
  EXPECT_EQ(nearest_double(Quadratic(power_of_two(5000)) * -root(2)), -kInfinity);
  EXPECT_EQ(nearest_double(Quadratic(power_of_two(-5000)) * root(2)), 0);
}

}  // namespace
}  // namespace patchproof::test
