// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/fixed_evaluate.h"

#include <gtest/gtest.h>

#include <vector>

#include "patchproof/patch/bezier_patch.h"
#include "support/wild_numbers.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Numbers = std::vector<double>;

struct Patch {
  int p, q;
  Numbers points, weights;
};

// The point by de Casteljau's algorithm over Rational; empty where the denominator vanishes.
std::optional<Vec<Rational, 3>> exact_point(const Patch& patch, const Rational& u, const Rational& v) {
  std::vector<Vec<Rational, 4>> net(patch.points.size() / 3);
  for (std::size_t i = 0; i < net.size(); ++i) {
    const Rational w = patch.weights.empty() ? Rational(1) : from_double(patch.weights[i]);
    for (std::size_t c = 0; c < 3; ++c) net[i][c] = w * from_double(patch.points[3 * i + c]);
    net[i][3] = w;
  }
  const Vec<Rational, 4> h = evaluate(BezierPatch<Rational, 4>(patch.p, patch.q, net), u, v);
  if (h[3] == 0) return std::nullopt;
  return Vec<Rational, 3>{{h[0] / h[3], h[1] / h[3], h[2] / h[3]}};
}

// kind 0: fractions of 20 bits, 1: 53 bits, 2: exponents apart, 3: about as far apart as 255 bits allow, 4: subnormal,
// 5: huge. Some are zero. Weights are spread less, because products must fit.
Numbers numbers(std::size_t count, int kind, bool weights, int most_spread, WildNumbers& wild) {
  Numbers out;
  for (std::size_t i = 0; i < count; ++i) {
    const int spread = kind == 2 || kind == 3 ? (weights ? 10 : kind == 2 ? 30 : most_spread) : 1;
    double x = kind == 0 ? std::ldexp(wild.below(1 << 20) - (1 << 19), -10) : wild.moderate(spread);
    if (kind == 4) x = std::ldexp(x, weights ? 0 : -1060);
    if (kind == 5) x = std::ldexp(x, weights ? 3 : 1019);
    out.push_back(wild.below(12) == 0 ? 0.0 : x);
  }
  return out;
}

Patch random_patch(int p, int q, int kind, bool rational, WildNumbers& wild) {
  const std::size_t count = (p + std::size_t(1)) * (q + std::size_t(1));
  return {p, q, numbers(3 * count, kind, false, rational ? 60 : 95, wild),
          rational ? numbers(count, kind, true, 10, wild) : Numbers{}};
}

struct Parameter {
  FixedParameter fixed;
  Rational exact;
};
Parameter parameter(double x) { return {FixedParameter::from_double(x).value(), from_double(x)}; }
Parameter parameter(std::int64_t a, std::int64_t b) {
  return {FixedParameter::from_ratio(a, b), Rational(Integer(a)) / Rational(Integer(b))};
}

// Inside and outside of [0, 1], short and as long as accepted.
Parameter random_parameter(WildNumbers& wild) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max(),
                         least = std::numeric_limits<std::int64_t>::min();
  const auto word = [&] { return wild.integer(63).convert_to<std::int64_t>(); };
  switch (wild.below(10)) {
    case 0: return parameter(wild.below(2));
    case 1: return parameter(wild.below(12), 1 + wild.below(11));
    case 2: return parameter(word(), most);
    case 3: return parameter(wild.below(2) != 0 ? least : most, wild.below(2) != 0 ? least : most);
    case 4: return parameter(word(), 2 * (word() / 2) + 1);
    case 5: return parameter(std::ldexp(1.0, -wild.below(126)));
    case 6: return parameter(-std::ldexp(1.0, wild.below(125)) * (2 - 0x1p-52) / 2);
    case 7: return parameter(std::nextafter(1.0, wild.below(2)));
    default: return parameter(std::fabs(wild.moderate(1)) / 4);
  }
}

void expect_exact(const Patch& patch, const Parameter& u, const Parameter& v) {
  const auto fixed = FixedPatch::make(patch.p, patch.q, patch.points, patch.weights);
  ASSERT_TRUE(fixed.has_value());
  const auto point = fixed->evaluate(u.fixed, v.fixed);
  const auto exact = exact_point(patch, u.exact, v.exact);
  ASSERT_EQ(point.has_value(), exact.has_value());
  if (!exact) return;
  for (int c = 0; c < 3; ++c) {
    ASSERT_EQ(point->coordinate(c), (*exact)[c]) << "u = " << u.exact << ", v = " << v.exact;
    ASSERT_EQ(point->nearest(c), nearest_double((*exact)[c])) << (*exact)[c];
  }
}

