// SPDX-License-Identifier: Apache-2.0
// The judge is the exact rung: forms over Integer, which share no code with fixed widths.
#include "patchproof/join/fixed_g1.h"

#include <gtest/gtest.h>

#include "patchproof/join/continuity.h"
#include "patchproof/join/filter.h"
#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

using Row = BicubicJoinRows::Row;

// The same join as a piece: X = E, X_s = 3 (A − E), Y_s = 3 (B − E), in exact numbers.
JoinPiece<Rational> piece_of(const BicubicJoinRows& rows) {
  const auto points = [&](const Row& row, int which) {
    std::vector<Vec<Rational, 4>> out;
    for (int i = 0; i < 4; ++i) {
      const Rational w = rows.weights ? from_double((*rows.weights)[which][i]) : Rational(1);
      const Rational factor = rows.points == WeightedPoints::cartesian ? w : Rational(1);
      out.push_back(
          {{from_double(row[i][0]) * factor, from_double(row[i][1]) * factor, from_double(row[i][2]) * factor, w}});
    }
    return out;
  };
  const auto edge = points(rows.edge, 0);
  JoinPiece<Rational> piece{0, 1, 0, 1, {}, {}};
  for (auto [side, behind] :
       {std::pair{&piece.a, points(rows.behind_a, 1)}, std::pair{&piece.b, points(rows.behind_b, 2)}}) {
    (*side)[0] = edge;
    (*side)[2].resize(4);
    for (int i = 0; i < 4; ++i) (*side)[1].push_back(Rational(3) * (behind[i] - edge[i]));
  }
  return piece;
}

struct Truth {
  bool coplanar = false;  // det ≡ 0
  bool smooth = false;    // coplanar, both normals free of zeros, opposed
};
Truth truth(const JoinPiece<Rational>& piece) {
  const RoundingGuard guard;
  const JoinForms<Integer> forms = join_forms<Integer>(piece);
  Truth t;
  t.coplanar = vanishes(coplanarity(forms.a, forms.b));
  if (!t.coplanar) return t;
  const ReducedNormal<Integer> a = reduce_normal(forms.a), b = reduce_normal(forms.b);
  const auto regular = [](const ReducedNormal<Integer>& n) {
    return n.found() && n.order == NormalOrder::first && n.ends.at_zero == 0 && n.ends.at_one == 0 && !n.has_factor();
  };
  t.smooth = regular(a) && regular(b) && *scalar_traits<Integer>::sign(dot(a.n, b.n)[0]) == Sign::negative;
  return t;
}

struct Tally {
  int proven = 0, refuted = 0, open = 0, empty = 0;
  int all() const { return proven + refuted + open + empty; }
};

// Laws 1 to 3 on one join.
void check(const BicubicJoinRows& rows, Tally& tally) {
  const std::optional<FixedG1> answer = decide_fixed_g1(rows);
  if (!answer) {
    ++tally.empty;
    return;
  }
  const Truth t = truth(piece_of(rows));
  ASSERT_EQ(*answer == FixedG1::refuted, !t.coplanar);
  if (*answer == FixedG1::proven_smooth) {
    ASSERT_TRUE(t.smooth);
  }
  ++(*answer == FixedG1::refuted ? tally.refuted : *answer == FixedG1::proven_smooth ? tally.proven : tally.open);
}

// G1, not C1, by construction: B − E = −λ (A − E) + β E_t + γ E with small whole numbers λ, β (linear), γ.
struct Maker {
  WildNumbers random;
  int bits = 20;  // of the coordinates drawn
  int ratio = 2;  // λ; negative: the patches fold back
  bool weighted = false;

  double whole() { return static_cast<double>(static_cast<std::int64_t>(random.integer(bits))); }

  BicubicJoinRows join() {
    using Point = std::array<double, 4>;
    std::array<Point, 4> e, a, b;
    const double size = std::ldexp(1.0, bits);
    for (int i = 0; i < 4; ++i) {
      e[i] = {whole() / 4, size * i + whole() / 4, whole() / 4, size};
      a[i] = {size + whole() / 4, size * i + whole() / 4, whole() / 4, size};
      for (auto* p : {&e[i], &a[i]}) {
        for (int k = 0; k < 3; ++k) (*p)[k] = std::floor((*p)[k]);
        if (weighted) (*p)[3] += std::floor(whole() / 4);
      }
    }
    const double beta0 = 3 * (random.below(5) - 2), beta1 = 3 * (random.below(5) - 2),
                 gamma = weighted ? random.below(3) : 0;
    for (int k = 0; k < 4; ++k) {
      const double c0 = e[1][k] - e[0][k], c1 = e[2][k] - e[1][k], c2 = e[3][k] - e[2][k];
      const std::array<double, 4> tangent{beta0 * c0, (2 * beta0 * c1 + beta1 * c0) / 3,
                                          (beta0 * c2 + 2 * beta1 * c1) / 3, beta1 * c2};
      for (int i = 0; i < 4; ++i) b[i][k] = e[i][k] - ratio * (a[i][k] - e[i][k]) + tangent[i] + gamma * e[i][k];
    }
    BicubicJoinRows rows;
    rows.points = WeightedPoints::homogeneous;
    if (weighted) rows.weights.emplace();
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) {
        rows.edge[i][k] = e[i][k];
        rows.behind_a[i][k] = a[i][k];
        rows.behind_b[i][k] = b[i][k];
      }
      if (weighted) (*rows.weights)[0][i] = e[i][3], (*rows.weights)[1][i] = a[i][3], (*rows.weights)[2][i] = b[i][3];
    }
    return rows;
  }
};

