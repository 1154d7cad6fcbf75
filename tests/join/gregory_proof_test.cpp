// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/gregory_proof.h"

#include <gtest/gtest.h>

#include <functional>

#include "patchproof/mesh/fill_faces.h"
#include "support/graph_mesh.h"
#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;
using Surface = BsplinePatch<Rational, 4>;
using Point4 = Vec<Rational, 4>;

std::vector<Patch> filled(const GraphMesh& g, FillMethod method = FillMethod::c1) {
  const MeshTopology topology = analyse(g.mesh).value();
  return fill_faces<Rational>(g.mesh, topology, {NodeScale::none, method}, 1).value().patches;
}

// Are all four rows C¹, by the definition of the basis?
bool rows_are_c1(const Surface& s, Direction along) {
  for (const Rational& t : s.knots(along).breaks()) {
    if (t == 0 || t == 1) continue;
    for (const Rational& x : {Rational(0), "1/3"_q, "2/3"_q, Rational(1)}) {
      const bool v = along == Direction::v;
      const auto at = [&](Side side) {
        return derivative_by_definition(s, v ? x : t, v ? t : x, v ? 0 : 1, v ? 1 : 0, side, side);
      };
      if (!(at(Side::left) == at(Side::right))) return false;
    }
  }
  return true;
}

// With one number of one control point changed.
Patch changed(const Patch& patch, bool u_surface, std::size_t place, std::size_t component, const Rational& by) {
  const Surface& s = u_surface ? patch.u_surface() : patch.v_surface();
  std::vector<Point4> net = s.net();
  net[place][component] += by;
  const Surface other(s.knots(Direction::u), s.knots(Direction::v), std::move(net));
  return u_surface ? Patch::make(other, patch.v_surface()).value() : Patch::make(patch.u_surface(), other).value();
}

TEST(GregoryProof, Law1_PatchesOfAFillAreC1) {
  for (const auto& g :
       {two_columns(),
        two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q}, .w0 = 2, .to_left = {"1/3"_q}, .to_right = {"1/2"_q}})})
    for (const Patch& patch : filled(g)) {
      const GregoryProof proof = prove_patch(patch);
      EXPECT_TRUE(proof.matched && proof.corners && proof.c1 && proof.positive);
      EXPECT_TRUE(proof.is_c1());
    }
}

// Rows times one positive function that is only continuous: the same affine surface, with homogeneous rows that jump.
TEST(GregoryProof, Law1_RowsMayJumpByMultiplesOfThemselves) {
  const Patch patch = filled(two_columns({.inner = {"1/2"_q}}))[0];
  const Surface& u = patch.u_surface();
  const Piecewise<Rational, 1> factor{{Rational(0), "1/2"_q, {{{1}}, {{2}}}}, {"1/2"_q, Rational(1), {{{2}}, {{1}}}}};
  std::vector<BsplineCurve<Rational, 4>> rows;
  for (int i = 0; i < 4; ++i) {
    std::vector<Point4> points;
    for (int k = 0; k < u.count(Direction::v); ++k) points.push_back(u.point(i, k));
    const auto pieces = product(factor, extract_bezier(BsplineCurve<Rational, 4>(u.knots(Direction::v), points)));
    rows.push_back(joined(pieces, pieces.front().degree()));
  }
  std::vector<Point4> net;
  for (const auto& row : rows) net.insert(net.end(), row.points().begin(), row.points().end());
  const Surface other(u.knots(Direction::u), rows[0].knots(), std::move(net));
  const Patch scaled = Patch::make(other, patch.v_surface()).value();
  EXPECT_EQ(evaluate_rational(other, "1/3"_q, "1/5"_q), evaluate_rational(u, "1/3"_q, "1/5"_q));
  EXPECT_FALSE(rows_are_c1(other, Direction::v));
  EXPECT_TRUE(prove_patch(scaled).is_c1());
}

