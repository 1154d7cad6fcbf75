// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/continuity.h"

#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Form = BinaryForm<Rational>;
using Forms = FormVector<Rational>;
using Side3 = SideForms<Rational>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }
Form random_form(RandomRationals& random, int degree) { return Form(random.numbers(degree + 1)); }
Forms random_forms(RandomRationals& random, int degree) {
  return {random_form(random, degree), random_form(random, degree), random_form(random, degree)};
}
Forms scaled(const Rational& s, const Forms& f) { return Form::constant(s) * f; }
Form root_at(const Rational& r) { return Form({Rational(-r), Rational(1 - r)}); }

// The side times a positive number, in a ring: integers when `s` clears the denominators.
template <class R>
R to(const Rational& x) {
  if constexpr (std::is_same_v<R, Integer>) {
    EXPECT_EQ(denominator(x), 1);
    return numerator(x);
  } else {
    return embed<R>(x);
  }
}
template <class R>
BinaryForm<R> to_form(const Form& f, const Rational& s) {
  std::vector<R> a;
  for (const Rational& x : f.coefficients()) a.push_back(to<R>(s * x));
  return BinaryForm<R>(std::move(a));
}
template <class R>
SideForms<R> to_side(const Side3& side, const Rational& s) {
  SideForms<R> out;
  for (int k = 0; k < 3; ++k) {
    out.weight[k] = to_form<R>(side.weight[k], s);
    for (int c = 0; c < 3; ++c) out.position[k][c] = to_form<R>(side.position[k][c], s);
  }
  return out;
}
// 9!⁴ clears every denominator that random numbers and products of a few of them have.
const Rational kClear = [] {
  Rational r(1);
  for (int i = 2; i <= 9; ++i) r = r * i;
  return Rational(r * r * r * r);
}();

template <class R>
JoinForms<R> to_join(const Side3& a, const Side3& b) {
  return {to_side<R>(a, kClear), to_side<R>(b, 3 * kClear)};
}

// A rational or polynomial side with everything random.
Side3 random_side(RandomRationals& random, bool weighted) {
  Side3 side;
  for (int k = 0; k < 3; ++k) {
    side.position[k] = random_forms(random, 3);
    if (weighted) side.weight[k] = random_form(random, 3);
  }
  side.weight[0] = weighted ? Form({1, 4, 5, 2}) : Form::constant(1);
  return side;
}

// The side opposite a, from  Y(s) = h(s)·X(−λ s + μ s²): homogeneous factor h = h0 + h1 s + h2 s², so y(s) = x(−λ s + …).
// Exactly C1 for λ = 1, C2 for μ = 0 besides.
Side3 continued(const Side3& a, const Rational& lambda, const Rational& mu, RandomRationals& random) {
  const Form h0({2, 3}), h1 = random_form(random, 1), h2 = random_form(random, 1), two = Form::constant(2);
  Side3 b;
  const auto fill = [&](const std::array<Form, 3>& x, std::array<Form*, 3> y) {
    // d/ds and d²/ds² of X(−λ s + μ s²) at 0.
    const Form x1 = Form::constant(-lambda) * x[1],
               x2 = Form::constant(lambda * lambda) * x[2] + Form::constant(2 * mu) * x[1];
    *y[0] = h0 * x[0];
    *y[1] = h1 * x[0] + h0 * x1;
    *y[2] = two * h2 * x[0] + two * h1 * x1 + h0 * x2;
  };
  for (int c = 0; c < 3; ++c)
    fill({a.position[0][c], a.position[1][c], a.position[2][c]},
         {&b.position[0][c], &b.position[1][c], &b.position[2][c]});
  fill(a.weight, {&b.weight[0], &b.weight[1], &b.weight[2]});
  return b;
}

template <class R>
class ContinuityLaws : public ::testing::Test {
 private:
  RoundingGuard guard_;
};
struct RingNames {
  template <class T>
  static std::string GetName(int) {
    return std::is_same_v<T, Integer> ? "Integer" : ScalarNames::GetName<T>(0);
  }
};
using Rings = ::testing::Types<Integer, Rational, Quadratic>;
TYPED_TEST_SUITE(ContinuityLaws, Rings, RingNames);

