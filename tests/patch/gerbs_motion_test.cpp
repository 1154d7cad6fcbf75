// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gerbs_motion.h"

#include <gtest/gtest.h>

#include "patchproof/spline/gerbs_spline.h"
#include "support/curves.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Point = Vec<Rational, 4>;
using Curve = GerbsCurve<Rational, 4>;
using Surface = GerbsSurface<Rational, 4>;
using Motion = AffineMotion<Rational>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Vec<Rational, 3> vec(const Rational& x, const Rational& y, const Rational& z) { return {{x, y, z}}; }

// A motion with everything in it.
Motion some_motion(RandomRationals& random) {
  Motion m;
  m.translation = random.points<3>(1)[0];
  m.axis = vec(q(1), q(-2), q(3));
  m.half_tangent = q(1, 4);
  m.scale = vec(q(3, 2), q(2, 3), q(5));
  m.shear[0][1] = q(1, 3);
  m.shear[2][0] = q(-2);
  return m;
}

std::vector<Rational> breaks(int n) {
  std::vector<Rational> out;
  for (int k = 0; k <= n; ++k) out.push_back(q(k * (k + 3), 4));
  return out;
}

// Cubics over the whole line of parameters, with weights.
Curve some_curve(RandomRationals& random, bool closed, const std::string& b = "polynomial(1)") {
  const auto knots = gerbs_knots(breaks(4), closed).value();
  std::vector<LocalCurve<Rational, 4>> locals;
  const auto bezier = KnotVector<Rational>::make(3, {q(-9), q(-9), q(-9), q(-9), q(19), q(19), q(19), q(19)}).value();
  for (int i = 0; i < knots.control_count() - (closed ? 1 : 0); ++i) {
    std::vector<Point> points = random.points<4>(4);
    for (Point& p : points) p[3] = Rational(2) + p[3] * p[3];
    locals.emplace_back(BsplineCurve<Rational, 4>(bezier, std::move(points)));
  }
  return Curve::make(BFunction::parse(b).value(), knots, std::move(locals), closed).value();
}

Surface some_surface(RandomRationals& random, bool closed_u, bool closed_v) {
  const auto bezier = KnotVector<Rational>::make(2, {q(-9), q(-9), q(-9), q(19), q(19), q(19)}).value();
  const Surface::Axis u{gerbs_knots(breaks(3), closed_u).value(), closed_u},
      v{gerbs_knots(breaks(4), closed_v).value(), closed_v};
  std::vector<LocalSurface<Rational, 4>> locals;
  for (int k = 0; k < u.distinct() * v.distinct(); ++k) {
    std::vector<Point> net = random.points<4>(9);
    for (Point& p : net) p[3] = Rational(2) + p[3] * p[3];
    locals.emplace_back(BsplinePatch<Rational, 4>(bezier, bezier, std::move(net)));
  }
  return Surface::make(BFunction::polynomial(1).value(), u, v, locals).value();
}

std::vector<std::pair<Rational, Side>> places(const KnotVector<Rational>& knots) {
  std::vector<std::pair<Rational, Side>> out;
  const auto all = knots.breaks();
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    out.emplace_back(all[i], Side::right);
    out.emplace_back(all[i] + (all[i + 1] - all[i]) / 3, Side::right);
    out.emplace_back(all[i + 1], Side::left);
  }
  return out;
}

std::vector<LocalMotion<Rational>> everyone(const Curve& curve, const Motion& motion) {
  std::vector<LocalMotion<Rational>> out;
  for (int p = 0; p < static_cast<int>(curve.locals().size()) - (curve.is_closed() ? 1 : 0); ++p)
    out.push_back({p, 0, motion});
  return out;
}

