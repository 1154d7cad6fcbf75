// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/ball.h"

#include <gtest/gtest.h>

#include <utility>

#include "patchproof/contract.h"
#include "patchproof/scalar/parse_scalar.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

bool is_whole_line(const Ball& b) {
  const Interval i = b.to_interval();
  return i.inf() == -kInfinity && i.sup() == kInfinity;
}

// Decimal digits of a famous number, cut off: truth lies between the digits and one unit more in the last place.
void expect_digits(const Ball& value, const std::string& digits, int bits) {
  const Rational below = *parse_scalar<Rational>(digits);
  const auto places = static_cast<long>(digits.size() - digits.find('.') - 1);
  const Rational above = below + *parse_scalar<Rational>("1e-" + std::to_string(places));
  EXPECT_NE((value - Ball(below)).sign(), Sign::negative) << digits;
  EXPECT_NE((value - Ball(above)).sign(), Sign::positive) << digits;
  EXPECT_TRUE(value.is_tight(bits)) << digits;
}

TEST(BallLaws, Law1_ContainsTheExactResult) {
  WildNumbers random;
  for (int bits : {2, 24, 53, 128, 300}) {
    const BallPrecision precision(bits);
    for (int i = 0; i < 200; ++i) {
      const Rational x = random.rational(80), y = random.rational(80);
      const Ball a(x), b(y);
      EXPECT_TRUE(a.contains(x) && (a + b).contains(x + y) && (a - b).contains(x - y) && (a * b).contains(x * y));
      EXPECT_TRUE((-a).contains(-x));
      if (y != 0) {
        EXPECT_TRUE((a / b).contains(x / y));
      }
      Ball sum = a;
      sum += sum;
      EXPECT_TRUE(sum.contains(x + x)) << "aliased";
      const Rational square = x * x;
      EXPECT_TRUE(sqrt(Ball(square)).contains(abs(x)));
    }
  }
}

TEST(BallLaws, Law1_WideOperands) {
  WildNumbers random;
  const RoundingGuard guard;
  for (int i = 0; i < 300; ++i) {
    const Rational x = random.rational(), y = random.rational(), r = abs(random.rational(20));
    const Interval a(nearest_double(x - r), nearest_double(x + r)), b(nearest_double(y - r), nearest_double(y + r));
    for (const Rational& s : {from_double(a.inf()), from_double(a.sup())})
      for (const Rational& t : {from_double(b.inf()), from_double(b.sup())}) {
        EXPECT_TRUE((Ball(a) * Ball(b)).contains(s * t));
        if (t != 0) {
          EXPECT_TRUE((Ball(a) / Ball(b)).contains(s / t));
        }
      }
  }
}

TEST(BallLaws, Law1_DivisionByABallWithZero) {
  const Ball zero, around(Interval(-1, 1)), from_zero(Interval(0, 1));
  for (const Ball& a : {zero, Ball(1), around})
    for (const Ball& b : {zero, around, from_zero}) {
      EXPECT_TRUE(is_whole_line(a / b));
      EXPECT_TRUE((a / b).contains(power_of_two(5000)));
      EXPECT_EQ((a / b).sign(), std::nullopt);
      EXPECT_TRUE(((a / b) * zero).contains(Rational(0)));
      EXPECT_TRUE(is_whole_line(a / b - a / b));
      EXPECT_FALSE((a / b).is_tight(1));
      const ScaledInterval unbounded = (a / b).to_scaled_interval();
      EXPECT_EQ(unbounded.mantissa.inf(), -kInfinity);
      EXPECT_EQ(unbounded.mantissa.sup(), kInfinity);
    }
}

TEST(BallLaws, Law1_RootsAndArcs) {
  const std::string pi = "3.14159265358979323846264338327950288419716939937510";
  expect_digits(Ball::pi(), pi, 120);
  expect_digits(sqrt(Ball(2)), "1.41421356237309504880168872420969807856967187537694", 120);
  expect_digits(Ball(4) * atan(Ball(1)), pi, 120);
  // Machin: π/4 = 4·atan(1/5) − atan(1/239).
  const auto atan_of = [](int n) { return atan(Ball(Rational(1) / Rational(n))); };
  expect_digits(Ball(16) * atan_of(5) - Ball(4) * atan_of(239), pi, 110);
  expect_digits(exp(Ball(1)), "2.71828182845904523536028747135266249775724709369996", 120);
  expect_digits(sin(Ball(1)), "0.84147098480789650665250232163029899962256306079837", 120);
  expect_digits(cos(Ball(1)), "0.54030230586813971740093660744297660373231042061792", 120);
  EXPECT_TRUE(sin(Ball(Interval(1, 2))).contains(Rational(1))) << "the summit lies inside";
  EXPECT_TRUE(sqrt(Ball(Interval(-1, 4))).contains(Rational(0))) << "the negative part is cut off";
  EXPECT_TRUE(sqrt(Ball(Interval(-1, 4))).contains(Rational(2)));
  EXPECT_EQ(sqrt(Ball(0)).sign(), Sign::zero);
  EXPECT_THROW(sqrt(Ball(-1)), contract_error);
}

