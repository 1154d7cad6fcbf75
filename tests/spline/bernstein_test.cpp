// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/bernstein.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "patchproof/scalar/integer.h"
#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Point2 = Vec<Rational, 2>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

Numbers component(const std::vector<Point2>& points, int c) {
  Numbers out;
  for (const Point2& p : points) out.push_back(p[c]);
  return out;
}

// Parameters inside, at the ends of, and outside [0, 1]; doubles hold them all.
const Numbers parameters = {q(0), q(3, 8), q(1, 2), q(1), q(-1, 4), q(9, 4)};

template <class T>
class Bernstein : public ScalarTest<T> {};
TYPED_TEST_SUITE(Bernstein, AllScalars, ScalarNames);

TYPED_TEST(Bernstein, Law1_BasisSumsToOne) {
  for (int n : {0, 1, 2, 5, 12})
    for (const Rational& t : {q(0), q(5, 16), q(1)})
      check<TypeParam>(q(1), [&]<class S>() {
        S sum(0);
        for (const S& b : bernstein_basis(n, make<S>(t))) sum += b;
        return sum;
      });
}

TYPED_TEST(Bernstein, Law2_BasisIsSymmetric) {
  for (int n : {0, 1, 4, 7})
    for (const Rational& t : parameters)
      check<TypeParam>(reverse(bernstein_basis(n, Rational(1 - t))),
                       [&]<class S>() { return bernstein_basis(n, make<S>(t)); });
}

TYPED_TEST(Bernstein, Law4_DerivativesAreThoseOfThePolynomial) {
  RandomRationals random;
  for (int n : {0, 1, 2, 3, 5}) {
    const Numbers b = random.numbers(n + 1);
    for (int order = 0; order <= n + 2; ++order)
      for (const Rational& t : parameters) {
        const Rational exact = from_bernstein(b).derivative(order)(t);
        check<TypeParam>(exact, [&]<class S>() { return derivative(make_numbers<S>(b), make<S>(t), order); });
        check<TypeParam>(exact, [&]<class S>() {
          S sum(0);
          const std::vector<S> basis = bernstein_basis_derivative(n, order, make<S>(t)), points = make_numbers<S>(b);
          for (int i = 0; i <= n; ++i) sum += points[i] * basis[i];
          return sum;
        });
      }
  }
}

TYPED_TEST(Bernstein, Law3And5_DeCasteljauEqualsTheSumAndMeetsTheEnds) {
  RandomRationals random;
  for (int n : {0, 1, 3, 6}) {
    const std::vector<Point2> b = random.points<2>(n + 1);
    for (const Rational& t : parameters) {
      const Point2 exact{{from_bernstein(component(b, 0))(t), from_bernstein(component(b, 1))(t)}};
      check<TypeParam>(exact, [&]<class S>() { return de_casteljau(make_points<S>(b), make<S>(t)); });
    }
    check<TypeParam>(b.front(), [&]<class S>() { return de_casteljau(make_points<S>(b), S(0)); });
    check<TypeParam>(b.back(), [&]<class S>() { return de_casteljau(make_points<S>(b), S(1)); });
  }
}

TYPED_TEST(Bernstein, Law6_HalvesAndRestrictionsAreTheCurve) {
  RandomRationals random;
  for (int n : {0, 1, 2, 5}) {
    const Numbers b = random.numbers(n + 1);
    for (const Rational& t : parameters) {
      const auto halves = split(b, t);
      check<TypeParam>(halves.left, [&]<class S>() { return split(make_numbers<S>(b), make<S>(t)).left; });
      check<TypeParam>(halves.right, [&]<class S>() { return split(make_numbers<S>(b), make<S>(t)).right; });
      check<TypeParam>(restrict(b, t, q(7, 8)),
                       [&]<class S>() { return restrict(make_numbers<S>(b), make<S>(t), make<S>(q(7, 8))); });
    }
  }
}

TYPED_TEST(Bernstein, Law7_ElevationInEveryScalar) {
  RandomRationals random;
  for (int n : {0, 1, 4}) {
    const std::vector<Point2> b = random.points<2>(n + 1);
    for (int times : {0, 1, 3})
      check<TypeParam>(elevate_degree(b, times), [&]<class S>() { return elevate_degree(make_points<S>(b), times); });
  }
}

