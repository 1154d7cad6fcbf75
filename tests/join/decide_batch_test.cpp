// SPDX-License-Identifier: Apache-2.0
// decide_join and the filter's bounds; the batches of the kernels: tests/kernels/decide_batch_test.cpp.
#include "patchproof/join/decide_batch.h"

#include <gtest/gtest.h>

#include <iostream>

#include "join/decide_one.h"
#include "join/decide_rational_forms.h"
#include "support/g1_joins.h"
#include "support/g1_truth.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

BicubicEdge edge_of(const BicubicJoinRows& rows) {
  return {rows.edge, rows.weights ? (*rows.weights)[0] : std::array<double, 4>{1, 1, 1, 1}};
}

void expect_true_decision(const BicubicJoinRows& rows, const BicubicEdge* other = nullptr) {
  const JoinDecision decision = decide_join(rows, other);
  const ExactAnswer truth = exact_answer(rows, other);
  ASSERT_EQ(decision.c0, truth.c0);
  ASSERT_EQ(decision.c1, truth.c1);
  if (decision.g1) {
    ASSERT_EQ(*decision.g1 == FixedG1::refuted, !truth.coplanar);
    ASSERT_TRUE(truth.smooth || *decision.g1 != FixedG1::proven_smooth);
  }
}

TEST(DecideJoin, Law1_C0OfRowsThatAreGivenTwice) {
  for (const G1Family& family : {kD24, kD53, kR53, kR106})
    for (const BicubicJoinRows& rows : make_g1_joins(family, 20)) {
      BicubicEdge other = edge_of(rows);
      EXPECT_EQ(decide_join(rows, &other), decide_join(rows));
      other.points[1][2] = std::nextafter(other.points[1][2], kInfinity);
      const JoinDecision apart = decide_join(rows, &other);
      EXPECT_EQ(apart, (JoinDecision{false, false, FixedG1::refuted, DecidedBy::edges}));
      EXPECT_FALSE(exact_answer(rows, &other).c0);
      other = edge_of(rows);
      for (double& w : other.weights) w *= 2;  // another factor, the same curve
      ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows, &other));
      EXPECT_TRUE(decide_join(rows, &other).c0);
      other.weights[2] = std::nextafter(other.weights[2], 0);
      ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows, &other));
      EXPECT_FALSE(decide_join(rows, &other).c0);
    }
}

// E = (1 + t) Q, F = (2 − t) Q with one Q of degree 2: one curve, rows that are not proportional.
TEST(DecideJoin, Law1_C0OfRowsWithDifferentFactors) {
  const int q[3][4] = {{0, 0, 0, 1}, {4, 7, 1, 2}, {5, 20, 3, 1}};
  BicubicJoinRows rows;
  rows.points = WeightedPoints::homogeneous;
  rows.weights.emplace();
  BicubicEdge other;
  const auto raise = [&](double at0, double at1, BicubicJoinRows::Row& row, std::array<double, 4>& weights) {
    for (int k = 0; k < 4; ++k) {
      const double c[4] = {3 * at0 * q[0][k], at1 * q[0][k] + 2 * at0 * q[1][k], 2 * at1 * q[1][k] + at0 * q[2][k],
                           3 * at1 * q[2][k]};
      for (int i = 0; i < 4; ++i) (k < 3 ? row[i][k] : weights[i]) = c[i];
    }
  };
  raise(1, 2, rows.edge, (*rows.weights)[0]);
  raise(2, 1, other.points, other.weights);
  for (const double side : {-1.0, 1.0}) {
    auto& row = side < 0 ? rows.behind_a : rows.behind_b;
    row = side < 0 ? rows.edge : other.points;
    (*rows.weights)[side < 0 ? 1 : 2] = side < 0 ? (*rows.weights)[0] : other.weights;
    for (auto& point : row) point[0] += 9 * side;
  }
  ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows, &other));
  EXPECT_TRUE(decide_join(rows, &other).c0);
  other.points[3][2] += 1;
  ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows, &other));
  EXPECT_FALSE(decide_join(rows, &other).c0);
}

TEST(DecideJoin, Law1_C1) {
  for (const G1Family& family : {kC1, kR53, kR106})
    for (BicubicJoinRows rows : make_g1_joins(family, 20)) {
      EXPECT_TRUE(decide_join(rows).c1);
      ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows));
      spoil(rows);
      EXPECT_FALSE(decide_join(rows).c1);
      ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows));
    }
  for (const BicubicJoinRows& rows : make_g1_joins(kD53, 40)) ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows));
}

