// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/transcendental.h"

#include <gtest/gtest.h>

#include <random>

#include "patchproof/scalar/quadratic.h"

namespace patchproof::test {
namespace {

using Model = TaylorModel<6>;
static_assert(Transcendental<double> && Transcendental<Interval> && Transcendental<Ball> && Transcendental<Model>);
static_assert(!Transcendental<Rational> && !Transcendental<Quadratic>);

bool meet(const Interval& a, const Interval& b) { return a.inf() <= b.sup() && b.inf() <= a.sup(); }
// cos and sin by the definition.
std::array<Interval, 2> by_definition(const Rational& x) {
  const Ball angle = Ball::pi() * Ball(x);
  return {cos(angle).to_interval(), sin(angle).to_interval()};
}
Rational random_place(std::mt19937_64& engine) {
  return Rational(static_cast<long>(engine() % 4001) - 2000) / Rational(static_cast<long>(engine() % 400) + 1);
}

TEST(Transcendental, Law1_EnclosuresContainTheExactNumbers) {
  const RoundingGuard guard;
  std::mt19937_64 engine(20240301);
  for (int round = 0; round < 500; ++round) {
    const Rational x = random_place(engine);
    const auto exact = by_definition(x), narrow = cos_sin_pi(enclose(x));
    const auto ball = cos_sin_pi(Ball(x));
    const auto wide = cos_sin_pi(Interval(enclose(x).inf() - 0.125, enclose(x).sup() + 0.0625));
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(meet(exact[i], narrow[i]) && meet(exact[i], ball[i].to_interval())) << x;
      EXPECT_TRUE(wide[i].inf() <= exact[i].sup() && exact[i].inf() <= wide[i].sup()) << x;
      EXPECT_LE(narrow[i].sup() - narrow[i].inf(), 1e-12) << x;
    }
  }
  EXPECT_TRUE(meet(pi<Interval>(), Ball::pi().to_interval()));
  EXPECT_EQ(pi<double>(), 3.141592653589793);
}

// ctest runs each test in a process of its own: this is the first call there.
TEST(Transcendental, Law1_PiInDoubleDoesNotDependOnThePrecisionOfTheFirstCaller) {
  const BallPrecision precision(20);
  EXPECT_EQ(pi<double>(), 3.141592653589793);
  EXPECT_EQ(cos_sin_pi(0.25)[0], cos_sin_pi(-0.25)[0]);
}

TEST(Transcendental, Law1_WideIntervalsGiveTheWholeRange) {
  const RoundingGuard guard;
  const auto half_turn = cos_sin_pi(Interval(0.25, 1.25));
  EXPECT_EQ(half_turn[0].inf(), -1);
  EXPECT_EQ(half_turn[1].sup(), 1);
  EXPECT_LT(half_turn[0].sup(), 0.7072);
  const auto everywhere = cos_sin_pi(Interval(-1e300, 1e300));
  EXPECT_TRUE(everywhere[0].inf() == -1 && everywhere[0].sup() == 1);
}

TEST(Transcendental, Law2_QuarterTurnsAreExact) {
  const double cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
  for (int k = -9; k <= 9; ++k) {
    const int turn = (k % 4 + 4) % 4;
    const double x = k / 2.0;
    EXPECT_EQ(cos_sin_pi(x)[0], cosine[turn]) << k;
    EXPECT_EQ(cos_sin_pi(x)[1], sine[turn]) << k;
    const RoundingGuard guard;
    for (int i = 0; i < 2; ++i) {
      const double exact = i == 0 ? cosine[turn] : sine[turn];
      const Interval y = cos_sin_pi(Interval(x))[i], b = cos_sin_pi(Ball(x))[i].to_interval();
      EXPECT_TRUE(y.inf() == exact && y.sup() == exact) << k;
      EXPECT_TRUE(b.inf() == exact && b.sup() == exact) << k;
    }
  }
  EXPECT_EQ(cos_sin_pi(0x1p60)[0], 1);
}

TEST(Transcendental, Law3_DoublesAreWithinTheirBound) {
  std::mt19937_64 engine(7);
  double worst = 0;
  for (int round = 0; round < 4000; ++round) {
    const double size = std::ldexp(1.0, static_cast<int>(engine() % 80) - 40);
    const double x = (static_cast<double>(engine() % 2000001) - 1e6) / 1e6 * size;
    const auto computed = cos_sin_pi(x);
    const auto exact = by_definition(from_double(x));
    for (int i = 0; i < 2; ++i) {
      EXPECT_LE(std::fabs(computed[i]), 1);
      worst = std::max({worst, computed[i] - exact[i].inf(), exact[i].sup() - computed[i]});
    }
  }
  EXPECT_LE(worst, 0x1p-51);
}

TEST(Transcendental, Law4_ModelsHaveRemaindersOfTheirOrder) {
  const RoundingGuard guard;
  for (const double centre : {0.0, 0.3, 0.5, -1.25}) {
    double previous = 0;
    for (const double radius : {0.25, 0.125}) {
      const auto models = cos_sin_pi(Model::variable(Interval(centre), Interval(radius)));
      for (int i = -8; i <= 8; ++i) {
        const Rational s = Rational(i) / 8;
        const auto exact = by_definition(from_double(centre) + from_double(radius) * s);
        for (int j = 0; j < 2; ++j) EXPECT_TRUE(meet(models[j].value(enclose(s)), exact[j])) << centre << " " << s;
      }
      const double width = models[0].remainder().sup() - models[0].remainder().inf() +
                           (models[1].remainder().sup() - models[1].remainder().inf());
      if (previous != 0) {
        EXPECT_LT(width, previous / 50) << centre;  // 2^7 times smaller, but for roundings
      }
      previous = width;
    }
  }
  const auto point = cos_sin_pi(Model(Interval(0.5)));
  EXPECT_TRUE(point[0].range().inf() == 0 && point[0].range().sup() == 0);
}

// The function x², by its Taylor coefficients c², 2c, 1 and nothing beyond.
TEST(TaylorModelComposition, Law6_ComposesWithCoefficients) {
  const RoundingGuard guard;
  const Model t = Model::variable(Interval(0.75), Interval(0.25));
  const Interval c(0.75);
  std::array<Interval, 7> f{};
  f[0] = c * c, f[1] = c + c, f[2] = Interval(1);
  const Model composed = t.composed(f, Interval(0));
  for (int i = -4; i <= 4; ++i) {
    const Rational s = Rational(i) / 4, x = Rational(3) / 4 + s / 4;
    EXPECT_TRUE(meet(composed.value(enclose(s)), enclose(Rational(x * x)))) << s;
  }
  EXPECT_TRUE(t.argument_range().inf() == 0.5 && t.argument_range().sup() == 1);
}

TEST(Transcendental, Contract_NoAngle) {
  EXPECT_THROW(cos_sin_pi(std::numeric_limits<double>::quiet_NaN()), contract_error);
}

}  // namespace
}  // namespace patchproof::test
