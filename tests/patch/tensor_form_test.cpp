// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/tensor_form.h"

#include <gtest/gtest.h>

#include "support/patches.h"
#include "support/rational_literal.h"

namespace patchproof::test {
namespace {

using Form = TensorForm<Rational>;

// Monomial coefficients [k][l] of u^k v^l, by multiplying the definition out: the second opinion.
using Monomials = std::vector<std::vector<Rational>>;

Monomials monomials(const Form& f, int degree_u, int degree_v) {
  Monomials out(degree_u + 1, std::vector<Rational>(degree_v + 1, Rational(0)));
  if (f.is_empty()) return out;
  const Polynomial t({0, 1}), s({1, -1});
  for (int i = 0; i <= f.degree_u(); ++i)
    for (int j = 0; j <= f.degree_v(); ++j) {
      const Polynomial of_u = power(t, i) * power(s, f.degree_u() - i), of_v = power(t, j) * power(s, f.degree_v() - j);
      for (std::size_t k = 0; k < of_u.c.size(); ++k)
        for (std::size_t l = 0; l < of_v.c.size(); ++l) out[k][l] += f.at(i, j) * of_u.c[k] * of_v.c[l];
    }
  return out;
}

Form random_form(RandomRationals& random, int m, int n) {
  Form f(m, n);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) f.at(i, j) = random();
  return f;
}

BezierPatch<Rational, 2> random_bezier(RandomRationals& random, int m, int n) {
  return BezierPatch<Rational, 2>(m, n, random.points<2>((m + 1) * (n + 1)));
}

TEST(TensorForm, Law1_BernsteinCoefficientsThereAndBack) {
  RandomRationals random;
  for (const auto& [m, n] : std::vector<std::pair<int, int>>{{0, 0}, {0, 3}, {4, 0}, {1, 1}, {3, 5}, {33, 2}}) {
    const BezierPatch<Rational, 2> patch = random_bezier(random, m, n);
    for (const std::size_t c : {0u, 1u}) {
      const Form f = Form::from_bernstein(patch, c);
      EXPECT_EQ(f.degree_u(), m);
      EXPECT_EQ(f.degree_v(), n);
      const std::vector<Rational> b = f.bernstein();
      ASSERT_EQ(b.size(), patch.net().size());
      for (std::size_t k = 0; k < b.size(); ++k) EXPECT_EQ(b[k], patch.net()[k][c]);
      // The values, by the definition of the Bernstein basis.
      const Rational u = random(), v = random();
      Rational sum(0);
      for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= n; ++j) {
          std::vector<Rational> unit_u(m + 1, Rational(0)), unit_v(n + 1, Rational(0));
          unit_u[i] = unit_v[j] = 1;
          sum += patch.point(i, j)[c] * from_bernstein(unit_u)(u) * from_bernstein(unit_v)(v);
        }
      EXPECT_EQ(f(u, v), sum);
    }
  }
}

TEST(TensorForm, Law2_SumsAndProductsAreThoseOfThePolynomials) {
  RandomRationals random;
  const std::vector<std::pair<int, int>> degrees{{0, 0}, {2, 1}, {1, 3}, {3, 3}};
  for (const auto& [m, n] : degrees)
    for (const auto& [k, l] : degrees) {
      const Form f = random_form(random, m, n), g = random_form(random, k, l);
      const int p = std::max(m, k), q = std::max(n, l);
      const Monomials of_f = monomials(f, p, q), of_g = monomials(g, p, q);
      const Form sum = f + g, difference = f - g, product = f * g;
      EXPECT_EQ(sum.degree_u(), p);
      EXPECT_EQ(sum.degree_v(), q);
      EXPECT_EQ(product.degree_u(), m + k);
      EXPECT_EQ(product.degree_v(), n + l);
      const Monomials of_sum = monomials(sum, p, q), of_difference = monomials(difference, p, q),
                      negated = monomials(-f, p, q), of_product = monomials(product, m + k, n + l);
      Monomials convolved(m + k + 1, std::vector<Rational>(n + l + 1, Rational(0)));
      for (int a = 0; a <= p; ++a)
        for (int b = 0; b <= q; ++b) {
          EXPECT_EQ(of_sum[a][b], of_f[a][b] + of_g[a][b]);
          EXPECT_EQ(of_difference[a][b], of_f[a][b] - of_g[a][b]);
          EXPECT_EQ(negated[a][b], -of_f[a][b]);
          for (int c = 0; c <= p; ++c)
            for (int d = 0; d <= q; ++d)
              if (of_f[a][b] != 0 && of_g[c][d] != 0) convolved[a + c][b + d] += of_f[a][b] * of_g[c][d];
        }
      EXPECT_EQ(of_product, convolved);
    }
}