template <class F>
void for_each_number(BicubicJoinRows& rows, const F& f) {
  for (Row* row : {&rows.edge, &rows.behind_a, &rows.behind_b})
    for (auto& point : *row)
      for (double& x : point) f(x);
}

TEST(FixedG1, Law2_SmoothJoinsAreProven) {
  for (const bool weighted : {false, true})
    for (const int bits : {3, 20, 45}) {
      Maker make{WildNumbers(), bits, 2, weighted};
      Tally tally;
      for (int i = 0; i < 150; ++i) ASSERT_NO_FATAL_FAILURE(check(make.join(), tally));
      EXPECT_EQ(tally.proven + tally.open, 150) << bits;
      EXPECT_GT(tally.proven, 120) << bits << (weighted ? " weighted" : "");
    }
}

TEST(FixedG1, Law1_OneUlpIsRefuted) {
  for (const bool weighted : {false, true}) {
    Maker make{WildNumbers(), 40, 3, weighted};
    Tally tally;
    for (int i = 0; i < 150; ++i) {
      BicubicJoinRows rows = make.join();
      double& z = (i % 2 ? rows.behind_a : rows.behind_b)[i % 4][2];
      z = std::nextafter(z, i % 3 ? kInfinity : -kInfinity);
      ASSERT_NO_FATAL_FAILURE(check(rows, tally));
    }
    EXPECT_GT(tally.refuted, 145) << weighted;  // a change within the tangent plane would be none
  }
}

TEST(FixedG1, Law1_OtherWeightsAreRefuted) {
  Maker make{WildNumbers(), 30, 1, true};
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    BicubicJoinRows rows = make.join();
    (*rows.weights)[1 + i % 2][i % 4] += 1;
    ASSERT_NO_FATAL_FAILURE(check(rows, tally));
  }
  EXPECT_GT(tally.refuted, 95);
}

TEST(FixedG1, Law3_CuspsAndZerosAreLeftOpen) {
  for (const bool weighted : {false, true}) {
    Maker cusp{WildNumbers(), 20, -2, weighted};
    Tally tally;
    for (int i = 0; i < 60; ++i) ASSERT_NO_FATAL_FAILURE(check(cusp.join(), tally));
    EXPECT_EQ(tally.open, 60);

    Maker make{WildNumbers(), 20, 2, false};
    for (int kind = 0; kind < 5; ++kind) {
      BicubicJoinRows rows = make.join();
      if (weighted) rows.weights = {{{1, 2, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 4}}};
      if (kind == 0) rows.edge[1] = rows.edge[2] = rows.edge[3] = rows.edge[0];  // no tangent
      if (kind == 0 && weighted) rows.points = WeightedPoints::cartesian;
      if (kind == 1) rows.behind_a = rows.edge;  // no cross derivative
      if (kind == 2) rows.behind_b = rows.edge;
      if (kind == 3) rows.behind_a = rows.behind_b = rows.edge;
      if (kind == 4) for_each_number(rows, [](double& x) { x = 0; });
      Tally degenerate;
      ASSERT_NO_FATAL_FAILURE(check(rows, degenerate));
      EXPECT_EQ(degenerate.open, 1) << kind;
    }
  }
}

// Normals that no half-space holds firmly: the direction at the middle fails, n_A · n_B decides.
TEST(FixedG1, Law2_StrongBends) {
  BicubicJoinRows rows;
  rows.edge = {{{0, 0, 0}, {20, 0, 0}, {22, 20, 0}, {-2, 25, 0}}};
  for (int i = 0; i < 4; ++i) {
    rows.behind_a[i] = rows.behind_b[i] = rows.edge[i];
    rows.behind_a[i][2] = 1;
    rows.behind_b[i][2] = -1;
  }
  for (const bool weighted : {false, true}) {
    // Weights all 1 except behind B, where (x, w) is halved: the same plane, in homogeneous numbers.
    if (weighted) {
      rows.weights = {{{1, 1, 1, 1}, {1, 1, 1, 1}, {0.5, 0.5, 0.5, 0.5}}};
      rows.points = WeightedPoints::cartesian;
    }
    Tally tally;
    ASSERT_NO_FATAL_FAILURE(check(rows, tally));
    EXPECT_EQ(tally.proven, 1) << weighted;
  }
}