// A + B = 5 E in homogeneous numbers is C1 as well; so is everything at sizes where sums overflow.
TEST(DecideJoin, Law1_C1ThatIsNoPlainReflection) {
  for (BicubicJoinRows rows : make_g1_joins(kR53, 20)) {
    rows.points = WeightedPoints::homogeneous;
    for (int i = 0; i < 4; ++i) {
      (*rows.weights)[1][i] += i;
      for (int k = 0; k < 3; ++k) rows.behind_b[i][k] = 5 * rows.edge[i][k] - rows.behind_a[i][k];
      (*rows.weights)[2][i] = 5 * (*rows.weights)[0][i] - (*rows.weights)[1][i];
    }
    EXPECT_TRUE(decide_join(rows).c1);
    ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows));
    (*rows.weights)[2][3] += 1;
    EXPECT_FALSE(decide_join(rows).c1);
  }
  BicubicJoinRows huge;
  for (auto* row : {&huge.edge, &huge.behind_a, &huge.behind_b})
    for (auto& point : *row) point.fill(kLargest);
  EXPECT_TRUE(decide_join(huge).c1);
  huge.behind_a[0][0] = std::nextafter(kLargest, 0);
  EXPECT_FALSE(decide_join(huge).c1);
}

TEST(DecideJoin, Law2_IsTheFixedDecision) {
  for (const G1Family& family : {kD24, kD53, kR53, kR106})
    for (BicubicJoinRows rows : make_g1_joins(family, 40)) {
      EXPECT_EQ(decide_join(rows).g1, decide_fixed_g1(rows));
      EXPECT_EQ(decide_join(rows).g1, FixedG1::proven_smooth);
      EXPECT_EQ(decide_join(rows).rung, DecidedBy::fixed);
      spoil(rows);
      EXPECT_EQ(decide_join(rows).g1, FixedG1::refuted);
    }
}

TEST(DecideJoin, Law3_TooLongNumbersAreRefutedByTheFilterOrLeftOpen) {
  int refuted = 0, open = 0;
  for (const G1Family& family : {kD53, kR106})
    for (BicubicJoinRows rows : make_g1_joins(family, 40)) {
      for (auto& point : rows.edge) point[0] += 0x1p-90 * point[1];  // rounds away: too long only where it is tiny
      rows.edge[1][0] = 0x1p-140;
      ASSERT_EQ(decide_fixed_g1(rows), std::nullopt);
      const JoinDecision decision = decide_join(rows);
      ASSERT_NO_FATAL_FAILURE(expect_true_decision(rows));
      decision.g1 ? ++refuted : ++open;
      EXPECT_EQ(decision.rung, decision.g1 ? DecidedBy::filter : DecidedBy::nothing);
    }
  EXPECT_GT(refuted, 70);
  BicubicJoinRows flat = make_g1_joins(kC1, 1)[0];  // in a plane, and with a number of 2^-140
  for (auto* row : {&flat.edge, &flat.behind_a, &flat.behind_b})
    for (auto& point : *row) point[2] = 0;
  flat.edge[1][0] = 0x1p-140;
  EXPECT_EQ(decide_join(flat).g1, std::nullopt);
}

TEST(DecideJoin, Law5_WeightsOfTheEdgeArePositive) {
  for (const double w : {0.0, -1.0}) {
    BicubicJoinRows rows = make_g1_joins(kR53, 1)[0];
    BicubicEdge other = edge_of(rows);
    (*rows.weights)[0][1] = other.weights[1] = w;
    const JoinDecision decision = decide_join(rows, &other);
    EXPECT_TRUE(decision.c0);
    EXPECT_EQ(decision.g1, std::nullopt);
    EXPECT_EQ(decision.rung, DecidedBy::nothing);
  }
}

TEST(DecideJoin, ContractNumbersAreFinite) {
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    const BicubicJoinRows good = make_g1_joins(kR53, 1)[0];
    BicubicJoinRows rows = good;
    rows.behind_a[1][1] = bad;
    EXPECT_THROW(decide_join(rows), contract_error);
    rows = good;
    (*rows.weights)[2][0] = bad;
    EXPECT_THROW(decide_join(rows), contract_error);
    BicubicEdge other = edge_of(good);
    other.weights[3] = bad;
    EXPECT_THROW(decide_join(good, &other), contract_error);
  }
}

