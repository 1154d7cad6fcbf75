// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/curve_denominator.h"

#include <gtest/gtest.h>

#include "patchproof/spline/homogeneous.h"
#include "support/curves.h"

namespace patchproof::test {
namespace {

using Sign1 = CurveDenominatorSign;
using Numbers = std::vector<Rational>;
using Weights = BsplineCurve<Rational, 1>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

Weights weights_of(int degree, const Numbers& knots, const Numbers& weights) {
  std::vector<Vec<Rational, 1>> points;
  for (const Rational& w : weights) points.push_back({{w}});
  return Weights::make(KnotVector<Rational>::make(degree, knots).value(), points).value();
}
Weights bezier(const Numbers& weights) {
  Numbers knots(weights.size(), q(0));
  knots.resize(2 * weights.size(), q(1));
  return weights_of(static_cast<int>(weights.size()) - 1, knots, weights);
}
// Bernstein coefficients of the product of linear factors (t − root).
Numbers with_roots(const Numbers& roots) {
  Numbers b{q(1)};
  for (const Rational& r : roots) b = product(b, Numbers{Rational(-r), Rational(1 - r)});
  return b;
}

Numbers exact_zeros(const Weights& w) {
  const auto verdict = certify_denominator(w);
  Numbers out;
  for (const auto& zero : verdict.zeros) {
    EXPECT_TRUE(zero.is_exact());
    EXPECT_EQ(evaluate(w, zero.begin)[0] * evaluate(w, zero.begin, Side::left)[0], 0);
    out.push_back(zero.begin);
  }
  EXPECT_EQ(verdict.is_nonzero(), out.empty());
  return out;
}

TEST(CurveDenominator, Law1_OneStrictSign) {
  EXPECT_EQ(certify_denominator(bezier({q(1), q(2), q(1, 7)})).sign, Sign1::positive);
  EXPECT_EQ(certify_denominator(bezier({q(-1), q(-2), q(-3)})).sign, Sign1::negative);
  // Zero and negative weights with W > 0: 2t² − 2t + 1, 1 − 4t + 5t², and one that comes within 1/1000 of zero.
  EXPECT_EQ(certify_denominator(bezier({q(1), q(0), q(1)})).sign, Sign1::positive);
  EXPECT_EQ(certify_denominator(bezier({q(1), q(-1), q(2)})).sign, Sign1::positive);
  EXPECT_EQ(certify_denominator(bezier({q(1), q(-999, 1000), q(1)})).sign, Sign1::positive);
  EXPECT_EQ(certify_denominator(bezier({q(-1), q(1), q(-2)})).sign, Sign1::negative);
  EXPECT_TRUE(certify_denominator(bezier({q(1), q(0), q(1)})).is_nonzero());
}

TEST(CurveDenominator, Law1_DeadWeightsAreNotAsked) {
  const Numbers knots = {q(0), q(0), q(0), q(1), q(1), q(1), q(1), q(2), q(2), q(2)};
  EXPECT_EQ(certify_denominator(weights_of(2, knots, {q(1), q(1), q(1), q(-5), q(1), q(1), q(1)})).sign,
            Sign1::positive);
  EXPECT_EQ(certify_denominator(weights_of(2, knots, {q(1), q(1), q(1), q(0), q(1), q(-1, 2), q(1)})).sign,
            Sign1::positive);
  EXPECT_EQ(certify_denominator(weights_of(2, knots, {q(1), q(1), q(0), q(1), q(1), q(1), q(1)})).sign,
            Sign1::vanishes);
}

TEST(CurveDenominator, Law2_AJumpToTheOtherSignIsNoZero) {
  const Numbers knots = {q(0), q(0), q(1), q(1), q(2), q(2)};
  EXPECT_EQ(certify_denominator(weights_of(1, knots, {q(1), q(2), q(-1), q(-1)})).sign, Sign1::one_sign_per_piece);
  EXPECT_TRUE(certify_denominator(weights_of(1, knots, {q(1), q(2), q(-1), q(-1)})).is_nonzero());
  // Zero at the jump from one side only.
  EXPECT_EQ(exact_zeros(weights_of(1, knots, {q(1), q(0), q(1), q(1)})), Numbers{q(1)});
  EXPECT_EQ(exact_zeros(weights_of(1, knots, {q(1), q(1), q(0), q(1)})), Numbers{q(1)});
  EXPECT_EQ(exact_zeros(weights_of(1, knots, {q(1), q(0), q(0), q(1)})), Numbers{q(1)});
  // Without the jump the change of sign is a zero.
  EXPECT_EQ(exact_zeros(weights_of(1, {q(0), q(0), q(1), q(2), q(2)}, {q(1), q(2), q(-1)})), Numbers{q(5, 3)});
}

// Weights 1, −1, 1: W = (1 − 2t)², and the curve passes through infinity at 1/2 with the homogeneous value (0, −1/2, 0).
TEST(CurveDenominator, Law3_PoleOfAConic) {
  const BsplineCurve<Rational, 3> pole =
      BsplineCurve<Rational, 3>::bezier({{{q(0), q(0), q(1)}}, {{q(-1), q(-1), q(-1)}}, {{q(2), q(0), q(1)}}});
  const auto verdict = certify_denominator(pole);
  EXPECT_EQ(verdict.sign, Sign1::vanishes);
  ASSERT_EQ(verdict.zeros.size(), 1u);
  EXPECT_TRUE(verdict.zeros[0].is_exact());
  EXPECT_EQ(verdict.zeros[0].begin, q(1, 2));
  EXPECT_EQ(evaluate(pole, q(1, 2)), (Vec<Rational, 3>{{q(0), q(-1, 2), q(0)}}));
  EXPECT_THROW(evaluate_rational(pole, q(1, 2)), contract_error);
  EXPECT_EQ(evaluate_rational(pole, q(1, 4)), (Vec<Rational, 2>{{q(-1), q(-3, 2)}}));
}

TEST(CurveDenominator, Law3And4_RationalZerosAreExact) {
  for (const Numbers& roots : {Numbers{q(1, 3)},
                               {q(1, 3), q(1, 3)},
                               {q(0), q(1)},
                               {q(0), q(0), q(2, 7), q(5, 7), q(1)},
                               {q(1, 1000)},
                               {q(999, 1000), q(999, 1000)},
                               {q(500, 1023), q(501, 1023)},
                               {q(1, 2), q(1, 2), q(1, 2)},
                               {q(1, 4), q(3, 4)}}) {
    Numbers distinct = roots;
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    EXPECT_EQ(exact_zeros(bezier(with_roots(roots))), distinct);
  }
  // Zeros outside the domain are none of the curve's.
  EXPECT_TRUE(certify_denominator(bezier(with_roots({q(-1), q(2), q(1001, 1000)}))).is_nonzero());
  EXPECT_EQ(exact_zeros(bezier(with_roots({q(-1), q(1, 5), q(2)}))), Numbers{q(1, 5)});
}

TEST(CurveDenominator, Law4_IrrationalZerosAreIsolated) {
  // 1 − 2t²: the zero √(1/2).
  const Weights w = bezier({q(1), q(1), q(-1)});
  const auto verdict = certify_denominator(w);
  ASSERT_EQ(verdict.zeros.size(), 1u);
  const auto& zero = verdict.zeros[0];
  EXPECT_FALSE(zero.is_exact());
  EXPECT_FALSE(zero.everywhere);
  EXPECT_LT(2 * zero.begin * zero.begin, 1);
  EXPECT_GT(2 * zero.end * zero.end, 1);
  EXPECT_LT((zero.end - zero.begin) * (1 << 20), 1);
  // The same where numbers are Q(√2), and an exact zero of Q(√2) coefficients: √2 − 2√2 t.
  const auto root = [](int a, int b) { return Quadratic(q(a), q(b), 2); };
  using Q1 = BsplineCurve<Quadratic, 1>;
  const auto half = certify_denominator(Q1::bezier({{{root(0, 1)}}, {{root(0, -1)}}}));
  ASSERT_EQ(half.zeros.size(), 1u);
  EXPECT_TRUE(half.zeros[0].is_exact() && half.zeros[0].begin == Quadratic(q(1, 2)));
  EXPECT_TRUE(certify_denominator(Q1::bezier({{{root(3, -2)}}, {{root(1, 0)}}})).is_nonzero());  // 3 − 2√2 > 0
  EXPECT_EQ(certify_denominator(Q1::bezier({{{root(7, -5)}}, {{root(1, 0)}}})).sign, Sign1::vanishes);  // 7 − 5√2 < 0
}

TEST(CurveDenominator, Law3_WholeSpansOfZeros) {
  const Numbers knots = {q(0), q(0), q(1), q(2), q(3), q(4), q(4)};
  const auto zeros = [&](const Numbers& weights) { return certify_denominator(weights_of(1, knots, weights)).zeros; };
  auto z = zeros({q(1), q(0), q(0), q(1), q(1)});
  ASSERT_EQ(z.size(), 1u);
  EXPECT_TRUE(z[0].everywhere && z[0].begin == 1 && z[0].end == 2);
  z = zeros({q(1), q(0), q(0), q(0), q(1)});
  ASSERT_EQ(z.size(), 1u);
  EXPECT_TRUE(z[0].everywhere && z[0].begin == 1 && z[0].end == 3);
  z = zeros({q(0), q(0), q(1), q(0), q(-1)});
  ASSERT_EQ(z.size(), 2u);
  EXPECT_TRUE(z[0].everywhere && z[0].begin == 0 && z[0].end == 1);
  EXPECT_TRUE(z[1].is_exact() && z[1].begin == 3);
  EXPECT_TRUE(certify_denominator(bezier({q(0)})).zeros[0].everywhere);
}

// Zeros put at random places of a spline with awkward knots are all found, and nothing else is.
TEST(CurveDenominator, Law3_ZerosOfSplinesAgainstConstruction) {
  RandomRationals random;
  for (const NamedCurve& named : awkward_curves(random)) {
    SCOPED_TRACE(named.name);
    const KnotVector<Rational>& knots = named.curve.knots();
    if (knots.degree() == 0) continue;
    // The line t − z as a spline on these knots: its control points are Greville abscissae minus z, also outside.
    const Rational z = (q(2) * knots.domain_begin() + knots.domain_end()) / 3;
    Numbers weights;
    for (int i = 0; i < knots.control_count(); ++i) {
      Rational sum(0);
      for (int j = 1; j <= knots.degree(); ++j) sum += knots[i + j];
      weights.push_back(sum / knots.degree() - z);
    }
    const auto verdict = certify_denominator(weights_of(knots.degree(), knots.knots(), weights));
    ASSERT_EQ(verdict.zeros.size(), 1u);
    EXPECT_LE(verdict.zeros[0].begin, z);
    EXPECT_GE(verdict.zeros[0].end, z);
  }
}

TEST(CurveDenominator, Law5_KnotInsertionScalingAndReversal) {
  RandomRationals random;
  int vanishing = 0, others = 0;
  for (int round = 0; round < 60; ++round) {
    const int degree = random.integer(1, 4), count = degree + 1 + random.integer(0, 4);
    const Numbers knots = random.knots(degree, count);
    Numbers w = random.numbers(count);
    for (Rational& x : w) x += round % 3 * 8;
    const Weights curve = weights_of(degree, knots, w);
    const auto verdict = certify_denominator(curve);
    (verdict.is_nonzero() ? others : vanishing) += 1;

    const Rational middle = (curve.knots().domain_begin() + q(2) * curve.knots().domain_end()) / 3;
    const auto inserted = certify_denominator(raise_multiplicity(curve, middle, degree));
    EXPECT_EQ(inserted.sign, verdict.sign);
    EXPECT_EQ(inserted.zeros.size(), verdict.zeros.size());

    Numbers negated, reversed_knots;
    for (const Rational& x : w) negated.push_back(q(-3) * x);
    const auto flipped = certify_denominator(weights_of(degree, knots, negated)).sign;
    if (verdict.sign == Sign1::positive) {
      EXPECT_EQ(flipped, Sign1::negative);
    } else if (verdict.sign == Sign1::negative) {
      EXPECT_EQ(flipped, Sign1::positive);
    } else {
      EXPECT_EQ(flipped, verdict.sign);
    }
    for (auto k = knots.rbegin(); k != knots.rend(); ++k) reversed_knots.push_back(-*k);
    const auto turned = certify_denominator(weights_of(degree, reversed_knots, Numbers(w.rbegin(), w.rend())));
    EXPECT_EQ(turned.sign, verdict.sign);
    ASSERT_EQ(turned.zeros.size(), verdict.zeros.size());
    for (std::size_t i = 0; i < verdict.zeros.size(); ++i) {
      const auto& a = verdict.zeros[i];
      const auto& b = turned.zeros[verdict.zeros.size() - 1 - i];
      EXPECT_TRUE(a.begin <= -b.begin && -b.end <= a.end);
    }
  }
  EXPECT_GT(vanishing, 5);
  EXPECT_GT(others, 5);
}

TEST(CurveDenominator, Law4_SimplestFractions) {
  EXPECT_EQ(detail::simplest_between(q(0), q(1)), q(1, 2));
  EXPECT_EQ(detail::simplest_between(q(333, 1000), q(334, 1000)), q(1, 3));
  EXPECT_EQ(detail::simplest_between(q(0), q(1, 100)), q(1, 101));
  EXPECT_EQ(detail::simplest_between(q(1, 2), q(1)), q(2, 3));
  EXPECT_EQ(detail::simplest_between(q(31415, 10000), q(31416, 10000)), q(333, 106));
  EXPECT_EQ(detail::simplest_between(q(0), Rational(q(1) / Rational(Integer(1) << 40))), std::nullopt);
}

}  // namespace
}  // namespace patchproof::test
