// SPDX-License-Identifier: Apache-2.0
// Laws 7 and 8 of gregory_patch.h: doubles up to the corners, and parameters of other rings.
#include <gtest/gtest.h>

#include "patchproof/patch/gregory_patch.h"
#include "patchproof/scalar/taylor_model.h"
#include "support/gregory_patches.h"

namespace patchproof::test {

// Tracked, with sums that happen to be exact taken for exact (Knuth's residual is the rounding error of a sum): next to the
// edges u = 1 and v = 1 all depends on 1 − u and 1 − v.
class TrackedSums {
 public:
  TrackedSums() = default;
  explicit TrackedSums(int value) : x_(value) {}
  explicit TrackedSums(const Tracked& x) : x_(x) {}
  const Tracked& tracked() const { return x_; }

  TrackedSums& operator+=(const TrackedSums& o) { return *this = *this + o; }
  friend TrackedSums operator-(const TrackedSums& a) { return TrackedSums(-a.x_); }
  friend TrackedSums operator+(const TrackedSums& a, const TrackedSums& b) {
    const double x = a.x_.value(), y = b.x_.value(), sum = x + y, part = sum - x;
    const Tracked usual = a.x_ + b.x_;
    const bool exact = (x - (sum - part)) + (y - part) == 0;
    if (!exact) return TrackedSums(usual);
    const double error = a.x_.error() + b.x_.error();
    return TrackedSums(Tracked(sum, error == 0 ? 0 : std::nextafter(error, 1e308)));
  }
  friend TrackedSums operator-(const TrackedSums& a, const TrackedSums& b) { return a + -b; }
  friend TrackedSums operator*(const TrackedSums& a, const TrackedSums& b) { return TrackedSums(a.x_ * b.x_); }
  friend TrackedSums operator/(const TrackedSums& a, const TrackedSums& b) { return TrackedSums(a.x_ / b.x_); }

 private:
  Tracked x_;
};

}  // namespace patchproof::test

namespace patchproof {

template <>
struct scalar_traits<test::TrackedSums> {
  static constexpr bool is_exact = false, is_field = true, is_ordered = false;
  static std::optional<Sign> sign(const test::TrackedSums& x) { return scalar_traits<Tracked>::sign(x.tracked()); }
  using knot_scalar = double;
};
template <>
struct embedding<test::TrackedSums, double> {
  static test::TrackedSums apply(double x) { return test::TrackedSums(Tracked(x)); }
};
template <>
struct embedding<test::TrackedSums, Rational> {
  static test::TrackedSums apply(const Rational& x) { return test::TrackedSums(embed<Tracked>(x)); }
};

}  // namespace patchproof

