// SPDX-License-Identifier: Apache-2.0
// The zero test modulo primes: residues at the ends of their ranges, and enough primes for the proof.
#include <gtest/gtest.h>

#include "join/decide_one.h"
#include "kernels/decide_support.h"
#include "kernels/join/primes.h"
#include "kernels/join/residues28.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

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

// A product of primes as the determinant of constant a, b, c: det = (a_y b_z − a_z b_y) c_x. The terms are so much
// greater that the filter sees nothing, and one prime less than the bound asks for would see nothing either. Whole a, b
// just below 2^53 are found by the extended Euclidean algorithm.
TEST(DecideResidues, ProductsOfPrimesAreNotZero) {
  WildNumbers random;
  const auto prime = [](int bits, int i) {
    return (Integer(1) << bits) - Integer(bits == 28 ? kernels::kBelow28[i] : kernels::kBelow47[i]);
  };
  const auto size = [&] { return (Integer(1) << 53) - Integer(1) - abs(random.integer(49)); };
  const Integer p28[] = {prime(28, 0), prime(28, 1), prime(28, 2)};
  const std::pair<Integer, Integer> products[] = {{1, 1},
                                                  {p28[0], 1},
                                                  {p28[0] * p28[1], 1},
                                                  {p28[0], p28[1]},
                                                  {p28[0] * p28[1], p28[2]},
                                                  {p28[1] * p28[2], p28[0]},
                                                  {prime(47, 0), 1},
                                                  {prime(47, 0), prime(47, 1)},
                                                  {prime(47, 1), prime(47, 0)}};
  std::map<DecidedBy, int> rungs, rungs_weighted;
  for (const auto& [minor, tangent] : products)
    for (int found = 0; found < 6;) {
      const Integer ay = size(), az = size();
      Integer g, s, t, k;
      mpz_gcdext(g.backend().data(), s.backend().data(), t.backend().data(), ay.backend().data(), az.backend().data());
      if (g != 1) continue;
      // (b_z, b_y) = minor · (s, −t) + k · (a_z, a_y), reduced.
      Integer bz = s * minor, by = -t * minor;
      mpz_fdiv_q(k.backend().data(), bz.backend().data(), az.backend().data());
      bz -= k * az, by -= k * ay;
      if (bz < az / 4 * 3) continue;
      ++found;
      ASSERT_EQ(Integer(ay * bz - az * by), minor);
      const auto number = [](const Integer& z) { return mpz_get_d(z.backend().data()); };
      const std::array<double, 3> a{0, number(ay), number(az)}, b{0, number(by), number(bz)};
      for (const int end :
           {-1, 0, 3})  // everywhere, or so that one coefficient of det is not zero: the first or the last
        for (const bool weighted : {false, true}) {
          BicubicJoinRows rows;
          for (int i = 0; i < 4; ++i) {
            rows.edge[i][0] = end < 0 ? number(tangent) * i : i == end ? number(tangent) : 0;
            for (int k = 0; k < 3; ++k) {
              const bool here = end < 0 || i == end;
              rows.behind_a[i][k] = rows.edge[i][k] + (here ? a[k] : k == 0);
              rows.behind_b[i][k] = rows.edge[i][k] + (here ? b[k] : k == 0);
            }
          }
          if (weighted) rows.weights = {{{1, 1, 1, 1}, {2, 2, 2, 2}, {1, 1, 1, 1}}};
          for (const int longer : {0, 20}) {
            flatten(rows, longer);
            for (const InstructionSet set : sets()) {
              const JoinDecision d = decisions({rows}, set)[0];
              EXPECT_EQ(d.g1, FixedG1::refuted)
                  << kernels::name_of(set) << " " << minor << " " << tangent << " " << end;
              if (set != InstructionSet::portable) ++(weighted ? rungs_weighted : rungs)[d.rung];
            }
          }
        }
    }
  if (have_vectors()) {
    EXPECT_EQ(rungs.size(), 1u);
    EXPECT_GT(rungs[DecidedBy::modular], 0);
    EXPECT_GT(rungs_weighted[DecidedBy::modular], 100);
  }
}

// One lane with the operations residues need: their ranges are those of decide_lanes.h.
struct PlainLane : decide::OneLane {
  using I = std::uint64_t;
  static I no_bits() { return 0; }
  static I constant_bits(unsigned long long x) { return x; }
  static I bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
  static I multiply_low(I x, I y) { return (x & 0xffffffff) * (y & 0xffffffff); }
  static I add_bits(I x, I y) { return x + y; }
  static I subtract_bits(I x, I y) { return x - y; }
  static I high_half(I x) { return x >> 32; }
  static unsigned low_half_above(I x, unsigned limit) { return (x & 0xffffffff) > limit; }
};

TEST(DecideResidues, EveryStepKeepsTheResidueAndItsRange) {
  WildNumbers random;
  for (int q = 0; q < 16; ++q) {
    const std::uint64_t p = (1u << 28) - kernels::kBelow28[q];
    for (const int split : {0, 8, 50}) {
      const Residues28<PlainLane> m(q, split);
      const auto residue = [&](std::uint64_t x) { return x % p; };
      const auto of = [&](const Integer& z) {  // z modulo p
        Integer r;
        mpz_fdiv_r_ui(r.backend().data(), z.backend().data(), p);
        return static_cast<std::uint64_t>(mpz_get_ui(r.backend().data()));
      };
      const Integer big_r = (Integer(1) << 32);
      for (int i = 0; i < 200; ++i) {
        // Whole numbers up to 2^53, beside multiples of p / 2 above all.
        Integer z =
            i % 2 ? random.integer(53) : Integer(2 * random.below(1 << 20) + 1) * Integer(p) / 2 + random.below(3) - 1;
        if (i % 3 == 0) z = -z;
        const double r = m.remainder(mpz_get_d(z.backend().data()));
        EXPECT_LE(std::fabs(r), 0.51 * static_cast<double>(p));
        for (const double factor : {1.0, -1.0, 2.0, 3.0, -3.0}) {
          const std::uint64_t n = m.number(r, factor) & 0xffffffff;
          EXPECT_EQ(residue(n), of(z * Integer(static_cast<int>(factor))));
          EXPECT_LT(n, (std::fabs(factor) * 51 + 200) * static_cast<double>(p) / 100 + 1);
        }
        const Integer low = random.integer(split);
        const std::uint64_t both = m.joined(r, m.remainder(mpz_get_d(low.backend().data())), 3);
        EXPECT_EQ(of(Integer(both) * big_r), of(Integer(3) * (z * (Integer(1) << split) + low)));
        EXPECT_LT(both, 1.3 * static_cast<double>(p));
        // The greatest sum allowed, and one near it.
        const std::uint64_t sum =
            240 * p * p - (random.below(1000) == 0 ? 0 : static_cast<unsigned>(random.below(1 << 30)));
        const std::uint64_t closed = m.close(sum);
        EXPECT_EQ(of(Integer(closed) * big_r), of(Integer(sum)));
        EXPECT_LT(closed, 16 * p);
      }
      for (std::uint64_t k = 0; k < 16; ++k) {
        EXPECT_EQ(m.nonzero(k * p), 0u);
        for (const std::uint64_t off : {std::uint64_t{1}, p / 2, p - 1}) EXPECT_EQ(m.nonzero(k * p + off), 1u);
      }
      for (int i = 0; i < 100; ++i) {
        const std::uint64_t x = static_cast<std::uint64_t>(random.below(1 << 30)) * 3;
        EXPECT_EQ(m.nonzero(x), x % p != 0);
      }
    }
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

}  // namespace
}  // namespace patchproof::test