// Sharing weights column by column, reflected points: C1, with products of up to 106 bits.
TEST(FixedG1, Law2_CartesianPointsWithFullWeights) {
  WildNumbers random;
  Tally right, wrong;
  for (int i = 0; i < 100; ++i) {
    BicubicJoinRows rows;
    rows.weights.emplace();
    for (int j = 0; j < 4; ++j) {
      const double w = 1 + std::abs(random.moderate(0)) / 16;
      for (auto& row : *rows.weights) row[j] = w;
      for (int k = 0; k < 3; ++k) {
        const double base = k == 1 ? 16 * j : 0, e = std::floor(std::ldexp(random.moderate(0), 44)),
                     d = std::floor(std::ldexp(random.moderate(0), 44));
        rows.edge[j][k] = base + std::ldexp(e, -44);
        rows.behind_a[j][k] = rows.edge[j][k] + std::ldexp(d, -44) + (k == 0 ? 8 : 0);
        rows.behind_b[j][k] = rows.edge[j][k] - std::ldexp(d, -44) - (k == 0 ? 8 : 0);
      }
    }
    ASSERT_NO_FATAL_FAILURE(check(rows, right));
    rows.behind_b[i % 4][2] = std::nextafter(rows.behind_b[i % 4][2], kInfinity);
    ASSERT_NO_FATAL_FAILURE(check(rows, wrong));
  }
  EXPECT_EQ(right.proven + right.open, 100);
  EXPECT_GT(right.proven, 80);
  EXPECT_EQ(wrong.refuted, 100);
}

// The largest numbers a width accepts, with signs that make terms add up; one entry 1 keeps the unit.
TEST(FixedG1, Law3_LargestNumbersOfEachWidth) {
  WildNumbers random;
  for (const bool weighted : {false, true})
    for (const int bits : {53, 59, 60, 62, 63, 64, 123}) {
      Tally tally;
      const double large = std::ldexp(0x1p53 - 1, bits - 53);
      const auto either = [&] { return random.below(2) ? large : -large; };
      for (int i = 0; i < 150; ++i) {
        const bool coplanar = i % 3 == 0;  // a reflection: B = 2 E − A, with E half as large
        const auto draw = [&](double& e, double& a, double& b, bool positive) {
          const double size = positive ? large : either();
          e = coplanar ? size / 2 : size;
          a = coplanar ? e + either() / 2 : either();
          b = coplanar ? 2 * e - a : either();
        };
        BicubicJoinRows rows;
        rows.points = WeightedPoints::homogeneous;
        if (weighted) rows.weights.emplace();
        for (int j = 0; j < 4; ++j) {
          for (int k = 0; k < 3; ++k) draw(rows.edge[j][k], rows.behind_a[j][k], rows.behind_b[j][k], false);
          if (weighted) draw((*rows.weights)[0][j], (*rows.weights)[1][j], (*rows.weights)[2][j], true);
        }
        if (weighted)
          for (auto& row : *rows.weights) row[3] = 1;
        for (Row* row : {&rows.edge, &rows.behind_a, &rows.behind_b}) (*row)[i % 4][1] = 1;
        ASSERT_NO_FATAL_FAILURE(check(rows, tally));
      }
      EXPECT_EQ(tally.empty, 0);
      EXPECT_GT(tally.refuted, 90) << bits;
      EXPECT_GE(tally.open + tally.proven, 50) << bits;
    }
}

// All points in a plane but one, and so arranged that a single coefficient of det is not zero: its first or its last.
TEST(FixedG1, Law1_EveryEndOfTheEdgeCounts) {
  for (const int end : {0, 3})
    for (const bool weighted : {false, true}) {
      BicubicJoinRows rows;
      for (int i = 0; i < 4; ++i) rows.behind_a[i] = {-1, 0, 0};
      rows.edge[end] = {0, 1, 0};
      rows.behind_b = rows.edge;
      rows.behind_b[end][0] = 1;
      rows.behind_a[end][2] = 1;
      if (weighted) rows.weights = {{{1, 1, 1, 1}, {1, 1, 1, 1}, {2, 2, 2, 2}}};
      Tally tally;
      ASSERT_NO_FATAL_FAILURE(check(rows, tally));
      EXPECT_EQ(tally.refuted, 1) << end << weighted;
      rows.behind_a[end][2] = 0;
      ASSERT_NO_FATAL_FAILURE(check(rows, tally));
      EXPECT_EQ(tally.refuted, 1) << end << weighted;
    }
}

