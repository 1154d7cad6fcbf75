// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/patch_knots.h"

#include "patchproof/patch/rational_patch.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Patch = BsplinePatch<Rational, 3>;

Rational q(int a, int b) { return Rational(a) / Rational(b); }

// Clamped and unclamped, inner knots of every multiplicity up to degree + 2, domains far from 0, tiny spans.
std::vector<Patch> some_patches() {
  RandomRationals random(23);
  const Rational far(1000000), tiny = 1 / Rational(1 << 20);
  std::vector<Patch> out;
  out.emplace_back(make_knots<Rational>(2, {0, 0, 0, 1, 1, 2, 3, 3, 3}),
                   make_knots<Rational>(1, {q(7, 5), q(7, 5), 2, 3, 3}), random.points<3>(6 * 3));
  out.emplace_back(make_knots<Rational>(2, {-1, 0, 0, 1, 2, 2, 2, 2, 3, 4, 4, 5}),
                   make_knots<Rational>(3, {far, far, far, far, far + tiny, far + 1, far + 1, far + 1, far + 1}),
                   random.points<3>(9 * 5));
  out.push_back(random_patch<3>(random, 3, 6, 2, 5));
  return out;
}

// A parameter inside the domain that is no knot, and one that is a knot.
Rational between_knots(const KnotVector<Rational>& knots) {
  const auto b = knots.breaks();
  return (2 * b[0] + b[1]) / 3;
}

constexpr Direction kDirections[] = {Direction::u, Direction::v};

TEST(PatchKnots, Law1_TheSurfaceIsUnchanged) {
  for (const Patch& s : some_patches())
    for (const Direction d : kDirections) {
      const KnotVector<Rational>& knots = s.knots(d);
      const Rational t = between_knots(knots);
      const auto inserted = insert_knot(s, d, t, 2);
      EXPECT_EQ(inserted.knots(d).multiplicity(t), 2);
      expect_same_surface(inserted, s);
      const Rational b = knots.breaks()[knots.breaks().size() / 2];
      const auto raised = raise_multiplicity(s, d, b, knots.degree() + 1);
      EXPECT_EQ(raised.knots(d).multiplicity(b), std::max(knots.degree() + 1, knots.multiplicity(b)));
      expect_same_surface(raised, s);
      const auto refined = refine(s, d, insert_knot(inserted, d, t).knots(d));
      EXPECT_EQ(refined.knots(d).multiplicity(t), 3);
      expect_same_surface(refined, s);
      const auto elevated = elevate_degree(s, d, 2);
      EXPECT_EQ(elevated.degree(d), knots.degree() + 2);
      expect_same_surface(elevated, s);
      const auto clamped = clamp(s, d);
      EXPECT_TRUE(clamped.knots(d).is_clamped());
      expect_same_surface(clamped, s);
    }
}

TEST(PatchKnots, Law2_RemovalAndReductionUndo) {
  for (const Patch& s : some_patches())
    for (const Direction d : kDirections) {
      const Rational t = between_knots(s.knots(d));
      const auto removed = remove_knot(insert_knot(s, d, t), d, t);
      ASSERT_TRUE(removed.has_value());
      EXPECT_TRUE(removed->knots(d) == s.knots(d));
      expect_same_surface(*removed, s);
      EXPECT_FALSE(remove_knot(s, d, t).has_value()) << "t is no knot";
      const auto reduced = reduce_degree(elevate_degree(s, d), d);
      ASSERT_TRUE(reduced.has_value());
      EXPECT_EQ(reduced->degree(d), s.degree(d));
      expect_same_surface(*reduced, s);
      EXPECT_FALSE(reduce_degree(s, d).has_value());
    }
}

TEST(PatchKnots, Law2_OneLineIsEnoughToRefuse) {
  const Patch s = some_patches()[0];
  const Rational t = between_knots(s.knots(Direction::u));
  const auto finer = insert_knot(s, Direction::u, t);
  for (int j = 0; j < finer.count(Direction::v); ++j) {
    auto net = finer.net();
    net[1 * finer.count(Direction::v) + j][2] += q(1, 1000000);
    const Patch moved(finer.knots(Direction::u), finer.knots(Direction::v), net);
    EXPECT_FALSE(remove_knot(moved, Direction::u, t).has_value()) << "line " << j;
  }
}

TEST(PatchKnots, Law3_PartsAreThePatchOnTheirBox) {
  for (const Patch& s : some_patches())
    for (const Direction d : kDirections) {
      const auto breaks = s.knots(d).breaks();
      for (const Rational& t : {between_knots(s.knots(d)), breaks[breaks.size() / 2]}) {
        if (!(breaks.front() < t && t < breaks.back())) continue;
        const auto [low, high] = split(s, d, t);
        EXPECT_EQ(low.knots(d).domain_end(), t);
        EXPECT_EQ(high.knots(d).domain_begin(), t);
        EXPECT_EQ(low.knots(d).domain_begin(), breaks.front());
        EXPECT_EQ(high.knots(d).domain_end(), breaks.back());
        EXPECT_TRUE(low.knots(d).is_clamped() && high.knots(d).is_clamped());
        const Rational other = between_knots(s.knots(d == Direction::u ? Direction::v : Direction::u));
        const auto value = [&](const Patch& patch, const Rational& x, Side side) {
          return d == Direction::u ? evaluate(patch, x, other, side) : evaluate(patch, other, x, Side::right, side);
        };
        for (const Patch* part : {&low, &high})
          for (const Rational& x : deciding_parameters(part->knots(d), part->knots(d)))
            EXPECT_TRUE(value(*part, x, Side::right) == value(s, x, Side::right));
        EXPECT_TRUE(value(low, t, Side::left) == value(s, t, Side::left));
        EXPECT_TRUE(value(high, t, Side::right) == value(s, t, Side::right));
      }
    }
  const Patch s = some_patches()[0];
  const ParameterBox<Rational> box{q(1, 2), q(5, 2), q(3, 2), q(11, 4)};
  const Patch part = restrict(s, box);
  EXPECT_TRUE(part.domain() == box);
  EXPECT_TRUE(evaluate(part, Rational(2), q(9, 4)) == evaluate(s, Rational(2), q(9, 4)));
}

