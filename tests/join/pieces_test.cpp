// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/pieces.h"

#include "patchproof/patch/rational_patch.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Patch = BsplinePatch<Rational, 4>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }

Patch patch_on(RandomRationals& random, int p, const std::vector<Rational>& u, int degree_v,
               const std::vector<Rational>& v) {
  const auto ku = make_knots<Rational>(p, u), kv = make_knots<Rational>(degree_v, v);
  return {ku, kv, random.points<4>(ku.control_count() * kv.control_count())};
}

// Cubic in u and quadratic in v, breaks 0, 1, 3 and −1, 0, 2, 5.
Patch patch_a(RandomRationals& random) {
  return patch_on(random, 3, {0, 0, 0, 0, 1, 3, 3, 3, 3}, 2, {-1, -1, -1, 0, 2, 2, 5, 5, 5});
}
// Quadratic in u and cubic in v, breaks 0, 4 and 10, 11, 14.
Patch patch_b(RandomRationals& random) {
  return patch_on(random, 2, {0, 0, 0, 4, 4, 4}, 3, {10, 10, 10, 10, 11, 14, 14, 14, 14});
}

// The parameter on line B paired with t on line A.
Rational paired(const Pairing<Rational>& p, const Rational& t) {
  std::size_t i = 0;
  while (i + 2 < p.a.size() && p.a[i + 1] < t) ++i;
  const Rational x = (t - p.a[i]) / (p.a[i + 1] - p.a[i]);
  const Rational y = p.kind == PairingKind::rational_linear ? Rational(p.ratio * x / (1 - x + p.ratio * x)) : x;
  return p.b[i] + y * (p.b[i + 1] - p.b[i]);
}

// ∂^k/∂n^k at n = 0 by the definition of the basis.
Vec<Rational, 4> across(const Patch& s, const IsoLine<Rational>& line, const Rational& t, int k, Side side) {
  const Rational sign(line.side == Side::left && k % 2 == 1 ? -1 : 1);
  return sign * (line.constant == Direction::u ? derivative_by_definition(s, line.value, t, k, 0, line.side, side)
                                               : derivative_by_definition(s, t, line.value, 0, k, side, line.side));
}

// Law 1 at inner places of every piece, and law 2. Under a rational linear pairing B's rows share one positive factor.
void expect_pieces(const Patch& a, const Patch& b, const Join<Rational>& join, std::size_t count) {
  const auto pieces = join_pieces(a, b, join);
  ASSERT_EQ(pieces.size(), count);
  EXPECT_EQ(pieces.front().a_begin, join.pairing.a.front());
  EXPECT_EQ(pieces.back().a_end, join.pairing.a.back());
  EXPECT_EQ(pieces.front().b_begin, join.pairing.b.front());
  EXPECT_EQ(pieces.back().b_end, join.pairing.b.back());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const JoinPiece<Rational>& piece = pieces[i];
    EXPECT_LT(piece.a_begin, piece.a_end);
    if (i > 0) {
      EXPECT_EQ(pieces[i - 1].a_end, piece.a_begin);
      EXPECT_EQ(pieces[i - 1].b_end, piece.b_begin);
    }
    const int n = static_cast<int>(std::max(piece.a[0].size(), piece.b[0].size()));
    for (int j = 1; j <= n; ++j) {
      const Rational x = q(j, n + 1), t = piece.a_begin + x * (piece.a_end - piece.a_begin),
                     tau = paired(join.pairing, t);
      const Rational r = join.pairing.kind == PairingKind::rational_linear ? join.pairing.ratio : Rational(1);
      Rational factor(1);
      for (std::size_t d = 1; d < piece.b[0].size(); ++d) factor = factor * (1 - x + r * x);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(de_casteljau(piece.a[k], x), across(a, join.line_a, t, k, Side::right));
        EXPECT_EQ(de_casteljau(piece.b[k], x), factor * across(b, join.line_b, tau, k, Side::right));
      }
    }
  }
}

