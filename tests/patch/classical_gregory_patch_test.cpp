// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/classical_gregory_patch.h"

#include <gtest/gtest.h>

#include "support/gregory_patches.h"

namespace patchproof::test {
namespace {

using Patch = ClassicalGregoryPatch<Rational>;
using Point = Vec<Rational, 3>;

// blended: bit 2p + q set where the two inner points of the corner (p, q) differ.
Patch random_classical(RandomRationals& random, unsigned blended = 15) {
  std::array<Point, 12> boundary;
  for (Point& p : boundary) p = random.point<3>();
  Patch::Inner of_u, of_v;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      of_u[p][q] = of_v[p][q] = random.point<3>();
      if (blended >> (2 * p + q) & 1) of_v[p][q] += Point{{1 + abs(random()), random(), random()}};
    }
  return Patch(boundary, of_u, of_v);
}

template <class T>
ClassicalGregoryPatch<T> in_scalar(const Patch& s) {
  std::array<Vec<T, 3>, 12> boundary;
  std::size_t next = 0;
  for (const auto& [i, j] :
       {std::pair{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 2}, {0, 1}})
    boundary[next++] = make_point<T>(s.across_u(i, j));
  typename ClassicalGregoryPatch<T>::Inner of_u, of_v;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q)
      of_u[p][q] = make_point<T>(s.across_u(1 + p, 1 + q)), of_v[p][q] = make_point<T>(s.across_v(1 + p, 1 + q));
  return {boundary, of_u, of_v};
}

const std::vector<Rational>& places() {
  static const std::vector<Rational> all{0, "1/1000003"_q, "1/7"_q, "1/3"_q, "1/2"_q, "5/7"_q, "999/1000"_q, 1};
  return all;
}
bool is_corner(const Rational& u, const Rational& v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

Rational bernstein(int i, const Rational& t) {
  Rational out(i == 0 || i == 3 ? 1 : 3);
  for (int k = 0; k < 3; ++k) out *= k < i ? t : Rational(1 - t);
  return out;
}

// The formula, with no code of the library.
Point by_definition(const Patch& s, const Rational& u, const Rational& v) {
  Point sum;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Rational x = i < 2 ? u : Rational(1 - u), y = j < 2 ? v : Rational(1 - v);
      const bool inner = (i == 1 || i == 2) && (j == 1 || j == 2);
      const Point p = !inner || x + y == 0
                          ? s.across_u(i, j)
                          : Rational(x / (x + y)) * s.across_v(i, j) + Rational(y / (x + y)) * s.across_u(i, j);
      sum += Rational(bernstein(i, u) * bernstein(j, v)) * p;
    }
  return sum;
}

TEST(ClassicalGregoryPatch, Law1_IsTheFormulaAndItsCorners) {
  RandomRationals random;
  for (const unsigned blended : {0u, 1u, 6u, 15u}) {
    const Patch s = random_classical(random, blended);
    for (const Rational& u : places())
      for (const Rational& v : places()) EXPECT_EQ(evaluate(s, u, v), by_definition(s, u, v)) << u << ", " << v;
    for (const int i : {0, 3})
      for (const int j : {0, 3}) EXPECT_EQ(evaluate(s, Rational(i / 3), Rational(j / 3)), s.across_u(i, j));
  }
}

TEST(ClassicalGregoryPatch, Law2_EdgesAndCrossBoundaryDerivativesAreCubics) {
  RandomRationals random;
  const Patch s = random_classical(random);
  for (const Rational& t : places())
    for (const int end : {0, 1}) {
      const SurfaceFrame<Rational> along_v = frame(s, Rational(end), t), along_u = frame(s, t, Rational(end));
      Point edge_v, edge_u, across_u, across_v;
      const std::size_t a = end == 0 ? 0 : 3, b = end == 0 ? 1 : 2;
      for (int k = 0; k < 4; ++k) {
        const Rational basis = bernstein(k, t), factor = 3 * (end == 0 ? basis : Rational(-basis));
        edge_v += basis * s.across_u(a, k);
        edge_u += basis * s.across_u(k, a);
        across_u += factor * (s.across_u(b, k) - s.across_u(a, k));
        across_v += factor * (s.across_v(k, b) - s.across_v(k, a));
      }
      EXPECT_EQ(along_v.point, edge_v);
      EXPECT_EQ(along_u.point, edge_u);
      EXPECT_EQ(along_v.du, across_u);
      EXPECT_EQ(along_u.dv, across_v);
    }
}

template <class T>
class ClassicalGregoryPatchScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(ClassicalGregoryPatchScalars, AllScalars, ScalarNames);

