// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gregory_approximate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "patchproof/patch/gregory_expand.h"
#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

using Point = Vec<Rational, 3>;

Rational blend(const Rational& x, const Rational& y) {
  if (x == 0 && y == 0) return 0;
  return 9 * x * y * (1 - x) * (1 - x) * (1 - y) * (1 - y) * (x * x / (x * x + y * y) - Rational(1, 2));
}
Rational blend_x(const Rational& x, const Rational& y) {  // y > 0
  const Rational s = x * x + y * y, b = x * x / s - Rational(1, 2), bx = 2 * x * y * y / (s * s);
  return 9 * y * (1 - y) * (1 - y) * ((1 - x) * (1 - 3 * x) * b + x * (1 - x) * (1 - x) * bx);
}

double length(const Point& p) { return std::sqrt(nearest_double(dot(p, p))); }

TEST(GregoryApproximate, Law6_TheSplineIsNearTheBlend) {
  for (const int n : {1, 2, 8}) {
    SCOPED_TRACE(n);
    const BlendSpline h = BlendSpline::make(n);
    double worst = 0, largest = 0, worst_slope = 0, largest_slope = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        largest = std::max(largest, h.value(i, j)), largest_slope = std::max(largest_slope, h.slope(i, j));
        for (int a = 0; a <= 6; ++a)
          for (int b = 1; b <= 6; ++b) {
            const Rational x = (i + Rational(a) / 6) / n, y = (j + Rational(b) / 6) / n;
            const auto d = partial_derivatives(h.spline(), x, y, 1, 0, a == 6 ? Side::left : Side::right, Side::left);
            const double value = nearest_double(Rational(abs(d.at(0, 0)[0] - blend(x, y)))),
                         slope = nearest_double(Rational(abs(d.at(1, 0)[0] - blend_x(x, y))));
            EXPECT_LE(value, h.value(i, j)) << i << " " << j << " " << a << " " << b;
            EXPECT_LE(slope, h.slope(i, j)) << i << " " << j << " " << a << " " << b;
            worst = std::max(worst, value), worst_slope = std::max(worst_slope, slope);
          }
      }
    std::printf("%d cells: |H - g| %.5f, bound %.5f; slope %.4f, bound %.4f\n", n, worst, largest, worst_slope,
                largest_slope);
    EXPECT_GT(worst, 0.3 * largest);
    EXPECT_GT(worst_slope, 0.3 * largest_slope);
  }
}

void expect_laws(const GregoryPatch<Rational>& patch, int cells) {
  const BlendSpline h = BlendSpline::make(cells);
  const auto out = approximate(patch, h).value();
  EXPECT_EQ(out.surface.degree(Direction::u), std::max(3, patch.v_surface().degree(Direction::u)));
  EXPECT_EQ(out.surface.degree(Direction::v), std::max(3, patch.u_surface().degree(Direction::v)));
  for (const Vec<Rational, 4>& p : out.surface.net()) EXPECT_EQ(p[3], 1);
  double worst = 0, worst_angle = 0;
  const int n = 24;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Rational u = Rational(i) / n, v = Rational(j) / n;
      const auto e = rational_derivatives(out.surface, u, v, 1, 1);
      const SurfaceFrame<Rational> f = frame(patch, u, v);
      const bool edge_u = i == 0 || i == n, edge_v = j == 0 || j == n;
      if (edge_u || edge_v) {
        EXPECT_EQ(e.at(0, 0), f.point) << u << " " << v;
      }
      const auto inside = [&](const Rational& t) { return Rational(1) / cells <= t && t <= 1 - Rational(1) / cells; };
      if (edge_u && inside(v)) {
        EXPECT_EQ(e.at(1, 0), f.du);
      }
      if (edge_v && inside(u)) {
        EXPECT_EQ(e.at(0, 1), f.dv);
      }
      const double away = length(e.at(0, 0) - f.point);
      EXPECT_LE(away, out.point_deviation * (1 + 1e-12));
      worst = std::max(worst, away);
      const Point a = f.normal(), b = cross(e.at(1, 0), e.at(0, 1)), c = cross(a, b);
      const double angle = std::atan2(length(c), nearest_double(dot(a, b)));
      worst_angle = std::max(worst_angle, angle);
      if (out.normal_angle) {
        EXPECT_LE(angle, *out.normal_angle + 1e-12) << u << " " << v;
      }
    }
  std::printf("%d cells: deviation %.4g, bound %.4g; angle %.4g, bound %.4g\n", cells, worst, out.point_deviation,
              worst_angle, out.normal_angle.value_or(-1));
  EXPECT_GT(worst, out.point_deviation / 20);
}

