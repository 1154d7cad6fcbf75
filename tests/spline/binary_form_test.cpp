// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/binary_form.h"

#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Form = BinaryForm<Rational>;

Polynomial multiplied_out(const Form& f) {
  const Polynomial t({Rational(0), Rational(1)}), s({Rational(1), Rational(-1)});
  Polynomial sum;
  for (int i = 0; i <= f.degree(); ++i) sum = sum + Polynomial({f[i]}) * power(t, i) * power(s, f.degree() - i);
  return sum;
}

template <class R>
BinaryForm<R> make_form(const Form& f) {
  std::vector<R> a;
  for (const Rational& x : f.coefficients()) a.push_back(make<R>(x));
  return BinaryForm<R>(std::move(a));
}

// a t + b s as a form; roots of products of these are known.
Form line(const Rational& at_zero, const Rational& at_one) { return Form({at_zero, at_one}); }

Rational two_to(int k) {
  const Rational p = Rational(Integer(1) << std::abs(k));
  return k < 0 ? Rational(1 / p) : p;
}

template <class T>
class BinaryFormLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(BinaryFormLaws, BoundedScalars, ScalarNames);

TYPED_TEST(BinaryFormLaws, Law1_FromBernstein) {
  using T = TypeParam;
  RandomRationals random;
  for (const int n : {0, 1, 2, 3, 7, 12}) {
    const std::vector<Rational> b = random.numbers(n + 1);
    const Polynomial exact = from_bernstein(b);
    const auto f = BinaryForm<T>::from_bernstein(make_numbers<T>(b));
    ASSERT_EQ(f.degree(), n);
    for (int i = 0; i <= 4; ++i) {
      const Rational t = Rational(i) / Rational(4);
      expect_agrees(f(make<T>(t)), exact(t));
    }
  }
}

TYPED_TEST(BinaryFormLaws, Law2_SumsProductsDerivatives) {
  using T = TypeParam;
  RandomRationals random;
  for (const auto& [m, n] : std::vector<std::pair<int, int>>{{0, 0}, {0, 3}, {3, 0}, {2, 5}, {5, 2}, {4, 4}, {1, 1}}) {
    const Form f(random.numbers(m + 1)), g(random.numbers(n + 1));
    const Polynomial F = multiplied_out(f), G = multiplied_out(g);
    const auto x = make_form<T>(f), y = make_form<T>(g);
    const Rational t = random.unit();
    const T at = make<T>(t);
    expect_agrees((x + y)(at), F(t) + G(t));
    expect_agrees((x - y)(at), F(t) - G(t));
    expect_agrees((-x)(at), -F(t));
    expect_agrees((x * y)(at), F(t) * G(t));
    expect_agrees(x.derivative()(at), F.derivative()(t));
    expect_agrees(x.derivative().derivative()(at), F.derivative(2)(t));
    expect_agrees((x * x)(at), F(t) * F(t));  // aliased operands
    expect_agrees((x + x)(at), 2 * F(t));
  }
}

TEST(BinaryFormLawsExact, Law2_CoefficientsAreThoseOfThePolynomial) {
  RandomRationals random;
  for (int round = 0; round < 40; ++round) {
    const Form f(random.numbers(random.integer(1, 7))), g(random.numbers(random.integer(1, 7)));
    const Polynomial F = multiplied_out(f), G = multiplied_out(g);
    EXPECT_EQ(multiplied_out(f + g), F + G);
    EXPECT_EQ(multiplied_out(f * g), F * G);
    EXPECT_EQ(multiplied_out(f - g), F + Polynomial({Rational(-1)}) * G);
    EXPECT_EQ(multiplied_out(f.derivative()), F.derivative());
    EXPECT_EQ((f * g).degree(), f.degree() + g.degree());
  }
}

TEST(BinaryFormLawsExact, Law2_HugeAndTinyCoefficients) {
  // Sums over 2^±4000 lose nothing: (f + g) − f == g when g is 2^-8000 times smaller.
  RandomRationals random;
  for (const int degree : {3, 9}) {
    Form f(random.numbers(degree + 1)), g(random.numbers(degree + 1));
    f = Form::constant(two_to(4000)) * f;
    g = Form::constant(two_to(-4000)) * g;
    EXPECT_EQ(((f + g) - f).coefficients(), g.coefficients());
    EXPECT_EQ(multiplied_out(f * g), multiplied_out(f) * multiplied_out(g));
  }
}