TEST(GregoryProof, Law1_TheFormerMethodIsNot) {
  GraphMesh g = two_columns({.inner = {"1/2"_q}, .to_left = {"1/3"_q}});
  const Point3 d = g.lifted(g.at(0, "2/3"_q), {-1, 0});
  g.mesh.control_vectors = {{0, "2/3"_q, 5 * d, -d}};
  int kinked = 0;
  for (const Patch& patch : filled(g, FillMethod::former)) {
    const GregoryProof proof = prove_patch(patch);
    EXPECT_TRUE(proof.matched && proof.corners && proof.positive);
    EXPECT_EQ(proof.c1, rows_are_c1(patch.u_surface(), Direction::v) && rows_are_c1(patch.v_surface(), Direction::u));
    EXPECT_EQ(proof.is_c1(), proof.c1);
    kinked += !proof.c1;
  }
  EXPECT_EQ(kinked, 2) << "the two faces beside the control vectors";
  for (const Patch& patch : filled(g)) EXPECT_TRUE(prove_patch(patch).is_c1());
}

TEST(GregoryProof, Law1_OneChangedNumberFailsTheRightProof) {
  GraphMesh g = two_columns({.inner = {"1/2"_q}, .w0 = 2});
  const Patch patch = filled(g)[0];
  ASSERT_TRUE(prove_patch(patch, 0).is_c1());
  const Rational tiny(1, Integer(1) << 80);
  for (const bool u_surface : {true, false}) {
    const Surface& s = u_surface ? patch.u_surface() : patch.v_surface();
    const int rows_count = u_surface ? s.count(Direction::v) : s.count(Direction::u), columns = s.count(Direction::v);
    for (std::size_t place = 0; place < s.net().size(); ++place) {
      const int i = static_cast<int>(place) / columns, j = static_cast<int>(place) % columns;
      const int row = u_surface ? i : j, m = u_surface ? j : i, from_end = std::min(m, rows_count - 1 - m);
      const bool at_corner = from_end == 0 || (from_end == 1 && (row == 0 || row == 3));
      const GregoryProof moved = prove_patch(changed(patch, u_surface, place, 2, tiny), 0);
      EXPECT_EQ(moved.corners, !at_corner) << place;
      EXPECT_TRUE(moved.matched && moved.positive && moved.c1) << place;
      EXPECT_EQ(moved.is_c1(), !at_corner);
      if (from_end == 0) continue;  // refused by make
      const GregoryProof negative = prove_patch(changed(patch, u_surface, place, 3, Rational(-50)), 0);
      EXPECT_FALSE(negative.positive) << place;
      EXPECT_FALSE(negative.is_c1());
      const GregoryProof zero = prove_patch(changed(patch, u_surface, place, 3, -s.net()[place][3]), 0);
      EXPECT_FALSE(zero.positive) << place;
    }
  }
}

// Knots where the rows may have kinks: whether they do is decided by the control points.
TEST(GregoryProof, Law1_C1AtKnotsOfHighMultiplicity) {
  RandomRationals random;
  const auto across = KnotVector<Rational>::bezier(3);
  const auto knots = KnotVector<Rational>::make(3, {0, 0, 0, 0, "1/3"_q, "1/3"_q, "1/3"_q, 1, 1, 1, 1}).value();
  std::vector<Point4> net;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 7; ++j) net.push_back({{random(), random(), random(), 1}});
  for (int i = 0; i < 4; ++i) net[7 * i + 3] = "2/3"_q * net[7 * i + 2] + "1/3"_q * net[7 * i + 4];
  const Surface v(across, across, std::vector<Point4>(16, Point4{{0, 0, 0, 1}}));
  const auto proven = [&] { return prove_patch(Patch::make(Surface(across, knots, net), v).value(), 0).c1; };
  EXPECT_TRUE(proven());
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 7; ++j) {
      Point4& p = net[7 * i + j];
      p[1] += Rational(1, Integer(1) << 90);
      EXPECT_EQ(proven(), j < 2 || j > 4) << i << j;
      p[1] -= Rational(1, Integer(1) << 90);
    }
  // Of random patches, by the definition.
  int smooth = 0;
  for (int round = 0; round < 20; ++round) {
    const Patch patch = random_gregory_patch(random, {.rational = round % 2 == 0});
    const GregoryProof proof = prove_patch(patch, 0);
    EXPECT_TRUE(proof.matched && proof.corners);
    EXPECT_EQ(proof.c1, rows_are_c1(patch.u_surface(), Direction::v) && rows_are_c1(patch.v_surface(), Direction::u));
    smooth += proof.c1;
  }
  EXPECT_GT(smooth, 0);
  EXPECT_LT(smooth, 20);
}

