// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/denominator.h"

#include <chrono>

#include "patchproof/patch/patch_knots.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Weights = BsplinePatch<Rational, 1>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }

// The scalar Bézier patch with these coefficients, v running fastest.
Weights bezier(int p, int degree_v, const std::vector<Rational>& b) {
  std::vector<Vec<Rational, 1>> net;
  for (const Rational& x : b) net.push_back({{x}});
  return {KnotVector<Rational>::bezier(p), KnotVector<Rational>::bezier(degree_v), net};
}

// f(u)·g(v) and f(u) + g(v) from Bernstein coefficients.
Weights times(const std::vector<Rational>& f, const std::vector<Rational>& g) {
  std::vector<Rational> b;
  for (const auto& x : f)
    for (const auto& y : g) b.push_back(x * y);
  return bezier(static_cast<int>(f.size()) - 1, static_cast<int>(g.size()) - 1, b);
}
Weights plus(const std::vector<Rational>& f, const std::vector<Rational>& g) {
  std::vector<Rational> b;
  for (const auto& x : f)
    for (const auto& y : g) b.push_back(x + y);
  return bezier(static_cast<int>(f.size()) - 1, static_cast<int>(g.size()) - 1, b);
}

template <class T>
class DenominatorLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(DenominatorLaws, ExactScalars, ScalarNames);

TYPED_TEST(DenominatorLaws, Law1_ProvenSigns) {
  using T = TypeParam;
  const auto sign = [](const Weights& w) { return certify_denominator(make_patch<T>(w)).sign; };
  EXPECT_EQ(sign(bezier(1, 1, {1, 2, 3, 4})), DenominatorSign::positive);
  EXPECT_EQ(sign(bezier(1, 1, {-1, -2, -3, -4})), DenominatorSign::negative);
  // Zero and negative weights under a positive denominator: w = 1 − 2t + 2t² and w = 1 − 4t + 5t².
  EXPECT_EQ(sign(times({1, 0, 1}, {1, 1})), DenominatorSign::positive);
  EXPECT_EQ(sign(times({1, -1, 2}, {1, 2})), DenominatorSign::positive);
  EXPECT_EQ(sign(times({1, -1, 2}, {-1, 1, -2})), DenominatorSign::negative);
  // All inner weights and inner edge weights zero: only the corners carry.
  EXPECT_EQ(sign(bezier(2, 2, {1, 0, 1, 0, 0, 0, 1, 0, 1})), DenominatorSign::positive);
  // Barely positive: (2u − 1)² + 10⁻⁶.
  EXPECT_EQ(sign(times({1 + q(1, 1000000), -1 + q(1, 1000000), 1 + q(1, 1000000)}, {1})), DenominatorSign::positive);
  // The same around 1/3, not met by halving: (3u − 1)² + 10⁻⁴.
  const Rational e = q(1, 10000);
  EXPECT_EQ(sign(plus({1 + e, -2 + e, 4 + e}, {0, 0})), DenominatorSign::positive);
}

