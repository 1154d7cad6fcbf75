// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/fit_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "patchproof/spline/sample_parameters.h"
#include "support/lar_curves.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Within the bounds; returns the largest share of its bound that a distance has.
template <std::size_t N>
double expect_within(const CertifiedFit<Rational, N>& found, const BsplineCurve<Rational, N>& exact) {
  double share = 0;
  for (std::size_t j = 0; j < exact.points().size(); ++j)
    for (std::size_t c = 0; c < N; ++c) {
      const Rational distance = abs(Rational(from_double(found.curve.points()[j][c]) - exact.points()[j][c]));
      if (found.errors[j][c] == kInfinity) continue;
      EXPECT_LE(distance, from_double(found.errors[j][c])) << "control point " << j;
      if (distance > 0) share = std::max(share, nearest_double(distance / from_double(found.errors[j][c])));
    }
  return share;
}

Rational power_of_two(int exponent) { return from_double(std::ldexp(double(1), exponent)); }

// Coordinates and weights of very different sizes.
CurveSamples<Rational, 2> random_samples(RandomRationals& random, const KnotVector<Rational>& knots, int count) {
  CurveSamples<Rational, 2> out;
  const Rational length = knots.domain_end() - knots.domain_begin();
  for (int a = 0; a < count; ++a) {
    out.parameters.push_back(knots.domain_begin() + length * Rational(random.integer(0, 97)) / Rational(97));
    out.points.push_back(power_of_two(random.integer(-40, 40)) * random.point<2>());
    out.weights.push_back(power_of_two(random.integer(-20, 20)) / Rational(random.integer(1, 7)));
  }
  return out;
}

TEST(FitDouble, Law1_BoundsHoldAndAreApproached) {
  RandomRationals random;
  int fitted = 0;
  double share = 0;
  for (int round = 0; round < 300; ++round) {
    const int degree = random.integer(0, 5), count = degree + random.integer(1, 12);
    const auto knots = KnotVector<Rational>::make(degree, random.knots(degree, count)).value();
    const auto samples = random_samples(random, knots, count + random.integer(0, 30));
    const auto exact = fit_curve(knots, samples);
    const auto found = fit_curve_double(knots, samples);
    if (!exact) {
      ASSERT_FALSE(found.has_value());
      EXPECT_EQ(found.error().text(), exact.error().text());
      continue;
    }
    ASSERT_TRUE(found.has_value()) << found.error().text();
    ++fitted;
    share = std::max(share, expect_within(*found, *exact));
  }
  EXPECT_GT(fitted, 20);
  EXPECT_GT(share, 0.02);  // not fifty times what is needed
  RecordProperty("largest_share_of_a_bound", std::to_string(share));
}

TEST(FitDouble, Law1_UniformFitsAreNarrow) {
  RandomRationals random;
  const auto knots = uniform_clamped_knots<Rational>(3, 40).value();
  CurveSamples<Rational, 2> samples{uniform_parameters<Rational>(120, knots.domain_begin(), knots.domain_end()).value(),
                                    random.points<2>(120)};
  const auto found = fit_curve_double(knots, samples).value();
  ASSERT_TRUE(found.is_certified());
  const auto exact = fit_curve(knots, samples).value();
  Rational size(0);
  for (const Vec<Rational, 2>& p : exact.points()) size = std::max({size, Rational(abs(p[0])), Rational(abs(p[1]))});
  EXPECT_LT(found.largest_error(), 1e-13 * nearest_double(size));
  expect_within(found, exact);
  // The curves stay as near between the control points, exactly.
  std::vector<Vec<Rational, 2>> doubles;
  for (const auto& p : found.curve.points()) doubles.push_back({{from_double(p[0]), from_double(p[1])}});
  const BsplineCurve<Rational, 2> near(knots, doubles);
  for (const Rational& t : numbers_of("0 1/7 3 17/3 33 37")) {
    const auto gap = evaluate(near, t) - evaluate(exact, t);
    for (int c = 0; c < 2; ++c) EXPECT_LE(abs(gap[c]), from_double(found.largest_error()));
  }
}

// Doubles count as the numbers that they are.
TEST(FitDouble, Law1_DoubleData) {
  RandomRationals random;
  std::vector<double> knot_numbers;
  const auto knots = KnotVector<double>::make(3, {0, 0, 0, 0, 0.1, 0.35, 0.6, 1, 1, 1, 1}).value();
  CurveSamples<double, 2> samples;
  CurveSamples<Rational, 2> same;
  for (int a = 0; a <= 25; ++a) {
    samples.parameters.push_back(a / 25.0);
    samples.points.push_back({{std::sin(a * 0.3), 1e6 * std::cos(a * 0.2)}});
    samples.weights.push_back(1 + a % 3 * 0.7);
    same.parameters.push_back(from_double(samples.parameters.back()));
    same.points.push_back({{from_double(samples.points.back()[0]), from_double(samples.points.back()[1])}});
    same.weights.push_back(from_double(samples.weights.back()));
  }
  std::vector<Rational> exact_knots;
  for (const double t : knots.knots()) exact_knots.push_back(from_double(t));
  const auto exact = fit_curve(KnotVector<Rational>::make(3, exact_knots).value(), same).value();
  const auto found = fit_curve_double(knots, samples).value();
  ASSERT_TRUE(found.is_certified());
  for (std::size_t j = 0; j < exact.points().size(); ++j)
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_LE(abs(Rational(from_double(found.curve.points()[j][c]) - exact.points()[j][c])),
                from_double(found.errors[j][c]));
      EXPECT_LT(found.errors[j][c], (c == 0 ? 1 : 1e6) * 1e-13);
    }
}