// The bicubic surface with these coefficients of u^i v^j: then S is that polynomial.
Patch of_polynomial(const std::function<Point3(const Rational&, const Rational&)>& f) {
  // Tensor interpolation at 0, 1/3, 2/3, 1 in the Bernstein basis.
  const auto bernstein = [](const std::array<Point3, 4>& x) {
    return std::array<Point3, 4>{
        x[0], "1/6"_q * (Rational(-5) * x[0] + Rational(18) * x[1] + Rational(-9) * x[2] + Rational(2) * x[3]),
        "1/6"_q * (Rational(2) * x[0] + Rational(-9) * x[1] + Rational(18) * x[2] + Rational(-5) * x[3]), x[3]};
  };
  std::array<std::array<Point3, 4>, 4> rows;
  for (int i = 0; i < 4; ++i) {
    std::array<Point3, 4> x;
    for (int j = 0; j < 4; ++j) x[j] = f(Rational(i, 3), Rational(j, 3));
    rows[i] = bernstein(x);
  }
  std::vector<Point4> net(16);
  for (int j = 0; j < 4; ++j) {
    const auto column = bernstein({rows[0][j], rows[1][j], rows[2][j], rows[3][j]});
    for (int i = 0; i < 4; ++i) net[4 * i + j] = {{column[i][0], column[i][1], column[i][2], 1}};
  }
  const auto k = KnotVector<Rational>::bezier(3);
  const Surface s(k, k, net);
  return Patch::make(s, s).value();
}

// z², whose derivative vanishes at (a, b) alone.
Patch squared(const Rational& a, const Rational& b, const Rational& scale = 1, const Rational& offset = 0) {
  return of_polynomial([&](const Rational& u, const Rational& v) {
    const Rational x = u - a, y = v - b;
    return Point3{{scale * (x * x - y * y) + offset, scale * 2 * x * y - offset, offset}};
  });
}

TEST(GregoryProof, Law2_NormalsThatVanishAreNeverProvenAway) {
  const auto verdict = [](const Patch& patch) { return prove_patch(patch, 4000).regular; };
  const std::vector<Rational> inside{0, "1/3"_q, "1/2"_q, "1000001/3000000"_q, 1};
  for (const Rational& a : inside)
    for (const Rational& b : inside) {
      const ExactClass regular = verdict(squared(a, b));
      const bool on_grid = denominator(Rational(4 * a)) == 1 && denominator(Rational(4 * b)) == 1;
      EXPECT_EQ(regular.verdict, on_grid ? Verdict::refuted : Verdict::undecided) << a << ", " << b;
      EXPECT_FALSE(regular.reason.empty());
      ASSERT_EQ(regular.witness.has_value(), on_grid);
      if (on_grid) {
        EXPECT_EQ(parse_scalar<Rational>(regular.witness->a[0]).value(), a);
        EXPECT_EQ(parse_scalar<Rational>(regular.witness->a[1]).value(), b);
      }
    }
  // A fold along a line without rational parameters, and one where the normal only touches zero.
  EXPECT_NE(verdict(of_polynomial([](const Rational& u, const Rational& v) {
              return Point3{{u * u * u / 3 - u / 2, v, 0}};
            })).verdict,
            Verdict::proven);
  EXPECT_NE(verdict(of_polynomial([](const Rational& u, const Rational& v) {
              const Rational x = u - "1/3"_q;
              return Point3{{x * x * x, v, v * v}};
            })).verdict,
            Verdict::proven);
  // A curve, a point.
  EXPECT_EQ(verdict(of_polynomial([](const Rational& u, const Rational&) {
              return Point3{{u, u * u, 0}};
            })).verdict,
            Verdict::refuted);
  EXPECT_EQ(verdict(of_polynomial([](const Rational&, const Rational&) {
              return Point3{{1, 2, 3}};
            })).verdict,
            Verdict::refuted);
}

