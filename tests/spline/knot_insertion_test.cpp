// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/knot_insertion.h"

#include "support/curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class KnotInsertion : public ScalarTest<T> {};
TYPED_TEST_SUITE(KnotInsertion, AllScalars, ScalarNames);

TEST(KnotInsertion, Law1_the_curve_is_unchanged) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& t : places(curve.knots()))
      for (int times = 0; times <= curve.degree() + 2; ++times) expect_same_curve(insert_knot(curve, t, times), curve);
  }
  for (int i = 0; i < 20; ++i) {
    const int degree = random.integer(0, 5);
    const PlaneCurve curve = curve_on(random, degree, random.knots(degree, degree + 1 + random.integer(0, 6)));
    const Rational a = curve.knots().domain_begin(), b = curve.knots().domain_end();
    const Rational t = a + (b - a) * Rational(random.integer(0, 7)) / Rational(7);
    expect_same_curve(insert_knot(curve, t, 1 + i % 3), curve);
  }
}

TEST(KnotInsertion, Law1_with_knots_and_points_in_a_quadratic_field) {
  const Quadratic root(Rational(0), Rational(1), 2), one(1);
  const BsplineCurve<Quadratic, 1> curve(
      KnotVector<Quadratic>::make(
          2, {Quadratic(0), Quadratic(0), Quadratic(0), one, root, Quadratic(2), Quadratic(2), Quadratic(2)})
          .value(),
      {{{one}}, {{root}}, {{Quadratic(3) - root}}, {{Quadratic(0)}}, {{root * root + root}}});
  const BsplineCurve<Quadratic, 1> finer = insert_knot(insert_knot(curve, root), Quadratic(root / Quadratic(2)), 2);
  EXPECT_EQ(finer.knots().multiplicity(root), 2);
  expect_same_curve(finer, curve);
  EXPECT_TRUE(remove_redundant_knots(finer).points() == curve.points());
}

TYPED_TEST(KnotInsertion, Law1_in_every_scalar) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& t : places(curve.knots()))
      check<TypeParam>(insert_knot(curve, t, 2).points(),
                       [&]<class S>() { return insert_knot(make_curve<S>(curve), make_knot<S>(t), 2).points(); });
  }
}

TEST(KnotInsertion, Law2_multiplicity_grows_by_times) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& t : places(curve.knots())) {
      const PlaneCurve finer = insert_knot(curve, t, 2);
      std::vector<Rational> expected = curve.knots().knots();
      expected.insert(std::upper_bound(expected.begin(), expected.end(), t), 2, t);
      EXPECT_EQ(finer.knots().knots(), expected);
      EXPECT_EQ(raise_multiplicity(curve, t, curve.knots().multiplicity(t) + 2).knots(), finer.knots());
      EXPECT_EQ(raise_multiplicity(curve, t, 0).knots(), curve.knots());
    }
  }
}

TEST(KnotInsertion, Law3_insertions_commute) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& s : places(curve.knots()))
      for (const Rational& t : places(curve.knots())) {
        const PlaneCurve one = insert_knot(insert_knot(curve, s), t), other = insert_knot(insert_knot(curve, t), s);
        EXPECT_EQ(one.knots(), other.knots());
        EXPECT_EQ(one.points(), other.points());
      }
  }
}

TEST(KnotInsertion, Law4_refine_has_the_knots_asked_for) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    std::vector<Rational> finer = curve.knots().knots();
    for (const Rational& t : places(curve.knots())) finer.push_back(t);
    std::sort(finer.begin(), finer.end());
    const auto knots = KnotVector<Rational>::make_unchecked(curve.degree(), finer);
    const PlaneCurve refined = refine(curve, knots);
    EXPECT_EQ(refined.knots(), knots);
    expect_same_curve(refined, curve);
  }
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 2, 2, 2});
  const auto without = KnotVector<Rational>::make(2, {0, 0, 0, 2, 2, 2}).value();
  EXPECT_THROW(refine(curve, without), contract_error);
  const auto longer = KnotVector<Rational>::make(2, {0, 0, 0, 1, 2, 2, 2, 3, 3, 3}).value();
  EXPECT_THROW(refine(curve, longer), contract_error);
}