TEST(GerbsMotion, Law1_NothingMovesAtPhase0) {
  RandomRationals random;
  for (const bool closed : {false, true}) {
    const Curve f = some_curve(random, closed);
    EXPECT_TRUE(moved(f, everyone(f, some_motion(random)), q(0)).locals() == f.locals());
    const Surface s = some_surface(random, closed, closed);
    const Surface same = moved(s, {{1, 2, some_motion(random)}, {0, 0, some_motion(random)}}, q(0));
    for (int p = 0; p < s.knots(Direction::u).control_count(); ++p)
      for (int l = 0; l < s.knots(Direction::v).control_count(); ++l) EXPECT_TRUE(same.local(p, l) == s.local(p, l));
  }
}

TEST(GerbsMotion, Law2_OneMapOfAllMapsTheCurveAndTheSurface) {
  RandomRationals random;
  Motion motion = some_motion(random);
  motion.about = vec(q(1), q(2), q(-1, 3));
  for (const bool closed : {false, true})
    for (const Rational& s : {q(1, 3), q(1)}) {
      const AffineMap<Rational> map = at_phase(motion, *motion.about, s);
      const Curve f = some_curve(random, closed), g = moved(f, everyone(f, motion), s);
      for (const auto& [t, side] : places(f.knots()))
        EXPECT_TRUE((derivatives_at<Rational>(g, t, side, t, 0)[0]) ==
                    apply(map, derivatives_at<Rational>(f, t, side, t, 0)[0]));
      const Surface a = some_surface(random, closed, !closed);
      std::vector<LocalMotion<Rational>> all;
      for (int p = 0; p < a.axis(Direction::u).distinct(); ++p)
        for (int l = 0; l < a.axis(Direction::v).distinct(); ++l) all.push_back({p, l, motion});
      const Surface b = moved(a, all, s);
      for (const auto& [u, side_u] : places(a.knots(Direction::u)))
        for (const auto& [v, side_v] : places(a.knots(Direction::v))) {
          const auto at = [&](const Surface& x) {
            return partial_derivatives_at<Rational>(x, {u, v}, {side_u, side_v}, u, v, 0, 0).at(0, 0);
          };
          EXPECT_TRUE(at(b) == apply(map, at(a)));
        }
    }
}

TEST(GerbsMotion, Law3_WhatIsClosedStaysClosed) {
  RandomRationals random;
  const Curve f = some_curve(random, true, "polynomial(2)");
  const Curve g = moved(f, {{0, 0, some_motion(random)}}, q(2, 3));
  const Rational begin = f.knots().domain_begin(), end = f.knots().domain_end();
  const auto first = derivatives_at<Rational>(g, begin, Side::right, begin, 2),
             last = derivatives_at<Rational>(g, end, Side::left, end, 2);
  for (int r = 0; r <= 2; ++r) EXPECT_TRUE(first[r] == last[r]) << r;
  EXPECT_FALSE((first[0] == derivatives_at<Rational>(f, begin, Side::right, begin, 0)[0])) << "it has moved";
  const Surface a =
      moved(some_surface(random, true, true), {{0, 0, some_motion(random)}, {0, 1, some_motion(random)}}, q(1));
  const auto &ku = a.knots(Direction::u), &kv = a.knots(Direction::v);
  for (const auto& [v, side] : places(kv)) {
    const auto low = partial_derivatives_at<Rational>(a, {ku.domain_begin(), v}, {Side::right, side}, ku.domain_begin(),
                                                      v, 1, 1),
               high = partial_derivatives_at<Rational>(a, {ku.domain_end(), v}, {Side::left, side}, ku.domain_end(), v,
                                                       1, 1);
    for (const int k : {0, 1})
      for (const int l : {0, 1}) EXPECT_TRUE(low.at(k, l) == high.at(k, l));
  }
  for (const auto& [u, side] : places(ku)) {
    const auto low = partial_derivatives_at<Rational>(a, {u, kv.domain_begin()}, {side, Side::right}, u,
                                                      kv.domain_begin(), 1, 1),
               high = partial_derivatives_at<Rational>(a, {u, kv.domain_end()}, {side, Side::left}, u, kv.domain_end(),
                                                       1, 1);
    for (const int k : {0, 1})
      for (const int l : {0, 1}) EXPECT_TRUE(low.at(k, l) == high.at(k, l));
  }
}