TYPED_TEST(ClassicalGregoryPatchScalars, Law1_Law3_PointsAndDerivatives) {
  using T = TypeParam;
  RandomRationals random;
  const Patch s = random_classical(random);
  for (const Rational& u : {Rational(0), "1/16"_q, "1/2"_q, Rational(1)})
    for (const Rational& v : {Rational(0), "3/8"_q, "7/8"_q, Rational(1)}) {
      const SurfaceFrame<Rational> exact = frame(s, u, v);
      check<T>(std::vector{exact.point, exact.du, exact.dv, evaluate(s, u, v)}, [&]<class S>() {
        const ClassicalGregoryPatch<S> patch = in_scalar<S>(s);
        const SurfaceFrame<S> f = frame(patch, make<S>(u), make<S>(v));
        return std::vector{f.point, f.du, f.dv, evaluate(patch, make<S>(u), make<S>(v))};
      });
      if (is_corner(u, v)) continue;
      const SecondDerivatives<Rational> two = second_derivatives(s, u, v);
      check<T>(std::vector{two.duu, two.duv, two.dvv}, [&]<class S>() {
        const SecondDerivatives<S> d = second_derivatives(in_scalar<S>(s), make<S>(u), make<S>(v));
        return std::vector{d.duu, d.duv, d.dvv};
      });
    }
}

// At a corner: what the derivatives tend to along five rays, their distance shrinking with the distance from the corner.
TEST(ClassicalGregoryPatch, Law3_FirstDerivativesAreContinuousAtTheCorners) {
  RandomRationals random;
  const Patch s = random_classical(random);
  for (const int cu : {0, 1})
    for (const int cv : {0, 1}) {
      const SurfaceFrame<Rational> at = frame(s, Rational(cu), Rational(cv));
      for (const auto& [a, b] : {std::pair{1, 0}, {3, 1}, {1, 1}, {1, 7}, {0, 1}}) {
        Rational last(1000000);
        for (const int power : {10, 20, 40}) {
          const Rational r(1, Integer(1) << power);
          const SurfaceFrame<Rational> f = frame(s, cu == 0 ? Rational(a * r) : Rational(1 - a * r),
                                                 cv == 0 ? Rational(b * r) : Rational(1 - b * r));
          Rational distance(0);
          for (const Point& d : {f.point - at.point, f.du - at.du, f.dv - at.dv}) distance += dot(d, d);
          EXPECT_LT(distance, 1000000 * r);
          EXPECT_LT(distance, last);
          last = distance;
        }
      }
    }
}

TEST(ClassicalGregoryPatch, Law4_TwistsAreLimitsAlongTheEdges) {
  RandomRationals random;
  const Patch s = random_classical(random);
  const auto twists = corner_twists(s);
  const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const Rational r(1, Integer(1) << 60), near(1, Integer(1) << 80);
  for (std::size_t k = 0; k < 4; ++k) {
    const Rational u(corners[k][0]), v(corners[k][1]), inside_u = u == 0 ? r : Rational(1 - r),
                                                       inside_v = v == 0 ? r : Rational(1 - r);
    const Point along_u = second_derivatives(s, inside_u, v).duv - twists[k].from_v,
                along_v = second_derivatives(s, u, inside_v).duv - twists[k].from_u;
    EXPECT_LT(dot(along_u, along_u), near);
    EXPECT_LT(dot(along_v, along_v), near);
    const Point apart = twists[k].from_u - twists[k].from_v;
    EXPECT_GT(dot(apart, apart), 1);
  }
}

TEST(ClassicalGregoryPatch, Law5_ExpandsToDegreeSevenWithFourZeroWeights) {
  RandomRationals random;
  for (unsigned blended = 0; blended < 16; ++blended) {
    SCOPED_TRACE(blended);
    const Patch s = random_classical(random, blended);
    const BezierPatch<Rational, 4> e = expand(s);
    const int degree = 3 + std::popcount(blended);
    ASSERT_EQ(e.degree(Direction::u), degree);
    ASSERT_EQ(e.degree(Direction::v), degree);
    const BsplinePatch<Rational, 4> spline = to_bspline(e);
    for (const Rational& u : places())
      for (const Rational& v : places()) {
        const unsigned corner = (u == 1 ? 2 : 0) + (v == 1 ? 1 : 0);
        if (is_corner(u, v) && blended >> corner & 1) continue;
        const PartialDerivatives<Rational, 3> d = rational_derivatives(spline, u, v, 2, 2);
        const SurfaceFrame<Rational> f = frame(s, u, v);
        EXPECT_EQ(f.point, d.at(0, 0));
        EXPECT_EQ(f.du, d.at(1, 0));
        EXPECT_EQ(f.dv, d.at(0, 1));
        if (is_corner(u, v)) continue;
        const SecondDerivatives<Rational> two = second_derivatives(s, u, v);
        EXPECT_EQ(two.duu, d.at(2, 0));
        EXPECT_EQ(two.duv, d.at(1, 1));
        EXPECT_EQ(two.dvv, d.at(0, 2));
      }
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree; ++j) {
        const bool at_corner = (i == 0 || i == degree) && (j == 0 || j == degree);
        if (at_corner && blended >> ((i == 0 ? 0 : 2) + (j == 0 ? 0 : 1)) & 1) {
          EXPECT_EQ(e.point(i, j), (Vec<Rational, 4>{}));
        } else {
          EXPECT_GT(e.point(i, j)[3], 0);
        }
      }
  }
}

