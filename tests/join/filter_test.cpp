// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/filter.h"

#include "support/scalars.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Rows = SideRows<Rational>;
using Piece = JoinPiece<Rational>;

Rational two_to(int k) {
  const Rational p(Integer(1) << std::abs(k));
  return k < 0 ? Rational(1 / p) : p;
}
Rational ten_to(int k) {
  Rational p(1);
  for (int i = 0; i < std::abs(k); ++i) p = p * 10;
  return k < 0 ? Rational(1 / p) : p;
}

// A cubic side, with weights near 1 or all 1.
Rows random_rows(RandomRationals& random, bool weighted) {
  Rows rows;
  for (auto& row : rows) row = random.points<4>(4);
  for (int k = 0; k < 3; ++k)
    for (auto& p : rows[k])
      p[3] = k > 0      ? (weighted ? random() / Rational(20) : Rational(0))
             : weighted ? Rational(random.integer(4, 8)) / Rational(5)
                        : Rational(1);
  return rows;
}
Piece piece_of(Rows a, Rows b) { return {0, 1, 0, 1, std::move(a), std::move(b)}; }

// Everything a ladder can be tripped by, done to both sides alike.
struct Pathology {
  std::string name;
  Rational scale, offset;
};
const std::vector<Pathology> kPathologies{{"plain", 1, 0},
                                          {"offset by 10^6", 1, ten_to(6)},
                                          {"offset by 10^12", 1, ten_to(12)},
                                          {"scaled by 2^-30", two_to(-30), 0},
                                          {"scaled by 2^-30, offset by 10^6", two_to(-30), ten_to(6)},
                                          {"scaled by 2^40", two_to(40), 0},
                                          {"scaled by 2^-200", two_to(-200), 0},
                                          {"scaled by 2^-2000", two_to(-2000), 0}};
Piece spoiled(Piece piece, const Pathology& how) {
  for (Rows* rows : {&piece.a, &piece.b}) {
    for (auto& row : *rows)
      for (auto& p : row)
        for (int c = 0; c < 3; ++c) p[c] = how.scale * p[c];
    shift_origin(*rows, Vec<Rational, 3>{{-how.offset, how.offset, how.offset / 3}});
  }
  return piece;
}

std::vector<JoinForms<Integer>> exact_forms(const Piece& piece) { return {join_forms<Integer>(piece)}; }
std::vector<JoinForms<Interval>> interval_forms(const Piece& piece) { return {join_forms<Interval>(piece)}; }

// gap² at t from the rows themselves.
Rational squared_gap(const Piece& piece, const Rational& t) {
  const auto x = de_casteljau(piece.a[0], t), y = de_casteljau(piece.b[0], t);
  Rational sum(0);
  for (int c = 0; c < 3; ++c) {
    const Rational d = x[c] / x[3] - y[c] / y[3];
    sum += d * d;
  }
  return sum;
}
// The first-order normal x_t × x_s (up to a positive factor) from the rows: w² x_t = w X_t − w_t X, likewise x_s.
Vec<Rational, 3> normal_at(const Rows& rows, const Rational& t) {
  const auto x = de_casteljau(rows[0], t), xt = derivative(rows[0], t, 1), xs = de_casteljau(rows[1], t);
  Vec<Rational, 3> along, across;
  for (int c = 0; c < 3; ++c) along[c] = x[3] * xt[c] - xt[3] * x[c], across[c] = x[3] * xs[c] - xs[3] * x[c];
  return cross(along, across);
}
// Degrees between n_A and −n_B, by MPFI.
Ball angle_at(const Piece& piece, const Rational& t) {
  const auto n = normal_at(piece.a, t), m = -normal_at(piece.b, t);
  const auto c = cross(n, m);
  const Rational d = dot(n, m), square = dot(c, c);
  if (d == 0) return Ball(90);
  const Ball acute = atan(sqrt(Ball(square)) / Ball(Rational(abs(d)))) * Ball(180) / Ball::pi();
  return d > 0 ? acute : Ball(180) - acute;
}
const std::vector<Rational> kPlaces = [] {
  std::vector<Rational> out;
  for (int i = 0; i <= 60; ++i) out.push_back(Rational(i) / Rational(60));
  return out;
}();