// Bounds of the sizes of data: scaled by powers of two, the same fit, the bounds with it.
TEST(FitDouble, Law1_FarFromOne) {
  RandomRationals random;
  const auto knots = uniform_clamped_knots<Rational>(2, 6).value();
  for (const char* size : {"1e-290", "1e-40", "1", "1e40", "1e290"}) {
    SCOPED_TRACE(size);
    CurveSamples<Rational, 1> samples{
        uniform_parameters<Rational>(15, knots.domain_begin(), knots.domain_end()).value(), {}};
    const Rational scale = parse_scalar<Rational>(size).value();
    for (int a = 0; a < 15; ++a) samples.points.push_back({{scale * random()}});
    samples.weights.assign(15, scale);
    const auto found = fit_curve_double(knots, samples).value();
    ASSERT_TRUE(found.is_certified());
    expect_within(found, fit_curve(knots, samples).value());
    EXPECT_LT(found.largest_error(), nearest_double(scale) * 1e-12);
  }
}

TEST(FitDouble, Law1_SubnormalAndZeroData) {
  const auto knots = KnotVector<double>::bezier(1);
  const double tiny = std::numeric_limits<double>::denorm_min();
  const CurveSamples<double, 2> samples{{0, 0.5, 1}, {{{tiny, 0}}, {{0, 0}}, {{tiny, 0}}}};
  const auto found = fit_curve_double(knots, samples).value();  // exact: x = 2/3 of the tiniest, y = 0
  for (std::size_t j = 0; j < 2; ++j) {
    const Rational exact = Rational(2) / Rational(3) * from_double(tiny);
    EXPECT_LE(abs(Rational(from_double(found.curve.points()[j][0]) - exact)), from_double(found.errors[j][0]));
    EXPECT_EQ(found.curve.points()[j][1], 0);
  }
}

// Nearly singular fits: nothing false is claimed. Beside the end of the domain the scaling of the control points helps, in its
// middle nothing does.
TEST(FitDouble, Law2_WhatCannotBeCertifiedIsNot) {
  const auto knots = KnotVector<Rational>::bezier(3);
  int certified = 0, uncertified = 0;
  for (const char* begin : {"0", "1/2"})
    for (const char* step : {"1e-2", "1e-3", "1e-6", "1e-9", "1e-60", "1e-200"}) {
      SCOPED_TRACE(std::string(begin) + " + " + step);
      const Rational t = parse_scalar<Rational>(begin).value(), h = parse_scalar<Rational>(step).value();
      const CurveSamples<Rational, 2> samples{{t, t + h, t + Rational(2) * h, t + Rational(3) * h},
                                              points_of("0 0  1 1  0 2  5 3")};
      const auto exact = fit_curve(knots, samples).value();
      const auto found = fit_curve_double(knots, samples);
      if (!found) {
        EXPECT_EQ(found.error().code, ErrorCode::singular_fit);
        ++uncertified;
        continue;
      }
      expect_within(*found, exact);
      ++(found->is_certified() ? certified : uncertified);
      if (t > 0 && h < "1e-5"_q) {
        EXPECT_FALSE(found->is_certified());
        EXPECT_EQ(found->largest_error(), kInfinity);
      }
    }
  EXPECT_GT(certified, 3);
  EXPECT_GT(uncertified, 4);
}

TEST(FitDouble, Law3_TheSameRefusals) {
  const auto knots = KnotVector<double>::bezier(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [&](const CurveSamples<double, 1>& s) { return fit_curve_double(knots, s).error().code; };
  EXPECT_EQ(code({{0, 1}, {{{1}}, {{nan}}}}), ErrorCode::bad_number);
  EXPECT_EQ(code({{0, 1}, {{{1}}, {{kInfinity}}}}), ErrorCode::bad_number);
  EXPECT_EQ(code({{0, nan}, {{{1}}, {{1}}}}), ErrorCode::outside_domain);
  EXPECT_EQ(code({{0, 1}, {{{1}}, {{1}}}, {1, nan}}), ErrorCode::bad_weight);
  EXPECT_EQ(code({{0, 1}, {{{1}}, {{1}}}, {1, kInfinity}}), ErrorCode::bad_number);
  EXPECT_EQ(code({{0, 0}, {{{1}}, {{1}}}}), ErrorCode::singular_fit);
  EXPECT_EQ(code({{0, 1}, {{{1}}}}), ErrorCode::wrong_count);
  const CurveSamples<Rational, 1> huge{numbers_of("0 1"),
                                       {{{Rational(1)}}, {{parse_scalar<Rational>("1e400").value()}}}};
  EXPECT_EQ(fit_curve_double(KnotVector<Rational>::bezier(1), huge).error().code, ErrorCode::bad_number);
}

TEST(FitDouble, RootsAreEnclosed) {
  const Quadratic root(Rational(0), Rational(1), 2);
  const CurveSamples<Quadratic, 1> samples{{Quadratic(0), Quadratic(1) / root, Quadratic(1)},
                                           {{{Quadratic(0)}}, {{Quadratic(1)}}, {{root}}}};
  const auto exact = fit_curve(KnotVector<Quadratic>::bezier(2), samples).value();
  const auto found = fit_curve_double(KnotVector<Quadratic>::bezier(2), samples).value();
  ASSERT_TRUE(found.is_certified());
  for (std::size_t j = 0; j < 3; ++j) {
    const Quadratic gap = Quadratic(from_double(found.curve.points()[j][0])) - exact.points()[j][0];
    const Quadratic bound(from_double(found.errors[j][0]));
    EXPECT_TRUE(-bound <= gap && gap <= bound);
  }
}

}  // namespace
}  // namespace patchproof::test
