// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/real_roots.h"

#include "support/scalars.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Form = BinaryForm<Rational>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }
// b t − a: one root at a/b.
Form root_at(const Rational& r) { return Form({Rational(-r), Rational(1 - r)}); }

// Places in (0, 1), more than the factors below have roots.
std::vector<Rational> spread_out() {
  std::vector<Rational> out;
  for (int i = 1; i < 40; ++i) out.push_back(q(i, 40));
  return out;
}

// The law itself: one interval per known root, in order, each holding exactly its root.
void expect_roots(const Form& f, std::vector<Rational> roots, const Rational& width) {
  const auto found = isolate_roots(f, width);
  ASSERT_EQ(found.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto& [a, b] = found[i];
    EXPECT_LT(b - a, width);
    if (a == b) {
      EXPECT_EQ(a, roots[i]);
      continue;
    }
    EXPECT_TRUE(a < roots[i] && roots[i] < b) << a << " " << b;
    EXPECT_TRUE(a == 0 || f(a) != 0) << a;
    EXPECT_TRUE(b == 1 || f(b) != 0) << b;
    EXPECT_TRUE(i == 0 || found[i - 1].second <= a);
  }
}

TEST(RealRootsLaws, Law1_KnownRationalRoots) {
  const std::vector<Rational> roots{q(1, 1000), q(1, 7), q(1, 3), q(1, 2), q(5, 8), q(999, 1000)};
  RandomRationals random;
  for (int round = 0; round < 30; ++round) {
    Form f = Form::constant(random.integer(0, 1) == 0 ? -3 : q(1, 9));
    std::vector<Rational> inside;
    for (const Rational& r : roots) {
      const int multiplicity = random.integer(0, 3);
      for (int k = 0; k < multiplicity; ++k) f = f * root_at(r);
      if (multiplicity > 0) inside.push_back(r);
    }
    // Roots that do not count: the ends, outside, infinity, complex pairs.
    for (int k = random.integer(0, 2); k > 0; --k) f = f * root_at(0);
    for (int k = random.integer(0, 2); k > 0; --k) f = f * root_at(1);
    for (int k = random.integer(0, 2); k > 0; --k) f = f * root_at(q(-1, 5));
    for (int k = random.integer(0, 1); k > 0; --k) f = f * root_at(q(1001, 1000));
    for (int k = random.integer(0, 2); k > 0; --k) f = f * Form({1, 1});
    if (random.integer(0, 1) == 1) f = f * Form({1, 1, q(26, 100)}).elevated(1);
    expect_roots(f, inside, q(1, 64));
    expect_roots(f, inside, Rational(2));
  }
}

TEST(RealRootsLaws, Law1_NoRoots) {
  EXPECT_TRUE(isolate_roots(Form::constant(5), Rational(1)).empty());
  EXPECT_TRUE(isolate_roots(Form({1, 1, 1}), Rational(1)).empty());     // (s + t)² up to its middle, no real zero
  EXPECT_TRUE(isolate_roots(Form({0, 0, 3, 0}), Rational(1)).empty());  // only the ends
  EXPECT_TRUE(isolate_roots(Form({1, -2, q(10001, 10000)}), q(1, 1 << 20)).empty());  // misses the axis by little
}

TEST(RealRootsLaws, Law1_RootsAlmostTogether) {
  const Rational tiny = Rational(1) / Rational(Integer(1) << 300);
  expect_roots(root_at(q(1, 3)) * root_at(q(1, 3) + tiny) * root_at(q(1, 2) - tiny) * root_at(q(1, 2)),
               {q(1, 3), q(1, 3) + tiny, q(1, 2) - tiny, q(1, 2)}, q(1, 4));
  expect_roots(root_at(tiny) * root_at(1 - tiny), {tiny, 1 - tiny}, q(1, 2));
}