TEST(BallLaws, Law2_PrecisionFollowsTheScope) {
  EXPECT_EQ(BallPrecision::current(), 128);
  const Ball before = sqrt(Ball(2));
  {
    const BallPrecision wide(1000);
    EXPECT_EQ(BallPrecision::current(), 1000);
    EXPECT_TRUE(sqrt(Ball(2)).is_tight(990));
    EXPECT_FALSE((before + Ball(0)).is_tight(200)) << "an old ball gains nothing";
    {
      const BallPrecision narrow(20);
      EXPECT_FALSE(sqrt(Ball(2)).is_tight(30));
    }
    EXPECT_EQ(BallPrecision::current(), 1000);
  }
  EXPECT_EQ(BallPrecision::current(), 128);
  EXPECT_FALSE(sqrt(Ball(2)).is_tight(140));
  EXPECT_THROW(BallPrecision(1), contract_error);
  EXPECT_EQ(BallPrecision::current(), 128) << "a refused precision changes nothing";
}

TEST(Ball, CopiesAndMoves) {
  const BallPrecision precision(200);
  const Rational x = Rational(1) / Rational(3);
  Ball a(x), b(a);
  EXPECT_TRUE(b.contains(x) && b.is_tight(190)) << "a copy keeps the precision";
  {
    const BallPrecision narrow(10);
    Ball c(5);
    c = a;
    EXPECT_TRUE(c.contains(x) && c.is_tight(190));
  }
  Ball& same = a;
  a = same;
  EXPECT_TRUE(a.contains(x) && a.is_tight(190)) << "assigned to itself";
  a = std::move(same);
  EXPECT_TRUE(a.contains(x) && a.is_tight(190)) << "moved to itself";
  Ball moved(std::move(a));
  EXPECT_TRUE(moved.contains(x));
  a = Ball(7);  // a moved-from ball may be assigned
  EXPECT_TRUE(a.contains(Rational(7)));
  std::swap(a, moved);
  EXPECT_TRUE(a.contains(x) && moved.contains(Rational(7)));
}

TEST(Ball, RefusesWhatIsNoNumber) {
  EXPECT_THROW(Ball(std::nan("")), contract_error);
  EXPECT_THROW(Ball{kInfinity}, contract_error);
}

TEST(Ball, LeavesAsIntervals) {
  WildNumbers random;
  for (int i = 0; i < 300; ++i) {
    const Rational x = scaled(random.rational(300), random.below(6000) - 3000);
    if (x == 0) continue;
    const Interval rounded = Ball(x).to_interval();
    EXPECT_TRUE(rounded.inf() == -kInfinity || from_double(rounded.inf()) <= x);
    EXPECT_TRUE(rounded.sup() == kInfinity || from_double(rounded.sup()) >= x);
    const ScaledInterval s = Ball(x).to_scaled_interval();
    EXPECT_LE(scaled(from_double(s.mantissa.inf()), s.exponent), x);
    EXPECT_GE(scaled(from_double(s.mantissa.sup()), s.exponent), x);
    const double size = std::max(std::fabs(s.mantissa.inf()), std::fabs(s.mantissa.sup()));
    EXPECT_TRUE(size >= 0.5 && size <= 1);
    EXPECT_LE(s.mantissa.sup() - s.mantissa.inf(), 0x1p-52);
  }
  const Interval around_zero = Ball(Interval(-1, 1024)).to_scaled_interval().mantissa;
  EXPECT_TRUE(around_zero.inf() < 0 && around_zero.sup() <= 1);
  EXPECT_TRUE(Ball(0).to_scaled_interval().mantissa.is_point());
  EXPECT_EQ(Ball(0.1).to_interval().inf(), 0.1);
  EXPECT_TRUE(Ball(0.1).to_interval().is_point());
}

TEST(Ball, SignOnlyWhenCertain) {
  EXPECT_EQ(Ball(power_of_two(-100000)).sign(), Sign::positive);
  EXPECT_EQ(Ball(-power_of_two(-100000)).sign(), Sign::negative);
  EXPECT_EQ(Ball(Interval(0.0, 1.0)).sign(), std::nullopt);
  EXPECT_EQ(Ball(Interval(-1.0, 0.0)).sign(), std::nullopt);
  EXPECT_EQ((sqrt(Ball(2)) * sqrt(Ball(2)) - Ball(2)).sign(), std::nullopt);
}

}  // namespace
}  // namespace patchproof::test