TYPED_TEST(Bernstein, Law8_ProductIsPointwise) {
  RandomRationals random;
  for (int m : {0, 1, 3})
    for (int n : {0, 2, 3}) {
      const Numbers f = random.numbers(m + 1);
      const std::vector<Point2> b = random.points<2>(n + 1);
      const std::vector<Point2> exact = product(f, b);
      for (int c : {0, 1})
        EXPECT_EQ(from_bernstein(component(exact, c)), from_bernstein(f) * from_bernstein(component(b, c)));
      check<TypeParam>(exact, [&]<class S>() { return product(make_numbers<S>(f), make_points<S>(b)); });
      check<TypeParam>(product(f, component(b, 0)),
                       [&]<class S>() { return product(make_numbers<S>(f), make_numbers<S>(component(b, 0))); });
    }
}

TYPED_TEST(Bernstein, Law9_BlossomInEveryScalar) {
  RandomRationals random;
  const Numbers b = random.numbers(4);
  const Numbers arguments = {q(1, 4), q(-1, 2), q(3, 2)};
  check<TypeParam>(blossom(b, arguments),
                   [&]<class S>() { return blossom(make_numbers<S>(b), make_numbers<S>(arguments)); });
}

// The laws as identities of polynomials: every coefficient is compared, so they hold for all parameters at once.
TEST(BernsteinExact, Law1_HighDegreesAndNoOverflowOfBinomials) {
  Rational sum(0);
  for (const Rational& b : bernstein_basis(80, q(1, 3))) sum += b;
  EXPECT_EQ(sum, 1);
  EXPECT_EQ(binomial_row<Rational>(80)[40], Rational("107507208733336176461620"));
  EXPECT_EQ(binomial_row<Rational>(0), Numbers{q(1)});
}

TEST(BernsteinExact, Law3_DoublesMeetTheEndsBitForBit) {
  const std::vector<double> b = {0.1, 1e300, -7e-300};
  EXPECT_EQ(de_casteljau(b, 0.0), b.front());
  EXPECT_EQ(de_casteljau(b, 1.0), b.back());
}

TEST(BernsteinExact, Law4_HodographIsTheDerivative) {
  RandomRationals random;
  for (int n = 0; n <= 6; ++n) {
    const Numbers b = random.numbers(n + 1);
    EXPECT_EQ(from_bernstein(hodograph(b)), from_bernstein(b).derivative());
    EXPECT_EQ(static_cast<int>(hodograph(b).size()), std::max(n, 1));
  }
}

TEST(BernsteinExact, Law6_HalvesAreTheSamePolynomial) {
  RandomRationals random;
  for (int n = 0; n <= 6; ++n) {
    const Numbers b = random.numbers(n + 1);
    const Rational t = random(), a = random();
    const auto halves = split(b, t);
    EXPECT_EQ(from_bernstein(halves.left), from_bernstein(b).compose(Polynomial({q(0), t})));
    EXPECT_EQ(from_bernstein(halves.right), from_bernstein(b).compose(Polynomial({t, 1 - t})));
    EXPECT_EQ(from_bernstein(restrict(b, a, t)), from_bernstein(b).compose(Polynomial({a, t - a})));
    EXPECT_EQ(restrict(b, q(0), t), halves.left);
    EXPECT_EQ(restrict(b, t, q(1)), halves.right);
    EXPECT_EQ(restrict(b, q(1), q(0)), reverse(b));
  }
}

TEST(BernsteinExact, Law7_ReductionUndoesElevationAndNothingElse) {
  RandomRationals random;
  for (int n = 0; n <= 6; ++n) {
    const std::vector<Point2> b = random.points<2>(n + 1);
    std::vector<Point2> elevated = elevate_degree(b);
    EXPECT_EQ(elevated.size(), b.size() + 1);
    EXPECT_EQ(from_bernstein(component(elevated, 1)), from_bernstein(component(b, 1)));
    ASSERT_TRUE(reduce_degree(elevated).has_value());
    EXPECT_EQ(*reduce_degree(elevated), b);
    elevated[n / 2][1] += q(1, 1000000007);  // one component of one point is enough
    EXPECT_FALSE(reduce_degree(elevated).has_value());
  }
  EXPECT_FALSE(reduce_degree(Numbers{q(3)}).has_value());
  // t³ has degree 3 and no less; t² written with degree 3 has degree 2.
  EXPECT_FALSE(reduce_degree(Numbers{q(0), q(0), q(0), q(1)}).has_value());
  EXPECT_EQ(reduce_degree(Numbers{q(0), q(0), q(1, 3), q(1)}), (Numbers{q(0), q(0), q(1)}));
}