TEST(KnotInsertion, Law5_removal_undoes_insertion) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& t : places(curve.knots())) {
      PlaneCurve back = insert_knot(curve, t, 3);
      for (int i = 0; i < 3; ++i) {
        const auto shorter = remove_knot(back, t);
        ASSERT_TRUE(shorter.has_value()) << "at " << t << ", removal " << i;
        back = *shorter;
      }
      EXPECT_EQ(back.knots(), curve.knots());
      expect_same_curve(back, curve);
      if (is_clean(curve)) {
        EXPECT_EQ(back.points(), curve.points());
      }
    }
  }
}

TEST(KnotInsertion, Law6_removal_that_would_change_the_curve_is_refused) {
  RandomRationals random;
  // Random points are as rough as the knots allow.
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    for (const Rational& t : curve.knots().breaks()) {
      if (t == curve.knots().domain_begin() || t == curve.knots().domain_end()) continue;
      const bool has_dead_point = curve.knots().multiplicity(t) > curve.degree() + 1;
      const auto shorter = remove_knot(curve, t);
      EXPECT_EQ(shorter.has_value(), has_dead_point) << "at " << t;
      if (shorter) expect_same_curve(*shorter, curve);
    }
    EXPECT_FALSE(remove_knot(curve, Rational(curve.knots().domain_begin() + Rational(1) / Rational(1000000))));
  }
  // One unit in one coordinate of one point is enough.
  const PlaneCurve curve = curve_on(random, 3, {0, 0, 0, 0, 2, 4, 4, 4, 4});
  const PlaneCurve finer = insert_knot(curve, Rational(1));
  for (std::size_t i = 1; i < 4; ++i) {
    std::vector<Vec<Rational, 2>> points = finer.points();
    points[i][1] += Rational(1) / Rational(1000000000);
    EXPECT_FALSE(remove_knot(PlaneCurve(finer.knots(), points), Rational(1))) << "point " << i;
  }
  EXPECT_FALSE(remove_knot(curve, Rational(0))) << "the domain would change";
  EXPECT_FALSE(remove_knot(curve, Rational(4))) << "the domain would change";
  EXPECT_FALSE(remove_knot(curve, Rational(9))) << "outside the domain";
}

TEST(KnotInsertion, Law7_no_knot_is_left_to_remove) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    PlaneCurve finer = curve;
    for (const Rational& t : places(curve.knots())) finer = insert_knot(finer, t, 2);
    const PlaneCurve least = remove_redundant_knots(finer);
    expect_same_curve(least, curve);
    for (const Rational& t : least.knots().breaks()) EXPECT_FALSE(remove_knot(least, t));
    if (is_clean(curve)) {
      EXPECT_EQ(least.knots(), curve.knots());
      EXPECT_EQ(least.points(), curve.points());
    }
  }
  // A parabola needs no inner knots.
  const PlaneCurve parabola = PlaneCurve::bezier({{{0, 0}}, {{1, 0}}, {{2, 4}}});
  const PlaneCurve finer =
      insert_knot(insert_knot(parabola, Rational(Rational(1) / Rational(3)), 3), Rational(Rational(1) / Rational(2)));
  EXPECT_EQ(remove_redundant_knots(finer).points(), parabola.points());
}

TEST(KnotInsertion, Contracts) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 2, {0, 1, 2, 3, 4, 5, 6});
  EXPECT_THROW(insert_knot(curve, Rational(1)), contract_error);
  EXPECT_THROW(insert_knot(curve, Rational(2), -1), contract_error);
}

}  // namespace
}  // namespace patchproof::test