TYPED_TEST(BinaryFormLaws, Law3_Elevation) {
  using T = TypeParam;
  RandomRationals random;
  for (const int n : {0, 1, 4})
    for (const int k : {0, 1, 5}) {
      const Form f(random.numbers(n + 1));
      EXPECT_EQ(multiplied_out(f.elevated(k)), multiplied_out(f));
      EXPECT_EQ(f.elevated(k).degree(), n + k);
      const Rational t = random.unit();
      expect_agrees(make_form<T>(f).elevated(k)(make<T>(t)), multiplied_out(f)(t));
    }
}

TYPED_TEST(BinaryFormLaws, Law4_TheEmptyFormIsZero) {
  using T = TypeParam;
  const BinaryForm<T> zero;
  const auto f = make_form<T>(Form({Rational(2), Rational(-1), Rational(5)}));
  const T half = make<T>(Rational(1) / Rational(2));
  EXPECT_EQ(zero.degree(), -1);
  EXPECT_TRUE(zero.is_empty());
  EXPECT_EQ(is_zero(zero), std::optional<bool>(true));
  expect_agrees(zero(half), Rational(0));
  EXPECT_TRUE((zero * f).is_empty() && (f * zero).is_empty() && zero.derivative().is_empty() && (-zero).is_empty());
  EXPECT_TRUE(zero.elevated(3).is_empty() && (zero + zero).is_empty());
  expect_agrees((zero + f)(half), Rational(3) / Rational(2));
  expect_agrees((f + zero)(half), Rational(3) / Rational(2));
  expect_agrees((zero - f)(half), Rational(-3) / Rational(2));
  EXPECT_TRUE(BinaryForm<T>::constant(make<T>(Rational(3))).derivative().is_empty());
}

TYPED_TEST(BinaryFormLaws, Law4_IsZeroAnswersOnlyWhenCertain) {
  using T = TypeParam;
  EXPECT_EQ(is_zero(make_form<T>(Form(std::vector<Rational>(4, Rational(0))))), std::optional<bool>(true));
  EXPECT_EQ(is_zero(make_form<T>(Form({Rational(0), Rational(0), two_to(-900)}))), std::optional<bool>(false));
  if constexpr (std::is_same_v<T, Interval>) {
    EXPECT_EQ(is_zero(BinaryForm<T>({Interval(0), Interval(-1.0, 1.0)})), std::nullopt);
    EXPECT_EQ(is_zero(BinaryForm<T>({Interval(-1.0, 1.0), Interval(2)})), std::optional<bool>(false));
  }
}

TEST(BinaryFormLawsExact, Law5_EndOrdersAndStripping) {
  RandomRationals random;
  const Form t({Rational(0), Rational(1)}), s({Rational(1), Rational(0)});
  for (int k = 0; k <= 3; ++k)
    for (int l = 0; l <= 3; ++l) {
      Form f(random.numbers(4));
      while (f[0] == 0 || f[3] == 0) f = Form(random.numbers(4));
      Form g = f;
      for (int i = 0; i < k; ++i) g = g * t;
      for (int i = 0; i < l; ++i) g = g * s;
      const EndOrders orders = end_orders(g);
      EXPECT_EQ(orders.at_zero, k);
      EXPECT_EQ(orders.at_one, l);
      EXPECT_EQ(strip_ends(g, orders).coefficients(), f.coefficients());
    }
  // A single term: all of it is powers of t and s.
  const EndOrders orders = end_orders(t * t * s);
  EXPECT_EQ(orders.at_zero, 2);
  EXPECT_EQ(orders.at_one, 1);
  EXPECT_THROW(end_orders(Form(std::vector<Rational>(3, Rational(0)))), contract_error);
  EXPECT_THROW(end_orders(Form()), contract_error);
  EXPECT_TRUE(strip_ends(Form(), {2, 1}).is_empty());
}

// Equal up to a constant factor other than zero.
void expect_proportional(const Form& f, const Form& g) {
  ASSERT_EQ(f.degree(), g.degree());
  ASSERT_FALSE(*is_zero(f));
  ASSERT_FALSE(*is_zero(g));
  for (int i = 0; i <= f.degree(); ++i)
    for (int j = 0; j < i; ++j) EXPECT_EQ(f[i] * g[j], f[j] * g[i]);
}

template <class F>
void expect_gcd(const BinaryForm<F>& f, const BinaryForm<F>& g, int degree) {
  const BinaryForm<F> d = gcd(f, g);
  EXPECT_EQ(d.degree(), degree);
  const BinaryForm<F> x = divide_exactly(f, d), y = divide_exactly(g, d);
  EXPECT_TRUE(*is_zero(x * d - f));
  EXPECT_TRUE(*is_zero(y * d - g));
  EXPECT_EQ(gcd(x, y).degree(), 0);
}