TEST(BernsteinExact, Law9_BlossomIsSymmetricMultiaffineAndDiagonal) {
  RandomRationals random;
  for (int n = 1; n <= 5; ++n) {
    const Numbers b = random.numbers(n + 1);
    Numbers arguments = random.numbers(n);
    const Rational value = blossom(b, arguments);
    for (int rotation = 0; rotation < n; ++rotation) {
      std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
      EXPECT_EQ(blossom(b, arguments), value);
      std::swap(arguments.front(), arguments.back());
      EXPECT_EQ(blossom(b, arguments), value);
    }
    const Rational u = random(), v = random(), s = random();
    const auto with_first = [&](const Rational& x) {
      Numbers changed = arguments;
      changed[0] = x;
      return blossom(b, changed);
    };
    EXPECT_EQ(with_first((1 - s) * u + s * v), (1 - s) * with_first(u) + s * with_first(v));
    EXPECT_EQ(blossom(b, Numbers(n, u)), from_bernstein(b)(u));
  }
}

TEST(BernsteinExact, Law10_ReverseRunsBackwards) {
  RandomRationals random;
  const Numbers b = random.numbers(5);
  EXPECT_EQ(from_bernstein(reverse(b)), from_bernstein(b).compose(Polynomial({q(1), q(-1)})));
}

// Figures worked out independently: a quartic and a cubic by their monomial coefficients.
TEST(BernsteinExact, Law5_KnownCurves) {
  const std::vector<Point2> quartic = {{{q(0), q(0)}}, {{q(1), q(0)}}, {{q(1), q(1)}}, {{q(2), q(1)}}, {{q(3), q(1)}}};
  const Polynomial x({q(0), q(4), q(-6), q(8), q(-3)}), y({q(0), q(0), q(6), q(-8), q(3)});
  for (const Rational& t : parameters) {
    EXPECT_EQ(de_casteljau(quartic, t), (Point2{{x(t), y(t)}}));
    EXPECT_EQ(derivative(quartic, t, 2), (Point2{{x.derivative(2)(t), y.derivative(2)(t)}}));
  }
}

TEST(BernsteinExact, Law5_RingsWithoutDivision) {
  const std::vector<Integer> cubic = {Integer(0), Integer(0), Integer(0), Integer(1)};  // t³
  EXPECT_EQ(de_casteljau(cubic, Integer(-5)), -125);
  EXPECT_EQ(derivative(cubic, Integer(2), 1), 12);
  EXPECT_EQ(split(cubic, Integer(2)).left, (std::vector<Integer>{0, 0, 0, 8}));
}

TEST(BernsteinExact, ContractsAreChecked) {
  const Numbers none, two = {q(1), q(2)};
  EXPECT_THROW(de_casteljau(none, q(1)), contract_error);
  EXPECT_THROW(hodograph(none), contract_error);
  EXPECT_THROW(derivative(none, q(1), 0), contract_error);
  EXPECT_THROW(derivative(two, q(1), -1), contract_error);
  EXPECT_THROW(split(none, q(1)), contract_error);
  EXPECT_THROW(restrict(none, q(0), q(1)), contract_error);
  EXPECT_THROW(blossom(two, two), contract_error);
  EXPECT_THROW(elevate_degree(none), contract_error);
  EXPECT_THROW(elevate_degree(two, -1), contract_error);
  EXPECT_THROW(reduce_degree(none), contract_error);
  EXPECT_THROW(product(none, two), contract_error);
  EXPECT_THROW(product(two, none), contract_error);
  EXPECT_THROW(bernstein_basis(-1, q(1)), contract_error);
  EXPECT_THROW(bernstein_basis_derivative(2, -1, q(1)), contract_error);
}

}  // namespace
}  // namespace patchproof::test
