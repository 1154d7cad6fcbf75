// SPDX-License-Identifier: Apache-2.0
// Every instruction set of this machine against decide_join, which tests/join/decide_batch_test.cpp holds against the
// exact rung; on a part the exact rung is asked here too.
#include "patchproof/join/decide_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "kernels/decide_support.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

TEST(DecideBatch, Law2_FamiliesAreProven) {
  for (const G1Family& family : {kD24, kD53, kC1, kR53, kR106}) {
    const auto rows = make_g1_joins(family, 64);
    auto rungs = expect_all_alike(rows);
    if (have_vectors()) {
      EXPECT_EQ(rungs[DecidedBy::modular], 64);
    }
    for (const InstructionSet set : sets())
      for (const JoinDecision& d : decisions(rows, set)) {
        EXPECT_EQ(d.g1, FixedG1::proven_smooth);
        EXPECT_TRUE(d.c1 || !(family.reflected || family.weight_bits > 0));
      }
  }
}

TEST(DecideBatch, Law2_SpoiledFamiliesAreRefuted) {
  for (const double step : {0.0, 0x1p-35, 1e-6})
    for (const G1Family& family : {kD24, kD53, kR53, kR106}) {
      auto rows = make_g1_joins(family, 64);
      for (auto& r : rows) spoil(r, step);
      auto rungs = expect_all_alike(rows);
      for (const InstructionSet set : sets())
        for (const JoinDecision& d : decisions(rows, set)) EXPECT_EQ(d.g1, FixedG1::refuted);
      if (have_vectors() && step == 1e-6) {
        EXPECT_EQ(rungs[DecidedBy::filter], 64);
      }
    }
}

// One bit of one number of a D53 or R53 join, the least that keeps whole numbers of 53 bits: only residues see it.
TEST(DecideBatch, Law2_TheLeastBitIsSeen) {
  int modular = 0, refuted = 0;
  for (const G1Family& family : {G1Family{42}, G1Family{43, true, 26}}) {
    auto rows = make_g1_joins(family, 128);
    for (std::size_t i = 0; i < rows.size(); ++i)
      (i % 2 ? rows[i].behind_a : rows[i].behind_b)[i % 4][i / 4 % 3] +=
          std::ldexp(1.0, family.weight_bits == 0 ? -46 : -47);
    modular += expect_all_alike(rows)[DecidedBy::modular];
    for (const JoinDecision& d : decisions(rows, kernels::best_instruction_set())) refuted += d.g1 == FixedG1::refuted;
  }
  EXPECT_GT(refuted, 240);
  if (have_vectors()) {
    EXPECT_GT(modular, 200);
  }
}

// One axis scaled keeps every class and makes long numbers: 53 + bits. Differences are taken up to 103 bits, points
// that weights multiply up to 61, weights as well.
TEST(DecideBatch, Law2_LongNumbers) {
  for (const G1Family& family : {kD53, kC1, kR53, kR106})
    for (const int bits : {1, 7, 20, 44}) {
      auto rows = make_g1_joins(family, 64);
      const bool weighted = family.weight_bits > 0;
      for (auto& r : rows) flatten(r, bits);
      if (weighted && bits > 7)
        for (auto& r : rows) {  // homogeneous: A + B = 2 E
          r.points = WeightedPoints::homogeneous;
          for (auto& row : *r.weights) row = (*r.weights)[0];
        }
      auto rungs = expect_all_alike(rows);
      if (have_vectors()) {  // weighted normals cancel more: doubles do not always show their sides
        EXPECT_EQ(rungs[DecidedBy::modular] + rungs[DecidedBy::fixed], 64);
        EXPECT_GE(rungs[DecidedBy::modular], weighted && bits > 7 ? 32 : 64);
      }
      for (const InstructionSet set : sets())
        for (const JoinDecision& d : decisions(rows, set)) {
          EXPECT_NE(d.g1, FixedG1::refuted);
          EXPECT_TRUE(d.c1 || !family.reflected);
        }
      for (auto& r : rows) spoil(r);
      auto spoiled = expect_all_alike(rows);
      for (const InstructionSet set : sets())
        for (const JoinDecision& d : decisions(rows, set)) EXPECT_EQ(d.g1, FixedG1::refuted);
      if (have_vectors() && !weighted) {
        EXPECT_GE(spoiled[DecidedBy::modular], bits > 40 ? 56 : 64);  // a tiny z makes tiny units in the last place
      }
    }
}

// Twice the weights behind one side: the same planes, twice the derivative.
TEST(DecideBatch, Law1_C1SeesWeights) {
  for (const G1Family& family : {kR53, kR106}) {
    auto rows = make_g1_joins(family, 24);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (double& w : (*rows[i].weights)[1 + i % 2]) w *= 2;
    expect_all_alike(rows);
    for (const InstructionSet set : sets())
      for (const JoinDecision& d : decisions(rows, set)) {
        EXPECT_EQ(d.g1, FixedG1::proven_smooth);
        EXPECT_FALSE(d.c1);
      }
  }
}

