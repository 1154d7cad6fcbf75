// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/local_curve.h"

#include <gtest/gtest.h>

#include "patchproof/spline/reparametrize.h"
#include "support/curves.h"
#include "support/gerbs.h"

namespace patchproof::test {
namespace {

using Local = LocalCurve<Rational, 3>;
using Spline = BsplineCurve<Rational, 3>;

// value, first derivative, … by power series
template <class R>
std::vector<Vec<R, 2>> reference(const Local& c, const Rational& inside, Side side, const Rational& t, int order) {
  const auto jets = jets_of<R>(c, inside, side, t, order);
  std::vector<Vec<R, 2>> out(order + 1);
  for (int r = 0; r <= order; ++r)
    for (const std::size_t k : {0u, 1u}) out[r][k] = embed<R>(factorial(r)) * jets[k][r];
  return out;
}

Local trigonometric(std::vector<Vec<Rational, 3>> points) { return Local::trigonometric(std::move(points)).value(); }

// 1 + cos πt/2 as weight
Local weighted_turn() {
  return trigonometric({{{1, 2, 2}}, {{"1/2"_q, 0, "1/2"_q}}, {{0, 3, "-1/3"_q}}, {{1, 0, 0}}, {{0, 1, "1/4"_q}}});
}

TEST(LocalCurve, Law1_SplinesOfEveryWeight) {
  RandomRationals random;
  for (const Weights weights : {Weights::one, Weights::common, Weights::different})
    for (int degree = 0; degree <= 4; ++degree) {
      const Local c(random_spline<3>(random, -1, 3, degree, degree == 0 ? 0 : 3, weights));
      EXPECT_EQ(c.has_unit_weights(), weights == Weights::one);
      for (const Rational& t : places(*c.basis().knots()))
        for (const Side side : {Side::left, Side::right})
          EXPECT_EQ((derivatives_at<Rational>(c, t, side, t, 5)), reference<Rational>(c, t, side, t, 5));
    }
}

template <class T>
class LocalCurveScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(LocalCurveScalars, AllScalars, ScalarNames);

TYPED_TEST(LocalCurveScalars, Law1_InEveryScalar) {
  RandomRationals random;
  for (const Weights weights : {Weights::one, Weights::different}) {
    const Local c(random_spline<3>(random, 0, 2, 3, 2, weights));
    for (const Rational& t : {Rational(0), "1/2"_q, "7/8"_q, Rational(2)})
      check<TypeParam>(reference<Rational>(c, t, Side::left, t, 3),
                       [&]<class S>() { return derivatives_at<S>(c, t, Side::left, embed<S>(t), 3); });
  }
}

TEST(LocalCurve, Law1_TrigonometricCurvesWithAWeight) {
  const Local c = weighted_turn();
  EXPECT_FALSE(c.has_unit_weights());
  for (const Rational& t : {Rational(0), "1/3"_q, Rational(-5), "77/8"_q}) {
    const auto value = derivatives_at<Ball>(c, t, Side::right, Ball(t), 5);
    expect_overlap(value, reference<Ball>(c, t, Side::right, t, 5));
    for (const auto& d : value)
      for (const std::size_t k : {0u, 1u}) EXPECT_LT(width(d[k]), 1e-28);
  }
  // Exactly a circle of radius 1: the weight stands on the constant.
  const Local circle = trigonometric({{{0, 0, 1}}, {{1, 0, 0}}, {{0, 1, 0}}});
  EXPECT_TRUE(circle.has_unit_weights());
  EXPECT_EQ(derivatives_at<double>(circle, Rational(0), Side::right, 0.5, 0)[0], (Vec<double, 2>{{0, 1}}));
}

TEST(LocalCurve, Law1_ModelsContainTheCurve) {
  const RoundingGuard guard;
  using Model = TaylorModel<5>;
  RandomRationals random;
  const std::vector<Local> curves{random_spline<3>(random, 0, 1, 3, 0, Weights::different), weighted_turn()};
  const Rational centre = "3/8"_q, radius = "1/32"_q;
  for (const Local& c : curves) {
    const auto models = derivatives_at<Model>(c, centre, Side::right,
                                              Model::variable(embed<Interval>(centre), embed<Interval>(radius)), 2);
    for (const Rational& s : {Rational(-1), "1/3"_q, Rational(1)}) {
      const Rational t = centre + s * radius;
      const auto truth = reference<Ball>(c, centre, Side::right, t, 2);
      for (int r = 0; r <= 2; ++r)
        for (const std::size_t k : {0u, 1u}) {
          const Interval exact = truth[r][k].to_interval(), model = models[r][k].value(embed<Interval>(s));
          EXPECT_TRUE(model.inf() <= exact.inf() && exact.sup() <= model.sup());
          EXPECT_LT(model.sup() - model.inf(), 1e-3);
        }
    }
  }
}

TEST(LocalCurve, Law2_ShiftedRunsLater) {
  RandomRationals random;
  const Local c(random_spline<3>(random, 1, 3, 3, 2, Weights::different));
  const Local later = c.shifted("7/3"_q), twice = later.shifted("-10/3"_q);
  EXPECT_EQ(twice.shift(), -1);
  EXPECT_EQ(c.shifted("1/9"_q).shifted("-1/9"_q), c);
  for (const Rational& t : places(*c.basis().knots()))
    for (const Side side : {Side::left, Side::right}) {
      const auto expected = derivatives_at<Rational>(c, t, side, t, 3);
      const Rational at = t + "7/3"_q, before = t - Rational(1);
      EXPECT_EQ((derivatives_at<Rational>(later, at, side, at, 3)), expected);
      EXPECT_EQ((derivatives_at<Rational>(twice, before, side, before, 3)), expected);
    }
  EXPECT_TRUE(later.covers("10/3"_q, "16/3"_q));
  EXPECT_FALSE(later.covers("10/3"_q, "17/3"_q));
  EXPECT_EQ(later.breaks_between(0, 10), (std::vector<Rational>{"10/3"_q, "23/6"_q, "13/3"_q, "16/3"_q}));
  expect_same_curve(later.spline(), map_domain(c.spline(), Rational("10/3"_q), Rational("16/3"_q)));
}

TEST(LocalCurve, Law2_AWholeTurnLaterIsTheSameTurn) {
  const Local c = weighted_turn();
  const Rational t = "5/7"_q;
  expect_overlap(derivatives_at<Ball>(c.shifted(2), t, Side::right, Ball(t), 3),
                 derivatives_at<Ball>(c, t, Side::right, Ball(t), 3));
  EXPECT_NE(c.shifted(2), c);  // the same curve, but not known to be
}

// x ↦ A x + b on homogeneous points.
Vec<Rational, 3> sheared(const Vec<Rational, 3>& p) {
  return {{"3/5"_q * p[0] - "4/5"_q * p[1] + Rational(2) * p[2], p[0] + "7/3"_q * p[1] - "1/2"_q * p[2], p[2]}};
}
template <class R>
Vec<R, 2> sheared_value(const Vec<R, 2>& p, bool is_point) {
  const R w(is_point ? 1 : 0);
  return {{embed<R>("3/5"_q) * p[0] - embed<R>("4/5"_q) * p[1] + R(2) * w,
           p[0] + embed<R>("7/3"_q) * p[1] - embed<R>("1/2"_q) * w}};
}

TEST(LocalCurve, Law3_AffineMapsOfThePointsMapTheCurve) {
  RandomRationals random;
  for (const Weights weights : {Weights::one, Weights::different}) {
    const Local c(random_spline<3>(random, 0, 1, 3, 2, weights)), mapped = c.map_points(sheared);
    EXPECT_EQ(mapped.has_unit_weights(), c.has_unit_weights());
    for (const Rational& t : places(*c.basis().knots())) {
      const auto before = derivatives_at<Rational>(c, t, Side::left, t, 3),
                 after = derivatives_at<Rational>(mapped, t, Side::left, t, 3);
      for (int r = 0; r <= 3; ++r) EXPECT_EQ(after[r], sheared_value(before[r], r == 0));
    }
  }
  for (const Local& c : {weighted_turn(), trigonometric({{{1, 2, 1}}, {{3, 0, 0}}, {{0, -5, 0}}})}) {
    const Local mapped = c.map_points(sheared);
    EXPECT_EQ(mapped.has_unit_weights(), c.has_unit_weights());
    const auto before = derivatives_at<Ball>(c, Rational(0), Side::right, Ball("5/9"_q), 2),
               after = derivatives_at<Ball>(mapped, Rational(0), Side::right, Ball("5/9"_q), 2);
    for (int r = 0; r <= 2; ++r) expect_overlap(std::vector{after[r]}, std::vector{sheared_value(before[r], r == 0)});
  }
}

TEST(LocalCurve, UnitWeightsAreFoundAgainAfterAMap) {
  RandomRationals random;
  const Local c(random_spline<3>(random, 0, 1, 2, 0, Weights::one));
  const auto twice = [](Vec<Rational, 3> p) { return Rational(2) * p; };
  const auto half = [](Vec<Rational, 3> p) { return "1/2"_q * p; };
  EXPECT_FALSE(c.map_points(twice).has_unit_weights());
  EXPECT_EQ(c.map_points(twice).map_points(half), c);
  EXPECT_EQ((derivatives_at<Rational>(c.map_points(twice), Rational(0), Side::right, Rational("1/3"_q), 2)),
            (derivatives_at<Rational>(c, Rational(0), Side::right, Rational("1/3"_q), 2)));
}

TEST(LocalCurve, TrigonometricCurvesHaveAnOddNumberOfPoints) {
  for (const std::size_t count : {0u, 2u, 8u}) {
    const auto made = Local::trigonometric(std::vector<Vec<Rational, 3>>(count));
    ASSERT_FALSE(made) << count;
    EXPECT_EQ(made.error().code, ErrorCode::wrong_count);
    EXPECT_EQ(made.error().values, std::to_string(count));
  }
  EXPECT_EQ(trigonometric({{{1, 2, 1}}}).basis().count(), 1);
}

}  // namespace
}  // namespace patchproof::test