namespace patchproof::test {
namespace {

using Patch = GregoryPatch<Rational>;
using Point3 = Vec<Rational, 3>;

// Dense at both ends: from the smallest subnormal to the double below 1, with the knots and their neighbours.
const std::vector<double>& parameters() {
  static const std::vector<double> all = [] {
    std::vector<double> out{0,          0x1p-1074, 0x1.8p-1060, 0x1p-1022, 0x1p-600, 0x1p-300,
                            0x1.8p-257, 0x1p-256,  0x1.8p-256,  0x1p-200,  0x1p-128, 1e-20,
                            0x1p-53,    0x1p-30,   0.1,         0.5,       0.9};
    for (const double knot : {0.25, 0.625})
      out.insert(out.end(), {std::nextafter(knot, 0), knot, std::nextafter(knot, 1)});
    for (const double y : {0x1p-20, 0x1p-52, 0x1p-53}) out.push_back(1 - y);
    out.push_back(1);
    return out;
  }();
  return all;
}
bool is_corner(double u, double v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

void expect_near(const Vec<TrackedSums, 3>& bound, const Vec<double, 3>& rounded, const Point3& exact) {
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(rounded[c], bound[c].tracked().value());
    expect_agrees(bound[c].tracked(), exact[c]);
  }
}

// The doubles are what Tracked carries, whose bounds hold at the place the parameters are moved to; and from there the exact
// points and first derivatives are no further than the surface can go in a distance of 2^-255.
void expect_law7(const Patch& patch) {
  const GregoryPatch<double> in_double = make_patch<double>(patch);
  const GregoryPatch<TrackedSums> tracked = make_patch<TrackedSums>(patch);
  const Rational nothing(1, Integer(1) << 200);
  int index = 0;
  for (const double u : parameters())
    for (const double v : parameters()) {
      SCOPED_TRACE(testing::Message() << "at " << u << ", " << v);
      const auto [x, y] = detail::off_the_corners(u, v);
      ASSERT_TRUE(0 <= x && x <= 1 && 0 <= y && y <= 1);
      ASSERT_LE(std::fabs(x - u) + std::fabs(y - v), 0x1p-255);
      EXPECT_EQ(is_corner(x, y), is_corner(u, v));
      const SurfaceFrame<double> s = frame(in_double, u, v);
      const SurfaceFrame<TrackedSums> t = frame(tracked, u, v);
      EXPECT_EQ(evaluate(in_double, u, v), s.point);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(s.point[c], t.point[c].tracked().value());
        // The surface is about 20 wide: such bounds say something.
        EXPECT_LE(t.point[c].tracked().error(), 1e-11);
        EXPECT_LE(std::max(t.du[c].tracked().error(), t.dv[c].tracked().error()), 1e-9);
      }
      if (!is_corner(u, v)) {
        const SecondDerivatives<double> two = second_derivatives(in_double, u, v);
        for (const Vec<double, 3>& d : {two.duu, two.duv, two.dvv})
          for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(d[c]));
      }
      if (++index % 7 != 0 && !is_corner(u, v)) continue;
      const SurfaceFrame<Rational> exact = frame(patch, from_double(x), from_double(y));
      expect_near(t.point, s.point, exact.point);
      expect_near(t.du, s.du, exact.du);
      expect_near(t.dv, s.dv, exact.dv);
      if (x != u || y != v) {
        const SurfaceFrame<Rational> there = frame(patch, from_double(u), from_double(v));
        for (const Point3& d : {there.point - exact.point, there.du - exact.du, there.dv - exact.dv})
          EXPECT_LT(dot(d, d), nothing);
      }
      if (index % 4 != 0 || is_corner(u, v)) continue;
      const SecondDerivatives<double> two = second_derivatives(in_double, u, v);
      const SecondDerivatives<TrackedSums> of_two = second_derivatives(tracked, u, v);
      const SecondDerivatives<Rational> exact_two = second_derivatives(patch, from_double(x), from_double(y));
      expect_near(of_two.duu, two.duu, exact_two.duu);
      expect_near(of_two.duv, two.duv, exact_two.duv);
      expect_near(of_two.dvv, two.dvv, exact_two.dvv);
    }
}

TEST(GregoryPatchScalars, Law7_NoNaNAnywhereAndWithinTheBound) {
  RandomRationals random;
  expect_law7(random_gregory_patch(random, {.dyadic = true}));
}

TEST(GregoryPatchScalars, Law7_RationalPatches) {
  RandomRationals random(7);
  expect_law7(random_gregory_patch(random, {.rational = true, .dyadic = true}));
}

// Far from the origin, very small and very large: control points rounded, and the patch of the rounded ones the exact one.
TEST(GregoryPatchScalars, Law7_OffsetsAndScales) {
  RandomRationals random;
  const Patch unit = random_gregory_patch(random, {.rational = true, .dyadic = true});
  for (const auto& [factor, offset] : std::vector<std::pair<Rational, Rational>>{
           {1, 1000000}, {"1/1000000000"_q, 0}, {1000000000, 0}, {"1/1000000000"_q, 1000000}}) {
    const Patch patch = mapped_patch(unit, [&](const Vec<Rational, 4>& p) {
      Vec<Rational, 4> out{{0, 0, 0, p[3]}};
      for (std::size_t c = 0; c < 3; ++c) out[c] = from_double(nearest_double(factor * p[c] + offset * p[3]));
      return out;
    });
    const GregoryPatch<double> in_double = make_patch<double>(patch);
    const GregoryPatch<TrackedSums> tracked = make_patch<TrackedSums>(patch);
    for (const double u : {0.0, 0x1p-1074, 0.1, 1 - 0x1p-53})
      for (const double v : {0x1p-1030, 0.25, 0.7, 1.0}) {
        SCOPED_TRACE(testing::Message() << "at " << u << ", " << v << ", scale " << factor << ", offset " << offset);
        const auto [x, y] = detail::off_the_corners(u, v);
        const SurfaceFrame<double> s = frame(in_double, u, v);
        const SurfaceFrame<TrackedSums> t = frame(tracked, u, v);
        const SurfaceFrame<Rational> exact = frame(patch, from_double(x), from_double(y));
        expect_near(t.point, s.point, exact.point);
        expect_near(t.du, s.du, exact.du);
        expect_near(t.dv, s.dv, exact.dv);
        const double size = nearest_double(factor * 20 + offset);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(t.point[c].tracked().error(), 1e-12 * size);
      }
  }
}

