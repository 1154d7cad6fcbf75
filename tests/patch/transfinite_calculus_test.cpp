// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/transfinite_calculus.h"

#include <gtest/gtest.h>

#include "support/transfinite.h"

namespace patchproof::test {
namespace {

// Places at and between the knots 1/4, 1/2, 3/4 of random_surface, from both sides.
template <class F>
void for_each_place(F f) {
  for (const Rational& u : {"0"_q, "1/4"_q, "3/10"_q, "1/2"_q, "1"_q})
    for (const Rational& v : {"0"_q, "1/3"_q, "3/4"_q, "1"_q})
      for (const Side side : {Side::left, Side::right}) f(place_of<2>({u, v}, side));
}

Vec<Rational, 3> first_derivative(const Surface& s, const ParameterPlace<Rational, 2>& place, std::size_t coordinate) {
  const auto t = taylor(s, place, 1);
  std::array<int, 2> alpha{};
  alpha[coordinate] = 1;
  return {{t[0].derivative(alpha), t[1].derivative(alpha), t[2].derivative(alpha)}};
}

TEST(TransfiniteCalculus, Law1_FixAndDerivativeAreThoseOfTheMap) {
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Surface s = random_surface(random, 3);
    for_each_place([&](const ParameterPlace<Rational, 2>& place) {
      for (const std::size_t c : {0, 1}) {
        const Surface fixed = fix(s, c, place.at[c], place.sides[c]);
        EXPECT_FALSE(fixed.dependence(c));
        EXPECT_EQ(evaluate(fixed, place), evaluate(s, place));
        EXPECT_EQ(evaluate(derivative(s, c), place), first_derivative(s, place, c));
      }
    });
  }
}

TEST(TransfiniteCalculus, Law2_DifferentCoordinatesCommute) {
  RandomRationals random;
  for (int round = 0; round < 15; ++round) {
    const Surface s = random_surface(random, 3);
    EXPECT_TRUE(identical(derivative(derivative(s, 0), 1), derivative(derivative(s, 1), 0)));
    const Rational t = random.unit();
    EXPECT_TRUE(identical(fix(derivative(s, 0), 1, t), derivative(fix(s, 1, t), 0)));
  }
}

TEST(TransfiniteCalculus, Law3_IdenticalMapsAreFound) {
  RandomRationals random;
  for (int round = 0; round < 15; ++round) {
    const Surface a = random_surface(random, 2), b = random_surface(random, 2);
    const auto u = coordinate_function<Rational, 2>(0);
    EXPECT_TRUE(identical(a + b, b + a));
    EXPECT_TRUE(identical(product(u, a - b), product(u, a) - product(u, b)));
    // A difference that is zero at both ends of u, and at every sample of a coarse grid.
    const Function one(Vec<Rational, 1>{{Rational(1)}});
    Function bump = one;
    for (const Rational& root : {"0"_q, "1/4"_q, "1/2"_q, "3/4"_q, "1"_q})
      bump = product(bump, u - Function(Vec<Rational, 1>{{root}}));
    EXPECT_FALSE(identical(a, a + product(bump, Surface(p(0, 0, "1/1000000000000"_q)))));
  }
}

// Two maps that differ on one span only.
TEST(TransfiniteCalculus, Law3_ADifferenceOnOneSpanIsSeen) {
  const auto k = knots_of(1, {0, 0, "1/2"_q, "1/2"_q, 1, 1});
  const auto along = [&](const Rational& z) {
    return Surface::blend(0, k, {p(0, 0, 0), p(1, 0, 0), p(1, 0, 0), p(2, 0, z)}).value();
  };
  EXPECT_FALSE(identical(along(0), along(1)));
  EXPECT_TRUE(identical(along(1), along(1)));
  // The constant 0 is the same over any domain; two curves over different domains are not.
  const Surface longer = bezier(0, {p(0, 0, 0), p(1, 0, 0)}, 0, 2), shorter = bezier(0, {p(0, 0, 0), p(1, 0, 0)});
  EXPECT_FALSE(identical(longer, shorter));
  EXPECT_TRUE(identical(longer - longer, Surface(p(0, 0, 0))));
}

TEST(TransfiniteCalculus, Law4_PointsWhateverTheFactor) {
  using Map = TransfiniteMap<Rational, 2, 4>;
  RandomRationals random;
  for (int round = 0; round < 10; ++round) {
    std::vector<Map> controls;
    for (int i = 0; i < 4; ++i) controls.push_back(random.point<4>());
    const Map s = Map::bezier(0, controls).value();
    const auto factor =
        TransfiniteMap<Rational, 2, 1>::bezier(1, {Vec<Rational, 1>{{"2"_q}}, Vec<Rational, 1>{{"5"_q}}});
    EXPECT_TRUE(identical_points(s, product(*factor, s)));
    EXPECT_FALSE(identical(s, product(*factor, s)));
    controls[2] = Map(random.point<4>());
    EXPECT_FALSE(identical_points(s, Map::bezier(0, controls).value()));
  }
}

TEST(TransfiniteCalculus, BreaksAreThoseOfEveryBlend) {
  const Surface s = four_curves();
  EXPECT_EQ(breaks(s, 0), (std::vector<Rational>{0, 1}));
  const auto k = knots_of(1, {0, 0, "1/2"_q, 1, 1}), m = knots_of(2, {0, 0, 0, "1/3"_q, "1/3"_q, 1, 1, 1});
  const Surface a = Surface::blend(0, k, {p(0, 0, 0), p(1, 0, 0), p(0, 1, 0)}).value();
  const Surface b = Surface::blend(0, m, {p(0, 0, 0), p(1, 0, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)}).value();
  EXPECT_EQ(breaks(a + b, 0), (std::vector<Rational>{0, "1/3"_q, "1/2"_q, 1}));
  EXPECT_EQ(breaks(a + b, 1), (std::vector<Rational>{0, 1}));
}

TEST(TransfiniteCalculus, FixedOutsideTheDomainIsRefused) {
  EXPECT_THROW(fix(four_curves(), 0, "3/2"_q), contract_error);
}

}  // namespace
}  // namespace patchproof::test