// G_i of closed knots at t, for B of order 1: by hand.
Rational hat(const KnotVector<Rational>& knots, int i, const Rational& t) {
  const auto ramp = [](const Rational& w) { return Rational(w * w * (Rational(3) - 2 * w)); };
  if (knots[i] <= t && t < knots[i + 1]) return ramp((t - knots[i]) / (knots[i + 1] - knots[i]));
  if (knots[i + 1] <= t && t <= knots[i + 2]) return 1 - ramp((t - knots[i + 1]) / (knots[i + 2] - knots[i + 1]));
  return q(0);
}

// x = 12 sin t − 4 sin 3t, y = 13 cos t − 5 cos 2t − 2 cos 3t − cos 4t, t in units of π.
Curve heart() {
  std::vector<Point> points(9);
  points[0][3] = 1;
  points[2][0] = 12, points[6][0] = -4;
  points[1][1] = 13, points[3][1] = -5, points[5][1] = -2, points[7][1] = -1;
  std::vector<Rational> tenths;
  for (int k = 0; k <= 10; ++k) tenths.push_back(q(k, 5));
  const auto local = LocalCurve<Rational, 4>::trigonometric(points).value();
  return Curve::make(BFunction::polynomial(1).value(), gerbs_knots(tenths, true).value(),
                     std::vector<LocalCurve<Rational, 4>>(10, local), true)
      .value();
}

TEST(GerbsMotion, Law4_TranslationsMoveByTheSumOfTheirHats) {
  // The beating heart: 1–4 and 6–9 along x, 0 and 5 along y.
  const Curve f = heart();
  std::vector<LocalMotion<Rational>> beat;
  for (int i = 0; i < 10; ++i) {
    Motion m;
    m.translation = i == 0   ? vec(q(0), q(2), q(0))
                    : i == 5 ? vec(q(0), q(-2), q(0))
                             : vec(q(i < 5 ? 1 : -1), q(0), q(0));
    beat.push_back({i, 0, m});
  }
  const auto displacement = [&](const Rational& t, const Rational& s) {
    Vec<Rational, 3> out{};
    for (int i = 0; i <= 10; ++i) out += (s * hat(f.knots(), i, t)) * beat[i % 10].motion.translation;
    return out;
  };
  // Displacements worked out elsewhere.
  struct Given {
    Rational t, x, y;
  };
  for (const Given& g :
       {Given{q(0), q(0), q(2)}, Given{q(1, 10), q(1, 2), q(1)}, Given{q(1, 5), q(1), q(0)},
        Given{q(3, 10), q(1), q(0)}, Given{q(7, 8), q(175, 256), q(-81, 128)}, Given{q(1), q(0), q(-2)},
        Given{q(17, 10), q(-1), q(0)}, Given{q(19, 10), q(-1, 2), q(1)}, Given{q(2), q(0), q(2)}})
    EXPECT_TRUE(displacement(g.t, q(1)) == vec(g.x, g.y, q(0))) << to_text(g.t);
  for (const Rational& s : {q(1, 3), q(1)}) {
    const Curve g = moved(f, beat, s);
    // Exact: the local curves differ by constants, whose blend is a curve of its own.
    std::vector<LocalCurve<Rational, 4>> differences;
    for (std::size_t i = 0; i < 10; ++i) {
      const auto &a = f.locals()[i].points(), &b = g.locals()[i].points();
      for (std::size_t k = 1; k < a.size(); ++k) EXPECT_TRUE(a[k] == b[k]);
      Point constant = b[0] - a[0];
      constant[3] = 1;
      differences.push_back(LocalCurve<Rational, 4>::trigonometric({constant}).value());
    }
    const Curve d = Curve::make(f.b_function(), f.knots(), differences, true).value();
    for (const auto& [t, side] : places(f.knots())) {
      const auto before = derivatives_at<Ball>(f, t, side, Ball(t), 0)[0],
                 after = derivatives_at<Ball>(g, t, side, Ball(t), 0)[0];
      const Vec<Rational, 3> by = displacement(t, s);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(Ball(after[c] - before[c]).contains(by[c]));
      for (const auto& p : {derivatives_at<Ball>(d, t, side, Ball(t), 0)[0]})
        for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(p[c].contains(by[c]));
    }
  }
  // Exactly, where local curves have exact values.
  RandomRationals random;
  const Curve a = some_curve(random, true);
  std::vector<LocalMotion<Rational>> all;
  for (int i = 0; i < 4; ++i) {
    Motion m;
    m.translation = random.points<3>(1)[0];
    all.push_back({i, 0, m});
  }
  const Curve b = moved(a, all, q(2, 7));
  for (const auto& [t, side] : places(a.knots())) {
    Vec<Rational, 3> by{};
    for (int i = 0; i <= 4; ++i) by += (q(2, 7) * hat(a.knots(), i, t)) * all[i % 4].motion.translation;
    EXPECT_TRUE((derivatives_at<Rational>(b, t, side, t, 0)[0]) ==
                (derivatives_at<Rational>(a, t, side, t, 0)[0] + by));
  }
}