TEST(JoinPiecesLaws, Law1and2_WholeEdgesBothWays) {
  RandomRationals random;
  const Patch a = patch_a(random), b = patch_b(random);
  for (const EdgeName edge : {EdgeName::u_min, EdgeName::u_max}) {
    Join<Rational> join{JoinKind::isoparametric,
                        0,
                        1,
                        edge_line(a, EdgeName::u_max),
                        edge_line(b, edge),
                        {PairingKind::affine, {-1, 5}, {10, 14}, 1}};
    // A's breaks 0, 2 and B's break 11, at 1/2 on A.
    expect_pieces(a, b, join, 4);
    join.pairing.b = {14, 10};  // 11 is at 7/2
    expect_pieces(a, b, join, 4);
    EXPECT_TRUE(join.pairing.reversed());
  }
  const Join<Rational> other{JoinKind::isoparametric,
                             0,
                             1,
                             edge_line(a, EdgeName::v_max),
                             edge_line(b, EdgeName::v_min),
                             {PairingKind::affine, {0, 3}, {4, 0}, 1}};
  expect_pieces(a, b, other, 2);
}

TEST(JoinPiecesLaws, Law1and2_TJunctionsAndCoincidingCuts) {
  RandomRationals random;
  const Patch a = patch_a(random), b = patch_b(random);
  Join<Rational> join{JoinKind::t_junction,
                      0,
                      1,
                      edge_line(a, EdgeName::u_min),
                      edge_line(b, EdgeName::u_max),
                      {PairingKind::affine, {q(1, 2), 1}, {10, 14}, 1}};
  expect_pieces(a, b, join, 2);
  join.pairing = {PairingKind::identity, {0, 2}, {10, 12}, 1};  // part of A, part of B
  expect_pieces(a, b, join, 2);
  join.pairing = {PairingKind::affine, {-1, 5}, {q(51, 5), q(54, 5)}, 1};  // inside one span of B
  expect_pieces(a, b, join, 3);
  join.pairing = {PairingKind::identity, {-1, 3}, {10, 14}, 1};  // A's 0 is B's 11: one cut, not two
  expect_pieces(a, b, join, 3);
  join.pairing = {PairingKind::identity, {0, 2}, {14, 12}, 1};
  expect_pieces(a, b, join, 1);
}

TEST(JoinPiecesLaws, Law1and2_PiecewiseLinearAndInnerLines) {
  RandomRationals random;
  const Patch a = patch_a(random), b = patch_b(random);
  Join<Rational> join{JoinKind::isoparametric,
                      0,
                      1,
                      edge_line(a, EdgeName::u_min),
                      edge_line(b, EdgeName::u_max),
                      {PairingKind::piecewise_linear, {-1, q(1, 3), 2, 5}, {10, q(21, 2), 13, 14}, 1}};
  expect_pieces(a, b, join, 5);  // nodes, 0, and 11 on the second stretch
  join.pairing.b = {14, 13, 11, 10};
  expect_pieces(a, b, join, 4);  // 11 is a node
  // The knot line u = 1 inside A, seen from both sides.
  join = {JoinKind::knot_line,
          0,
          0,
          {Direction::u, 1, Side::left},
          {Direction::u, 1, Side::right},
          {PairingKind::identity, {-1, 5}, {-1, 5}, 1}};
  expect_pieces(a, a, join, 3);
}

TEST(JoinPiecesLaws, Law1and2_RationalLinearPairing) {
  RandomRationals random;
  const Patch a = patch_on(random, 1, {0, 0, 1, 1}, 3, {0, 0, 0, 0, 2, 2, 2, 2}),
              b = patch_on(random, 2, {0, 0, 0, 1, 1, 1}, 2, {4, 4, 4, 5, 5, 5});
  for (const auto& ends : std::vector<std::vector<Rational>>{{4, 5}, {5, 4}}) {
    Join<Rational> join{JoinKind::isoparametric,
                        0,
                        1,
                        edge_line(a, EdgeName::u_max),
                        edge_line(b, EdgeName::u_min),
                        {PairingKind::rational_linear, {0, 2}, ends, q(3, 7)}};
    expect_pieces(a, b, join, 1);
  }
  const Patch knotted = patch_a(random);
  const Join<Rational> bad{JoinKind::isoparametric,
                           0,
                           1,
                           edge_line(knotted, EdgeName::u_max),
                           edge_line(b, EdgeName::u_min),
                           {PairingKind::rational_linear, {-1, 5}, {4, 5}, 2}};
  EXPECT_THROW(join_pieces(knotted, b, bad), contract_error);
  Join<Rational> none = bad;
  none.pairing = {PairingKind::identity, {0}, {4}, 1};
  EXPECT_THROW(join_pieces(knotted, b, none), contract_error);
}