TEST(RealRootsLaws, Law1_WilkinsonOfDegree20) {
  Form f = Form::constant(1);
  std::vector<Rational> roots;
  for (int i = 1; i <= 20; ++i) roots.push_back(q(i, 21)), f = f * root_at(q(i, 21));
  expect_roots(f, roots, q(1, 1000));
}

TEST(RealRootsLaws, Law1_IrrationalRoots) {
  // t² = 1/2: 2t² − (s + t)² has one root in (0, 1).
  const Form f({-1, -2, 1});
  const auto roots = isolate_roots(f, Rational(1) / Rational(1 << 30));
  ASSERT_EQ(roots.size(), 1u);
  const auto& [a, b] = roots[0];
  EXPECT_LT(a, b);
  EXPECT_LT(2 * a * a, 1);
  EXPECT_GT(2 * b * b, 1);
  // Squared and times a simple rational root, nothing changes but the count.
  const auto both = isolate_roots(f * f * root_at(q(1, 2)), q(1, 1024));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].first, q(1, 2));
  EXPECT_EQ(both[0].second, q(1, 2));
  EXPECT_TRUE(2 * both[1].first * both[1].first < 1 && 2 * both[1].second * both[1].second > 1);
}

TEST(RealRootsLaws, Law1_QuadraticField) {
  // In Q(√2) the root √2/2 is a number of the field; found beside 1/4, both to the width asked for.
  using F = BinaryForm<Quadratic>;
  const Quadratic half_root(Rational(0), q(1, 2), 2), quarter(q(1, 4)), one(1);
  const F f = F({-half_root, one - half_root}) * F({-half_root, one - half_root}) * F({-quarter, one - quarter});
  const auto roots = isolate_roots(f, Quadratic(q(1, 512)));
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_TRUE(roots[0].first == quarter && roots[0].second == quarter);
  EXPECT_TRUE(roots[1].first < half_root && half_root < roots[1].second);
  EXPECT_TRUE(roots[1].second - roots[1].first < Quadratic(q(1, 512)));
}

TEST(RealRootsLaws, Law2_Width) {
  const Form f = root_at(q(1, 3)) * root_at(q(2, 7)) * root_at(q(6, 7));
  for (const int bits : {0, 1, 5, 40, 200}) {
    const Rational width = Rational(1) / Rational(Integer(1) << bits);
    expect_roots(f, {q(2, 7), q(1, 3), q(6, 7)}, width);
  }
}

TEST(RealRootsLaws, Law3_OddPart) {
  const std::vector<Rational> roots{q(-1, 5), 0, q(1, 7), q(1, 3), q(1, 2), q(999, 1000), 1, 2};
  RandomRationals random;
  for (int round = 0; round < 40; ++round) {
    Form f = Form::constant(random.integer(0, 1) == 0 ? -3 : q(1, 9));
    std::vector<Rational> changes, places = spread_out();
    for (const Rational& r : roots) {
      const int multiplicity = random.integer(0, 5);
      for (int k = 0; k < multiplicity; ++k) f = f * root_at(r);
      if (multiplicity % 2 == 1 && r > 0 && r < 1) changes.push_back(r);
    }
    for (int k = random.integer(0, 3); k > 0; --k) f = f * Form({1, 1});
    const Form odd = odd_part(f);
    expect_roots(odd, changes, q(1, 64));
    EXPECT_EQ(gcd(odd, odd.derivative()).degree(), 0);
    for (const Rational& t : places) {
      if (f(t) == 0) continue;
      EXPECT_EQ(f(t) > 0, odd(t) > 0) << t;
      EXPECT_NE(odd(t), 0);
    }
  }
  EXPECT_EQ(odd_part(Form::constant(-7)).degree(), 0);
  EXPECT_LT(odd_part(Form::constant(-7))[0], 0);
}

TEST(RealRootsLaws, ZeroIsABrokenContract) {
  EXPECT_THROW(odd_part(Form({0, 0, 0})), contract_error);
  EXPECT_THROW(isolate_roots(Form({0, 0, 0}), Rational(1)), contract_error);
}

}  // namespace
}  // namespace patchproof