TYPED_TEST(DenominatorLaws, Law2_ZerosWithWitness) {
  using T = TypeParam;
  // Every verdict `vanishes` is checked: a point is a zero, a box has corners of different signs.
  const auto expect_zero = [](const Weights& w) {
    const auto patch = make_patch<T>(w);
    const auto verdict = certify_denominator(patch);
    ASSERT_EQ(verdict.sign, DenominatorSign::vanishes);
    const auto& box = verdict.where;
    const auto at = [&](const auto& u, const auto& v) { return *scalar_traits<T>::sign(evaluate(patch, u, v)[0]); };
    if (box.u_begin == box.u_end && box.v_begin == box.v_end) {
      EXPECT_EQ(at(box.u_begin, box.v_begin), Sign::zero);
    } else {
      bool positive = false, negative = false;
      for (const auto& u : {box.u_begin, box.u_end})
        for (const auto& v : {box.v_begin, box.v_end}) {
          positive = positive || at(u, v) == Sign::positive;
          negative = negative || at(u, v) == Sign::negative;
        }
      EXPECT_TRUE(positive && negative);
    }
  };
  expect_zero(bezier(1, 1, {1, 1, 1, -1}));
  expect_zero(bezier(1, 1, {1, 1, 1, 0}));  // a corner
  expect_zero(bezier(1, 1, {0, 0, 0, 0}));  // everywhere
  expect_zero(bezier(0, 0, {0}));
  expect_zero(bezier(2, 2, {1, 0, 1, 1, 1, 1, 0, 0, 0}));  // an edge
  expect_zero(times({1, -1, 1}, {1, 1}));                  // (1 − 2u)²: touches at 1/2
  expect_zero(times({1, -2, 4}, {1, 3}));                  // (3u − 1)²: touches at 1/3, which no halving meets
  expect_zero(plus({1, -2, 4}, {4, -6, 9}));               // (3u − 1)² + (5v − 2)²: one point
  expect_zero(plus({1, q(-5, 2), 6}, {1, q(-3, 2), 2}));   // a small region of negative values inside
  expect_zero(plus({q(-1, 1000), q(-1, 1000)}, {1, -1, 1}));
}

TEST(Denominator, Law2_TheWitnessIsThePoint) {
  const auto verdict = certify_denominator(plus({1, -2, 4}, {4, -6, 9}));
  ASSERT_EQ(verdict.sign, DenominatorSign::vanishes);
  EXPECT_TRUE(verdict.where == (ParameterBox<Rational>{q(1, 3), q(1, 3), q(2, 5), q(2, 5)}));
}

TEST(Denominator, Law3_SignsThatDifferBetweenPieces) {
  const KnotVector<Rational> broken = make_knots<Rational>(1, {0, 0, 1, 1, 2, 2});  // a jump at 1
  const KnotVector<Rational> line = KnotVector<Rational>::bezier(1);
  const auto at = [&](std::vector<int> w) {
    std::vector<Vec<Rational, 1>> net;
    for (int x : w) net.push_back({{Rational(x)}});
    return certify_denominator(Weights(broken, line, net));
  };
  const auto jumps = at({1, 1, 2, 2, -1, -1, -2, -2});
  EXPECT_EQ(jumps.sign, DenominatorSign::one_sign_per_piece);
  EXPECT_TRUE(jumps.is_nonzero());
  EXPECT_EQ(at({1, 1, 2, 2, 1, 1, -2, -2}).sign, DenominatorSign::vanishes);
  // The one-sided limit counts too: zero only from the left of 1.
  const auto limit = at({1, 1, 0, 1, 1, 1, 1, 1});
  EXPECT_EQ(limit.sign, DenominatorSign::vanishes);
  EXPECT_TRUE(limit.where == (ParameterBox<Rational>{1, 1, 0, 0}));
  EXPECT_FALSE(limit.is_nonzero());
}

TEST(Denominator, Law4_UnchangedByRewritingTheSurface) {
  RandomRationals random;
  int positive = 0, vanishing = 0;
  for (int i = 0; i < 40; ++i) {
    auto w = random_patch<1>(random, 2, 4, 3, 5);
    w = map_points(w, [](const Vec<Rational, 1>& p) { return Vec<Rational, 1>{{p[0] + 7}}; });
    const auto sign = certify_denominator(w).sign;
    ASSERT_NE(sign, DenominatorSign::undecided);
    (sign == DenominatorSign::vanishes ? vanishing : positive) += 1;
    const auto d = w.domain();
    EXPECT_EQ(certify_denominator(swap_directions(w)).sign, sign);
    EXPECT_EQ(certify_denominator(reverse(w, Direction::u)).sign, sign);
    EXPECT_EQ(certify_denominator(insert_knot(w, Direction::v, (d.v_begin + 2 * d.v_end) / 3, 2)).sign, sign);
    EXPECT_EQ(certify_denominator(elevate_degree(w, Direction::u)).sign, sign);
    EXPECT_EQ(certify_denominator(map_points(w, [](const auto& p) { return q(1, 1 << 20) * p; })).sign, sign);
  }
  EXPECT_GE(positive, 5);
  EXPECT_GE(vanishing, 5);
}