// Places inside a box and at its border.
std::vector<Rational> places_in(const Rational& a, const Rational& b) {
  return {a, Rational((2 * a + b) / 3), Rational((a + 9 * b) / 10), b};
}
Interval hull(const Rational& a, const Rational& b) { return Interval(enclose(a).inf(), enclose(b).sup()); }
void expect_contains(const Interval& x, const Rational& exact) {
  ASSERT_FALSE(std::isnan(x.inf()) || std::isnan(x.sup()));
  EXPECT_TRUE((std::isinf(x.inf()) || from_double(x.inf()) <= exact) &&
              (std::isinf(x.sup()) || exact <= from_double(x.sup())))
      << "[" << x.inf() << ", " << x.sup() << "] misses " << exact;
}

TEST(GregoryPatchScalars, Law8_BoxesEncloseAlsoAtTheCorners) {
  RandomRationals random;
  for (const bool rational : {false, true}) {
    const Patch patch = random_gregory_patch(random, {.rational = rational});
    const std::vector<Rational> us = patch.v_surface().knots(Direction::u).breaks(),
                                vs = patch.u_surface().knots(Direction::v).breaks();
    int finite = 0;
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
      for (std::size_t j = 0; j + 1 < vs.size(); ++j)
        for (const int cells : {1, 8})
          for (int k = 0; k < cells; ++k)
            for (int l = 0; l < cells; l += 3) {
              const Rational du = (us[i + 1] - us[i]) / cells, dv = (vs[j + 1] - vs[j]) / cells;
              const Rational u0 = us[i] + k * du, u1 = u0 + du, v0 = vs[j] + l * dv, v1 = v0 + dv;
              const GregorySpans spans = find_spans(patch, Rational(u0 + du / 2), Rational(v0 + dv / 2));
              const Vec<Interval, 3> box = [&] {
                const RoundingGuard guard;
                return evaluate_in_spans<Interval>(patch, spans, hull(u0, u1), hull(v0, v1));
              }();
              for (const Rational& u : places_in(u0, u1))
                for (const Rational& v : places_in(v0, v1)) {
                  const Point3 exact = evaluate(patch, u, v);
                  for (std::size_t c = 0; c < 3; ++c) expect_contains(box[c], exact[c]);
                }
              finite += std::isfinite(box[0].inf()) && std::isfinite(box[0].sup());
            }
    EXPECT_GT(finite, 0) << "every box was the whole line";
  }
}

// In a patch of intervals, and at single parameters.
TEST(GregoryPatchScalars, Law8_PatchesOfIntervals) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  for (const Rational& u : {Rational(0), "1/1000000007"_q, "1/3"_q, "3/7"_q, Rational(1)})
    for (const Rational& v : {Rational(0), "1/99"_q, "1/2"_q, Rational(1)}) {
      const SurfaceFrame<Rational> exact = frame(patch, u, v);
      const RoundingGuard guard;
      const SurfaceFrame<Interval> s = frame(make_patch<Interval>(patch), u, v);
      for (std::size_t c = 0; c < 3; ++c) {
        expect_agrees(s.point[c], exact.point[c]);
        expect_agrees(s.du[c], exact.du[c]);
        expect_agrees(s.dv[c], exact.dv[c]);
      }
    }
}

// S(u(s), v(s)) on a whole piece of a line, as a Taylor model of order 5: half as long, it is 2⁶ times as sharp, about.
TEST(GregoryPatchScalars, Law8_TaylorModels) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const Rational u0("2/5"_q), v0("1/6"_q);
  const GregorySpans spans = find_spans(patch, u0, v0);
  std::vector<double> widths;
  for (const int parts : {64, 128}) {
    const Rational du = Rational(1, parts), dv = Rational(-2, parts);
    for (int k = -4; k <= 4; ++k) {
      const Rational s = Rational(k) / 4;
      const Point3 exact = evaluate_in_spans<Rational>(patch, spans, u0 + s * du, v0 + s * dv);
      const RoundingGuard guard;
      using Model = TaylorModel<5>;
      const Vec<Model, 3> model = evaluate_in_spans<Model>(patch, spans, Model::variable(enclose(u0), enclose(du)),
                                                           Model::variable(enclose(v0), enclose(dv)));
      for (std::size_t c = 0; c < 3; ++c) expect_contains(model[c].value(enclose(s)), exact[c]);
      if (k == 4) widths.push_back(model[0].remainder().sup() - model[0].remainder().inf());
    }
  }
  EXPECT_LT(widths[1] * 32, widths[0]);
}