TEST(GregoryApproximate, Laws1To4_RandomPatches) {
  RandomRationals random;
  for (int k = 0; k < 3; ++k) {
    const auto patch = random_gregory_patch(random);
    for (const int cells : {1, 2, 6}) expect_laws(patch, cells);
  }
}

// A gentle patch: the angle has a bound, and it shrinks with the cells.
TEST(GregoryApproximate, Law4_TheAngleShrinks) {
  RandomRationals random;
  const auto flat = mapped_patch(random_gregory_patch(random, {.dyadic = true}), [](const Vec<Rational, 4>& p) {
    return Vec<Rational, 4>{{p[0], p[1], p[2] / 64, p[3]}};
  });
  // Points that are evenly spread, but for a little height.
  const auto surface = [&](const BsplinePatch<Rational, 4>& s) {
    std::vector<Vec<Rational, 4>> net;
    const auto greville = [&](Direction d, int i) {
      Rational sum(0);
      for (int k = 1; k <= s.degree(d); ++k) sum += s.knots(d)[i + k];
      return Rational(sum / s.degree(d));
    };
    for (int i = 0; i < s.count(Direction::u); ++i)
      for (int j = 0; j < s.count(Direction::v); ++j)
        net.push_back({{20 * greville(Direction::u, i), 20 * greville(Direction::v, j), s.point(i, j)[2], 1}});
    return BsplinePatch<Rational, 4>(s.knots(Direction::u), s.knots(Direction::v), net);
  };
  const auto patch = GregoryPatch<Rational>::make(surface(flat.u_surface()), surface(flat.v_surface())).value();
  double last = 1;
  for (const int cells : {1, 4, 16}) {
    expect_laws(patch, cells);
    const auto out = approximate(patch, BlendSpline::make(cells)).value();
    ASSERT_TRUE(out.normal_angle);
    EXPECT_LT(*out.normal_angle, last);
    last = *out.normal_angle / 2;
  }
}

TEST(GregoryApproximate, Law5_WithoutBlendedQuadrantsItIsItself) {
  RandomRationals random;
  const auto classic = random_gregory_patch(random);
  const auto bicubic = BsplinePatch<Rational, 4>(KnotVector<Rational>::bezier(3), KnotVector<Rational>::bezier(3), [&] {
    std::vector<Vec<Rational, 4>> net;
    for (const auto& row : classic.from_u())
      for (const auto& p : row) net.push_back(p);
    return net;
  }());
  const auto patch = GregoryPatch<Rational>::make(bicubic, bicubic).value();
  const auto out = approximate(patch, BlendSpline::make(4)).value();
  EXPECT_EQ(out.point_deviation, 0);
  EXPECT_EQ(out.normal_angle, 0.0);
  EXPECT_EQ(out.surface.net(), bicubic.net());
}

TEST(GregoryApproximate, Error_Weights) {
  RandomRationals random;
  const auto out = approximate(random_gregory_patch(random, {.rational = true}), BlendSpline::make(2));
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, ErrorCode::unsupported);
}

TEST(GregoryApproximate, Law1_QuadraticNumbers) {
  RandomRationals random;
  const auto patch = random_gregory_patch(random);
  const auto a = approximate(patch, BlendSpline::make(2)).value();
  const auto b = approximate(make_patch<Quadratic>(patch), BlendSpline::make(2)).value();
  EXPECT_EQ(a.point_deviation, b.point_deviation);
  for (std::size_t k = 0; k < a.surface.net().size(); ++k)
    EXPECT_EQ(make_point<Quadratic>(a.surface.net()[k]), b.surface.net()[k]);
}

}  // namespace
}  // namespace patchproof::test