// ---- the filter's bounds, against exact numbers --------------------------------------------------------------------

using decide::OneLane;
using Form = std::vector<Rational>;

Form times(const Form& f, const Form& g) {
  Form out(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) out[i + j] += f[i] * g[j];
  return out;
}
Form minus(Form f, const Form& g) {
  for (std::size_t i = 0; i < f.size(); ++i) f[i] -= g[i];
  return f;
}
Form plus(Form f, const Form& g) {
  for (std::size_t i = 0; i < f.size(); ++i) f[i] += g[i];
  return f;
}
std::array<Form, 3> cross_of(const std::array<Form, 3>& f, const std::array<Form, 3>& g) {
  std::array<Form, 3> out;
  for (int k = 0; k < 3; ++k)
    out[k] = minus(times(f[(k + 1) % 3], g[(k + 2) % 3]), times(f[(k + 2) % 3], g[(k + 1) % 3]));
  return out;
}
Form dot_of(const std::array<Form, 3>& f, const std::array<Form, 3>& g) {
  return plus(plus(times(f[0], g[0]), times(f[1], g[1])), times(f[2], g[2]));
}

// Coordinates of very different sizes, joins that are nearly G1, and underflow.
BicubicJoinRows wild_join(WildNumbers& random, std::mt19937_64& engine, bool weighted) {
  BicubicJoinRows rows = make_g1_join(engine, weighted ? kR106 : kD53);
  const int kind = random.below(5);
  for (auto* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (auto& point : *row)
      for (double& x : point) {
        if (kind == 1) x += random.moderate(20) * 0x1p-45;
        if (kind == 2) x = random.moderate(30);
        if (kind == 3 && random.below(6) == 0) x = random.below(2) ? 0 : random.moderate(300) * 0x1p-600;
        if (kind == 4) x = std::ldexp(random.moderate(2), -700);
      }
  return rows;
}

// value against exact · scale, within error · binomial. The worst ratio so far is kept.
void expect_within(double value, const Rational& exact, double error, double binomial, double& worst) {
  Rational defect = from_double(value) - exact;
  if (defect < 0) defect = -defect;
  const Rational bound = from_double(error) * from_double(binomial);
  ASSERT_LE(defect, bound);
  worst = std::max(worst, nearest_double(defect / bound));
}

TEST(DecideFilter, BoundOfThePolynomialDeterminant) {
  WildNumbers random;
  std::mt19937_64 engine(1);
  double worst = 0;
  int opposed = 0;
  for (int i = 0; i < 400; ++i) {
    const BicubicJoinRows rows = wild_join(random, engine, false);
    double x[36];
    std::copy_n(rows.edge[0].data(), 36, x);
    decide::Differences<OneLane> d;
    decide::take_differences<OneLane>(x, d);
    ASSERT_TRUE(d.in_range);
    decide::WeightedForms<OneLane> forms;
    decide::apply_binomials<OneLane>(d, forms);
    decide::Filtered<OneLane> filtered;
    decide::filter_polynomial<OneLane>(d, forms, filtered);
    std::array<Form, 3> a, b, c;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 4; ++j) {
        const Rational binomial(j == 1 || j == 2 ? 3 : 1), e = from_double(rows.edge[j][k]);
        a[k].push_back(binomial * (from_double(rows.behind_a[j][k]) - e) / from_double(d.scale_a.down));
        b[k].push_back(binomial * (from_double(rows.behind_b[j][k]) - e) / from_double(d.scale_b.down));
        if (j < 3)
          c[k].push_back(Rational(j == 1 ? 2 : 1) * (from_double(rows.edge[j + 1][k]) - e) /
                         from_double(d.scale_c.down));
      }
    const Form det = dot_of(c, cross_of(a, b));
    for (int s = 0; s < 9; ++s)
      ASSERT_NO_FATAL_FAILURE(expect_within(filtered.value[s], det[s], filtered.error, decide::kEight[s], worst));
    const Form sides = dot_of(cross_of(c, a), cross_of(c, b));
    if (decide::opposed_polynomial<OneLane>(d, forms)) {
      for (const Rational& coefficient : sides) ASSERT_LT(coefficient, 0);
      ++opposed;
    }
  }
  EXPECT_GT(opposed, 70);
  std::cout << "worst error / bound: " << worst << "\n";
  EXPECT_GT(worst, 0x1p-10);  // not a bound a thousand times too large
}