// At a + b√2: near it the surface is near.
TEST(GregoryPatchScalars, Law8_QuadraticNumbers) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const Integer scale = Integer(1) << 200;
  const Rational root(Integer(boost::multiprecision::sqrt(Integer(2 * scale * scale))), scale);  // within 2^-200
  const Rational u = root / 2 - Rational(1, 2), v = 1 - root / 3;
  const Vec<Quadratic, 3> s = evaluate_in_spans<Quadratic>(patch, find_spans(patch, u, v),
                                                           Quadratic("-1/2"_q, "1/2"_q, 2), Quadratic(1, "-1/3"_q, 2));
  const Point3 near = evaluate(patch, u, v);
  const Rational tiny(1, Integer(1) << 150);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_FALSE(s[c].is_rational());
    EXPECT_LT(abs(Rational(s[c].rational_part() + s[c].root_coefficient() * root - near[c])), tiny);
  }
}

// A whole patch over them: with rational data it is the same.
TEST(GregoryPatchScalars, Law2And3_PatchesOfQuadraticNumbers) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const GregoryPatch<Quadratic> same = make_patch<Quadratic>(patch);
  EXPECT_TRUE(corners_agree(same));
  for (const Rational& u : {Rational(0), "2/5"_q, Rational(1)})
    for (const Rational& v : {Rational(0), "1/3"_q, Rational(1)}) {
      const SurfaceFrame<Rational> exact = frame(patch, u, v);
      const SurfaceFrame<Quadratic> s = frame(same, Quadratic(u), Quadratic(v));
      expect_agrees(s.point, exact.point);
      expect_agrees(s.du, exact.du);
      expect_agrees(s.dv, exact.dv);
    }
  // And with √2 in a control point it is the surface of √2's neighbours, up to their distance.
  const Rational root("665857/470832"_q), tiny("1/100000000"_q);  // within 2e-12
  const auto moved = [&]<class T>(const T& by) {
    std::vector<Vec<T, 4>> net = make_points<T>(patch.u_surface().net());
    net[net.size() / 2][1] += by;
    const auto& u = patch.u_surface();
    const BsplinePatch<T, 4> surface(make_knots<T>(3, u.knots(Direction::u).knots()),
                                     make_knots<T>(u.degree(Direction::v), u.knots(Direction::v).knots()), net);
    return GregoryPatch<T>::make(surface, make_patch<T>(patch).v_surface()).value();
  };
  const Vec<Quadratic, 3> s = evaluate(moved(Quadratic(0, 1, 2)), Quadratic("1/3"_q), Quadratic("1/2"_q));
  const Point3 near = evaluate(moved(root), "1/3"_q, "1/2"_q);
  EXPECT_FALSE(s[1].is_rational());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_LT(abs(Rational(s[c].rational_part() + s[c].root_coefficient() * root - near[c])), tiny);
}

TEST(GregoryPatchScalars, Law8_PowerSeriesAlongALine) {
  RandomRationals random;
  const Patch patch = random_gregory_patch(random, {.rational = true});
  const Rational u("1/4"_q), v("2/3"_q), a(3), b(-5);
  using Series = PowerSeries<Rational, 1>;
  const Series t = Series::variable(0, Rational(0), 2);
  const auto s =
      evaluate_in_spans<Series>(patch, find_spans(patch, u, v), Series(u) + Series(a) * t, Series(v) + Series(b) * t);
  const SurfaceFrame<Rational> f = frame(patch, u, v);
  const SecondDerivatives<Rational> d = second_derivatives(patch, u, v);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(s[c].derivative({0}), f.point[c]);
    EXPECT_EQ(s[c].derivative({1}), a * f.du[c] + b * f.dv[c]);
    EXPECT_EQ(s[c].derivative({2}), a * a * d.duu[c] + 2 * a * b * d.duv[c] + b * b * d.dvv[c]);
  }
}

}  // namespace
}  // namespace patchproof::test
