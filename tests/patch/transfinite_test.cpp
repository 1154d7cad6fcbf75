// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/transfinite.h"

#include <gtest/gtest.h>

#include "support/patches.h"
#include "support/transfinite.h"

namespace patchproof::test {
namespace {

using Solid = TransfiniteMap<Rational, 3, 3>;

template <std::size_t D, std::size_t N>
Vec<Rational, N> derivative_of(const Vec<PowerSeries<Rational, D>, N>& series, const std::array<int, D>& alpha) {
  Vec<Rational, N> out;
  for (std::size_t c = 0; c < N; ++c) out[c] = series[c].derivative(alpha);
  return out;
}

TEST(Transfinite, Law1_ABlendOfCurves) {
  const Surface s = four_curves();
  const auto at = [&](const Rational& u, const Rational& v) { return taylor(s, place_of<2>({u, v}), 2); };
  auto t = at("1/4"_q, "1/2"_q);
  EXPECT_EQ(derivative_of(t, {0, 0}), p("1919/512"_q, "429/128"_q, "95/512"_q));
  EXPECT_EQ(derivative_of(t, {1, 0}), p("1641/128"_q, "15/16"_q, "-23/128"_q));
  EXPECT_EQ(derivative_of(t, {0, 1}), p("423/256"_q, "393/64"_q, "231/256"_q));
  EXPECT_EQ(derivative_of(t, {1, 1}), p("249/64"_q, "3/8"_q, "57/64"_q));
  t = at(1, 1);
  EXPECT_EQ(derivative_of(t, {0, 0}), p(10, 6, -1));
  EXPECT_EQ(derivative_of(t, {1, 1}), p(-30, 9, -15));
}

// A solid from a surface, a point and a surface: constants and maps mixed, and the third control holds u² + 5.
Solid mixed_solid() {
  const Solid base = bezier<3>(0, {bezier<3>(1, {p(0, 0, 0), p(2, -4, 2)}), bezier<3>(1, {p(0, 3, 1), p(4, 0, 0)})});
  const auto u = coordinate_function<Rational, 3>(0);
  const Solid lifted = base + Solid(p(0, 0, 5)) + product(product(u, u), Solid(p(0, 0, 1)));
  return bezier<3>(2, {base, p(1, 1, 3), lifted});
}

TEST(Transfinite, Law1_ASolidFromSurfacesAndAPoint) {
  const auto t = taylor(mixed_solid(), place_of<3>({"1/2"_q, "1/3"_q, "1/4"_q}), 1);
  EXPECT_EQ(derivative_of(t, {0, 0, 0}), p(1, "7/12"_q, "359/192"_q));
  EXPECT_EQ(derivative_of(t, {1, 0, 0}), p("5/12"_q, "25/12"_q, "1/16"_q));
  EXPECT_EQ(derivative_of(t, {0, 1, 0}), p("15/8"_q, "-35/16"_q, "5/16"_q));
  EXPECT_EQ(derivative_of(t, {0, 0, 1}), p(0, "2/3"_q, "119/24"_q));
  EXPECT_EQ(evaluate(mixed_solid(), place_of<3>({"3/4"_q, "1/8"_q, 1})), p("7/16"_q, "59/32"_q, "201/32"_q));
}

// A B-spline in v of Bézier curves in u.
Surface spline_of_curves() {
  const auto line = [](int x, int y) { return bezier(0, {p(x, y, 0), p(x, y, 5)}); };
  return Surface::blend(
             1, knots_of(2, {0, 0, 0, 1, 2, 3, 3, 3}),
             {line(0, 1), line(0, 0), bezier(0, {p(1, 0, 0), p(2, -1, "5/2"_q), p(1, 0, 5)}), line(1, 1), line(0, 1)})
      .value();
}

TEST(Transfinite, Law1_ABsplineOfCurvesFromBothSides) {
  const Surface s = spline_of_curves();
  const auto t = taylor(s, place_of<2>({0, "7/3"_q}), 2);
  EXPECT_EQ(derivative_of(t, {0, 0}), p("8/9"_q, "7/9"_q, 0));
  EXPECT_EQ(derivative_of(t, {1, 0}), p("4/9"_q, "-4/9"_q, 5));
  EXPECT_EQ(derivative_of(t, {0, 1}), p("-2/3"_q, "2/3"_q, 0));
  EXPECT_EQ(derivative_of(t, {1, 1}), p("-4/3"_q, "4/3"_q, 0));
  const auto left = taylor(s, place_of<2>({"1/2"_q, 1}, Side::left), 2);
  const auto right = taylor(s, place_of<2>({"1/2"_q, 1}, Side::right), 2);
  EXPECT_EQ(derivative_of(left, {0, 1}), p("3/2"_q, "-1/2"_q, 0));
  EXPECT_EQ(derivative_of(left, {0, 1}), derivative_of(right, {0, 1}));
  EXPECT_FALSE(derivative_of(left, {0, 2}) == derivative_of(right, {0, 2}));  // a simple knot of degree 2
  EXPECT_EQ(evaluate(s, place_of<2>({1, 3})), p(0, 1, 5));
}

// The unit cylinder: the nine-point circle over Q(√2), its homogeneous control points moved along z.
TEST(Transfinite, Law1_ANurbsOfCurves) {
  using Map = TransfiniteMap<Quadratic, 2, 4>;
  const Quadratic zero(0), one(1), h = parse_scalar<Quadratic>("1/2*sqrt(2)").value();
  const auto line = [&](const Quadratic& x, const Quadratic& y, const Quadratic& w) {
    return Map::bezier(0, {Vec<Quadratic, 4>{{x, y, zero, w}}, Vec<Quadratic, 4>{{x, y, w, w}}}).value();
  };
  std::vector<Quadratic> knots;
  for (const int k : {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}) knots.push_back(Quadratic(k));
  const Map s =
      Map::blend(1, KnotVector<Quadratic>::make(2, knots).value(),
                 {line(-one, zero, one), line(-h, h, h), line(zero, one, one), line(h, h, h), line(one, zero, one),
                  line(h, -h, h), line(zero, -one, one), line(-h, -h, h), line(-one, zero, one)})
          .value();
  const Quadratic third = Quadratic(1) / Quadratic(3), half = Quadratic(1) / Quadratic(2);
  const auto t = rational_taylor(s, ParameterPlace<Quadratic, 2>({third, half}), 1);
  EXPECT_TRUE(t[0].derivative({0, 0}) == -h && t[1].derivative({0, 0}) == h && t[2].derivative({0, 0}) == third);
  EXPECT_TRUE(t[2].derivative({1, 0}) == one && t[0].derivative({1, 0}) == zero);
  const Quadratic speed = Quadratic(4) - Quadratic(4) * h;  // 4 − 2√2
  EXPECT_TRUE(t[0].derivative({0, 1}) == speed && t[1].derivative({0, 1}) == speed);
}

template <class T>
class TransfiniteLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(TransfiniteLaws, AllScalars, ScalarNames);

TYPED_TEST(TransfiniteLaws, Law6_OneFormulaInEveryScalar) {
  RandomRationals random;
  for (int round = 0; round < 12; ++round) {
    const Surface s = random_surface(random, 3);
    const Rational u = random.unit(), v = random.unit();
    const auto place = place_of<2>({u, v}, random.integer(0, 1) == 0 ? Side::left : Side::right);
    check<TypeParam>(evaluate(s, place), [&]<class S>() { return evaluate_at<S>(s, place, {make<S>(u), make<S>(v)}); });
  }
}

TEST(Transfinite, Law2_BlendsOfPointsAreSplines) {
  RandomRationals random;
  for (int round = 0; round < 20; ++round) {
    const int p = random.integer(0, 3), q = random.integer(0, 3);
    const int n = p + 1 + random.integer(0, 4), m = q + 1 + random.integer(0, 4);
    const BsplinePatch<Rational, 3> patch(knots_of(p, random.knots(p, n)), knots_of(q, random.knots(q, m)),
                                          random.points<3>(n * m));
    const Surface s = patch_over<2>(0, 1, patch);
    const auto box = patch.domain();
    const Rational u = box.u_begin + (box.u_end - box.u_begin) * random.unit(),
                   v = box.v_begin + (box.v_end - box.v_begin) * random.unit();
    for (const Side side : {Side::left, Side::right}) {
      const auto t = taylor(s, place_of<2>({u, v}, side), 3);
      const auto expected = partial_derivatives(patch, u, v, 2, 1, side, side);
      for (int k = 0; k <= 2; ++k)
        for (int l = 0; l <= 1; ++l) EXPECT_EQ(derivative_of(t, {k, l}), expected.at(k, l)) << k << l;
    }
  }
}

TEST(Transfinite, Law3_BezierBlendsInterpolateTheirEnds) {
  RandomRationals random;
  for (int round = 0; round < 10; ++round) {
    std::vector<Surface> controls;
    for (int i = random.integer(1, 4); i > 0; --i) controls.push_back(random_surface(random, 2));
    // The controls depend on v too: the ends hold at v = 0 and v = 1, where the controls are taken.
    const Surface s = bezier(1, controls);
    const Rational u = random.unit();
    EXPECT_EQ(evaluate(s, place_of<2>({u, 0})), evaluate(controls.front(), place_of<2>({u, 0})));
    EXPECT_EQ(evaluate(s, place_of<2>({u, 1}, Side::left)), evaluate(controls.back(), place_of<2>({u, 1}, Side::left)));
  }
}

// Against difference quotients no identity is exact; against the product rule written out it is.
TEST(Transfinite, Law4_TheFullProductRule) {
  RandomRationals random;
  const Surface c0 = random_surface(random, 2), c1 = random_surface(random, 2), c2 = random_surface(random, 2);
  const Surface s = bezier(1, {c0, c1, c2});
  const auto place = place_of<2>({"3/16"_q, "5/16"_q});
  const Rational v = "5/16"_q;
  const auto basis = bernstein_basis(2, v), rates = bernstein_basis_derivative(2, 1, v);
  Vec<Rational, 3> expected{};
  int i = 0;
  for (const Surface* c : {&c0, &c1, &c2}) {
    const auto t = taylor(*c, place, 1);
    expected += rates[i] * derivative_of(t, {0, 0}) + basis[i] * derivative_of(t, {0, 1});
    ++i;
  }
  EXPECT_EQ(derivative_of(taylor(s, place, 1), {0, 1}), expected);
}

TEST(Transfinite, Law5_BarycentricMapsAreAffinelyInvariant) {
  const auto image = [](const Vec<Rational, 3>& x) {
    return p(x[0] + 2 * x[1] + 7, x[2] - x[0] - 1, 3 * x[1] + x[2] / 2);
  };
  const auto mapped = [&](int x, int y) { return bezier(0, {image(p(x, y, 0)), image(p(x, y, 5))}); };
  const Surface s = Surface::blend(1, knots_of(2, {0, 0, 0, 1, 2, 3, 3, 3}),
                                   {mapped(0, 1), mapped(0, 0),
                                    bezier(0, {image(p(1, 0, 0)), image(p(2, -1, "5/2"_q)), image(p(1, 0, 5))}),
                                    mapped(1, 1), mapped(0, 1)})
                        .value();
  for (const Rational& u : {"0"_q, "1/3"_q, "1"_q})
    for (const Rational& v : {"0"_q, "1"_q, "5/2"_q, "3"_q})
      EXPECT_EQ(evaluate(s, place_of<2>({u, v})), image(evaluate(spline_of_curves(), place_of<2>({u, v}))));
}

TEST(Transfinite, BadInputIsNamed) {
  const Surface curve = bezier(0, {p(0, 0, 0), p(1, 0, 0)}), longer = bezier(0, {p(0, 0, 0), p(1, 0, 0)}, 0, 2);
  const auto few = Surface::blend(1, KnotVector<Rational>::bezier(2), {curve, curve});
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::wrong_count);
  const auto mixed = Surface::bezier(1, {curve, longer});
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, ErrorCode::domains_differ);
  EXPECT_NE(mixed.error().message.find("control 1"), std::string::npos);
  EXPECT_EQ(Surface::bezier(0, {}).error().code, ErrorCode::wrong_count);
  EXPECT_THROW(curve + longer, contract_error);
  EXPECT_THROW(evaluate(longer, place_of<2>({"5/2"_q, 0})), contract_error);  // outside, never a silent zero
  EXPECT_THROW(evaluate(longer, place_of<2>({"-1/1000"_q, 0})), contract_error);
  EXPECT_EQ(evaluate(longer, place_of<2>({2, 77})), p(1, 0, 0));  // it does not depend on v
  EXPECT_THROW(Surface::bezier(2, {curve}), contract_error);      // no third coordinate
  const TransfiniteMap<Rational, 1, 2> pole = curve_along<1>(
      0, BsplineCurve<Rational, 2>::bezier({{{Rational(1), Rational(1)}}, {{Rational(2), Rational(-1)}}}));
  EXPECT_THROW(evaluate_rational(pole, place_of<1>({"1/2"_q})), contract_error);
  EXPECT_THROW(rational_taylor(pole, place_of<1>({"1/2"_q}), 1), contract_error);
}

// Offsets and scales change nothing but the numbers.
TEST(Transfinite, FarAwayAndTiny) {
  const Rational far = 1000000, tiny = Rational(1) / Rational(1LL << 40);
  const Surface s =
      bezier(0, {p(far, 0, 0), bezier(1, {p(far, tiny, 0), p(far + tiny, 0, tiny)}, far, far + tiny)}, far, far + tiny);
  const Vec<Rational, 3> x = evaluate(s, place_of<2>({far + tiny, far + tiny / 2}));
  EXPECT_EQ(x, p(far + tiny / 2, tiny / 2, tiny / 2));
}

}  // namespace
}  // namespace patchproof::test
