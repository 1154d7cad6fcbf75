// SPDX-License-Identifier: Apache-2.0
// Errata of "From B-Spline to GERBS Curve and Surface" about blends, GERBS curves and surfaces. Each test holds what is printed
// and the wrong value it gives, and the right one from this library. docs/errata.md refers to the tests by name.
#include <gtest/gtest.h>

#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/spline/reparametrize.h"
#include "support/rational_literal.h"

namespace patchproof::test {
namespace {

using Curve = GerbsCurve<Rational, 3>;
using Local = LocalCurve<Rational, 3>;
using Spline = BsplineCurve<Rational, 3>;
using Point = Vec<Rational, 2>;

// A quadratic curve a + b t + c t² on [begin, end], in the parameter of the whole.
Spline quadratic(const Point& a, const Point& b, const Point& c, const Rational& begin, const Rational& end) {
  const Rational h = end - begin, two(2);
  const auto at = [&](const Point& p, const Point& v, const Point& w) {
    return Vec<Rational, 3>{{p[0] + v[0] + w[0], p[1] + v[1] + w[1], 1}};
  };
  const Point p = a + begin * b + (begin * begin) * c, v = (h / two) * (b + (two * begin) * c), none{{0, 0}};
  return {KnotVector<Rational>::bezier(2, begin, end),
          {at(p, none, none), at(p, v, none), at(p, two * v, (h * h) * c)}};
}
std::vector<Point> derivatives_of(const Curve& f, const Rational& t, Side side, int order) {
  return derivatives_at<Rational>(f, t, side, t, order);
}
std::vector<Local> copies(const Local& c, int n) { return std::vector<Local>(n, c); }

TEST(GerbsErrata, Erratum_E_GERBS_05_FirstOrderIsNotDegreeOneAndMonotoneIsNotEnough) {
  const BFunction b;
  EXPECT_EQ(b.numerator().size(), 4u);  // degree 3
  EXPECT_EQ(b.order(), 1);
  EXPECT_EQ(derivatives(b, Rational(0), 2), (std::vector<Rational>{0, 0, 6}));
  EXPECT_EQ(derivatives(b, Rational(1), 2), (std::vector<Rational>{1, 0, -6}));
  EXPECT_EQ(BFunction::from_polynomial({0, 2, -1, 1}).error().code, ErrorCode::not_monotone);
  // Symmetry is no part of it: a constant is reproduced without.
  const BFunction askew = BFunction::beta(2, 1).value();
  EXPECT_FALSE(askew.is_symmetric());
  const Local one(quadratic({{1, 1}}, {{0, 0}}, {{0, 0}}, 0, 2)),
      same = one.map_points([](Vec<Rational, 3> p) { return Rational(2) * p; });
  const Curve f = Curve::make(askew, gerbs_knots<Rational>({0, 2}, false).value(), {one, same}).value();
  EXPECT_EQ(derivatives_of(f, "1/3"_q, Side::right, 1), (std::vector<Point>{{{1, 1}}, {{0, 0}}}));
}

TEST(GerbsErrata, Erratum_E_GERBS_06_ABlendIsC1NotC2AndMayHaveACusp) {
  const Curve f = Curve::blend(BFunction(), quadratic({{0, 0}}, {{1, 0}}, {{0, 1}}, 0, 1),
                               quadratic({{"1/2"_q, 1}}, {{1, 0}}, {{0, -1}}, 0, 1), "1/2"_q)
                      .value();
  const auto left = derivatives_of(f, "1/2"_q, Side::left, 2), right = derivatives_of(f, "1/2"_q, Side::right, 2);
  EXPECT_EQ(left[1], right[1]);
  EXPECT_EQ(Point(right[2] - left[2]), (Point{{0, 18}}));
  const Curve back = Curve::blend(BFunction(), quadratic({{0, 0}}, {{1, 0}}, {{0, 0}}, 0, 1),
                                  quadratic({{"1/2"_q, 0}}, {{-1, 0}}, {{0, 0}}, 0, 1), "1/2"_q)
                         .value();
  EXPECT_EQ(derivatives_of(back, "1/2"_q, Side::right, 1)[1], (Point{{1, 0}}));
  EXPECT_EQ(derivatives_of(back, 1, Side::left, 1)[1], (Point{{-1, 0}}));
  EXPECT_FALSE(Curve::blend(BFunction(), quadratic({{0, 0}}, {{1, 0}}, {{0, 0}}, 0, 1),
                            quadratic({{0, 0}}, {{1, 0}}, {{0, 0}}, 0, 1), Rational(0)));
}

std::vector<Local> four() {
  return {quadratic({{1, 0}}, {{0, 1}}, {{0, 0}}, -2, 7),
          quadratic({{1, "3/4"_q}}, {{-1, "1/2"_q}}, {{0, "-1/4"_q}}, 0, 6),
          quadratic({{-1, 3}}, {{0, -1}}, {{0, 0}}, 0, 6), quadratic({{-4, -1}}, {{1, 0}}, {{0, 0}}, 0, 6)};
}

TEST(GerbsErrata, Erratum_E_GERBS_07_TheLastLocalCurveIsTheFirstAPeriodLater) {
  const auto knots = gerbs_knots<Rational>({0, 1, 3, 4, 6}, true).value();
  std::vector<Local> literal = four();
  literal.push_back(literal.front());
  EXPECT_EQ(derivatives_of(Curve::make(BFunction(), knots, literal).value(), 6, Side::left, 0)[0], (Point{{1, 6}}));
  const Curve f = Curve::make(BFunction(), knots, four(), true).value();
  EXPECT_EQ(derivatives_of(f, 6, Side::left, 0)[0], (Point{{1, 0}}));
  EXPECT_EQ(derivatives_of(f, 0, Side::right, 0)[0], (Point{{1, 0}}));
}

TEST(GerbsErrata, Erratum_E_GERBS_08_TenClosedLocalCurvesNeedThirteenKnots) {
  std::vector<Rational> turn;
  for (int i = 0; i <= 10; ++i) turn.push_back(Rational(i) / Rational(5));
  const auto closed = gerbs_knots(turn, true).value();
  EXPECT_EQ(closed.knots().size(), 13u);
  const Local g(quadratic({{0, 0}}, {{1, 0}}, {{0, 1}}, -1, 4));
  EXPECT_TRUE(Curve::make(BFunction(), closed, copies(g, 10), true));
  turn.pop_back();
  const auto open = gerbs_knots(turn, false).value();
  EXPECT_EQ(open.knots().size(), 12u);
  EXPECT_TRUE(Curve::make(BFunction(), open, copies(g, 10)));
  EXPECT_EQ(Curve::make(BFunction(), open, copies(g, 10), true).error().code, ErrorCode::not_closed);
}

using LocalPatch = LocalSurface<Rational, 4>;
using Surface = GerbsSurface<Rational, 4>;
LocalPatch bilinear(const Rational& x, const Rational& y, const Rational& twist) {
  const auto k = KnotVector<Rational>::bezier(1, 0, 3);
  return BsplinePatch<Rational, 4>(k, k,
                                   {{{x, y, 0, 1}},
                                    {{x, y + Rational(3), 1, 1}},
                                    {{x + Rational(3), y, 2, 1}},
                                    {{x + Rational(3), y + Rational(3), twist, 1}}});
}
Vec<Rational, 3> value(const Surface& s, const Rational& u, const Rational& v) {
  return partial_derivatives_at<Rational>(s, std::array{u, v}, std::array{Side::right, Side::right}, u, v, 0, 0)
      .at(0, 0);
}

TEST(GerbsErrata, Erratum_E_GERBS_09_RisingHalvesAreNoPartitionOfUnity) {
  const std::vector<Rational> t{0, 0, 1, 2, 3, 3};
  const Rational u = "3/2"_q;
  Rational printed(0);  // Σ_j B(w_{1,j}), w = 0 outside
  for (std::size_t j = 0; j + 1 < t.size(); ++j)
    if (t[j] <= u && u < t[j + 1]) printed += derivatives(BFunction(), Rational((u - t[j]) / (t[j + 1] - t[j])), 0)[0];
  EXPECT_EQ(printed, "1/2"_q);
  const auto k = KnotVector<Rational>::bezier(0, 0, 3);
  const LocalPatch constant(BsplinePatch<Rational, 4>(k, k, {{{4, 8, 12, 1}}})),
      same = constant.map_points([](Vec<Rational, 4> p) { return Rational(3) * p; });
  std::vector<LocalPatch> all;
  for (int i = 0; i < 16; ++i) all.push_back(i % 3 == 0 ? constant : same);
  const Surface s = Surface::make(BFunction(), {gerbs_knots<Rational>({0, 1, 2, 3}, false).value()},
                                  {gerbs_knots<Rational>({0, 1, 2, 3}, false).value()}, all)
                        .value();
  EXPECT_EQ(value(s, u, u), (Vec<Rational, 3>{{4, 8, 12}}));
  EXPECT_NE(value(s, u, u), Rational(printed * printed) * (Vec<Rational, 3>{{4, 8, 12}}));
}

TEST(GerbsErrata, Erratum_E_GERBS_10_11_RowsBelongToUAndTheOuterKnotsAreNotUsed) {
  const auto k = gerbs_knots<Rational>({0, 3}, false).value();
  const std::vector<LocalPatch> c{bilinear(0, 0, 0), bilinear(1, 0, 3), bilinear(5, 2, 1), bilinear(0, 7, 0)};
  const Surface s = Surface::make(BFunction(), {k}, {k}, c).value(),
                swapped = Surface::make(BFunction(), {k}, {k}, {c[0], c[2], c[1], c[3]}).value();
  const Rational u = 1, v = 2, a = derivatives(BFunction(), Rational(u / Rational(3)), 0)[0],
                 b = derivatives(BFunction(), Rational(v / Rational(3)), 0)[0], one(1);
  const auto at = [&](int i) {
    return partial_derivatives_at<Rational>(c[i], std::array{u, v}, std::array{Side::right, Side::right}, u, v, 0, 0)
        .at(0, 0);
  };
  const Vec<Rational, 3> right =
      ((one - a) * (one - b)) * at(0) + ((one - a) * b) * at(1) + (a * (one - b)) * at(2) + (a * b) * at(3);
  EXPECT_EQ(value(s, u, v), right);
  EXPECT_NE(value(swapped, u, v), right);  // the subscripts as printed: v first
  const auto wider = KnotVector<Rational>::make(1, {-1, 0, 3, 8}).value();
  EXPECT_EQ(value(Surface::make(BFunction(), {wider}, {k}, c).value(), u, v), right);
}

// Local curves on [0, 1] laid over their supports: with clamped knots a closed curve has a gap.
TEST(GerbsErrata, Erratum_E_GERBS_11_AClosedDirectionHasNoClampedKnots) {
  const Spline own = quadratic({{1, "-1/2"_q}}, {{0, 1}}, {{0, 0}}, 0, 1);
  const std::vector<Rational> clamped{0, 0, 1, 2, 2}, closed{-1, 0, 1, 2, 3};
  const auto seam = [&](const std::vector<Rational>& t, int i, const Rational& at) {
    const Local c(map_domain(own, t[i], t[i + 2]));
    return derivatives_at<Rational>(c, at, i == 0 ? Side::right : Side::left, at, 0)[0];
  };
  EXPECT_EQ(Point(seam(clamped, 2, 2) - seam(clamped, 0, 0)), (Point{{0, 1}}));
  EXPECT_EQ(seam(closed, 2, 2), seam(closed, 0, 0));
  const auto knots = KnotVector<Rational>::make(1, clamped).value();
  EXPECT_EQ(Curve::make(BFunction(), knots, copies(map_domain(own, Rational(0), Rational(2)), 2), true).error().code,
            ErrorCode::not_closed);
}

TEST(GerbsErrata, Erratum_E_GERBS_14_OwnDomainsScaleTheDerivatives) {
  const Spline own = quadratic({{1, 2}}, {{3, -1}}, {{2, 5}}, 0, 1);
  const std::vector<Rational> t{0, 1, 4, 6};
  const auto knots = gerbs_knots(t, false).value();  // 0 0 1 4 6 6: local curve 2 lies over [1, 6], its centre is 4
  std::vector<Local> locals = copies(quadratic({{0, 0}}, {{1, 0}}, {{0, 0}}, 0, 6), 4);
  locals[2] = map_domain(own, knots[2], knots[4]);
  const auto f =
      derivatives_of(Curve::make(BFunction::polynomial(2).value(), knots, locals).value(), 4, Side::right, 2);
  const Rational w = (knots[3] - knots[2]) / (knots[4] - knots[2]);
  const auto c = derivatives_at<Rational>(Local(own), w, Side::right, w, 2);
  EXPECT_EQ(f[0], c[0]);
  EXPECT_EQ(f[1], "1/5"_q * c[1]);
  EXPECT_EQ(f[2], "1/25"_q * c[2]);
  EXPECT_NE(f[1], c[1]);
}

}  // namespace
}  // namespace patchproof::test
