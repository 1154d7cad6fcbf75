// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/degree.h"

#include "support/curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class Degree : public ScalarTest<T> {};
TYPED_TEST_SUITE(Degree, AllScalars, ScalarNames);

TEST(Degree, Law1_elevation_leaves_the_curve_unchanged) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random))
    for (int times = 0; times <= 3; ++times) {
      SCOPED_TRACE(name + ", " + std::to_string(times) + " times");
      const PlaneCurve higher = elevate_degree(curve, times);
      EXPECT_EQ(higher.degree(), curve.degree() + times);
      expect_same_curve(higher, curve);
    }
  for (int i = 0; i < 20; ++i) {
    const int degree = random.integer(0, 4);
    const PlaneCurve curve = curve_on(random, degree, random.knots(degree, degree + 1 + random.integer(0, 6)));
    expect_same_curve(elevate_degree(curve, 1 + i % 2), curve);
  }
}

TYPED_TEST(Degree, Law1_in_every_scalar) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    check<TypeParam>(elevate_degree(curve, 2).points(),
                     [&]<class S>() { return elevate_degree(make_curve<S>(curve), 2).points(); });
  }
}

TEST(Degree, Law2_every_knot_gets_as_many_copies) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random))
    for (int times = 1; times <= 3; ++times) {
      SCOPED_TRACE(name);
      const auto higher = change_degree(curve.knots(), times);
      EXPECT_EQ(higher.breaks(), curve.knots().breaks());
      for (const Rational& t : curve.knots().breaks())
        EXPECT_EQ(higher.multiplicity(t), curve.knots().multiplicity(t) + times) << "at " << t;
    }
  const auto knots = [](int degree, std::vector<Rational> k) { return KnotVector<Rational>::make(degree, k).value(); };
  EXPECT_EQ(elevate_degree(curve_on(random, 2, {0, 0, 0, 1, 2, 2, 3, 3, 3})).knots(),
            knots(3, {0, 0, 0, 0, 1, 1, 2, 2, 2, 3, 3, 3, 3}));
  // Unclamped: as many knots outside as degree 4 can use, those next to the domain.
  EXPECT_EQ(elevate_degree(curve_on(random, 3, {-3, -2, -1, 0, 1, 2, 3, 4, 5})).knots(),
            knots(4, {-2, -1, -1, 0, 0, 1, 1, 2, 2, 3, 3, 4}));
}

TEST(Degree, Law2_no_knot_is_repeated_in_vain) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 3, {0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4});
  const PlaneCurve higher = elevate_degree(curve, 2);
  EXPECT_EQ(remove_redundant_knots(higher).knots(), higher.knots()) << "the continuity is exactly that of the knots";
}

TEST(Degree, Law3_reduction_undoes_elevation) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random))
    for (int times = 0; times <= 3; ++times) {
      SCOPED_TRACE(name + ", " + std::to_string(times) + " times");
      const auto back = reduce_degree(elevate_degree(curve, times), times);
      ASSERT_TRUE(back.has_value());
      EXPECT_EQ(back->degree(), curve.degree());
      expect_same_curve(*back, curve);
      if (is_clean(curve)) {
        EXPECT_EQ(back->knots(), curve.knots());
        EXPECT_EQ(back->points(), curve.points());
      }
    }
}

TEST(Degree, Law4_reduction_of_a_full_degree_is_refused) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    EXPECT_FALSE(reduce_degree(curve, 1));
    EXPECT_FALSE(reduce_degree(elevate_degree(curve, 2), 3));
    EXPECT_FALSE(reduce_degree(curve, curve.degree() + 1));
  }
  // One piece of full degree among others is enough.
  const PlaneCurve curve = elevate_degree(curve_on(random, 2, {0, 0, 0, 1, 2, 3, 3, 3}));
  for (std::size_t i = 0; i < curve.points().size(); ++i) {
    std::vector<Vec<Rational, 2>> points = curve.points();
    points[i][0] += Rational(1) / Rational(1000000000);
    EXPECT_FALSE(reduce_degree(PlaneCurve(curve.knots(), points))) << "point " << i;
  }
}

TEST(Degree, Law4_a_knot_vanishes_with_its_break) {
  // A parabola on cubic knots with a simple inner knot: twice differentiable there, so no break is left in degree 2.
  const PlaneCurve parabola = PlaneCurve::bezier({{{0, 0}}, {{1, 0}}, {{2, 4}}});
  const PlaneCurve cubic = insert_knot(elevate_degree(parabola), Rational(Rational(1) / Rational(3)));
  const auto back = reduce_degree(cubic);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->knots(), parabola.knots());
  EXPECT_EQ(back->points(), parabola.points());
  // The same between unclamped knots: the ends of the domain stay, and as much of their multiplicity as is left. In
  // all but the first the domain begins or ends with a point that has no influence.
  for (const std::vector<Rational>& unclamped : std::vector<std::vector<Rational>>{{-3, -2, -1, 0, 1, 2, 3, 4},
                                                                                   {-3, -2, -1, 0, 0, 1, 2, 3, 4},
                                                                                   {-3, -2, -1, 0, 1, 1, 2, 3, 4},
                                                                                   {-1, -1, -1, 0, 0, 1, 2, 3, 4},
                                                                                   {-3, -2, -1, 0, 1, 1, 2, 2, 2}}) {
    const auto knots = KnotVector<Rational>::make(3, unclamped).value();
    std::vector<Vec<Rational, 2>> line;  // C(t) = (t, 5 − 2t), whose points are averages of knots
    for (int i = 0; i < knots.control_count(); ++i) {
      const Rational mean = (knots[i + 1] + knots[i + 2] + knots[i + 3]) / Rational(3);
      line.push_back({{mean, Rational(5 - 2 * mean)}});
    }
    const PlaneCurve straight(knots, line);
    for (int times = 1; times <= 2; ++times) {
      const auto lower = reduce_degree(straight, times);
      ASSERT_TRUE(lower.has_value());
      EXPECT_EQ(lower->degree(), 3 - times);
      expect_same_curve(*lower, straight);
    }
    EXPECT_FALSE(reduce_degree(straight, 3));
  }
}

TEST(Degree, Contracts) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 1, 1});
  EXPECT_THROW(elevate_degree(curve, -1), contract_error);
  EXPECT_THROW(reduce_degree(curve, -1), contract_error);
  EXPECT_THROW(change_degree(curve.knots(), -3), contract_error);
}

}  // namespace
}  // namespace patchproof::test
