// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/chord_bound.h"

#include <numbers>

#include "mesh/mesh_proofs.h"

namespace patchproof {
namespace {

using namespace test;

double number(const Vec<Rational, 3>& v, std::size_t c) { return nearest_double(v[c]); }

struct Sampled {
  double chord = 0, angle = 0, u = 0, v = 0, uu = 0;
};

// The truth at samples of a box, for the triangle of three of its corners.
Sampled sampled(const Patch& patch, const ParameterBox<double>& box, const Vec<double, 3>& normal_of_triangle) {
  Sampled out;
  const Vec<double, 3> a = point(patch, box.u_begin, box.v_begin), b = point(patch, box.u_end, box.v_begin),
                       c = point(patch, box.u_begin, box.v_end);
  constexpr int n = 8;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = double(i) / n, y = double(j) / n;
      const double u = box.u_begin + x * (box.u_end - box.u_begin), v = box.v_begin + y * (box.v_end - box.v_begin);
      const Side left_u = i == n ? Side::left : Side::right, left_v = j == n ? Side::left : Side::right;
      if (i + j <= n) out.chord = std::max(out.chord, distance(point(patch, u, v), (1 - x - y) * a + x * b + y * c));
      const auto d = rational_derivatives(patch, from_double(u), from_double(v), 2, 2, left_u, left_v);
      const auto size = [&](int k, int l) {
        return std::hypot(number(d.at(k, l), 0), number(d.at(k, l), 1), number(d.at(k, l), 2));
      };
      out.u = std::max(out.u, size(1, 0));
      out.v = std::max(out.v, size(0, 1));
      out.uu = std::max(out.uu, size(2, 0));
      const auto exact = cross(d.at(1, 0), d.at(0, 1));
      const Vec<double, 3> m{{number(exact, 0), number(exact, 1), number(exact, 2)}}, t = cross(m, normal_of_triangle);
      if (dot(m, m) > 0)
        out.angle =
            std::max(out.angle, std::atan2(std::sqrt(dot(t, t)), dot(m, normal_of_triangle)) * 180 / std::numbers::pi);
    }
  return out;
}

void check(const Patch& patch, const ParameterBox<double>& box) {
  const SurfacePieces pieces = SurfacePieces::of(patch, PieceParameters::knots);
  const Vec<double, 3> a = point(patch, box.u_begin, box.v_begin), b = point(patch, box.u_end, box.v_begin),
                       c = point(patch, box.u_begin, box.v_end);
  const Vec<double, 3> n = cross(b - a, c - a);
  const Sampled truth = sampled(patch, box, n);
  const RoundingGuard guard;
  const SurfaceHull hull = pieces.bound(box);
  EXPECT_GE(hull.chord(box.u_end - box.u_begin, box.v_end - box.v_begin) * (1 + 1e-12), truth.chord);
  EXPECT_GE(hull.u * (1 + 1e-12), truth.u);
  EXPECT_GE(hull.v * (1 + 1e-12), truth.v);
  EXPECT_GE(hull.uu * (1 + 1e-12), truth.uu);
  EXPECT_GE(angle_bound(hull, {{Interval(n[0]), Interval(n[1]), Interval(n[2])}}) + 1e-9, truth.angle);
}

TEST(ChordBound, Law1_2_6_BoundsHoldAtEverySample) {
  for (const Patch& patch : {bumpy(), octant()})
    for (int depth = 0; depth < 5; ++depth)
      for (int k = 0; k < 3; ++k) {
        const double h = std::ldexp(1.0, -depth), u = std::min(0.3125 * k, 1 - h), v = std::min(0.21875 * k, 1 - h);
        check(patch, {u, u + h, v, v + h});
      }
}

TEST(ChordBound, Law1_AKinkCountsByItsJump) {
  // |x − 1/2|, in v constant: a triangle across the kink is off by up to a half times its width.
  const Patch roof = graph(clamped(1, {Rational(1, 2)}), clamped(1), [](int i, int) { return i == 1 ? 0 : 1; });
  check(roof, {0, 1, 0, 1});
  check(roof, {0.25, 1, 0, 0.5});
  const SurfacePieces pieces = SurfacePieces::of(roof, PieceParameters::knots);
  const RoundingGuard guard;
  EXPECT_EQ(pieces.bound({0, 0.5, 0, 1}).chord(0.5, 1), 0);
  EXPECT_GE(pieces.bound({0.25, 0.75, 0, 1}).jump_u, 4);
}

TEST(ChordBound, Law2_NoAngleWhereTheNormalTurnsAround) {
  const Patch fold = graph(clamped(2), clamped(1), [](int i, int) { return i; });
  std::vector<Vec<Rational, 4>> net = fold.net();
  for (std::size_t k = 4; k < 6; ++k) net[k][0] = Rational(0);  // x goes there and back
  for (auto& p : net) p[2] = Rational(0);
  const SurfacePieces pieces = SurfacePieces::of(Patch(clamped(2), clamped(1), net), PieceParameters::knots);
  const RoundingGuard guard;
  EXPECT_EQ(angle_bound(pieces.bound({0, 1, 0, 1}), {{Interval(0), Interval(0), Interval(1)}}), 180);
}

TEST(ChordBound, Law2_APoleDoesNotSpoilTheAngle) {
  const SurfacePieces pieces = SurfacePieces::of(octant(), PieceParameters::knots);
  const RoundingGuard guard;
  const SurfaceHull hull = pieces.bound({0, 0.125, 0.9375, 1});
  const Vec<Interval, 3> down{{Interval(0), Interval(0), Interval(-1)}}, up{{Interval(0), Interval(0), Interval(1)}};
  EXPECT_LT(std::min(angle_bound(hull, up), angle_bound(hull, down)), 10);
}

TEST(ChordBound, Law3_PointsAreEnclosed) {
  for (const Patch& patch : {bumpy(), octant()}) {
    const SurfacePieces pieces = SurfacePieces::of(patch, PieceParameters::knots);
    for (const double u : {0.0, 0.3, 1.0 / 3, 0.5, 0.77, 1.0})
      for (const double v : {0.0, 3.0 / 7, 0.9, 1.0}) {
        const auto exact = evaluate_rational(patch, from_double(u), from_double(v));
        const RoundingGuard guard;
        const Vec<Interval, 3> p = pieces.point(u, v);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_LE(from_double(p[c].inf()), exact[c]);
          EXPECT_GE(from_double(p[c].sup()), exact[c]);
          EXPECT_LT(p[c].sup() - p[c].inf(), 1e-13);
        }
      }
  }
}