TEST(FixedEvaluate, Law1And2And4_IsTheRationalPointAndItsNearestDouble) {
  WildNumbers wild(91);
  int done = 0;
  for (int p = 0; p <= 5; ++p)
    for (int q = 0; q <= 5; ++q)
      for (int kind = 0; kind < 6; ++kind)
        for (const bool rational : {false, true}) {
          const Patch patch = random_patch(p, q, kind, rational, wild);
          for (int i = 0; i < 6; ++i, ++done) expect_exact(patch, random_parameter(wild), random_parameter(wild));
        }
  EXPECT_GE(done, 2000);
}

// Every width of factors, from both sides of each bound, times the largest whole numbers of every width of numbers.
TEST(FixedEvaluate, Law1_TheLargestNumbersOfEachWidth) {
  const auto one = parameter(1.0);
  for (const int bits : {63, 64, 127, 128, 255})
    for (const int degree : {1, 2, 3, 5}) {
      Patch patch{degree, degree, {}, {}};
      // ± (2^53 − 1) 2^(bits − 53), and a 1 that makes the whole numbers so long.
      for (int i = 0; i < 3 * (degree + 1) * (degree + 1); ++i)
        patch.points.push_back((i % 2 == 0 ? 1 : -1) * std::ldexp(0x1p53 - 1, bits - 53));
      for (int i = 0; i < 3; ++i) patch.points[i] = 1;
      for (int k = 1; k <= 125; ++k) {
        const auto small = parameter(std::ldexp(1.0, -k)), large = parameter(-std::ldexp(1.0, k - 1));
        expect_exact(patch, small, small);
        expect_exact(patch, large, large);
        expect_exact(patch, large, small);
        expect_exact(patch, large, one);
      }
    }
}

TEST(FixedEvaluate, Law2_TiesAndTheEndsOfTheRange) {
  const auto nearest = [](double a, double b, const Parameter& u) {
    const Patch line{1, 0, {a, 0, 0, b, 0, 0}, {}};
    const auto point = FixedPatch::make(1, 0, line.points)->evaluate(u.fixed, parameter(0.0).fixed);
    EXPECT_EQ(point->nearest(0), nearest_double(point->coordinate(0)));
    return point->nearest(0);
  };
  const auto half = parameter(0.5), twice = parameter(2.0), third = parameter(1, 3);
  const double ulp = 0x1p-52;
  EXPECT_EQ(nearest(1, 1 + ulp, half), 1);
  EXPECT_EQ(nearest(1 + ulp, 1 + 2 * ulp, half), 1 + 2 * ulp);
  EXPECT_EQ(nearest(-1, -1 - ulp, half), -1);
  EXPECT_EQ(nearest(1, 1 + ulp, parameter((std::int64_t{1} << 62) - 1, std::numeric_limits<std::int64_t>::max())), 1);
  EXPECT_EQ(nearest(1, 1 + ulp, parameter(std::int64_t{1} << 62, std::numeric_limits<std::int64_t>::max())), 1 + ulp);
  EXPECT_EQ(nearest(1, 1 + ulp, parameter(0.5 + 0x1p-53)), 1 + ulp);
  EXPECT_EQ(nearest(0, kTiniest, half), 0);
  EXPECT_EQ(nearest(kTiniest, 2 * kTiniest, half), 2 * kTiniest);
  EXPECT_EQ(nearest(0, kTiniest, third), 0);
  EXPECT_EQ(nearest(0, 2 * kTiniest, third), kTiniest);
  EXPECT_EQ(nearest(0, kTiniest, parameter(0x1p-60)), 0);
  EXPECT_EQ(nearest(0, kTiniest, parameter(0.5 + 0x1p-40)), kTiniest);
  EXPECT_EQ(nearest(0, kSmallestNormal, parameter(1 - 0x1p-53)), kSmallestNormal) << "rounds up to a normal number";
  EXPECT_EQ(nearest(0, kLargest, twice), kInfinity);
  EXPECT_EQ(nearest(0, -kLargest, twice), -kInfinity);
  EXPECT_EQ(nearest(std::nextafter(kLargest, 0.0), kLargest, parameter(1.25)), kLargest);
  EXPECT_EQ(nearest(std::nextafter(kLargest, 0.0), kLargest, parameter(1.5)), kInfinity) << "a tie";
  EXPECT_EQ(nearest(0, 0, third), 0);

  // Denominators that begin with 64 ones, and just not; quotients near a power of two.
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t b : {most, most - 1, most / 2, most / 2 + 1, most / 2 + 2, std::int64_t{3}})
    for (const std::int64_t a : {std::int64_t{1}, std::int64_t{2}, b / 2, b / 2 + 1, b - 1})
      for (const double x : {1.0, 1 + ulp, 2 - ulp, 3.0, 5e300, kTiniest}) nearest(0, x, parameter(a, b));
  WildNumbers wild(92);
  for (int i = 0; i < 2000; ++i) {  // random fractions of random lengths, three limbs and more in the denominator
    const Patch patch = random_patch(3, 3, 1, i % 2 == 0, wild);
    const auto u = parameter(wild.integer(1 + wild.below(62)).convert_to<std::int64_t>(), most - wild.below(9)),
               v = parameter(wild.below(1000), 1001 + wild.below(1 << 30));
    expect_exact(patch, u, v);
  }
}