TYPED_TEST(ContinuityLaws, Law1_ClassesOfContinuedSides) {
  using R = TypeParam;
  RandomRationals random;
  for (const bool weighted : {true, false})
    for (const auto& [lambda, mu] :
         std::vector<std::pair<Rational, Rational>>{{1, 0}, {1, 2}, {3, 0}, {q(2, 7), 0}, {-1, 0}, {-5, 1}}) {
      const Side3 a = random_side(random, weighted), b = continued(a, lambda, mu, random);
      const JoinForms<R> forms = to_join<R>(a, b);
      ASSERT_TRUE(is_c0(forms));
      const CrossMatch<R> match = match_cross_derivatives(forms);
      EXPECT_EQ(match.equal, lambda == 1);
      EXPECT_TRUE(match.determined);
      ASSERT_TRUE(match.ratio.has_value());
      // The ratio is λ whatever positive constants the rows carry.
      using V = value_field_t<R>;
      EXPECT_TRUE(embed<V>(match.ratio->first) == embed<V>(lambda) * embed<V>(match.ratio->second));
      EXPECT_TRUE(!match.equal || is_c2(forms) == (mu == 0));
      const ReducedNormal<R> na = reduce_normal(forms.a), nb = reduce_normal(forms.b);
      ASSERT_TRUE(na.found() && nb.found());
      EXPECT_TRUE(is_coplanar(forms, na, nb));
      const auto side = over_field(dot(na.n, nb.n))(V(1) / V(2)) * over_field(na.factor * nb.factor)(V(1) / V(2));
      EXPECT_EQ(*scalar_traits<V>::sign(side), lambda > 0 ? Sign::negative : Sign::positive);
    }
}

// Every single coefficient matters: the smallest change anywhere is seen.
TYPED_TEST(ContinuityLaws, Law1_EveryCoefficientIsSeen) {
  using R = TypeParam;
  RandomRationals random;
  const Side3 a = random_side(random, true), b = continued(a, 1, 0, random);
  const Rational tiny = Rational(1) / kClear;
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 4; ++c)
      for (int i = 0; i <= b.weight[k].degree(); ++i) {
        Side3 changed = b;
        Form& f = c < 3 ? changed.position[k][c] : changed.weight[k];
        std::vector<Rational> coefficients = f.coefficients();
        coefficients[i] += tiny;
        f = Form(coefficients);
        const JoinForms<R> forms = to_join<R>(a, changed);
        EXPECT_EQ(is_c0(forms), k > 0);
        if (k == 0) continue;
        const CrossMatch<R> match = match_cross_derivatives(forms);
        EXPECT_EQ(match.equal, k > 1);
        EXPECT_EQ(match.ratio.has_value(), k > 1);
        EXPECT_FALSE(match.equal && is_c2(forms));
      }
}

TYPED_TEST(ContinuityLaws, Law1_UndeterminedRatios) {
  using R = TypeParam;
  RandomRationals random;
  Side3 a = random_side(random, false);
  Side3 b = continued(a, 1, 0, random);
  // One side stands still: no ratio, not equal. Both stand still: equal, nothing determined.
  for (int c = 0; c < 3; ++c) a.position[1][c] = Form();
  CrossMatch<R> match = match_cross_derivatives(to_join<R>(a, b));
  EXPECT_TRUE(!match.equal && match.determined && !match.ratio);
  b = continued(a, 1, 0, random);
  match = match_cross_derivatives(to_join<R>(a, b));
  EXPECT_TRUE(match.equal && !match.determined && !match.ratio);
  // A ratio that varies along the edge is none.
  a = random_side(random, false);
  b = continued(a, 1, 0, random);
  b.position[1] = scaled(-1, Form({1, 2}) * a.position[1]);
  b.position[0] = a.position[0], b.weight = a.weight;
  match = match_cross_derivatives(to_join<R>(a, b));
  EXPECT_TRUE(!match.equal && match.determined && !match.ratio);
}

