// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/power_series.h"

#include <gtest/gtest.h>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/homogeneous.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Series = PowerSeries<Rational, 2>;
using Exact = PowerSeries<Interval, 1>;
static_assert(Field<Series> && Field<Exact> && !OrderedField<Series> && !ExactRing<Series>);
static_assert(Ring<PowerSeries<double, 3>>);

Series x(int order = Series::kExact, const Rational& at = Rational(0)) { return Series::variable(0, at, order); }
Series y(int order = Series::kExact, const Rational& at = Rational(0)) { return Series::variable(1, at, order); }

// A polynomial of random coefficients, and its value from its coefficients.
Series random_polynomial(RandomRationals& random, int order) {
  Series sum;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Series term(random());
      for (int k = 0; k < i; ++k) term = term * x(order);
      for (int k = 0; k < j; ++k) term = term * y(order);
      sum += term;
    }
  return sum;
}
Rational value(const Series& f, const Rational& a, const Rational& b) {
  Rational sum(0), power_a(1);
  for (int i = 0; i <= f.degree(0); ++i, power_a *= a) {
    Rational power(power_a);
    for (int j = 0; j <= f.degree(1); ++j, power *= b) sum += f.coefficient({i, j}) * power;
  }
  return sum;
}

TEST(PowerSeries, Law1_PolynomialsFormARing) {
  RandomRationals random;
  for (int round = 0; round < 20; ++round) {
    const Series f = random_polynomial(random, Series::kExact), g = random_polynomial(random, Series::kExact);
    const Rational a = random(), b = random();
    EXPECT_EQ(value(f + g, a, b), Rational(value(f, a, b) + value(g, a, b)));
    EXPECT_EQ(value(f - g, a, b), Rational(value(f, a, b) - value(g, a, b)));
    EXPECT_EQ(value(f * g, a, b), Rational(value(f, a, b) * value(g, a, b)));
    EXPECT_TRUE(identical(f * g, g * f));
    EXPECT_TRUE(identical(f * (f + g), f * f + f * g));
    EXPECT_FALSE(identical(f, f + x() * x() * y()));
  }
  EXPECT_TRUE(identical(Series(3) / Series(4), Series(Rational(3) / Rational(4))));
  EXPECT_TRUE(identical((x() * Series(6)) / Series(4), Series(Rational(3) / Rational(2)) * x()));
}

TEST(PowerSeries, Law1_TermsBeyondTheOrderAreDropped) {
  const Series f = x(2, Rational(1)) * y(2, Rational(1)) * x(2, Rational(1));  // (1 + x)² (1 + y)
  EXPECT_EQ(f.coefficient({1, 1}), Rational(2));
  EXPECT_EQ(f.coefficient({2, 0}), Rational(1));
  EXPECT_THROW(f.coefficient({2, 1}), contract_error);
  EXPECT_EQ((x(3) + y(1)).order(), 1);
  EXPECT_TRUE(identical(x(0, Rational(5)), Series(5)));
}

TEST(PowerSeries, Law1_QuotientsUndoProducts) {
  RandomRationals random;
  for (int order = 0; order <= 4; ++order) {
    const Series f = random_polynomial(random, order) + x(order),
                 g = random_polynomial(random, order) + Series(50) + y(order);
    EXPECT_TRUE(identical((f / g) * g, f)) << order;
    EXPECT_TRUE(identical((f * g) / g, f)) << order;
  }
  EXPECT_THROW(x(3) / y(3), contract_error);              // 0/0 here
  EXPECT_THROW(x() / (Series(1) + y()), contract_error);  // no polynomial, and no order
  EXPECT_THROW(Series(1) / Series(0), contract_error);
}

// f(t) = t/(1 + t²) at t = 2: f = 2/5, f' = (1 − t²)/(1 + t²)² = −3/25, f'' = 2t(t² − 3)/(1 + t²)³ = 4/125.
TEST(PowerSeries, Law2_TaylorCoefficientsOfAQuotient) {
  using One = PowerSeries<Rational, 1>;
  const One t = One::variable(0, Rational(2), 2), f = t / (One(1) + t * t);
  EXPECT_EQ(f.derivative({0}), Rational(2) / Rational(5));
  EXPECT_EQ(f.derivative({1}), Rational(-3) / Rational(25));
  EXPECT_EQ(f.derivative({2}), Rational(4) / Rational(125));
}

TEST(PowerSeries, Law2_DeCasteljauGivesAllDerivatives) {
  using One = PowerSeries<Rational, 1>;
  RandomRationals random;
  const std::vector<Rational> numbers = random.numbers(5);
  std::vector<One> points;
  for (const Rational& n : numbers) points.push_back(One(n));
  const Rational at = random.unit();
  const One f = de_casteljau(points, One::variable(0, at, 6));
  for (int k = 0; k <= 6; ++k) EXPECT_EQ(f.derivative({k}), derivative(numbers, at, k)) << k;
}

// The quotient rule of homogeneous.h and the division of series are two ways to one result.
TEST(PowerSeries, Law2_ProjectionIsTheQuotientRule) {
  using One = PowerSeries<Rational, 1>;
  RandomRationals random;
  std::vector<Vec<Rational, 3>> points = random.points<3>(4);
  for (auto& h : points) h[2] = Rational(5) + h[2] * h[2];
  std::vector<Vec<One, 3>> series;
  for (const auto& h : points) series.push_back({{One(h[0]), One(h[1]), One(h[2])}});
  const Vec<One, 2> affine = project(de_casteljau(series, One::variable(0, Rational(1) / Rational(3), 4)));
  const auto curve = BsplineCurve<Rational, 3>::bezier(points);
  const auto expected = rational_derivatives(curve, Rational(Rational(1) / Rational(3)), 4);
  for (int k = 0; k <= 4; ++k)
    for (int c = 0; c < 2; ++c) EXPECT_EQ(affine[c].derivative({k}), expected[k][c]) << k;
}

template <class T>
class PowerSeriesLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(PowerSeriesLaws, BoundedScalars, ScalarNames);

TYPED_TEST(PowerSeriesLaws, Law3_CoefficientsAreEnclosed) {
  RandomRationals random;
  for (int round = 0; round < 5; ++round) {
    const Rational a = random(), b = Rational(30) + random();
    const auto formula = [&]<class S>() {
      using P = PowerSeries<S, 2>;
      const P u = P::variable(0, make<S>(a), 3), v = P::variable(1, make<S>(b), 3);
      const P f = (u * u * v - u) / (v + P(make<S>(a * a)));
      return std::vector<S>{f.derivative({0, 0}), f.derivative({1, 0}), f.derivative({1, 1}), f.derivative({0, 3})};
    };
    check<TypeParam>(formula.template operator()<Rational>(), formula);
  }
}

TYPED_TEST(PowerSeriesLaws, Law4_NumbersEmbedAsConstants) {
  using P = PowerSeries<TypeParam, 2>;
  const P third = embed<P>(Rational(Rational(1) / Rational(4)));
  expect_agrees(third.constant_term(), Rational(Rational(1) / Rational(4)));
  EXPECT_EQ(third.degree(0) + third.degree(1), 0);
  EXPECT_EQ(third.order(), P::kExact);
  expect_agrees(P().constant_term(), Rational(0));
}

}  // namespace
}  // namespace patchproof::test