TEST(TensorForm, Law2_AProductOfTwoBinaryForms) {
  RandomRationals random;
  const BinaryForm<Rational> f(random.numbers(4)), g(random.numbers(3));
  const Form both(f, g);
  for (const Rational& u : {Rational(0), Rational(1), random()})
    for (const Rational& v : {Rational(0), Rational(1), random()}) EXPECT_EQ(both(u, v), f(u) * g(v));
}

TEST(TensorForm, Law3_HigherDegreesOfTheSamePolynomial) {
  RandomRationals random;
  const Form f = random_form(random, 2, 3);
  for (int m = 2; m <= 5; ++m)
    for (int n = 3; n <= 5; ++n) {
      const Form g = f.elevated(m, n);
      EXPECT_EQ(g.degree_u(), m);
      EXPECT_EQ(g.degree_v(), n);
      EXPECT_EQ(monomials(g, m, n), monomials(f, m, n));
    }
  EXPECT_THROW((void)f.elevated(1, 3), contract_error);
  EXPECT_THROW((void)f.elevated(5, 2), contract_error);
}

TEST(TensorForm, Law4_TheEmptyFormIsZero) {
  RandomRationals random;
  const Form zero, f = random_form(random, 2, 1);
  EXPECT_TRUE(zero.is_empty());
  EXPECT_FALSE(Form::constant(0).is_empty());
  EXPECT_EQ(zero("1/3"_q, "2/3"_q), 0);
  EXPECT_EQ((zero - zero)("1/3"_q, 5), 0);
  EXPECT_EQ((zero * f)("1/3"_q, 5), 0);
  EXPECT_EQ((f * zero)("1/3"_q, 5), 0);
  EXPECT_EQ((-zero)("1/3"_q, 5), 0);
  EXPECT_EQ(zero.elevated(3, 4)("1/3"_q, 5), 0);
  EXPECT_EQ(zero.bernstein(), std::vector<Rational>{0});
  EXPECT_EQ(zero.elevated(3, 4).bernstein(), std::vector<Rational>(20));
  for (const Form& same : {zero + f, f + zero, f - zero}) EXPECT_EQ(monomials(same, 2, 1), monomials(f, 2, 1));
  EXPECT_EQ(monomials(zero - f, 2, 1), monomials(-f, 2, 1));
}

TEST(TensorForm, Law5_Values) {
  RandomRationals random;
  EXPECT_EQ(Form::constant("7/3"_q)(random(), random()), "7/3"_q);
  for (const auto& [m, n] : std::vector<std::pair<int, int>>{{0, 4}, {3, 0}, {2, 3}}) {
    const Form f = random_form(random, m, n);
    const Monomials c = monomials(f, m, n);
    for (const auto& [u, v] :
         std::vector<std::pair<Rational, Rational>>{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {random(), random()}}) {
      Rational sum(0);
      for (int k = m; k >= 0; --k) sum = sum * u + Polynomial(c[k])(v);
      EXPECT_EQ(f(u, v), sum);
    }
  }
}

template <class T>
class TensorFormScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(TensorFormScalars, AllScalars, ScalarNames);

TYPED_TEST(TensorFormScalars, Law1To5_InEveryScalar) {
  RandomRationals random;
  const BezierPatch<Rational, 2> patch = random_bezier(random, 3, 2), other = random_bezier(random, 1, 3);
  const Rational u = random.unit(), v = random.unit();
  const auto in = []<class S>(const BezierPatch<Rational, 2>& p) {
    return BezierPatch<S, 2>(p.degree(Direction::u), p.degree(Direction::v), make_points<S>(p.net()));
  };
  const auto formula = [&]<class S>() {
    const auto p = in.template operator()<S>(patch), q = in.template operator()<S>(other);
    const auto f =
        TensorForm<S>::from_bernstein(p, 0) * TensorForm<S>::from_bernstein(q, 1) - TensorForm<S>::from_bernstein(q, 0);
    std::vector<S> out = f.bernstein();
    out.push_back(f(make<S>(u), make<S>(v)));
    return out;
  };
  check<TypeParam>(formula.template operator()<Rational>(), formula);
}

// Polynomials over the integers need no division.
TEST(TensorForm, OverTheIntegers) {
  TensorForm<Integer> f(1, 1);
  f.at(0, 0) = 2, f.at(0, 1) = -3, f.at(1, 0) = 5, f.at(1, 1) = 7;
  const TensorForm<Integer> square = f * f;
  for (const int u : {-2, 0, 3})
    for (const int v : {-1, 1, 4}) {
      const Integer value = 2 * (1 - u) * (1 - v) - 3 * (1 - u) * v + 5 * u * (1 - v) + 7 * u * v;
      EXPECT_EQ(f(Integer(u), Integer(v)), value);
      EXPECT_EQ(square(Integer(u), Integer(v)), value * value);
      EXPECT_EQ(square.elevated(4, 3)(Integer(u), Integer(v)), value * value);
    }
}

}  // namespace
}  // namespace patchproof::test