// Second opinion: a proven sign holds on a dense grid, both sides at knots.
TEST(Denominator, Law1_AgreesWithSamples) {
  RandomRationals random(99);
  int proven = 0;
  for (int i = 0; i < 60; ++i) {
    auto w = random_patch<1>(random, 2, 3, 2, 4);
    w = map_points(w, [](const Vec<Rational, 1>& p) { return Vec<Rational, 1>{{p[0] + 5}}; });
    const auto verdict = certify_denominator(w);
    if (!verdict.is_nonzero()) continue;
    ++proven;
    const auto d = w.domain();
    for (const Rational& u : spread(d.u_begin, d.u_end, 12))
      for (const Rational& v : spread(d.v_begin, d.v_end, 12)) {
        const Rational value = evaluate(w, u, v)[0];
        EXPECT_EQ(verdict.sign == DenominatorSign::positive, value > 0);
        EXPECT_NE(value, 0);
      }
  }
  EXPECT_GE(proven, 10);
}

TEST(Denominator, Law5_EndsUndecidedWhenTheZeroIsOutOfReach) {
  // (2u² − 1)² touches zero at √2/2, which is neither found by halving nor a fraction.
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Rational> f{1, 1, q(1, 3), -1, 1};
  const auto verdict = certify_denominator(times(f, {1, 1, 1, 1}));
  EXPECT_EQ(verdict.sign, DenominatorSign::undecided);
  EXPECT_FALSE(verdict.is_nonzero());
  EXPECT_LT(2 * verdict.where.u_begin * verdict.where.u_begin, 1);
  EXPECT_GT(2 * verdict.where.u_end * verdict.where.u_end, 1);
  // A tiny budget is respected, and undecided is not mistaken for a proof.
  const auto small = times({1 + q(1, 1000000), -1, 1}, {1, 1});
  EXPECT_EQ(certify_denominator(small).sign, DenominatorSign::positive);
  EXPECT_EQ(certify_denominator(small, {0, 1000}).sign, DenominatorSign::undecided);
  EXPECT_EQ(certify_denominator(small, {20, 0}).sign, DenominatorSign::undecided);
  EXPECT_THROW(certify_denominator(small, {31, 1000}), contract_error);
  // High degree, touching an irrational curve.
  std::vector<Rational> high = f;
  for (int k = 0; k < 12; ++k) high = elevate_degree(high);
  EXPECT_EQ(certify_denominator(times(high, std::vector<Rational>(17, Rational(1)))).sign, DenominatorSign::undecided);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

// Readers call this for every patch: weights of one sign must cost next to nothing.
TEST(Denominator, ManyPatchesWithUnitWeights) {
  std::vector<Vec<Rational, 4>> net(16, {{1, 2, 3, 1}});
  const KnotVector<Rational> cubic = KnotVector<Rational>::bezier(3);
  const BsplinePatch<Rational, 4> patch(cubic, cubic, net);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 100000; ++i) ASSERT_EQ(certify_denominator(patch).sign, DenominatorSign::positive);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Denominator, SimplestFraction) {
  using detail::simplest_fraction;
  EXPECT_EQ(simplest_fraction(0, 1, 8), std::pair(0L, 1L));
  EXPECT_EQ(simplest_fraction(-1, 2, 8), std::pair(0L, 1L));
  EXPECT_EQ(simplest_fraction(7, 8, 8), std::pair(1L, 1L));
  EXPECT_EQ(simplest_fraction(2, 3, 8), std::pair(1L, 3L));
  EXPECT_EQ(simplest_fraction(349525, 349526, 1 << 20), std::pair(1L, 3L));
  EXPECT_EQ(simplest_fraction((1L << 30) - 2, (1L << 30) - 1, 1L << 30), std::nullopt);
}

}  // namespace
}  // namespace patchproof
