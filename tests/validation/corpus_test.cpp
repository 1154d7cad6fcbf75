// SPDX-License-Identifier: Apache-2.0
// The corpus and its exact values: what validation leans on.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "patchproof/patch/denominator.h"
#include "patchproof/patch/rational_patch.h"
#include "validation/check/judge.h"
#include "validation/corpus/random.h"
#include "validation/corpus/truth.h"
#include "validation/corpus/workloads.h"

namespace patchproof::validation {
namespace {

Rational power_of_two(int k) {
  Rational x(1);
  for (int i = 0; i < std::abs(k); ++i) x = k > 0 ? x * Rational(2) : x / Rational(2);
  return x;
}

TEST(Random, IsSplitMix64) {  // its published first numbers for the seed 1234567
  Random random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317u);
  EXPECT_EQ(random.bits(), 3203168211198807973u);
}

TEST(Corpus, Law1_TheSameOptionsGiveTheSameCases) {
  const auto a = surface_cases({3, 2}), b = surface_cases({3, 2}), other = surface_cases({4, 2});
  ASSERT_EQ(a.size(), b.size());
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].points, b[i].points);
    EXPECT_EQ(a[i].u, b[i].u);
    differs = differs || a[i].points != other[i].points;
  }
  EXPECT_TRUE(differs);
}

void expect_legal(int degree, const std::vector<double>& knots, const std::vector<double>& parameters) {
  const auto k = KnotVector<double>::make(degree, knots);
  ASSERT_TRUE(k);
  for (const double t : parameters) EXPECT_TRUE(k->in_domain(t)) << t;
}

TEST(Corpus, Law2_Law3_EveryCaseIsLegalAndHasADenominator) {
  std::set<std::string> seen;
  for (const SurfaceCase& s : surface_cases({1, 3})) {
    SCOPED_TRACE(s.name);
    seen.insert(s.group);
    expect_legal(s.degree_u, s.knots_u, s.u);
    expect_legal(s.degree_v, s.knots_v, s.v);
    expect_legal(s.degree_u, s.knots_u, s.grid_u);
    expect_legal(s.degree_v, s.knots_v, s.grid_v);
    for (const double x : s.points) EXPECT_TRUE(std::isfinite(x));
    EXPECT_EQ(certify_denominator(exact_patch(s.data())).sign, DenominatorSign::positive);
  }
  for (const CurveCase& c : curve_cases({1, 3})) {
    SCOPED_TRACE(c.name);
    expect_legal(c.degree, c.knots, c.t);
    EXPECT_EQ(c.points.size(), 3 * (c.knots.size() - c.degree - 1));
  }
  EXPECT_EQ(seen.size(), groups().size());
}

// The end of the domain, a knot and its neighbours are among the parameters of a case with knots.
TEST(Corpus, HasTheSpecialParameters) {
  for (const SurfaceCase& s : surface_cases({1, 0})) {
    const auto has = [&](double t) { return std::find(s.u.begin(), s.u.end(), t) != s.u.end(); };
    const double begin = s.knots_u[s.degree_u], end = s.knots_u[s.knots_u.size() - 1 - s.degree_u];
    EXPECT_TRUE(has(begin) && has(end) && has(std::nextafter(begin, end)) && has(std::nextafter(end, begin))) << s.name;
    const double inner = s.knots_u[s.degree_u + 1];
    EXPECT_TRUE(has(inner) || inner <= begin || end <= inner) << s.name;
  }
}

TEST(Truth, Law1_IsTheTemplatesValue) {
  for (const SurfaceCase& s : surface_cases({1, 0})) {
    if (s.degree_u * s.degree_v > 12) continue;
    const auto patch = exact_patch(s.data());
    const SurfaceTruth t = exact_values(patch, s.u[2], s.v[2], s.side, 2);
    const auto d = rational_derivatives(patch, from_double(s.u[2]), from_double(s.v[2]), 2, 2, s.side, s.side);
    EXPECT_EQ(t.vectors[kPoint], d.at(0, 0)) << s.name;
    EXPECT_EQ(t.vectors[kDu], d.at(1, 0)) << s.name;
    EXPECT_EQ(t.vectors[kDv], d.at(0, 1)) << s.name;
    EXPECT_EQ(t.vectors[kDuu], d.at(2, 0)) << s.name;
    EXPECT_EQ(t.vectors[kDuv], d.at(1, 1)) << s.name;
    EXPECT_EQ(t.vectors[kDvv], d.at(0, 2)) << s.name;
  }
}