TEST(GregoryProof, Law2_NormalsThatNearlyVanishAreProven) {
  for (const Rational& a : {"-1/100"_q, "101/100"_q, "-1/5000"_q})
    for (const Rational& b : {"-1/100"_q, "1/2"_q, "101/100"_q})
      EXPECT_EQ(prove_patch(squared(a, b)).regular.verdict, Verdict::proven) << a << ", " << b;
  // Of any size, anywhere.
  Rational huge(1);
  for (int i = 0; i < 250; ++i) huge *= 10;
  for (const Rational& scale : {"1/1000000000"_q, Rational(1000000000), huge, Rational(1 / huge), Rational(-1)})
    for (const Rational& offset : {Rational(0), Rational(1000000)}) {
      EXPECT_EQ(prove_patch(squared("-1/9"_q, "1/3"_q, scale, offset)).regular.verdict, Verdict::proven);
      EXPECT_NE(prove_patch(squared("1/9"_q, "1/3"_q, scale, offset), 1000).regular.verdict, Verdict::proven);
    }
}

// Plane patches with wild twists: the normal is a number, and exact samples of both signs mean that it vanishes somewhere.
TEST(GregoryProof, Law2_AgainstExactSamples) {
  RandomRationals random;
  int proven[2] = {0, 0}, folded[2] = {0, 0};
  for (int round = 0; round < 24; ++round) {
    const bool plane = round % 2 == 0, rational = round % 4 > 1;
    const Patch wild = random_gregory_patch(random, {.rational = rational});
    const Rational strength = std::array<Rational, 4>{0, "1/8"_q, "1/3"_q, 1}[random.integer(0, 3)];
    // Between a regular grid and the random patch.
    const auto milder = [&](const Surface& s) {
      std::vector<Point4> net = s.net();
      const Rational n(s.count(Direction::u) - 1), m(s.count(Direction::v) - 1);
      const auto greville = [](const KnotVector<Rational>& t, int i) {
        Rational sum(0);
        for (int k = 1; k <= t.degree(); ++k) sum += t[i + k];
        return Rational(18 * sum / t.degree());
      };
      for (int i = 0; i < s.count(Direction::u); ++i)
        for (int j = 0; j < s.count(Direction::v); ++j) {
          Point4& p = net[i * s.count(Direction::v) + j];
          const Point4 even{{greville(s.knots(Direction::u), i), greville(s.knots(Direction::v), j), 0, 1}};
          p = strength * p + Rational(1 - strength) * even;
          if (plane) p[2] = 0;
        }
      return Surface(s.knots(Direction::u), s.knots(Direction::v), net);
    };
    const Patch patch = Patch::make(milder(wild.u_surface()), milder(wild.v_surface())).value();
    const GregoryProof proof = prove_patch(patch, 400);
    EXPECT_LE(proof.boxes, 400);
    bool up = false, down = false, zero = false;
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; j <= 6; ++j) {
        const Point3 n = frame(patch, Rational(i, 6), Rational(j, 6)).normal();
        zero = zero || n == Point3{};
        up = up || n[2] > 0;
        down = down || n[2] < 0;
      }
    const bool vanishes = zero || (plane && up && down);
    if (vanishes) {
      EXPECT_NE(proof.regular.verdict, Verdict::proven) << "round " << round;
    }
    folded[rational] += vanishes;
    proven[rational] += proof.regular.verdict == Verdict::proven;
  }
  for (const int rational : {0, 1}) {
    EXPECT_GT(proven[rational], 2) << rational;
    EXPECT_GT(folded[rational], 1) << rational;
  }
}

