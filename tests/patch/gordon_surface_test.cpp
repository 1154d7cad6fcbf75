// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gordon_surface.h"

#include <gtest/gtest.h>

#include "support/coons.h"

namespace patchproof::test {
namespace {

using Network = CurveNetwork<Rational, 3>;

Network network_of(const Surface& s, std::vector<Rational> us, std::vector<Rational> vs) {
  Network out{std::move(us), std::move(vs), {}, {}};
  for (const Rational& v : out.v) out.along_u.push_back(fix(s, 1, v));
  for (const Rational& u : out.u) out.along_v.push_back(fix(s, 0, u));
  return out;
}

TEST(GordonSurface, Law1_TheNetworkLiesOnTheSurface) {
  RandomRationals random;
  for (int round = 0; round < 6; ++round) {
    const Network network =
        network_of(random_patch(random, -1, "3/2"_q, 2, 5), {-1, "1/7"_q, 1, "3/2"_q}, {2, "5/2"_q, 5});
    const Surface s = gordon_surface(network).value();
    EXPECT_TRUE(contains_network(s, network));
    Network other = network;
    other.along_v[1] = other.along_v[1] + product(coordinate_function<Rational, 2>(1, 2, 5), Surface(p(0, 0, 1)));
    EXPECT_FALSE(contains_network(s, other));
    // The same network through cardinal splines instead of one polynomial.
    const auto knots = knots_of(2, {-1, -1, -1, "1/2"_q, "3/2"_q, "3/2"_q, "3/2"_q});
    const Surface splined = gordon_surface(network, knots, knots_of(1, {2, 2, "5/2"_q, 5, 5})).value();
    EXPECT_TRUE(contains_network(splined, network));
  }
}

TEST(GordonSurface, Law2_APatchOfLowDegreeIsReproduced) {
  RandomRationals random;
  const auto k = KnotVector<Rational>::bezier(3), l = KnotVector<Rational>::bezier(2);
  const Surface source = patch_over<2>(0, 1, BsplinePatch<Rational, 3>(k, l, random.points<3>(12)));
  EXPECT_TRUE(identical(gordon_surface(network_of(source, {0, "1/5"_q, "2/3"_q, 1}, {0, "1/2"_q, 1})).value(), source));
  // Either direction suffices, and none does not.
  EXPECT_TRUE(identical(gordon_surface(network_of(source, {0, 1}, {0, "1/2"_q, 1})).value(), source));
  EXPECT_FALSE(identical(gordon_surface(network_of(source, {0, 1}, {0, 1})).value(), source));
}

TEST(GordonSurface, Law3_TwoCurvesEachWayAreACoonsPatch) {
  const Sides b = reference_boundary();
  const Network network{{0, 1}, {0, 1}, {b.v_min, b.v_max}, {b.u_min, b.u_max}};
  EXPECT_TRUE(identical(gordon_surface(network).value(), coons_patch(b).value()));
}

// A curve that jumps where another crosses it has no one point there, whichever of its two ends the other one meets.
TEST(GordonSurface, Law1_AJumpAtACrossingIsNoCrossing) {
  for (const int z : {0, 5}) {
    const auto jump = knots_of(1, {0, 0, 1, 1, 2, 2});
    const auto along_u = [&](int y) {
      return Surface::blend(0, jump, {p(0, y, 0), p(1, y, 0), p(1, y, 5), p(2, y, 5)}).value();
    };
    const auto along_v = [](int x, int height) { return bezier(1, {p(x, 0, height), p(x, 1, height)}); };
    const Network network{{0, 1, 2}, {0, 1}, {along_u(0), along_u(1)}, {along_v(0, 0), along_v(1, z), along_v(2, 5)}};
    const auto s = gordon_surface(network);
    ASSERT_FALSE(s);
    EXPECT_EQ(s.error().code, ErrorCode::curves_apart);
    EXPECT_EQ(s.error().where, "u = 1, v = 0");
  }
}

TEST(GordonSurface, BadNetworksAreNamed) {
  RandomRationals random;
  const Network good = network_of(random_patch(random, 0, 1, 0, 1), {0, "1/2"_q, 1}, {0, 1});
  Network bad = good;
  bad.along_v[1] = bad.along_v[1] + Surface(p(0, 0, "1/1000000"_q));
  const auto apart = gordon_surface(bad);
  ASSERT_FALSE(apart);
  EXPECT_EQ(apart.error().code, ErrorCode::curves_apart);
  EXPECT_EQ(apart.error().where, "u = 1/2, v = 0");
  EXPECT_NE(apart.error().message.find("curve 0 along u and curve 1 along v"), std::string::npos);
  bad = good;
  bad.along_v.pop_back();
  EXPECT_EQ(gordon_surface(bad).error().code, ErrorCode::wrong_count);
  bad = good;
  bad.u = {0, "1/2"_q, "1/2"_q};
  EXPECT_EQ(gordon_surface(bad).error().code, ErrorCode::decreasing_knots);
  bad = good;
  bad.u = {0, "1/2"_q, 2};
  EXPECT_EQ(gordon_surface(bad).error().code, ErrorCode::domains_differ);
  EXPECT_EQ(gordon_surface(Network{}).error().code, ErrorCode::wrong_count);
  const auto knots = knots_of(1, {0, 0, "3/4"_q, 1, 1});
  bad = good;
  bad.u = {0, "1/8"_q, "1/2"_q};
  EXPECT_EQ(gordon_surface(bad, knots, KnotVector<Rational>::bezier(1)).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace patchproof::test