TEST(ClassicalGregoryPatch, Law6_TheSquaredBlendHasTheSameEdgesAndIsNear) {
  RandomRationals random;
  double worst = 0;
  for (const unsigned blended : {0u, 2u, 8u, 15u}) {
    const Patch s = random_classical(random, blended);
    const GregoryPatch<Rational> squared = to_gregory_patch(s);
    double allowed = 0;
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) {
        const Point d = s.across_u(1 + p, 1 + q) - s.across_v(1 + p, 1 + q);
        allowed += 0.03 * std::sqrt(nearest_double(dot(d, d)));
      }
    bool same = true;
    for (int i = 0; i <= 24; ++i)
      for (int j = 0; j <= 24; ++j) {
        const Rational u = Rational(i) / 24, v = Rational(j) / 24;
        const SurfaceFrame<Rational> a = frame(s, u, v), b = frame(squared, u, v);
        const Point d = a.point - b.point;
        same = same && d == Point{};
        const double distance = std::sqrt(nearest_double(dot(d, d)));
        EXPECT_LE(distance, allowed * (1 + 1e-14));
        if (allowed > 0) worst = std::max(worst, distance / allowed);
        if (u > 0 && u < 1 && v > 0 && v < 1) continue;
        EXPECT_TRUE(a.point == b.point && a.du == b.du && a.dv == b.dv) << u << ", " << v;
      }
    EXPECT_EQ(same, blended == 0);
  }
  RecordProperty("worst_share_of_the_bound", std::to_string(worst));
  EXPECT_GT(worst, 0.5) << "the bound says too little";
}

TEST(ClassicalGregoryPatch, Law7_ToClassicalAndBack) {
  RandomRationals random;
  const Patch s = random_classical(random);
  const GregoryPatch<Rational> squared = to_gregory_patch(s);
  // Degrees raised and knots inserted do not matter.
  const auto disguised = GregoryPatch<Rational>::make(
      insert_knot(elevate_degree(squared.u_surface(), Direction::v), Direction::v, "1/3"_q, 2),
      insert_knot(squared.v_surface(), Direction::u, "2/5"_q));
  for (const GregoryPatch<Rational>& from : {squared, disguised.value()}) {
    const std::optional<Patch> back = to_classical(from);
    ASSERT_TRUE(back.has_value());
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_EQ(back->across_u(i, j), s.across_u(i, j));
        EXPECT_EQ(back->across_v(i, j), s.across_v(i, j));
      }
  }
  // One point of the edges, a weight, a knot that matters: no classical patch.
  const auto changed = [&](int at, const Vec<Rational, 4>& by) {
    auto net = squared.u_surface().net();
    net[at] += by;
    return GregoryPatch<Rational>::make(BsplinePatch<Rational, 4>(squared.u_surface().knots(Direction::u),
                                                                  squared.u_surface().knots(Direction::v), net),
                                        squared.v_surface())
        .value();
  };
  EXPECT_FALSE(to_classical(changed(1, {{1, 0, 0, 0}})));
  EXPECT_FALSE(to_classical(changed(5, {{0, 0, 0, 1}})));
  EXPECT_TRUE(to_classical(changed(5, {{1, 0, 0, 0}})));
  auto bent = insert_knot(squared.u_surface(), Direction::v, "1/2"_q);
  auto net = bent.net();
  net[7][2] += 1;  // the middle point of an inner row
  EXPECT_FALSE(to_classical(
      GregoryPatch<Rational>::make(BsplinePatch<Rational, 4>(bent.knots(Direction::u), bent.knots(Direction::v), net),
                                   squared.v_surface())
          .value()));
}

TEST(ClassicalGregoryPatch, Law8_NoNaNOnTheClosedSquare) {
  RandomRationals random;
  const Patch s = random_classical(random);
  const ClassicalGregoryPatch<double> in_double = in_scalar<double>(s);
  std::vector<double> all;
  for (const double t : {0.0, 0x1p-1074, 0x1p-1022, 0x1p-600, 0x1p-257, 0x1p-256, 1e-20, 0x1p-53, 0.25, 0.5})
    all.insert(all.end(), {t, 1 - t});
  for (const double u : all)
    for (const double v : all) {
      SCOPED_TRACE(testing::Message() << u << ", " << v);
      const SurfaceFrame<double> f = frame(in_double, u, v);
      const Point exact = evaluate(s, from_double(u), from_double(v));
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(f.point[c], nearest_double(exact[c]), 1e-13);
        EXPECT_TRUE(std::isfinite(f.du[c]) && std::isfinite(f.dv[c]));
      }
      if ((u == 0 || u == 1) && (v == 0 || v == 1)) continue;
      const SecondDerivatives<double> d = second_derivatives(in_double, u, v);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(std::isfinite(d.duu[c]) && std::isfinite(d.duv[c]) && std::isfinite(d.dvv[c]));
    }
}

}  // namespace
}  // namespace patchproof::test