TEST(FixedG1, Law4_EmptyWhenTooLong) {
  Maker make{WildNumbers(), 20, 2, true};
  BicubicJoinRows rows = make.join();
  for (const double w : {0.0, -1.0}) {
    BicubicJoinRows bad = rows;
    (*bad.weights)[0][2] = w;
    EXPECT_EQ(decide_fixed_g1(bad), std::nullopt);
  }
  rows.weights.reset();
  rows.edge[0][0] = 1;
  rows.edge[3][1] = -std::ldexp(0x1p53 - 1, 123 - 53);
  EXPECT_TRUE(decide_fixed_g1(rows));
  rows.edge[3][1] *= 2;
  EXPECT_EQ(decide_fixed_g1(rows), std::nullopt);
  rows.edge[3][1] = kLargest;
  rows.edge[3][2] = kTiniest;
  EXPECT_EQ(decide_fixed_g1(rows), std::nullopt);
}

TEST(FixedG1, Law5_PowersOfTwoChangeNothing) {
  for (const bool weighted : {false, true}) {
    Maker make{WildNumbers(), 20, 2, weighted};
    for (int i = 0; i < 40; ++i) {
      BicubicJoinRows rows = make.join();
      if (i % 2) rows.behind_a[1][2] += 1;
      const std::optional<FixedG1> answer = decide_fixed_g1(rows);
      ASSERT_TRUE(answer);
      for (const int k : {-1074, -1060, -300, 1, 60, 990}) {  // −1074: all numbers are subnormal
        BicubicJoinRows scaled = rows;
        for_each_number(scaled, [&](double& x) { x = std::ldexp(x, k); });
        ASSERT_EQ(decide_fixed_g1(scaled), answer) << k;
      }
    }
  }
}

TEST(FixedG1, ContractNumbersAreFinite) {
  Maker make{WildNumbers(), 20, 2, true};
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    BicubicJoinRows rows = make.join();
    rows.behind_b[3][2] = bad;
    EXPECT_THROW(decide_fixed_g1(rows), contract_error);
    rows = make.join();
    (*rows.weights)[2][3] = bad;
    EXPECT_THROW(decide_fixed_g1(rows), contract_error);
  }
}

TEST(FixedG1, Law6_RowsOfAPieceJoinAsThePieceDoes) {
  for (const bool weighted : {false, true}) {
    Maker make{WildNumbers(), 20, 2, weighted};
    for (int i = 0; i < 60; ++i) {
      BicubicJoinRows rows = make.join();
      if (i % 3 == 1) rows.behind_a[2][2] += 1;
      JoinPiece<Rational> piece = piece_of(rows);
      const Rational a = i % 2 ? Rational(-3) / Rational(7) : Rational(5), b = Rational(1) / Rational(11);
      for (auto& row : piece.b)  // a constant factor on a whole side, and another speed across the edge
        for (auto& p : row) p = b * p;
      for (auto& p : piece.b[1]) p = Rational(3) * p;
      if (!weighted)
        for (auto& row : piece.a)
          for (auto& p : row) p = a * p;
      const std::optional<BicubicJoinRows> back = bicubic_join_rows(piece);
      ASSERT_TRUE(back);
      ASSERT_EQ(decide_fixed_g1(*back) == FixedG1::refuted, !truth(piece).coplanar);
      ASSERT_EQ(fixed_rung_decides_g1({piece}), decide_fixed_g1(*back));
      ASSERT_EQ(back->behind_a, rows.behind_a);
    }
  }
  JoinPiece<Rational> piece = piece_of(Maker{WildNumbers()}.join());
  JoinPiece<Rational> other = piece;
  other.a[0].pop_back();
  EXPECT_FALSE(bicubic_join_rows(other));
  other = piece;
  other.b[0][2][1] = other.b[0][2][1] + Rational(1);
  EXPECT_FALSE(bicubic_join_rows(other)) << "not C0";
  other = piece;
  other.a[1][0][0] = power_of_two(-2000);
  EXPECT_FALSE(bicubic_join_rows(other)) << "no double";
  other.a[1][0][0] = Rational(1) / (power_of_two(60) + Rational(1));
  EXPECT_FALSE(bicubic_join_rows(other)) << "too long without denominators";
  EXPECT_EQ(fixed_rung_decides_g1({piece, other}), std::nullopt);
}

}  // namespace
}  // namespace patchproof::test