// The plane square with other inner points for the U than for the V surface, t times as far away: only β makes the normals.
class Twisted {
 public:
  Twisted(RandomRationals& random, bool rational) : factor_(rational ? 3 : 1) {
    for (auto* moves : {&of_u_, &of_v_})
      for (int k = 0; k < 4; ++k) {
        const Rational w = rational ? Rational(random.integer(2, 8)) / Rational(4) : Rational(1);
        moves->push_back({{random(), random(), 0, w}});
      }
  }
  Patch operator()(const Rational& t) const {
    const auto k = KnotVector<Rational>::bezier(3);
    const auto surface = [&](const std::vector<Point4>& moves, const Rational& factor) {
      std::vector<Point4> net;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          const bool inner = 0 < i && i < 3 && 0 < j && j < 3;
          const Point4 move = inner ? moves[2 * i + j - 3] : Point4{{0, 0, 0, 1}};
          const Rational w = factor * move[3];
          net.push_back({{w * (9 * i + t * move[0]), w * (9 * j + t * move[1]), 0, w}});
        }
      return Surface(k, k, net);
    };
    return Patch::make(surface(of_u_, factor_), surface(of_v_, 1)).value();
  }
  // The smallest Jacobian at places that crowd at the corners.
  static Rational smallest_normal(const Patch& patch) {
    const std::vector<Rational> at{0, "1/8"_q, "3/8"_q, "5/8"_q, "7/8"_q, 1};
    Rational least = frame(patch, Rational(0), Rational(0)).normal()[2];
    for (const Rational& u : at)
      for (const Rational& v : at) least = std::min(least, frame(patch, u, v).normal()[2]);
    return least;
  }

 private:
  std::vector<Point4> of_u_, of_v_;
  Rational factor_;
};

// Where it has just folded over, by exact values, it must not be proven regular; well before that it is.
TEST(GregoryProof, Law2_PatchesThatJustFoldOver) {
  RandomRationals random;
  for (const bool rational : {false, true}) {
    int folded = 0, proven = 0;
    for (int round = 0; round < 3; ++round) {
      const Twisted twisted(random, rational);
      if (Twisted::smallest_normal(twisted(0)) <= 0) continue;
      Rational low(0), high(1);
      while (high < 64 && Twisted::smallest_normal(twisted(high)) >= 0) high *= 2;
      if (high >= 64) continue;
      for (int step = 0; step < 5; ++step) {
        const Rational middle = (low + high) / 2;
        (Twisted::smallest_normal(twisted(middle)) < 0 ? high : low) = middle;
      }
      ++folded;
      EXPECT_NE(prove_patch(twisted(high), 300).regular.verdict, Verdict::proven) << "round " << round << ", " << high;
      if (!rational) proven += prove_patch(twisted(low / 10), 600).regular.verdict == Verdict::proven;
    }
    EXPECT_GT(folded, 1) << rational;
    EXPECT_TRUE(rational || proven > 0);
  }
}

TEST(GregoryProof, Law2_UndecidedForAReason) {
  const Patch good = squared("-1/100"_q, "-1/100"_q);
  ASSERT_EQ(prove_patch(good).regular.verdict, Verdict::proven);
  const GregoryProof unseen = prove_patch(good, 0);
  EXPECT_EQ(unseen.regular.verdict, Verdict::undecided);
  EXPECT_EQ(unseen.boxes, 0);
  EXPECT_FALSE(unseen.regular.reason.empty());
  EXPECT_TRUE(unseen.is_c1());
  // What the proof is built on does not hold: then nothing is proven.
  const GregoryProof torn = prove_patch(changed(good, true, 0, 2, "1/100"_q));
  EXPECT_FALSE(torn.corners);
  EXPECT_EQ(torn.regular.verdict, Verdict::undecided);
  const GregoryProof pole = prove_patch(changed(good, true, 5, 3, Rational(-40)));
  EXPECT_FALSE(pole.positive);
  EXPECT_EQ(pole.regular.verdict, Verdict::undecided);
  EXPECT_EQ(1 + 0x1p-60, 1.0) << "the rounding is what it was";
}

TEST(GregoryProof, TheCarrierOfEachEdge) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random);
  for (const EdgeName e : {EdgeName::v_min, EdgeName::v_max}) EXPECT_EQ(&carrier(patch, e), &patch.v_surface());
  for (const EdgeName e : {EdgeName::u_min, EdgeName::u_max}) EXPECT_EQ(&carrier(patch, e), &patch.u_surface());
}

}  // namespace
}  // namespace patchproof::test