TEST(Truth, Law2_NormalsHaveLengthOneAndStandOnBothTangents) {
  int normals = 0;
  for (const SurfaceCase& s : surface_cases({1, 0})) {
    if (s.degree_u * s.degree_v > 12) continue;
    const SurfaceTruth t = exact_values(exact_patch(s.data()), s.u[3], s.v[3], s.side, 1);
    if (!t.has_normal) continue;
    ++normals;
    EXPECT_EQ(cross(t.normal, cross(t.vectors[kDu], t.vectors[kDv])), ExactVector{}) << s.name;  // parallel
    const Rational off = dot(t.normal, t.normal) - Rational(1);
    EXPECT_LT(off, power_of_two(-199));
    EXPECT_GT(off, -power_of_two(-199));
  }
  EXPECT_GT(normals, 20);
}

TEST(Truth, Law3_Ulp) {
  EXPECT_EQ(ulp(Rational(1)), power_of_two(-52));
  EXPECT_EQ(ulp(Rational(-3)), power_of_two(-51));
  EXPECT_EQ(ulp(Rational(0)), power_of_two(-1074));
  EXPECT_EQ(ulp(power_of_two(-1073)), power_of_two(-1074));
  EXPECT_EQ(in_ulps(deviation(1.0, Rational(1)), Rational(1)), 0.0);
  EXPECT_EQ(in_ulps(deviation(std::nextafter(1.0, 2.0), Rational(1)), Rational(1)), 1.0);
  EXPECT_TRUE(std::isinf(in_ulps(deviation(std::nan(""), Rational(1)), Rational(1))));
}

// The judge says no where it must: beyond the bound by the smallest step, NaN, an enclosure that misses by one.
TEST(Judge, NoticesTheSmallestLie) {
  const auto place = [] { return std::string("here"); };
  const Rational third = Rational(1) / Rational(3);
  const double near = nearest_double(third), off = std::nextafter(near, 1.0);
  const auto violations = [&](auto judge_it) {
    Tally t;
    judge_it(Judge(t, third, third));
    EXPECT_EQ(t.numbers, 1);
    return t.violations;
  };
  const double error = nearest_double(deviation(near, third).modulus);
  EXPECT_EQ(violations([&](const Judge& j) { j.number(near, std::nextafter(error, 1.0), place); }), 0);
  EXPECT_EQ(violations([&](const Judge& j) { j.number(near, std::nextafter(error, 0.0), place); }), 1);
  EXPECT_EQ(violations([&](const Judge& j) { j.number(std::nan(""), 1.0, place); }), 1);
  EXPECT_EQ(violations([&](const Judge& j) { j.number(near, std::nan(""), place); }), 1);
  EXPECT_EQ(violations([&](const Judge& j) { j.nearest(near, place); }), 0);
  EXPECT_EQ(violations([&](const Judge& j) { j.nearest(off, place); }), 1);
  EXPECT_EQ(violations([&](const Judge& j) { j.enclosure(std::min(near, std::nextafter(near, 0.0)), off, place); }), 0);
  EXPECT_EQ(violations([&](const Judge& j) { j.enclosure(off, 1.0, place); }), 1);
  EXPECT_EQ(violations([&](const Judge& j) { j.enclosure(0.0, std::nextafter(near, 0.0), place); }), 1);
  Tally t;
  same_bits(t, 0.0, -0.0, place);
  EXPECT_EQ(t.violations, 1);
}

TEST(Workloads, RefiningKnotsStayInsideSpans) {
  for (const SurfaceCase& s : surface_workloads()) {
    if (s.knots_u.size() < 20) continue;
    const auto added = refining_knots(s.degree_u, s.knots_u, 20);
    EXPECT_EQ(std::set<double>(added.begin(), added.end()).size(), 20u);
    for (const double t : added) EXPECT_EQ(std::count(s.knots_u.begin(), s.knots_u.end(), t), 0);
  }
}

}  // namespace
}  // namespace patchproof::validation