class LadderLaws : public ::testing::Test {
 private:
  RoundingGuard guard_;
  BallPrecision precision_{400};
};

void expect_gap(const DeviationBound& bound, const Piece& piece) {
  if (bound.upper < std::numeric_limits<double>::infinity()) {
    const Rational upper = from_double(bound.upper);
    for (const Rational& t : kPlaces) EXPECT_LE(squared_gap(piece, t), upper * upper);
  }
  const Rational lower = from_double(bound.lower);
  EXPECT_LE(lower * lower, squared_gap(piece, from_double(bound.t)));
}
void expect_angle(const DeviationBound& bound, const Piece& piece) {
  for (const Rational& t : kPlaces)
    EXPECT_NE((angle_at(piece, t) - Ball(bound.upper)).sign(), std::optional(Sign::positive)) << t;
  EXPECT_NE((angle_at(piece, from_double(bound.t)) - Ball(bound.lower)).sign(), std::optional(Sign::negative));
}

// Both rungs on one piece: what the lower one says, the higher one says too; every bound holds for the rows themselves.
void expect_ladder(const Piece& piece) {
  const auto interval = interval_forms(piece);
  const auto exact = exact_forms(piece);
  const bool c0 = is_c0(exact[0]);
  EXPECT_EQ(c0, squared_gap(piece, 0) == 0 && squared_gap(piece, Rational(1) / 7) == 0 &&
                    squared_gap(piece, Rational(2) / 7) == 0 && squared_gap(piece, Rational(4) / 7) == 0 &&
                    squared_gap(piece, Rational(3) / 7) == 0 && squared_gap(piece, Rational(5) / 7) == 0 &&
                    squared_gap(piece, 1) == 0);
  const bool fits = fits_interval_rung(interval);
  if (fits) {
    EXPECT_FALSE(interval_rung_refutes_c0(interval) && c0);
    expect_gap(bound_gap(interval, {}), piece);
    Budget quick;
    quick.nodes = 400;
    expect_angle(interval_rung_bound_angle(interval, Deviation::angle, quick), piece);
  }
  const DeviationBound gap = bound_gap(exact, {});
  expect_gap(gap, piece);
  EXPECT_TRUE(gap.converged || gap.lower < 1e-300);
  EXPECT_EQ(gap.upper == 0, c0);
  const std::vector<std::pair<ReducedNormal<Integer>, ReducedNormal<Integer>>> normals{
      {reduce_normal(exact[0].a), reduce_normal(exact[0].b)}};
  ASSERT_TRUE(normals[0].first.found() && normals[0].second.found());
  const DeviationBound angle = exact_rung_bound_angle(normals, Deviation::angle, {});
  expect_angle(angle, piece);
  EXPECT_TRUE(angle.converged);
}

TEST_F(LadderLaws, Law1and2_RandomSides) {
  RandomRationals random;
  for (const Pathology& how : kPathologies) {
    SCOPED_TRACE(how.name);
    for (const bool weighted : {true, false})
      expect_ladder(spoiled(piece_of(random_rows(random, weighted), random_rows(random, weighted)), how));
  }
}

// The same edge, tangents bent apart by a little: the gap is exactly 0 and the angle near 10^-k, and a twin whose edge is
// off by 10^-12 or one unit in the last place.
TEST_F(LadderLaws, Law1and2_NearlySmoothJoins) {
  RandomRationals random;
  for (const Pathology& how : kPathologies) {
    SCOPED_TRACE(how.name);
    for (const int k : {-16, -8, -3}) {
      const Rows a = random_rows(random, true);
      Rows b = a;
      for (auto& p : b[1]) p = -p;
      b[1][1][0] += ten_to(k);
      const Piece piece = spoiled(piece_of(a, b), how);
      expect_ladder(piece);
      EXPECT_TRUE(is_c0(join_forms<Integer>(piece)));
      Piece off = piece;
      off.b[0][2][1] += how.scale * two_to(-52);
      expect_ladder(off);
      EXPECT_FALSE(is_c0(join_forms<Integer>(off)));
    }
  }
}

