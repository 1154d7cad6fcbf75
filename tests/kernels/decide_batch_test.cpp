// SPDX-License-Identifier: Apache-2.0
// Every instruction set of this machine against decide_join, which tests/join/decide_batch_test.cpp holds against the exact
// rung; on a part the exact rung is asked here too.
#include "patchproof/join/decide_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "kernels/join/decide_table.h"
#include "kernels/join/primes.h"
#include "support/g1_joins.h"
#include "support/g1_truth.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

using kernels::InstructionSet;

std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512, InstructionSet::avx512_ifma})
    if (kernels::is_available(set)) out.push_back(set);
  return out;
}

std::vector<JoinDecision> decisions(const std::vector<BicubicJoinRows>& rows, InstructionSet set,
                                    const std::vector<BicubicEdge>& edges = {}) {
  std::vector<JoinDecision> out(rows.size());
  kernels::decide_batch(rows, edges, out, set);
  return out;
}

bool same_answer(const JoinDecision& a, const JoinDecision& b) { return a.c0 == b.c0 && a.c1 == b.c1 && a.g1 == b.g1; }

// All sets answer as decide_join does. How many joins each rung of the vectors decided; empty without vectors.
std::map<DecidedBy, int> expect_all_alike(const std::vector<BicubicJoinRows>& rows) {
  std::map<DecidedBy, int> rungs;
  const std::vector<JoinDecision> reference = decisions(rows, InstructionSet::portable);
  for (const InstructionSet set : sets()) {
    const std::vector<JoinDecision> answers = decisions(rows, set);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_TRUE(same_answer(answers[i], reference[i])) << kernels::name_of(set) << ", join " << i;
      if (set == InstructionSet::portable) continue;
      if (set == InstructionSet::avx2) ++rungs[answers[i].rung];
      if (answers[i].rung == DecidedBy::modular && i % 8 == 0) {
        const ExactAnswer truth = exact_answer(rows[i]);
        EXPECT_EQ(answers[i].g1 == FixedG1::refuted, !truth.coplanar);
        EXPECT_TRUE(truth.smooth || answers[i].g1 != FixedG1::proven_smooth);
        EXPECT_EQ(answers[i].c1, truth.c1);
      }
    }
  }
  return rungs;
}
bool have_vectors() { return kernels::is_available(InstructionSet::avx2); }

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

// One axis scaled keeps every class and makes long numbers: 53 + bits. Differences are taken up to 103 bits, points that
// weights multiply up to 61, weights as well.
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

// ---- residues ------------------------------------------------------------------------------------------------------

TEST(DecideResidues, PrimesArePrime) {
  const auto check = [](const auto& below, int bits) {
    for (std::size_t i = 0; i < std::size(below); ++i) {
      const Integer p = (Integer(1) << bits) - Integer(below[i]);
      EXPECT_TRUE(mpz_probab_prime_p(p.backend().data(), 40) > 0);
      if (i > 0) {
        EXPECT_GT(below[i], below[i - 1]);
      }
    }
    EXPECT_LT(below[std::size(below) - 1], 1u << 10);  // products of all are above 2^(n bits − 1)
  };
  check(kernels::kBelow28, 28);
  check(kernels::kBelow47, 47);
}