// Bits that differences of doubles lose: a coordinate of 2^-20 beside coordinates of 2^40, or all of them far apart
// from the differences.
TEST(DecideBatch, Law2_RoundedDifferences) {
  WildNumbers random;
  std::vector<BicubicJoinRows> planar, apart, bent[4];
  for (int i = 0; i < 24; ++i) {
    BicubicJoinRows rows;
    const auto far = [&] { return std::ldexp(4 + random.below(4), 40); };
    for (int j = 0; j < 4; ++j) {
      const double x = far(), y = std::ldexp(j, 42);
      rows.edge[j] = {x, y, x};
      rows.behind_a[j] = {x - std::ldexp(1, 43), y, x - std::ldexp(1, 43)};
      rows.behind_b[j] = {x + std::ldexp(1, 43), y, x + std::ldexp(1, 43)};
    }
    // z = x but for one point, whose x all its differences lose; then only those of one row do.
    const int at = i % 4;
    bent[0].push_back(rows);
    bent[0].back().edge[at] = {0x1p-20, rows.edge[at][1], 0};
    bent[1].push_back(bent[0].back());
    bent[1].back().behind_a[at] = {0x1p-20 - 0x1p31, rows.edge[at][1] + 0x1p31, -0x1p31};
    bent[1].back().behind_b[at] = {0x1p-20 + 0x1p31, rows.edge[at][1], 0x1p31};
    bent[2].push_back(rows);
    bent[2].back().behind_a[at] = {0x1p-20, rows.edge[at][1], 0};
    bent[3].push_back(rows);
    bent[3].back().behind_b[at] = {0x1p-20, rows.edge[at][1], 0};
    planar.push_back(rows);  // C1 by rounded differences only
    planar.back().edge[i % 4] = {0x1p-20, rows.edge[i % 4][1], 0x1p-20};
    for (auto* side : {&planar.back().behind_a, &planar.back().behind_b})
      (*side)[i % 4] = {side == &planar.back().behind_a ? -0x1p43 : 0x1p43, rows.edge[i % 4][1],
                        side == &planar.back().behind_a ? -0x1p43 : 0x1p43};
    apart.push_back(rows);  // in a plane z = 2^-90: too long for decide_fixed_g1
    for (auto* row : {&apart.back().edge, &apart.back().behind_a, &apart.back().behind_b})
      for (auto& point : *row) point[2] = 0x1p-90;
  }
  for (const auto& joins : bent) {
    auto rungs = expect_all_alike(joins);
    for (const BicubicJoinRows& rows : joins) EXPECT_FALSE(exact_answer(rows).coplanar);
    for (const InstructionSet set : sets())
      for (const JoinDecision& d : decisions(joins, set)) EXPECT_EQ(d.g1, FixedG1::refuted);
    if (have_vectors()) {
      EXPECT_EQ(rungs[DecidedBy::modular], 24);
    }
  }
  expect_all_alike(planar);
  for (const InstructionSet set : sets()) {
    for (const JoinDecision& d : decisions(planar, set)) {
      EXPECT_EQ(d.g1, FixedG1::proven_smooth);
      EXPECT_FALSE(d.c1);
    }
    for (const JoinDecision& d : decisions(apart, set)) EXPECT_EQ(d.g1, std::nullopt);
  }
}