TEST_F(LadderLaws, Law1and2_FoldedBack) {
  RandomRationals random;
  for (const Pathology& how : kPathologies) {
    SCOPED_TRACE(how.name);
    const Rows a = random_rows(random, true);
    const Piece same = spoiled(piece_of(a, a), how);
    expect_ladder(same);
    const std::vector<std::pair<ReducedNormal<Integer>, ReducedNormal<Integer>>> normals{
        {reduce_normal(join_forms<Integer>(same).a), reduce_normal(join_forms<Integer>(same).b)}};
    EXPECT_EQ(exact_rung_bound_angle(normals, Deviation::angle, {}).lower, 180);
    EXPECT_EQ(exact_rung_bound_angle(normals, Deviation::plane_angle, {}).upper, 0);
  }
}

// The cross derivative is g(t)·(0, c, d): where g has a double zero the patch stays on its side, a simple one exchanges.
TEST_F(LadderLaws, Law2_NormalsThatVanishInside) {
  const auto side = [](const std::vector<Rational>& g, const Rational& y, const Rational& z) {
    Rows rows;
    for (int i = 0; i < 3; ++i) {
      rows[0].push_back({{Rational(i), Rational(0), Rational(0), Rational(1)}});
      rows[1].push_back({{Rational(i - 1), y * g[i], z * g[i], Rational(0)}});
      rows[2].push_back({{Rational(0), Rational(1), Rational(2 * i), Rational(0)}});
    }
    return rows;
  };
  const std::vector<Rational> one{1, 1, 1}, twice{1, -2, 4}, change{-1, 0, 1}, irrational{-1, -1, 1};
  const auto bound = [&](const std::vector<Rational>& g, const std::vector<Rational>& h, Deviation what) {
    const Piece piece = piece_of(side(g, 1, 0), side(h, -1, Rational(1) / 20));  // 2.86° apart
    const JoinForms<Integer> forms = join_forms<Integer>(piece);
    const std::vector<std::pair<ReducedNormal<Integer>, ReducedNormal<Integer>>> normals{
        {reduce_normal(forms.a), reduce_normal(forms.b)}};
    const DeviationBound exact = exact_rung_bound_angle(normals, what, {});
    EXPECT_TRUE(exact.converged);
    // The first rung claims nothing that is not so; 0/0 at the zero leaves it open.
    const DeviationBound filter = interval_rung_bound_angle({join_forms<Interval>(piece)}, what, Budget{400});
    EXPECT_GE(filter.upper, exact.lower);
    EXPECT_LE(filter.lower, exact.upper);
    return exact;
  };
  EXPECT_LT(bound(one, one, Deviation::angle).upper, 2.9);
  EXPECT_LT(bound(twice, one, Deviation::angle).upper, 2.9);
  EXPECT_LT(bound(one, twice, Deviation::angle).upper, 2.9);
  EXPECT_LT(bound(change, change, Deviation::angle).upper, 2.9);
  EXPECT_LT(bound(irrational, irrational, Deviation::angle).upper, 2.9);
  for (const auto& g : {change, irrational}) {
    EXPECT_GT(bound(g, one, Deviation::angle).lower, 177);
    EXPECT_LT(bound(one, g, Deviation::plane_angle).upper, 2.9);
  }
}

TEST_F(LadderLaws, FitsOnlyWhatCannotOverflow) {
  RandomRationals random;
  for (const Pathology& how : kPathologies) {
    const bool fits = fits_interval_rung(
        interval_forms(spoiled(piece_of(random_rows(random, true), random_rows(random, true)), how)));
    EXPECT_EQ(fits, how.scale > two_to(-100)) << how.name;
  }
}

}  // namespace
}  // namespace patchproof