TEST(GerbsMotion, Law5_OnlyTheNamedMoveInTurnAboutTheirCentres) {
  RandomRationals random;
  const Curve f = some_curve(random, false);
  const Motion first = some_motion(random), second = some_motion(random);
  const Curve g = moved(f, {{2, 0, first}, {2, 0, second}}, q(1, 2));
  for (std::size_t i = 0; i < f.locals().size(); ++i) EXPECT_EQ(g.locals()[i] == f.locals()[i], i != 2);
  const Vec<Rational, 3> o = centre_point(f, 2);
  EXPECT_TRUE(o == (derivatives_at<Rational>(f.locals()[2], f.centre(2), Side::right, f.centre(2), 0)[0]));
  const auto map = compose(at_phase(second, o, q(1, 2)), at_phase(first, o, q(1, 2)));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(g.locals()[2].points()[k] == apply(map, f.locals()[2].points()[k]));
  // A centre stays where it is when nothing is translated.
  Motion turn = some_motion(random);
  turn.translation = {};
  EXPECT_TRUE(apply(at_phase(turn, o, q(5, 7)), o) == o);
  // Trigonometric: a short number near the centre.
  const Vec<Rational, 3> near = centre_point(heart(), 1);
  const auto exact = derivatives_at<Ball>(heart().locals()[1], q(1, 5), Side::right, Ball(q(1, 5)), 0)[0];
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(std::abs(nearest_double(near[c]) - exact[c].to_interval().inf()), 1e-6);
    EXPECT_LE(to_text(near[c]).size(), 20u);
  }
}

TEST(GerbsMotion, Law6_RotationsPreserveLengths) {
  Motion turn;
  turn.axis = vec(q(2), q(-1), q(5));
  turn.half_tangent = q(7, 3);
  for (const Rational& s : {q(0), q(1, 9), q(1, 2), q(1)}) {
    const AffineMap<Rational> map = at_phase(turn, vec(q(1), q(1), q(4)), s);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(dot(map.linear[i], map.linear[k]), q(i == k ? 1 : 0));
  }
}

TEST(GerbsMotion, Law7_ThereAndBack) {
  for (const char* pace : {"polynomial(0)", "polynomial(1)", "beta(2,1)", "rational(1)"})
    for (const int n : {2, 5, 24}) {
      const BFunction b = BFunction::parse(pace).value();
      EXPECT_EQ(frame_phase(b, 0, n), 0);
      EXPECT_EQ(frame_phase(b, n, n), 0);
      EXPECT_EQ(frame_phase(b, n / 2, n) == 1, n % 2 == 0);
      for (int k = 0; k <= n; ++k) EXPECT_EQ(frame_phase(b, k, n), frame_phase(b, n - k, n));
      for (int k = 1; 2 * k <= n; ++k) EXPECT_LT(frame_phase(b, k - 1, n), frame_phase(b, k, n));
    }
}

}  // namespace
}  // namespace patchproof
