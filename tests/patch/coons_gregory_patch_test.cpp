// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/coons_gregory_patch.h"

#include <gtest/gtest.h>

#include "support/coons.h"

namespace patchproof::test {
namespace {

// A function along a side that changes neither its ends nor, at its end, its derivative: at its begin that by `twist`.
Surface twisting(std::size_t s, const Vec<Rational, 3>& twist, const Rational& begin, const Rational& end) {
  return bezier(s, {p(0, 0, 0), (end - begin) / Rational(3) * twist, p(0, 0, 0), p(0, 0, 0)}, begin, end);
}

struct Data {
  Sides boundary, across;
};
// Twists that disagree in `corners` corners.
Data twisted_data(RandomRationals& random, int corners) {
  const Surface source = random_patch(random, -1, "3/2"_q, 2, 5);
  Data data{sides_of(source), across_of(source)};
  if (corners > 0) data.across.v_min = data.across.v_min + twisting(0, random.point<3>() + p(50, 0, 0), -1, "3/2"_q);
  if (corners > 1) data.across.u_max = data.across.u_max + twisting(1, random.point<3>() + p(50, 0, 0), 2, 5);
  if (corners > 2) data.across.v_max = data.across.v_max + twisting(0, random.point<3>() + p(50, 0, 0), -1, "3/2"_q);
  return data;
}

TEST(CoonsGregoryPatch, Law1_EverythingIsInterpolated) {
  RandomRationals random;
  for (int corners = 0; corners <= 3; ++corners) {
    const Data data = twisted_data(random, corners);
    const auto patch = CoonsGregoryPatch<Rational, 3>::make(data.boundary, data.across);
    ASSERT_TRUE(patch);
    EXPECT_TRUE(interpolates_everywhere(*patch, data.boundary, data.across)) << corners;
    Data other = data;
    other.across.u_min = other.across.u_min + twisting(1, p(0, 0, 1), 2, 5);
    EXPECT_FALSE(interpolates_everywhere(*patch, other.boundary, other.across));
    if (corners > 0) {
      EXPECT_EQ(bicubic_coons_patch(data.boundary, data.across).error().code, ErrorCode::twists_differ);
      EXPECT_FALSE(interpolates_across(patch->bicubic(), data.across));  // what the correction is for
    }
  }
}

TEST(CoonsGregoryPatch, Law2_CornersHaveTheirTangents) {
  RandomRationals random;
  const Data data = twisted_data(random, 3);
  const auto patch = CoonsGregoryPatch<Rational, 3>::make(data.boundary, data.across).value();
  for (const Rational& u : {"-1"_q, "3/2"_q})
    for (const Rational& v : {"2"_q, "5"_q}) {
      const auto place = place_of<2>({u, v});
      const auto& side = v == 2 ? data.boundary.v_min : data.boundary.v_max;
      const auto& rate = v == 2 ? data.across.v_min : data.across.v_max;
      EXPECT_EQ(evaluate(patch, place), evaluate(side, place));
      const auto t = taylor(patch, place, 1);
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(t[c].derivative({1, 0}), evaluate(derivative(side, 0), place)[c]);
        EXPECT_EQ(t[c].derivative({0, 1}), evaluate(rate, place)[c]);
      }
      if (patch.has_pole_in_corner(place)) {
        EXPECT_THROW(taylor(patch, place, 2), contract_error);
      }
    }
}

// Near a corner the first derivatives tend to those in it: along every ray by a factor of the distance.
TEST(CoonsGregoryPatch, Law2_FirstDerivativesAreContinuousInACorner) {
  RandomRationals random;
  const Data data = twisted_data(random, 1);
  const auto patch = CoonsGregoryPatch<Rational, 3>::make(data.boundary, data.across).value();
  const auto corner = taylor(patch, place_of<2>({-1, 2}), 1);
  for (const auto& [du, dv] : {std::pair{"1"_q, "1"_q}, std::pair{"1"_q, "1000"_q}, std::pair{"1000"_q, "1"_q}}) {
    const Rational step = Rational(1) / Rational(1LL << 50);
    const auto near = taylor(patch, place_of<2>({-1 + du * step, 2 + dv * step}), 1);
    for (int c = 0; c < 3; ++c)
      for (const std::array<int, 2> alpha : {std::array{1, 0}, std::array{0, 1}}) {
        const Rational change = near[c].derivative(alpha) - corner[c].derivative(alpha);
        EXPECT_LE(abs(change), Rational(1000 * 100000) * step);
      }
  }
}

TEST(CoonsGregoryPatch, Law3_EqualTwistsGiveTheBicubicPatch) {
  RandomRationals random;
  const Data data = twisted_data(random, 0);
  const auto patch = CoonsGregoryPatch<Rational, 3>::make(data.boundary, data.across).value();
  EXPECT_TRUE(identical(patch.bicubic(), bicubic_coons_patch(data.boundary, data.across).value()));
  for (const Rational& u : {"-1"_q, "1/3"_q, "3/2"_q})
    for (const Rational& v : {"2"_q, "7/2"_q, "5"_q})
      EXPECT_EQ(evaluate(patch, place_of<2>({u, v})), evaluate(patch.bicubic(), place_of<2>({u, v})));
}

TEST(CoonsGregoryPatch, BadDataIsNamed) {
  RandomRationals random;
  Data data = twisted_data(random, 1);
  data.across.v_max = data.across.v_max + Surface(p(0, 1, 0));
  const auto patch = CoonsGregoryPatch<Rational, 3>::make(data.boundary, data.across);
  ASSERT_FALSE(patch);
  EXPECT_EQ(patch.error().code, ErrorCode::curves_apart);
}

}  // namespace
}  // namespace patchproof::test