TEST(PatchKnots, Law4_ReverseAndMapDomain) {
  for (const Patch& s : some_patches()) {
    const auto d = s.domain();
    const Rational u = between_knots(s.knots(Direction::u)), v = between_knots(s.knots(Direction::v));
    const Patch back_u = reverse(s, Direction::u), back_v = reverse(s, Direction::v);
    EXPECT_TRUE(evaluate(back_u, Rational(d.u_begin + d.u_end - u), v) == evaluate(s, u, v));
    EXPECT_TRUE(evaluate(back_v, u, Rational(d.v_begin + d.v_end - v)) == evaluate(s, u, v));
    EXPECT_TRUE(reverse(back_u, Direction::u).net() == s.net());
    EXPECT_TRUE(reverse(back_u, Direction::u).knots(Direction::u) == s.knots(Direction::u));
    const Patch moved = map_domain(s, Direction::v, Rational(5), Rational(7));
    const Rational image = 5 + 2 * (v - d.v_begin) / (d.v_end - d.v_begin);
    EXPECT_TRUE(evaluate(moved, u, image) == evaluate(s, u, v));
    EXPECT_EQ(moved.domain().v_end, 7);
  }
}

TEST(PatchKnots, Law4_MoebiusKeepsTheRationalSurface) {
  RandomRationals random(31);
  auto net = random.points<4>(5 * 3);
  for (auto& p : net) p[3] += 30;
  const BsplinePatch<Rational, 4> s(make_knots<Rational>(2, {0, 0, 0, q(1, 3), q(1, 2), 1, 1, 1}),
                                    make_knots<Rational>(2, {0, 0, 0, 1, 1, 1}), net);
  const Rational r = q(5, 2), v = q(2, 7);
  const auto paced = moebius(s, Direction::u, r);
  for (const Rational& x : spread(0, 1, 7))
    EXPECT_TRUE(evaluate_rational(paced, x, v) == evaluate_rational(s, Rational(r * x / (1 - x + r * x)), v));
}

TEST(PatchKnots, Law5_DirectionsCommute) {
  for (const Patch& s : some_patches()) {
    const Rational u = between_knots(s.knots(Direction::u)), v = between_knots(s.knots(Direction::v));
    const auto a = elevate_degree(insert_knot(s, Direction::u, u), Direction::v);
    const auto b = insert_knot(elevate_degree(s, Direction::v), Direction::u, u);
    EXPECT_TRUE(a.net() == b.net() && a.knots(Direction::u) == b.knots(Direction::u));
    const auto swapped = swap_directions(insert_knot(s, Direction::v, v));
    EXPECT_TRUE(swapped.net() == insert_knot(swap_directions(s), Direction::u, v).net());
  }
}

TEST(PatchKnots, Law6_NoRedundantKnotRemains) {
  const Patch s = some_patches()[0];
  const auto finer = insert_knot(insert_knot(s, Direction::u, q(1, 2), 2), Direction::u, Rational(2));
  const auto coarse = remove_redundant_knots(finer, Direction::u);
  EXPECT_TRUE(coarse.knots(Direction::u) == s.knots(Direction::u));
  EXPECT_TRUE(coarse.net() == s.net());
  for (const Rational& t : coarse.knots(Direction::u).breaks())
    EXPECT_FALSE(remove_knot(coarse, Direction::u, t).has_value());
}

// The enclosing scalars do the same: every line is the curve algorithm, whose own tests cover each scalar.
template <class T>
class PatchKnotsLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(PatchKnotsLaws, AllScalars, ScalarNames);

TYPED_TEST(PatchKnotsLaws, Law1_EveryScalar) {
  RandomRationals random(41);
  const Patch s(make_knots<Rational>(2, {0, 0, 0, 1, 1, 2, 3, 3, 3}), make_knots<Rational>(1, {1, 1, 2, 3, 3}),
                random.points<3>(6 * 3));
  const Rational u = q(5, 4), v = q(9, 4), t = q(3, 2);
  check<TypeParam>(derivative_by_definition(s, u, v, 1, 0), [&]<class S>() {
    const auto patch =
        restrict(elevate_degree(insert_knot(make_patch<S>(s), Direction::u, make_knot<S>(t)), Direction::v),
                 Direction::u, make_knot<S>(q(1, 2)), make_knot<S>(t));
    return partial_derivatives(patch, make_knot<S>(u), make_knot<S>(v), 1, 0).at(1, 0);
  });
}

TEST(PatchKnots, MapRowsRefusesDifferingKnots) {
  const Patch s = some_patches()[0];
  int line = 0;
  EXPECT_THROW(
      map_rows(s, Direction::u, [&](const BsplineCurve<Rational, 3>& c) { return insert_knot(c, q(1, 3), line++); }),
      contract_error);
}

}  // namespace
}  // namespace patchproof