TEST(BinaryFormLawsExact, Law6_GcdOfProductsOfKnownLines) {
  // Roots inside, outside, at both ends, at infinity (t + s), multiple.
  const std::vector<Form> lines{line(-1, 2), line(-1, 1), line(-3, 1), line(0, 1),
                                line(1, 0),  line(1, 1),  line(5, 3),  line(Rational(-1) / Rational(7), 9)};
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    Form f = Form::constant(random.integer(1, 9)), g = Form::constant(Rational(random.integer(1, 9)) / Rational(7)),
         d = Form::constant(1);
    int common = 0;
    for (const Form& l : lines) {
      const int in_f = random.integer(0, 2), in_g = random.integer(0, 2);
      for (int i = 0; i < in_f; ++i) f = f * l;
      for (int i = 0; i < in_g; ++i) g = g * l;
      for (int i = 0; i < std::min(in_f, in_g); ++i) d = d * l, ++common;
    }
    expect_proportional(gcd(f, g), d);
    expect_proportional(gcd(g, f), d);
    expect_gcd(f, g, common);
  }
}

TEST(BinaryFormLawsExact, Law6_GcdSpecialCases) {
  const Form zero(std::vector<Rational>(3, Rational(0))), f = line(-1, 2) * line(-1, 2) * line(1, 0);
  EXPECT_TRUE(gcd(zero, zero).is_empty());
  EXPECT_TRUE(gcd(Form(), Form()).is_empty());
  expect_proportional(gcd(zero, f), f);
  expect_proportional(gcd(f, Form()), f);
  expect_proportional(gcd(f, f), f);
  EXPECT_EQ(gcd(f, Form::constant(two_to(-2000))).degree(), 0);
  EXPECT_TRUE(*is_zero(divide_exactly(zero, f)));
  EXPECT_THROW(divide_exactly(f, line(-1, 3)), contract_error);
  EXPECT_THROW(divide_exactly(line(-1, 2), f), contract_error);
  EXPECT_THROW(divide_exactly(f, line(1, 0) * line(1, 0)), contract_error);  // a power of s too many
}

TEST(BinaryFormLawsExact, Law6_GcdOfHugeNumbers) {
  RandomRationals random;
  const auto huge = [&](int degree) {
    std::vector<Rational> a;
    for (int i = 0; i <= degree; ++i) a.push_back(Rational(random() + 1000) * two_to(random.integer(-2000, 3000)));
    return Form(a);
  };
  for (int round = 0; round < 4; ++round) {
    const Form d = huge(3), f = huge(4), g = huge(3);
    expect_gcd(f * d, g * d, 3);
  }
}

TEST(BinaryFormLawsExact, Law6_GcdInAQuadraticField) {
  // t² − s²/2 … in Q the factor is irreducible, in Q(√2) it splits.
  using F = BinaryForm<Quadratic>;
  const Quadratic root(Rational(0), Rational(1), 2);
  const F plus({root, Quadratic(1)}), minus({-root, Quadratic(1)}), other({Quadratic(1), Quadratic(3)});
  expect_gcd(plus * minus * other, minus * minus, 1);
  expect_gcd(plus * plus * other, plus * plus * minus, 2);
}

TEST(BinaryFormLawsExact, BinomialsUpToDegree64) {
  for (const int n : {0, 1, 2, 29, 30, 31, 33, 64}) {
    const std::vector<Rational> row = binomials<Rational>(n);
    const std::vector<Integer> integers = binomials<Integer>(n);
    ASSERT_EQ(static_cast<int>(row.size()), n + 1);
    Rational c(1);
    for (int k = 0; k <= n; ++k) {
      EXPECT_EQ(row[k], c);
      EXPECT_EQ(Rational(integers[k]), c);
      c = c * Rational(n - k) / Rational(k + 1);
    }
    const RoundingGuard guard;
    const std::vector<Interval> enclosed = binomials<Interval>(n);
    for (int k = 0; k <= n; ++k)
      expect_agrees(Interval(enclosed[k] / Interval(enclosed[k].sup())),
                    Rational(row[k] / from_double(enclosed[k].sup())));
  }
  // Degree 64 through the whole chain: constant 1 is constant 1.
  const auto one = BinaryForm<Rational>::from_bernstein(std::vector<Rational>(65, Rational(1)));
  EXPECT_EQ(one(Rational(1) / Rational(3)), 1);
  EXPECT_TRUE(*is_zero(one.derivative()));
}

}  // namespace
}  // namespace patchproof