// Tangent planes agree without C1: Y_s = −λ(t) X_s + μ(t) X_t.
TYPED_TEST(ContinuityLaws, Law1_GeometricContinuity) {
  using R = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 4; ++round) {
    const Side3 a = random_side(random, false);
    Side3 b = a;
    b.position[1] = Form({-1, -3}) * a.position[1] + random_form(random, 2) * derivative(a.position[0]);
    JoinForms<R> forms = to_join<R>(a, b);
    const auto coplanar = [&] { return is_coplanar(forms, reduce_normal(forms.a), reduce_normal(forms.b)); };
    EXPECT_TRUE(is_c0(forms) && !match_cross_derivatives(forms).equal);
    EXPECT_TRUE(coplanar());
    b.position[1][2] = b.position[1][2] + Form::constant(1 / kClear);
    forms = to_join<R>(a, b);
    EXPECT_FALSE(coplanar());
  }
}

// A side along the x-axis whose normal is exactly g·(0, −(1 + 3t), 1).
Side3 with_normal_factor(const Form& g) {
  Side3 side;
  side.position[0] = {Form({0, 1}), Form(), Form()};
  side.position[1] = {Form({1, 3, 2}), g, g * Form({1, 4})};
  side.position[2] = {Form({1, 1}), Form({2, 1}), Form({5, 2})};
  side.weight[0] = Form::constant(1);
  return side;
}

// Law 2 by the definition: n = t^k s^l F n̂ up to a positive constant, F and n̂ in the right places.
template <class R>
void expect_reduced(const Side3& side, int at_zero, int at_one, int factor_degree, NormalOrder order) {
  const SideForms<R> forms = to_side<R>(side, kClear);
  const ReducedNormal<R> reduced = reduce_normal(forms);
  using V = value_field_t<R>;
  ASSERT_TRUE(reduced.found());
  EXPECT_EQ(reduced.ends.at_zero, at_zero);
  EXPECT_EQ(reduced.ends.at_one, at_one);
  EXPECT_EQ(reduced.order, order);
  EXPECT_EQ(std::max(0, reduced.factor.degree()), factor_degree);
  EXPECT_TRUE(reduced.zero_free);
  const FormVector<R> n = normal(forms, order);
  for (const Rational& t : {q(1, 5), q(2, 5), q(4, 7), q(9, 10)}) {
    const V x = embed<V>(t), s = V(1) - x;
    V product = over_field(reduced.factor)(x);
    for (int i = 0; i < at_zero; ++i) product = product * x;
    for (int i = 0; i < at_one; ++i) product = product * s;
    V squares(0);
    int component = -1;
    for (int c = 0; c < 3; ++c) {
      const V limit = over_field(reduced.n[c])(x);
      squares = squares + limit * limit;
      if (!(limit == V(0))) component = c;
    }
    ASSERT_GE(component, 0);
    const V ratio = over_field(n[component])(x) / (product * over_field(reduced.n[component])(x));
    EXPECT_EQ(*scalar_traits<V>::sign(ratio), Sign::positive);
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(over_field(n[c])(x) == ratio * product * over_field(reduced.n[c])(x));
  }
  // No zero: not at the ends, and no common divisor with a root between.
  for (const int end : {0, 1}) {
    bool zero = true;
    for (int c = 0; c < 3; ++c) zero = zero && over_field(reduced.n[c])(V(end)) == V(0);
    EXPECT_FALSE(zero);
  }
  const auto common = gcd(gcd(over_field(reduced.n[0]), over_field(reduced.n[1])), over_field(reduced.n[2]));
  EXPECT_TRUE(isolate_roots(common, V(1)).empty());
}

TYPED_TEST(ContinuityLaws, Law2_ReducedNormals) {
  using R = TypeParam;
  const Form t({0, 1}), s({1, 0});
  const auto check = [](const Form& g, int at_zero, int at_one, int factor_degree) {
    expect_reduced<R>(with_normal_factor(g), at_zero, at_one, factor_degree, NormalOrder::first);
  };
  check(Form({1, 2}), 0, 0, 0);
  check(t, 1, 0, 0);
  check(s * s, 0, 2, 0);
  check(t * t * t * s, 3, 1, 0);
  check(root_at(q(1, 3)) * root_at(q(1, 3)), 0, 0, 2);
  check(root_at(q(1, 2)), 0, 0, 1);
  check(t * root_at(q(1, 2)) * s * s * s, 1, 3, 1);
  check(Form({-1, -2, 1}), 0, 0, 2);  // t² = 1/2, irreducible over Q
  check(Form({-1, -2, 1}) * root_at(q(1, 3)) * root_at(q(1, 3)) * t, 1, 0, 4);
}