// One coefficient of det, (a_y b_z − a_z b_y) c_x, is a product of the primes; the terms are far greater, so that the filter
// sees nothing. Whole numbers a, b below 2^53 are found by the extended Euclidean algorithm.
TEST(DecideResidues, ProductsOfPrimesAreNotZero) {
  WildNumbers random;
  const auto prime = [](int bits, int i) {
    return (Integer(1) << bits) - Integer(bits == 28 ? kernels::kBelow28[i] : kernels::kBelow47[i]);
  };
  std::vector<std::pair<Integer, Integer>> products{{1, 1}, {prime(47, 0), 1}, {prime(47, 0), prime(47, 1)}};
  for (int i = 0; i < 3; ++i)
    products.push_back({prime(28, i), 1}), products.push_back({prime(28, i), prime(28, i + 1)});
  products.push_back({prime(28, 0) * prime(28, 1), 1});
  products.push_back({prime(28, 0) * prime(28, 1), prime(28, 2)});
  products.push_back({prime(28, 2) * prime(28, 3), prime(28, 1)});
  int modular = 0, refuted = 0, all = 0;
  for (const auto& [minor, tangent] : products)
    for (int repeat = 0; repeat < 10; ++repeat) {
      // a_y b_z − a_z b_y = minor with random a.
      const Integer ay = (Integer(1) << 52) - Integer(1) - random.integer(50) / 2,
                    az = (Integer(1) << 51) + random.integer(50);
      Integer g, s, t;
      mpz_gcdext(g.backend().data(), s.backend().data(), t.backend().data(), ay.backend().data(), az.backend().data());
      if (g != 1) continue;
      // (b_z, b_y) = minor · (s, −t) + k · (az, ay), reduced.
      Integer bz = s * minor, by = -t * minor, k;
      mpz_fdiv_q(k.backend().data(), bz.backend().data(), az.backend().data());
      bz -= k * az, by -= k * ay;
      ASSERT_EQ(Integer(ay * bz - az * by), minor);
      BicubicJoinRows rows;
      const auto number = [](const Integer& z) { return mpz_get_d(z.backend().data()); };
      for (int i = 0; i < 4; ++i) rows.edge[i] = rows.behind_a[i] = rows.behind_b[i] = {number(tangent) * i, 0, 0};
      const int at = random.below(4);
      rows.behind_a[at][1] = number(ay), rows.behind_a[at][2] = number(az);
      rows.behind_b[at][1] = number(by), rows.behind_b[at][2] = number(bz);
      for (const InstructionSet set : sets()) {
        const JoinDecision d = decisions({rows}, set)[0];
        ++all;
        refuted += d.g1 == FixedG1::refuted;
        modular += d.rung == DecidedBy::modular;
      }
    }
  EXPECT_GT(all, 50);
  EXPECT_EQ(refuted, all);
  if (have_vectors()) {
    EXPECT_GT(modular, all / 2);
  }
}

// Differences of (p ± 1) / 2 modulo the first prime: remainders, and so all numbers, at the ends of their ranges.
TEST(DecideResidues, RemainderAtTheEndsOfTheirRange) {
  WildNumbers random;
  int zero = 0, nonzero = 0;
  for (const double p : {0x1p28 - kernels::kBelow28[0], 0x1p47 - kernels::kBelow47[0]})
    for (int i = 0; i < 400; ++i) {
      std::vector<BicubicJoinRows> joins(1);
      BicubicJoinRows& rows = joins[0];
      const bool weighted = i % 4 == 3;
      const auto half = [&] {
        const double turns = p < 0x1p30 ? random.below(1 << 20) : random.below(16);
        return (random.below(8) == 0 ? (p + 1) / 2 : (p - 1) / 2) + p * turns;
      };
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 3; ++k) {
          rows.edge[j][k] = weighted ? half() : j == 0 ? 0 : rows.edge[j - 1][k] + half();
          const double a = half();
          rows.behind_a[j][k] = rows.edge[j][k] + a;
          rows.behind_b[j][k] = rows.edge[j][k] + (i % 2 ? a : -a);
        }
      if (weighted) {
        rows.weights.emplace();
        for (auto& row : *rows.weights)
          for (int j = 0; j < 4; ++j) row[j] = j == 0 ? (p - 1) / 2 : (*rows.weights)[0][0] + p * j;
      }
      if (i % 8 >= 6) rows.behind_b[i % 4][0] += 1;
      ASSERT_NO_FATAL_FAILURE(expect_all_alike(joins));
      (decisions(joins, kernels::best_instruction_set())[0].g1 == FixedG1::refuted ? nonzero : zero)++;
    }
  EXPECT_GT(zero, 300);
  EXPECT_GT(nonzero, 100);
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