// The field in which a form over R takes its values.
template <class R>
using value_t = std::conditional_t<std::is_same_v<R, Integer>, Rational, R>;

// The forms are one positive constant times the rows, with the weight made positive.
template <class R>
void expect_forms(const SideRows<Rational>& rows) {
  const SideForms<R> forms = side_forms<R>(rows);
  const Rational weight = de_casteljau(rows[0], q(1, 2))[3];
  const auto at = [](const BinaryForm<R>& f, const Rational& t) { return f(embed<value_t<R>>(t)); };
  using V = value_t<R>;
  const V factor = at(forms.weight[0], q(1, 2)) / embed<V>(weight);
  EXPECT_EQ(*scalar_traits<V>::sign(factor), weight < 0 ? Sign::negative : Sign::positive);
  for (const Rational& t : {Rational(0), q(1, 3), q(1, 2), q(3, 4), Rational(1)})
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 4; ++c)
        EXPECT_TRUE(at(c < 3 ? forms.position[k][c] : forms.weight[k], t) ==
                    factor * embed<V>(de_casteljau(rows[k], t)[c]));
}

TEST(SideFormsLaws, RowsTimesOnePositiveConstant) {
  RandomRationals random;
  for (int round = 0; round < 12; ++round) {
    SideRows<Rational> rows;
    const int degree = random.integer(0, 4), kind = random.integer(0, 2), sign = random.integer(0, 1) == 0 ? -1 : 1;
    for (auto& row : rows) {
      row = random.points<4>(degree + 1);
      for (auto& p : row)
        p[3] = &row == &rows[0] ? Rational(sign) * (kind == 0 ? Rational(random.integer(1, 9)) / Rational(4) : q(2, 3))
               : kind == 2      ? Rational(0)
                                : random();
    }
    expect_forms<Integer>(rows);
    expect_forms<Rational>(rows);
    const SideForms<Integer> forms = side_forms<Integer>(rows);
    if (kind != 0) {
      EXPECT_EQ(forms.weight[0].degree(), 0);
    }
    if (kind == 2) {
      EXPECT_TRUE(forms.weight[1].is_empty() && forms.weight[2].is_empty());
    }
  }
}

TEST(SideFormsLaws, IntervalsEncloseTheRows) {
  const RoundingGuard guard;
  RandomRationals random;
  SideRows<Rational> rows;
  for (auto& row : rows) {
    row = random.points<4>(4);
    for (auto& p : row) p[3] = Rational(random.integer(1, 9)) / Rational(7);
  }
  const SideForms<Interval> forms = side_forms<Interval>(rows);
  for (int k = 0; k < 3; ++k)
    for (const Rational& t : {Rational(0), q(1, 4), Rational(1)})
      for (int c = 0; c < 4; ++c)
        expect_agrees((c < 3 ? forms.position[k][c] : forms.weight[k])(enclose(t)), de_casteljau(rows[k], t)[c]);
}

TEST(SideFormsLaws, ShiftedOriginMovesThePoints) {
  RandomRationals random;
  const Patch a = patch_a(random);
  SideRows<Rational> rows;
  const auto curves = cross_boundary_rows(a, edge_line(a, EdgeName::v_min), 2);
  for (int k = 0; k < 3; ++k) rows[k] = bezier_coefficients(curves[k], Rational(0), Rational(1));
  rows[0][1][3] = Rational(0);
  SideRows<Rational> shifted = rows;
  const Vec<Rational, 3> o{{Rational(1000000), q(-1, 3), Rational(7)}};
  shift_origin(shifted, o);
  for (int k = 0; k < 3; ++k)
    for (const Rational& t : {Rational(0), q(1, 3), Rational(1)}) {
      const auto p = de_casteljau(rows[k], t), moved = de_casteljau(shifted[k], t);
      EXPECT_EQ(moved[3], p[3]);
      for (int c = 0; c < 3; ++c) EXPECT_EQ(moved[c], p[c] - o[c] * p[3]);
    }
}

}  // namespace
}  // namespace patchproof