// Rows of every kind: G1 and not, weighted and not, degenerate, wild sizes, weights of zero, numbers too long.
BicubicJoinRows any_join(WildNumbers& random, std::mt19937_64& engine) {
  const G1Family families[] = {kD24, kD53, kC1, kR53, kR106, {4}, {4, true, 5}};
  BicubicJoinRows rows = make_g1_join(engine, families[random.below(7)]);
  if (random.below(3) == 0) flatten(rows, random.below(80));
  const auto each = [&](auto f) {
    for (auto* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
      for (auto& point : *row)
        for (double& x : point) f(x);
  };
  const auto scale = [&](int e) { each([&](double& x) { x = std::ldexp(x, e); }); };
  switch (random.below(24)) {
    case 0: spoil(rows); break;
    case 1: spoil(rows, 0x1p-30); break;
    case 2: spoil(rows, 1e-6); break;
    case 3: scale(500); break;
    case 4: scale(-500); break;
    case 5: scale(-1030); break;  // subnormal, rounded
    case 6: scale(1010); break;
    case 7: rows.behind_a = rows.edge; break;
    case 8: rows.behind_b = rows.edge; break;
    case 9: rows.behind_b = rows.behind_a; break;  // a cusp
    case 10: rows.edge[1] = rows.edge[2] = rows.edge[3] = rows.edge[0]; break;
    case 11: each([](double& x) { x = 0; }); break;
    case 12: each([&](double& x) { x = random.finite(); }); break;
    case 13: each([&](double& x) { x = random.moderate(40); }); break;
    case 14: rows.points = WeightedPoints::homogeneous; break;
    case 15:
      if (rows.weights) (*rows.weights)[random.below(3)][random.below(4)] = random.below(3) - 1;
      break;
    case 16: rows.weights = {{{2, 2, 2, 2}, {2, 2, 2, 2}, {2, 2, 2, 2}}}; break;
    case 17: rows.edge[0][0] = kTiniest; break;
    case 18: each([](double& x) { x += 0x1p40; }); break;  // far away: bits are lost, or the join stays
    case 19: each([&](double& x) { x = random.below(3) - 1; }); break;
    case 20:
      each([&](double& x) { x = random.below(2) ? 0x1p53 - 1 : 1 - 0x1p53; });
      if (random.below(2)) rows.behind_b = rows.behind_a;
      break;
    default: break;
  }
  return rows;
}

TEST(DecideBatch, Law2_MixedAndAdversarial) {
  WildNumbers random;
  std::mt19937_64 engine(3);
  std::vector<BicubicJoinRows> rows;
  for (int i = 0; i < 6000; ++i) rows.push_back(any_join(random, engine));
  auto rungs = expect_all_alike(rows);
  for (const DecidedBy rung : {DecidedBy::filter, DecidedBy::modular, DecidedBy::fixed, DecidedBy::nothing})
    EXPECT_GT(rungs[rung], have_vectors() ? 100 : -1) << name_of(rung);
}

// Order and company change nothing, the rung included; nor does the thread's rounding mode.
TEST(DecideBatch, Law4_AloneAndTogether) {
  WildNumbers random;
  std::mt19937_64 engine(4);
  std::vector<BicubicJoinRows> rows;
  for (int i = 0; i < 100; ++i) rows.push_back(any_join(random, engine));
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), engine);
  for (const InstructionSet set : sets()) {
    const std::vector<JoinDecision> together = decisions(rows, set);
    std::vector<BicubicJoinRows> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rows[i]);
    const std::vector<JoinDecision> other = decisions(shuffled, set);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(other[i], together[order[i]]) << kernels::name_of(set);
      ASSERT_EQ(decisions({rows[i]}, set)[0], together[i]) << kernels::name_of(set) << i;
    }
    for (std::size_t count = 0; count <= 17; ++count) {
      const std::vector<JoinDecision> some = decisions({rows.begin(), rows.begin() + static_cast<long>(count)}, set);
      ASSERT_TRUE(std::equal(some.begin(), some.end(), together.begin()));
    }
    const RoundingGuard upward;
    ASSERT_EQ(decisions(rows, set), together) << kernels::name_of(set);
  }
}

TEST(DecideBatch, Law1_SecondEdges) {
  WildNumbers random;
  auto rows = make_g1_joins(kD53, 20);
  for (const auto& r : make_g1_joins(kR53, 20)) rows.push_back(r);
  std::vector<BicubicEdge> edges;
  for (const BicubicJoinRows& r : rows) {
    edges.push_back({r.edge, r.weights ? (*r.weights)[0] : std::array<double, 4>{1, 1, 1, 1}});
    if (random.below(3) == 0) edges.back().points[1][1] += 1;
    if (random.below(3) == 0)
      for (double& w : edges.back().weights) w *= 2;
  }
  for (const InstructionSet set : sets()) {
    const auto answers = decisions(rows, set, edges);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_TRUE(same_answer(answers[i], decide_join(rows[i], &edges[i])));
      ASSERT_EQ(answers[i].c0, exact_answer(rows[i], &edges[i]).c0);
    }
  }
}

TEST(DecideBatch, Contracts) {
  const auto good = make_g1_joins(kR53, 11);
  for (const InstructionSet set : sets())
    for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()})
      for (int where = 0; where < 48; ++where) {
        auto rows = good;
        BicubicJoinRows& r = rows[static_cast<std::size_t>(where % 11)];
        auto& row = where < 12 ? r.edge : where < 24 ? r.behind_a : r.behind_b;
        (where < 36 ? row[where % 12 / 3][where % 3] : (*r.weights)[(where - 36) / 4][where % 4]) = bad;
        EXPECT_THROW(decisions(rows, set), contract_error) << kernels::name_of(set) << where;
        if (where >= 36) continue;
        for (auto& other : rows) other.weights.reset();
        EXPECT_THROW(decisions(rows, set), contract_error) << kernels::name_of(set) << where;
      }
  auto rows = make_g1_joins(kD24, 2);
  rows[1].weights.emplace();
  for (auto& row : *rows[1].weights) row.fill(kInfinity);
  for (const InstructionSet set : sets()) EXPECT_THROW(decisions(rows, set), contract_error);
  std::vector<JoinDecision> out(1);
  EXPECT_THROW(kernels::decide_batch(rows, {}, out), contract_error);
  out.resize(2);
  EXPECT_THROW(kernels::decide_batch(rows, std::vector<BicubicEdge>(1), out), contract_error);
}

}  // namespace
}  // namespace patchproof::test
