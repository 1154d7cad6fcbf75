// SPDX-License-Identifier: Apache-2.0
// A gap exceeds a tolerance only where a point of one edge is that far from the whole of the other.
#include "join/trimmed_distance.h"

#include <gtest/gtest.h>

#include "patchproof/scalar/interval.h"

namespace patchproof {
namespace {

using Surface = BsplinePatch<Rational, 4>;
Rational q(int a, int b = 1) { return Rational(a, b); }

// A plane strip along x, over [0, 1]², lifted by z and turned up to either side.
Surface strip(const Rational& z, int side) {
  const auto point = [&](const Rational& x, const Rational& y) { return Vec<Rational, 4>{{x, y, z, 1}}; };
  return Surface(KnotVector<Rational>::bezier(1), KnotVector<Rational>::bezier(1),
                 {point(0, 0), point(0, side), point(1, 0), point(1, side)});
}

// The line v = 0 of a strip, run through with u = t² or u = t (2 − t).
TrimmedSide edge_of(const Surface& surface, bool slow_first) {
  const Rational middle = slow_first ? q(0) : q(1);
  return {&surface,
          BsplineCurve<Rational, 3>(KnotVector<Rational>::bezier(2), {{{0, 0, 1}}, {{middle, 0, 1}}, {{1, 0, 1}}}),
          false};
}

Certificate certify(const Surface& a, const Surface& b, double tolerance) {
  Request request;
  request.gap_tolerance = tolerance;
  return certify_trimmed({edge_of(a, true), edge_of(b, false)}, request);
}

TEST(TrimmedDistance, IsALowerBoundOfTheDistance) {
  const Surface surface = strip(0, 1);
  const RoundingGuard guard;
  const double above = distance_from_edge({{q(1, 3), 0, q(1, 4)}}, edge_of(surface, true), 0.2);
  EXPECT_GT(above, 0.2);
  EXPECT_LE(above, 0.25);
  const double beyond = distance_from_edge({{q(3), 0, 0}}, edge_of(surface, true), 1.9);
  EXPECT_GT(beyond, 1.9);
  EXPECT_LE(beyond, 2);
  EXPECT_LE(distance_from_edge({{q(1, 3), 0, 0}}, edge_of(surface, true), 0.01), 0.01);
}

// One straight edge, run through at two paces: paired points are up to 1/2 apart, the edges are not.
TEST(TrimmedDistance, PairsAlongTheEdgeFailNoTolerance) {
  const Surface a = strip(0, 1), b = strip(0, -1);
  const Certificate c = certify(a, b, 0.1);
  EXPECT_GE(c.gap.upper, 0.5);
  EXPECT_LE(c.gap.lower, 0.1);
  Request request;
  request.gap_tolerance = 0.1;
  EXPECT_EQ(judge(c, request).outcome, Outcome::undecided);
}

TEST(TrimmedDistance, EdgesThatAreApartFail) {
  const Surface a = strip(0, 1), b = strip(q(1, 5), -1);
  Request request;
  request.gap_tolerance = 0.1;
  const Certificate c = certify(a, b, 0.1);
  EXPECT_GT(c.gap.lower, 0.1);
  EXPECT_EQ(judge(c, request).outcome, Outcome::fail);
  request.gap_tolerance = 0.25;
  EXPECT_NE(judge(certify(a, b, 0.25), request).outcome, Outcome::fail);
}

}  // namespace
}  // namespace patchproof