TEST(DecideFilter, BoundOfTheRationalDeterminant) {
  WildNumbers random;
  std::mt19937_64 engine(2);
  double worst = 0;
  int middle_refuted = 0, opposed = 0;
  for (int i = 0; i < 300; ++i) {
    const BicubicJoinRows rows = wild_join(random, engine, true);
    const bool cartesian = i % 2 == 0;
    decide::ScaledRows<OneLane> scaled;
    double x[36], w[12], line[5][6];
    std::copy_n(rows.edge[0].data(), 36, x);
    std::copy_n((*rows.weights)[0].data(), 12, w);
    decide::take_scaled<OneLane>(x, w, scaled);
    ASSERT_TRUE(scaled.in_range);
    decide::HomogeneousRows<OneLane> h;
    decide::take_homogeneous<OneLane>(scaled, cartesian, h);
    decide::edge_line(decide::Doubles<OneLane>(), h.edge, line);
    decide::Filtered<OneLane> filtered;
    decide::filter_rational<OneLane>(h, scaled.in_range, line, filtered);

    std::array<Form, 4> rows_of[3];
    for (int r = 0; r < 3; ++r)
      for (int j = 0; j < 4; ++j) {
        const Rational binomial(r > 0 && (j == 1 || j == 2) ? 3 : 1),
            weight = from_double(w[4 * r + j]) / from_double(scaled.scale_weights.down) * binomial;
        for (int k = 0; k < 3; ++k)
          rows_of[r][k].push_back(from_double(x[12 * r + 3 * j + k]) / from_double(scaled.scale_points.down) *
                                  (cartesian ? weight : binomial));
        rows_of[r][3].push_back(weight);
      }
    const auto wedge = [&](const std::array<Form, 4>& f, const std::array<Form, 4>& g, int k) {
      const int p = decide::kLine[k][0], q = decide::kLine[k][1];
      return minus(times(f[p], g[q]), times(f[q], g[p]));
    };
    std::array<Form, 6> exact_line;
    Form det(11);
    for (int k = 0; k < 6; ++k) {
      const auto pair = [&](int i0, int i1) {
        const auto& e = rows_of[0];
        const int p = decide::kLine[k][0], q = decide::kLine[k][1];
        return Rational(e[p][i0] * e[q][i1] - e[q][i0] * e[p][i1]);
      };
      exact_line[k] = {pair(0, 1), Rational(2) * pair(0, 2), pair(0, 3) + Rational(3) * pair(1, 2),
                       Rational(2) * pair(1, 3), pair(2, 3)};
      det = plus(det, times(exact_line[k], wedge(rows_of[1], rows_of[2], (k + 3) % 6)));
    }
    for (int s = 0; s < 11; ++s)
      ASSERT_NO_FATAL_FAILURE(expect_within(filtered.value[s], det[s], filtered.error, decide::kMeeting[s], worst));

    const std::array<Form, 3> direction{exact_line[0], exact_line[1], exact_line[2]};
    std::array<Form, 3> n[2];
    for (const int side : {1, 2}) {
      n[side - 1] = cross_of(direction, {rows_of[side][0], rows_of[side][1], rows_of[side][2]});
      for (int k = 0; k < 3; ++k) n[side - 1][k] = plus(n[side - 1][k], times(exact_line[3 + k], rows_of[side][3]));
    }
    if (decide::opposed_rational<OneLane>(h, line)) {
      for (const Rational& coefficient : dot_of(n[0], n[1])) ASSERT_LT(coefficient, 0);
      ++opposed;
    }
    if (decide::certainly_not_c1<OneLane>(h)) {
      BicubicJoinRows same = rows;
      same.points = cartesian ? WeightedPoints::cartesian : WeightedPoints::homogeneous;
      ASSERT_FALSE(exact_answer(same).c1);
      ++middle_refuted;
    }
  }
  EXPECT_GT(middle_refuted, 50);
  EXPECT_GT(opposed, 30);
  std::cout << "worst error / bound: " << worst << "\n";
  EXPECT_GT(worst, 0x1p-10);
}

}  // namespace
}  // namespace patchproof::test