TYPED_TEST(ContinuityLaws, Law2_ANormalThatAlmostVanishes) {
  using R = TypeParam;
  // n = (0, −(3t − 1)² − 1/K, 3t − 1) with a huge K: very small at 1/3 but no zero, so there is no factor.
  Side3 side = with_normal_factor(Form({1, 1}));
  const Form r = root_at(q(1, 3));
  side.position[1][1] = r;
  side.position[1][2] = Form::constant(1 / kClear) + r * r;
  const ReducedNormal<R> reduced = reduce_normal(to_side<R>(side, kClear));
  EXPECT_TRUE(reduced.zero_free);
  EXPECT_FALSE(reduced.has_factor());
}

TYPED_TEST(ContinuityLaws, Law2_SecondOrderOnCollapsedEdges) {
  using R = TypeParam;
  RandomRationals random;
  // A pole at the origin: X(0, t) constant.
  Side3 pole = random_side(random, false);
  pole.position[0] = {Form::constant(1), Form::constant(2), Form::constant(3)};
  const ReducedNormal<R> reduced = reduce_normal(to_side<R>(pole, kClear));
  EXPECT_EQ(reduced.order, NormalOrder::second);
  EXPECT_TRUE(reduced.found() && reduced.zero_free);
  // Cross derivative zero along a line that is not collapsed.
  Side3 still = random_side(random, false);
  still.position[1] = {};
  EXPECT_EQ(reduce_normal(to_side<R>(still, kClear)).order, NormalOrder::second);
  EXPECT_TRUE(reduce_normal(to_side<R>(still, kClear)).found());
  // Everything zero: nothing found, nothing claimed.
  still.position[2] = {};
  const ReducedNormal<R> none = reduce_normal(to_side<R>(still, kClear));
  EXPECT_FALSE(none.found() || none.zero_free);
}

TYPED_TEST(ContinuityLaws, Law3_PositiveFactorsChangeNothing) {
  using R = TypeParam;
  RandomRationals random;
  const Side3 a = random_side(random, true), b = continued(a, q(2, 3), 0, random);
  using V = value_field_t<R>;
  std::optional<V> ratio;
  for (const Rational& s : {Rational(1), Rational(7), Rational(Integer(1) << 3000)}) {
    const JoinForms<R> forms{to_side<R>(a, s * kClear), to_side<R>(b, kClear)};
    EXPECT_TRUE(is_c0(forms));
    const CrossMatch<R> match = match_cross_derivatives(forms);
    ASSERT_TRUE(match.ratio.has_value());
    const V here = embed<V>(match.ratio->first) / embed<V>(match.ratio->second);
    EXPECT_TRUE(!ratio || *ratio == here);
    ratio = here;
    EXPECT_TRUE(is_coplanar(forms, reduce_normal(forms.a), reduce_normal(forms.b)));
  }
}

// Enclosures certainly free of zeros really are; vectors with a zero are never called free of zeros.
TEST(CertainlyZeroFree, Law2_NeverWrong) {
  const RoundingGuard guard;
  RandomRationals random;
  int free = 0;
  for (int round = 0; round < 200; ++round) {
    const bool has_zero = round % 2 == 0;
    Forms f = random_forms(random, 3);
    const Rational root = q(random.integer(0, 12), 12);
    if (has_zero) f = root_at(root) * f;
    detail::level_degrees(f);
    const bool answer = detail::certainly_zero_free(detail::enclose_vector(f));
    EXPECT_FALSE(has_zero && answer) << root;
    free += answer;
  }
  EXPECT_GT(free, 90);  // of the 100 without a common root
}

}  // namespace
}  // namespace patchproof