TEST(ChordBound, Law4_PlanesHaveNoError) {
  const SurfacePieces pieces =
      SurfacePieces::of(graph(clamped(1), clamped(1), [](int i, int j) { return i + j; }), PieceParameters::knots);
  const RoundingGuard guard;
  const SurfaceHull hull = pieces.bound({0, 1, 0, 1});
  EXPECT_LE(hull.chord(1, 1), 1e-15);
  EXPECT_LE(angle_bound(hull, {{Interval(-1), Interval(-1), Interval(1)}}), 1e-12);
}

TEST(ChordBound, Law5_HalvingQuarters) {
  for (const Patch& patch : {bumpy(), octant()}) {
    const SurfacePieces pieces = SurfacePieces::of(patch, PieceParameters::knots);
    const RoundingGuard guard;
    double last = 0;
    for (int depth = 4; depth < 10; ++depth) {
      const double h = std::ldexp(1.0, -depth), now = pieces.bound({0.625, 0.625 + h, 0.25, 0.25 + h}).chord(h, h);
      if (depth > 4) EXPECT_NEAR(last / now, 4, 0.7);
      last = now;
    }
  }
}

TEST(ChordBound, BoxesBySpansAreThoseOfTheKnots) {
  const Patch patch = bumpy();
  const SurfacePieces knots = SurfacePieces::of(patch, PieceParameters::knots),
                      spans = SurfacePieces::of(patch, PieceParameters::spans);
  const RoundingGuard guard;
  const double h = 1.0 / 6;  // the second of three spans
  const SurfaceHull a = knots.bound({1.0 / 3 + 1e-9, 0.5 - 1e-9, 1e-9, 3.0 / 7 - 1e-9}), b = spans.bound({1, 2, 0, 1});
  EXPECT_NEAR(a.chord(h, 3.0 / 7), b.chord(1, 1), 1e-6);
  EXPECT_EQ(spans.bound({0.5, 1.5, 0, 1}).chord(1, 1), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace patchproof
