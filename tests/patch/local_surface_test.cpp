// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/local_surface.h"

#include <gtest/gtest.h>

#include "support/gerbs_surfaces.h"

namespace patchproof::test {
namespace {

constexpr Weights kWeights[] = {Weights::one, Weights::common, Weights::different};
const ParameterBox<Rational> kBox{0, 2, -1, 3};
const TrigonometricFunctions kTurn{1};

std::vector<Place> some_places() {
  std::vector<Place> out;
  for (const Rational& u : {Rational(0), "1/2"_q, "3/2"_q, Rational(2)})
    for (const Rational& v : {Rational(-1), Rational(0), "7/3"_q, Rational(3)})
      for (const Side side : {Side::left, Side::right}) out.push_back({u, v, side, Side::left});
  return out;
}

// A torus with radii 3 and 1 by angle; weight 1.
SurfaceLocal torus() {
  std::vector<Vec<Rational, 4>> net(9);
  net[0] = {{0, 0, 0, 1}};  // (3 + cos πv) cos πu, (3 + cos πv) sin πu, sin πv
  net[2] = {{0, 0, 1, 0}};
  net[3] = {{3, 0, 0, 0}};
  net[4] = {{1, 0, 0, 0}};
  net[6] = {{0, 3, 0, 0}};
  net[7] = {{0, 1, 0, 0}};
  return SurfaceLocal::make(kTurn, kTurn, net).value();
}

TEST(LocalSurface, Law1_SplinesOfEveryWeight) {
  RandomRationals random;
  for (const Weights weights : kWeights) {
    const SurfaceLocal c(random_patch(random, kBox, true, weights));
    EXPECT_EQ(c.has_unit_weights(), weights == Weights::one);
    for (const Place& at : some_places())
      EXPECT_EQ(partials<Rational>(c, at, 3, 2), reference_derivatives<Rational>(c, at, 3, 2));
  }
}

template <class T>
class LocalSurfaceScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(LocalSurfaceScalars, AllScalars, ScalarNames);

TYPED_TEST(LocalSurfaceScalars, Law1_InEveryScalar) {
  RandomRationals random;
  for (const Weights weights : kWeights) {
    const SurfaceLocal c(random_patch(random, kBox, true, weights));
    const Place at{"3/4"_q, "-1/4"_q, Side::left, Side::right};
    check<TypeParam>(reference_derivatives<Rational>(c, at, 2, 2), [&]<class S>() { return partials<S>(c, at, 2, 2); });
  }
}

TEST(LocalSurface, Law1_TrigonometricInOneDirectionOrTwo) {
  RandomRationals random;
  const auto knots = KnotVector<Rational>::make(2, {-1, -1, -1, 0, 3, 3, 3}).value();
  std::vector<Vec<Rational, 4>> net = random.points<4>(12);
  for (std::size_t k = 0; k < net.size(); ++k)
    net[k][3] = k < 4 ? Rational(2) : Rational(1) / Rational(4);  // 2 + (cos + sin)/4
  const SurfaceLocal mixed = SurfaceLocal::make(kTurn, knots, net).value();
  EXPECT_TRUE(mixed.is_trigonometric());
  EXPECT_FALSE(mixed.has_unit_weights());
  EXPECT_TRUE(torus().has_unit_weights());
  for (const Place& at : some_places())
    for (const SurfaceLocal& c : {mixed, torus()})
      expect_overlap(partials<Ball>(c, at, 2, 2), reference_derivatives<Ball>(c, at, 2, 2));
  // (3 + cos πv)² = x² + y², where x² + y² + z² = 10 + 6 cos πv
  const auto p = partials<double>(torus(), {"1/2"_q, 1, Side::right, Side::right}, 0, 0)[0];
  EXPECT_EQ(p, (Vec<double, 3>{{0, 2, 0}}));
}

TEST(LocalSurface, Law2_ShiftedLiesFurther) {
  RandomRationals random;
  const SurfaceLocal c(random_patch(random, kBox, true, Weights::different)),
      far = c.shifted("5/3"_q, -4).shifted(1, 1);
  EXPECT_EQ(far.shift(Direction::u), "8/3"_q);
  EXPECT_EQ(far.shift(Direction::v), -3);
  for (const Place& at : some_places())
    EXPECT_EQ(partials<Rational>(far, {at.u + "8/3"_q, at.v - Rational(3), at.side_u, at.side_v}, 2, 2),
              partials<Rational>(c, at, 2, 2));
  EXPECT_TRUE(far.covers(Direction::u, "8/3"_q, "14/3"_q));
  EXPECT_FALSE(far.covers(Direction::u, "8/3"_q, 5));
  EXPECT_TRUE(far.covers(Direction::v, -4, 0));
  EXPECT_FALSE(far.covers(Direction::v, -5, 0));
  EXPECT_EQ(far.breaks_between(Direction::u, 0, 10), (std::vector<Rational>{"8/3"_q, "19/6"_q, "14/3"_q}));
  EXPECT_TRUE(torus().shifted("1/7"_q, 5).covers(Direction::v, -100, 100));
  EXPECT_EQ(far.patch().net(), c.patch().net());
}

TEST(LocalSurface, Law3_AffineMapsOfThePointsMapTheSurface) {
  RandomRationals random;
  const auto map = [](const Vec<Rational, 4>& p) {
    return Vec<Rational, 4>{
        {Rational(2) * p[0] - p[2] + "1/3"_q * p[3], p[1] + "3/2"_q * p[0], p[2] - Rational(7) * p[3], p[3]}};
  };
  const auto mapped = []<class R>(const Partials<R>& before) {
    Partials<R> out;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const R w(k == 0 ? 1 : 0);
      const Vec<R, 3>& p = before[k];
      out.push_back({{R(2) * p[0] - p[2] + embed<R>("1/3"_q) * w, p[1] + embed<R>("3/2"_q) * p[0], p[2] - R(7) * w}});
    }
    return out;
  };
  for (const Weights weights : kWeights) {
    const SurfaceLocal c(random_patch(random, kBox, true, weights));
    for (const Place& at : some_places())
      EXPECT_EQ(partials<Rational>(c.map_points(map), at, 2, 1), mapped(partials<Rational>(c, at, 2, 1)));
  }
  for (const Place& at : some_places())
    expect_overlap(partials<Ball>(torus().map_points(map), at, 2, 1), mapped(partials<Ball>(torus(), at, 2, 1)));
}

TEST(LocalSurface, Law4_EdgeCurvesAndDerivativesAcross) {
  RandomRationals random;
  for (const Weights weights : kWeights)
    for (const Direction constant : {Direction::u, Direction::v})
      for (const Side side : {Side::left, Side::right}) {
        const SurfaceLocal c = SurfaceLocal(random_patch(random, kBox, true, weights)).shifted("1/3"_q, 2);
        const bool of_u = constant == Direction::u;
        for (const Rational& line : {Rational(0), "1/2"_q, Rational(2)})
          for (int order = 0; order <= (weights == Weights::one ? 1 : 0); ++order) {
            const Rational at = of_u ? Rational(line + "1/3"_q) : Rational(Rational(2) * line + Rational(1));
            const auto curve = edge_curve(c, constant, at, side, order);
            for (const Rational& t : {"1/2"_q, Rational(1), "7/3"_q}) {
              const Place place = of_u ? Place{at, t + Rational(1), side, Side::left} : Place{t, at, Side::left, side};
              const Rational along = of_u ? place.v : place.u;
              auto expected =
                  of_u ? partials<Rational>(c, place, order, 0).back() : partials<Rational>(c, place, 0, order).back();
              EXPECT_EQ((derivatives_at<Rational>(curve, along, Side::left, along, 0)[0]), expected);
            }
          }
      }
}

TEST(LocalSurface, Law4_EdgeOfATrigonometricSurface) {
  // A cylinder: a circle along u, lines along v.
  std::vector<Vec<Rational, 4>> net(6);
  net[0] = {{0, 0, 0, 1}};
  net[1] = {{0, 0, 5, 1}};
  net[2] = net[3] = {{2, 0, 0, 0}};
  net[4] = net[5] = {{0, 2, 0, 0}};
  const SurfaceLocal c = SurfaceLocal::make(kTurn, KnotVector<Rational>::bezier(1), net).value();
  const auto across = edge_curve(c, Direction::v, Rational(1), Side::left, 1);
  for (const Rational& u : {Rational(0), "1/3"_q, "9/7"_q}) {
    const auto edge = edge_curve(c, Direction::v, Rational(1), Side::left);
    const Place at{u, 1, Side::right, Side::left};
    expect_overlap(derivatives_at<Ball>(edge, u, Side::right, Ball(u), 0), partials<Ball>(c, at, 0, 0));
    const auto direction = derivatives_at<Ball>(across, u, Side::right, Ball(u), 1);
    EXPECT_TRUE(direction[0][0].contains(0) && direction[0][1].contains(0) && direction[0][2].contains(5));
  }
}

TEST(LocalSurface, NetsThatDoNotFit) {
  for (const std::size_t count : {0u, 8u, 10u}) {
    const auto made = SurfaceLocal::make(kTurn, kTurn, std::vector<Vec<Rational, 4>>(count));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::wrong_count);
    EXPECT_EQ(made.error().values, std::to_string(count));
    EXPECT_EQ(made.error().message, "the functions need 3 x 3 control points");
  }
}

}  // namespace
}  // namespace patchproof::test
