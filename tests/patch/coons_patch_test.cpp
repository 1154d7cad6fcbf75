// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/coons_patch.h"

#include <gtest/gtest.h>

#include "patchproof/patch/transfinite_expand.h"
#include "support/coons.h"

namespace patchproof::test {
namespace {

Vec<Rational, 3> derivative_at(const Surface& s, const Rational& u, const Rational& v, int k, int l) {
  const auto t = taylor(s, place_of<2>({u, v}), k + l);
  return {{t[0].derivative({k, l}), t[1].derivative({k, l}), t[2].derivative({k, l})}};
}

TEST(CoonsPatch, ReferenceValues) {
  const Surface s = coons_patch(reference_boundary()).value();
  EXPECT_EQ(derivative_at(s, "1/4"_q, "1/2"_q, 0, 0), p("5/2"_q, 5, "627/256"_q));
  EXPECT_EQ(derivative_at(s, "1/4"_q, "1/2"_q, 1, 0), p(10, 0, "-27/16"_q));
  EXPECT_EQ(derivative_at(s, "1/4"_q, "1/2"_q, 0, 1), p(0, "55/4"_q, "99/128"_q));
  EXPECT_EQ(derivative_at(s, "1/4"_q, "1/2"_q, 1, 1), p(0, -5, "-15/8"_q));
  EXPECT_EQ(derivative_at(s, "1/2"_q, "1/2"_q, 0, 0), p(5, 5, "33/16"_q));
  EXPECT_EQ(derivative_at(s, 1, 1, 0, 0), p(10, 10, 0));
  EXPECT_EQ(derivative_at(s, 1, 1, 1, 1), p(0, 10, -9));
}

// The printed sum adds the corner term, and takes the curves themselves for the corners.
TEST(CoonsPatch, Erratum_E_LAR_01_TheCornerTermIsSubtracted) {
  const Sides b = reference_boundary();
  const auto u = coordinate_function<Rational, 2>(0), v = coordinate_function<Rational, 2>(1);
  const Function one(Vec<Rational, 1>{{Rational(1)}});
  const Surface printed = product(one - v, b.v_min) + product(v, b.v_max) + product(one - u, b.u_min) +
                          product(u, b.u_max) + product(product(one - u, one - v), b.u_min) +
                          product(product(one - u, v), b.u_min) + product(product(u, one - v), b.u_max) +
                          product(product(u, v), b.u_max);
  EXPECT_EQ(evaluate(printed, place_of<2>({1, 1})), p(30, 30, 0));
  EXPECT_EQ(evaluate(printed, place_of<2>({"1/2"_q, "1/2"_q})), p(15, 15, "63/16"_q));
  EXPECT_FALSE(interpolates(printed, b));
  // Its weights sum to 3: it is not even affinely invariant.
  EXPECT_TRUE(interpolates(coons_patch(b).value(), b));
}

TEST(CoonsPatch, Law1_BoundariesAreInterpolatedIdentically) {
  RandomRationals random;
  for (int round = 0; round < 12; ++round) {
    const Sides b = sides_of(random_patch(random, -1, "3/2"_q, 1000000, 1000003));
    const Surface s = coons_patch(b).value();
    EXPECT_TRUE(interpolates(s, b));
    // Wrong in one of the four, by a curve that keeps the corners.
    Sides other = b;
    const auto along = coordinate_function<Rational, 2>(1, 1000000, 1000003);
    const auto from = [&](const Rational& t) { return along - Function(Vec<Rational, 1>{{t}}); };
    other.u_max = other.u_max + product(product(from(1000000), from(1000003)), Surface(p(0, 0, "1/1000000"_q)));
    EXPECT_FALSE(interpolates(s, other));
    EXPECT_TRUE(interpolates(coons_patch(other).value(), other));
  }
}

TEST(CoonsPatch, Law2_DerivativesAcrossAreInterpolatedIdentically) {
  RandomRationals random;
  for (int round = 0; round < 8; ++round) {
    const Surface source = random_patch(random, -1, "3/2"_q, 2, 5);
    const Sides b = sides_of(source), a = across_of(source);
    const Surface s = bicubic_coons_patch(b, a).value();
    EXPECT_TRUE(interpolates(s, b));
    EXPECT_TRUE(interpolates_across(s, a));
  }
}

// A surface that is cubic in both directions is given back by its own boundary data.
TEST(CoonsPatch, Law2_ABicubicSurfaceIsReproduced) {
  RandomRationals random;
  const auto k = KnotVector<Rational>::bezier(3);
  const Surface source = patch_over<2>(0, 1, BsplinePatch<Rational, 3>(k, k, random.points<3>(16)));
  EXPECT_TRUE(identical(bicubic_coons_patch(sides_of(source), across_of(source)).value(), source));
  EXPECT_FALSE(identical(coons_patch(sides_of(source)).value(), source));
  EXPECT_FALSE(interpolates_across(coons_patch(sides_of(source)).value(), across_of(source)));
}

TEST(CoonsPatch, Law3_AffineMapsOfTheData) {
  const auto linear = [](const Vec<Rational, 3>& x) { return p(x[0] + 2 * x[1], x[2] - x[0], 3 * x[1] + x[2] / 2); };
  const auto image = [&](const Surface& s) { return linear_image(s, linear) + Surface(p(7, -1, "1/3"_q)); };
  const Sides b = reference_boundary();
  const Sides mapped{image(b.v_min), image(b.v_max), image(b.u_min), image(b.u_max)};
  EXPECT_TRUE(identical(coons_patch(mapped).value(), image(coons_patch(b).value())));
}

TEST(CoonsPatch, Law4_ABilinearPatchIsReproduced) {
  RandomRationals random;
  const auto k = KnotVector<Rational>::bezier(1);
  const Surface source = patch_over<2>(0, 1, BsplinePatch<Rational, 3>(k, k, random.points<3>(4)));
  EXPECT_TRUE(identical(coons_patch(sides_of(source)).value(), source));
}

TEST(CoonsPatch, DegenerateEdgesArePoints) {
  const Surface apex(p(0, 0, 4));
  const Sides b{bezier(0, {p(0, 0, 0), p(1, 2, 0), p(3, 0, 0)}), apex, bezier(1, {p(0, 0, 0), p(0, 0, 4)}),
                bezier(1, {p(3, 0, 0), p(2, 2, 2), p(0, 0, 4)})};
  const Surface s = coons_patch(b).value();
  EXPECT_TRUE(interpolates(s, b));
  EXPECT_EQ(evaluate(s, place_of<2>({"1/3"_q, 1})), p(0, 0, 4));
  const auto patch = to_bspline_patch(s);
  EXPECT_EQ(patch.degree(Direction::u), 2);
  EXPECT_EQ(patch.degree(Direction::v), 2);
  EXPECT_TRUE(interpolates(coons_patch(Sides{apex, apex, apex, apex}).value(), Sides{apex, apex, apex, apex}));
}

using HomogeneousMap = TransfiniteMap<Rational, 2, 4>;
HomogeneousMap lifted(const Surface& s) {
  return linear_image(s,
                      [](const Vec<Rational, 3>& x) {
                        return Vec<Rational, 4>{{x[0], x[1], x[2], Rational(0)}};
                      }) +
         HomogeneousMap(Vec<Rational, 4>{{Rational(0), Rational(0), Rational(0), Rational(1)}});
}
HomogeneousMap rational(std::size_t s, std::vector<Vec<Rational, 4>> points) {
  return HomogeneousMap::bezier(s, {points.begin(), points.end()}).value();
}

TEST(CoonsPatch, Law5_FactorsOfHomogeneousBoundariesDoNotMatter) {
  const Sides b = reference_boundary();
  const HomogeneousMap expected = lifted(coons_patch(b).value());
  const auto weight = [](std::size_t s, const Rational& a, const Rational& c) {
    return TransfiniteMap<Rational, 2, 1>::bezier(s, {Vec<Rational, 1>{{a}}, Vec<Rational, 1>{{c}}}).value();
  };
  const FourSides<Rational, 4> one_factor{product(weight(0, 1, 3), lifted(b.v_min)), lifted(b.v_max), lifted(b.u_min),
                                          lifted(b.u_max)};
  const FourSides<Rational, 4> factors{
      product(weight(0, 1, 3), lifted(b.v_min)), product(weight(0, 2, 5), lifted(b.v_max)),
      product(weight(1, 7, 1), lifted(b.u_min)), product(weight(1, "1/2"_q, 1), lifted(b.u_max))};
  for (const auto& boundary : {one_factor, factors}) {
    const HomogeneousMap s = rational_coons_patch(boundary).value();
    EXPECT_TRUE(identical_points(s, expected));
    EXPECT_TRUE(interpolates_points(s, boundary));
  }
}

// Three sides of a square and a quarter of a circle.
TEST(CoonsPatch, Law5_ACircularSide) {
  const FourSides<Rational, 4> b{rational(0, {{{2, 0, 0, 1}}, {{3, 0, 0, 1}}}),
                                 rational(0, {{{0, 2, 0, 1}}, {{0, 3, 0, 1}}}),
                                 rational(1, {{{2, 0, 0, 1}}, {{2, 2, 0, 1}}, {{0, 4, 0, 2}}}),
                                 rational(1, {{{3, 0, 0, 1}}, {{3, 3, 1, 1}}, {{0, 6, 0, 2}}})};
  const HomogeneousMap s = rational_coons_patch(b).value();
  EXPECT_TRUE(interpolates_points(s, b));
  const auto patch = to_bspline_patch(s);
  EXPECT_EQ(patch.degree(Direction::u), 1);  // both arcs have one denominator
  EXPECT_EQ(patch.degree(Direction::v), 3);
  const auto x = evaluate_rational(s, place_of<2>({0, "1/2"_q}));
  EXPECT_EQ(Rational(x[0] * x[0] + x[1] * x[1]), Rational(4));
}

TEST(CoonsPatch, BadDataNamesTheCorner) {
  Sides b = reference_boundary();
  b.u_min = bezier(1, {p(0, 0, 0), p(0, 0, 3), p(0, 10, 3), p(0, 10, "1/1000000000"_q)});
  const auto apart = coons_patch(b);
  ASSERT_FALSE(apart);
  EXPECT_EQ(apart.error().code, ErrorCode::curves_apart);
  EXPECT_EQ(apart.error().where, "corner u_min, v_max");
  EXPECT_EQ(apart.error().values, "(0, 10, 0) and (0, 10, 1/1000000000)");
  b = reference_boundary();
  b.v_max = bezier(0, {p(0, 10, 0), p(10, 10, 0)}, 0, 2);
  EXPECT_EQ(coons_patch(b).error().code, ErrorCode::domains_differ);
  b = reference_boundary();
  b.v_max = b.u_min;
  EXPECT_THROW(coons_patch(b), contract_error);  // it runs along v

  const Surface source = coons_patch(reference_boundary()).value();
  Sides across = across_of(source);
  across.v_min = across.v_min + Surface(p(0, 0, 1));
  EXPECT_EQ(bicubic_coons_patch(reference_boundary(), across).error().code, ErrorCode::curves_apart);
  across = across_of(source);
  across.u_min = across.u_min + bezier(1, {p(0, 0, 0), p(0, 0, 1), p(0, 0, 0), p(0, 0, 0)});
  const auto twisted = bicubic_coons_patch(reference_boundary(), across);
  ASSERT_FALSE(twisted);
  EXPECT_EQ(twisted.error().code, ErrorCode::twists_differ);
  EXPECT_EQ(twisted.error().where, "corner u_min, v_min");

  FourSides<Rational, 4> rational_sides{
      rational(0, {{{0, 0, 0, 1}}, {{1, 0, 0, 1}}}), rational(0, {{{0, 1, 0, 1}}, {{1, 1, 0, 1}}}),
      rational(1, {{{0, 0, 0, 1}}, {{0, 2, 0, 1}}}), rational(1, {{{1, 0, 0, 1}}, {{1, 1, 0, 1}}})};
  EXPECT_EQ(rational_coons_patch(rational_sides).error().where, "corner u_min, v_max");
}

}  // namespace
}  // namespace patchproof::test