TEST(FixedEvaluate, Law3_WhatIsNotAccepted) {
  const auto line = [](double a, double b) { return FixedPatch::make(1, 0, Numbers{a, 0, 0, b, 0, 0}).has_value(); };
  EXPECT_TRUE(line(1, std::ldexp(1.5, 254)));
  EXPECT_FALSE(line(1, std::ldexp(1.5, 255)));
  EXPECT_TRUE(line(1, 0));
  EXPECT_TRUE(FixedPatch::make(0, 0, Numbers{1e-300, 1, 1e300}).has_value()) << "each coordinate has its own exponent";
  EXPECT_FALSE(FixedPatch::make(0, 6, Numbers(21, 1.0)).has_value());
  EXPECT_FALSE(FixedPatch::make(6, 0, Numbers(21, 1.0)).has_value());
  EXPECT_FALSE(FixedPatch::make(-1, 0, Numbers{}).has_value());
  EXPECT_TRUE(FixedPatch::make(1, 0, Numbers{1, 0, 0, 0x1p100, 0, 0}, Numbers{1, 0x1p153}).has_value());
  EXPECT_FALSE(FixedPatch::make(1, 0, Numbers{1, 0, 0, 0x1p100, 0, 0}, Numbers{1, 0x1p154}).has_value());
  EXPECT_THROW((void)FixedPatch::make(1, 1, Numbers(11, 1.0)), contract_error);

  EXPECT_TRUE(FixedParameter::from_double(0x1p-125).has_value());
  EXPECT_FALSE(FixedParameter::from_double(0x1p-126).has_value());
  EXPECT_TRUE(FixedParameter::from_double(-0x1p124).has_value());
  EXPECT_FALSE(FixedParameter::from_double(0x1p125).has_value());
  EXPECT_FALSE(FixedParameter::from_double(kInfinity).has_value());
  EXPECT_THROW((void)FixedParameter::from_ratio(1, 0), contract_error);

  const auto zero = FixedPatch::make(1, 0, Numbers{1, 2, 3, 4, 5, 6}, Numbers{1, -1});
  const auto half = parameter(0.5).fixed, third = parameter(1, 3).fixed;
  EXPECT_FALSE(zero->evaluate(half, half).has_value()) << "the denominator vanishes at 1/2";
  EXPECT_TRUE(zero->evaluate(third, half).has_value());
}

TEST(FixedEvaluate, Law5_ScalingScales) {
  WildNumbers wild(93);
  const Patch patch = random_patch(3, 3, 1, false, wild);
  Patch scaled_patch = patch;
  for (double& x : scaled_patch.points) x = std::ldexp(x, 700);
  const auto u = parameter(5, 7).fixed, v = parameter(0.1).fixed;
  const auto a = FixedPatch::make(3, 3, patch.points)->evaluate(u, v),
             b = FixedPatch::make(3, 3, scaled_patch.points)->evaluate(u, v);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(b->coordinate(c), scaled(a->coordinate(c), 700));
    EXPECT_EQ(b->nearest(c), std::ldexp(a->nearest(c), 700));
  }
}

TEST(FixedEvaluate, DivisionOfTwoWordsByOne) {
  WildNumbers wild(94);
  const auto word = [&] { return wild.integer(64 - wild.below(8)).convert_to<std::int64_t>(); };
  for (int i = 0; i < 2000; ++i) {
    const auto d = static_cast<std::uint64_t>(word()) | (i % 2 == 0 ? std::uint64_t{1} << 63 : 1);
    const auto high = static_cast<std::uint64_t>(word()) % d, low = static_cast<std::uint64_t>(word());
    const std::uint64_t q = detail::divide_words_by_bits(high, low, d);
    EXPECT_EQ(q, detail::divide_words(high, low, d));
    const Integer n = (Integer(high) << 64) + Integer(low), floor = Integer(q) * Integer(d);
    EXPECT_TRUE(floor <= n && n < floor + Integer(d));
  }
}

}  // namespace
}  // namespace patchproof
