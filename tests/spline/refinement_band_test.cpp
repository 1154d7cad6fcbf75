// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/refinement_band.h"

#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/knot_insertion.h"
#include "support/scalars.h"
#include "support/strained_knots.h"

namespace patchproof {
namespace {

using namespace patchproof::test;
using Curve = BsplineCurve<Rational, 2>;
using Knots = std::vector<Rational>;

// Knots of any multiplicity up to degree + 3, also at the ends of the domain and outside it, and random ones.
std::vector<KnotVector<Rational>> some_knots(RandomRationals& random) {
  std::vector<KnotVector<Rational>> out;
  const auto add = [&](int degree, Knots knots) { out.push_back(make_knots<Rational>(degree, knots)); };
  add(0, {0, 1, 1, 3});
  add(1, {-1, 0, 0, 0, 0, 1, 2, 2});
  add(2, {-1, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 3, 4, 4, 4, 5});
  add(2, {-1, 0, 0, 1, 2, 2, 2, 2, 3, 4, 4, 5});
  add(3, {0, 0, 0, 0, 1, 2, 3, 3, 4, 5, 5, 5, 6, 6, 6, 6});
  add(3, {-2, -1, -1, 0, 1, 2, 2, 2, 2, 2, 2, 3, 4, 5, 6, 6, 7});
  add(3, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
  for (int degree = 0; degree <= 6; ++degree)
    for (int repeat = 0; repeat < 4; ++repeat) add(degree, random.knots(degree, degree + 1 + random.integer(0, 8)));
  return out;
}

// Each break repeated up to degree + 3 times, some new knots, also many in one span.
KnotVector<Rational> some_finer(const KnotVector<Rational>& knots, RandomRationals& random) {
  Knots all = knots.knots();
  const Knots breaks = knots.breaks();
  for (const Rational& t : breaks)
    for (int times = random.integer(-3, knots.degree() + 2); times > 0; --times) all.push_back(t);
  for (int more = random.integer(0, 9); more > 0; --more) {
    const int span = random.integer(0, static_cast<int>(breaks.size()) - 2);
    const Rational t = breaks[span] + (breaks[span + 1] - breaks[span]) * Rational(random.integer(1, 7)) / Rational(8);
    for (int times = random.integer(1, 3); times > 0; --times) all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  return KnotVector<Rational>::make(knots.degree(), all).value();
}

Curve curve_on(const KnotVector<Rational>& knots, RandomRationals& random) {
  return Curve(knots, random.points<2>(knots.control_count()));
}

TEST(RefinementBand, Law1_IsRepeatedInsertionIdentically) {
  RandomRationals random(71);
  for (const auto& knots : some_knots(random))
    for (int repeat = 0; repeat < 12; ++repeat) {
      const Curve curve = curve_on(knots, random);
      const auto finer = some_finer(knots, random);
      const auto points = apply_band(refinement_band<Rational>(knots, finer), curve.points());
      const auto expected = refine(curve, finer).points();
      ASSERT_EQ(points.size(), expected.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_EQ(points[i].c, expected[i].c) << "point " << i << " of degree " << knots.degree();
    }
}

TEST(RefinementBand, Law1_RefusesKnotsThatAreNoRefinement) {
  const auto old = make_knots<Rational>(2, {-1, 0, 0, 1, 2, 2, 3});
  EXPECT_TRUE(is_refinement(old, old));
  EXPECT_TRUE(is_refinement(old, make_knots<Rational>(2, {-1, 0, 0, 0, 1, 1, 2, 2, 3})));
  EXPECT_FALSE(is_refinement(old, make_knots<Rational>(2, {-1, 0, 0, 1, 1, 2, 3})));      // one 2 is missing
  EXPECT_FALSE(is_refinement(old, make_knots<Rational>(2, {-1, 0, 0, 1, 2, 2, 3, 3})));   // another domain
  EXPECT_FALSE(is_refinement(old, make_knots<Rational>(2, {-1, -1, 0, 0, 1, 2, 2, 3})));  // another domain
  EXPECT_FALSE(is_refinement(old, make_knots<Rational>(1, {-1, 0, 0, 1, 2, 2, 3})));      // another degree
  EXPECT_FALSE(is_refinement(make_knots<Rational>(1, {0, 1, 2, 3}), make_knots<Rational>(1, {0, 1, 2, 4})));
  EXPECT_THROW(refinement_band<Rational>(old, make_knots<Rational>(2, {-1, 0, 0, 1, 1, 2, 3})), contract_error);
}

TEST(RefinementBand, Law2_IsBezierExtractionIdentically) {
  RandomRationals random(72);
  for (const auto& knots : some_knots(random)) {
    const Curve curve = curve_on(knots, random);
    const auto points = apply_band(bezier_band<Rational>(knots), curve.points());
    const auto pieces = extract_bezier(curve);
    const std::size_t order = knots.degree() + std::size_t(1);
    ASSERT_EQ(points.size(), pieces.size() * order);
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
      for (std::size_t j = 0; j < order; ++j)
        ASSERT_EQ(points[piece * order + j].c, pieces[piece].points[j].c) << "piece " << piece << ", point " << j;
  }
}

TEST(RefinementBand, Law3And4_ConvexAndMonotone) {
  RandomRationals random(73);
  for (const auto& knots : some_knots(random))
    for (const auto& band :
         {bezier_band<Rational>(knots), refinement_band<Rational>(knots, some_finer(knots, random))}) {
      EXPECT_TRUE(std::is_sorted(band.first.begin(), band.first.end()));
      for (int i = 0; i < band.rows(); ++i) {
        ASSERT_GE(band.first[i], 0);
        ASSERT_LE(band.first[i] + band.degree, band.old_count - 1);
        Rational sum(0);
        for (int k = 0; k <= band.degree; ++k) {
          EXPECT_GE(band.row(i)[k], 0);
          sum += band.row(i)[k];
        }
        EXPECT_EQ(sum, 1);
      }
    }
}

// Coefficients of `rounded` against the exact ones of the same knots; returns the worst error over bound.
double worst_against(const RefinementBand<double>& rounded, const RefinementBand<Tracked>& tracked,
                     const RefinementBand<Rational>& exact) {
  Rational worst(0);
  const int p = exact.degree;
  const Rational tiny = Rational((p + 1) * (p + 2)) / 2 * power_of_two(-1074);
  EXPECT_EQ(rounded.first, exact.first);
  for (int i = 0; i < exact.rows(); ++i) {
    Rational lost(0);  // what underflow must account for in this row
    for (int k = 0; k <= p; ++k) {
      const double a = rounded.row(i)[k];
      EXPECT_GE(a, 0);
      if (exact.row(i)[k] == 0) {
        EXPECT_EQ(a, 0);
      }
      if (a == 0) {
        EXPECT_LE(exact.row(i)[k], tiny);
      }
      expect_same_bits(a, tracked.row(i)[k]);
      expect_agrees(tracked.row(i)[k], exact.row(i)[k]);
      const Rational error = abs(Rational(from_double(a) - exact.row(i)[k])), bound = gamma(5 * p) * exact.row(i)[k];
      if (error > bound) lost += error - bound;
      if (exact.row(i)[k] > power_of_two(-900) && p > 0) worst = std::max(worst, Rational(error / bound));
    }
    EXPECT_LE(lost, tiny);
  }
  return nearest_double(worst);
}

TEST(RefinementBand, Law5_DoublesStayWithinTheBound) {
  WildNumbers wild(74);
  double worst = 0;
  for (int degree = 0; degree <= 7; ++degree)
    for (int repeat = 0; repeat < 3; ++repeat)
      for (const auto& knots : strained_double_knots(degree, wild)) {
        const auto old = KnotVector<double>::make(degree, knots).value();
        std::vector<double> all = knots;
        const auto added = strained_insertion(old, 14, wild);
        all.insert(all.end(), added.begin(), added.end());
        std::sort(all.begin(), all.end());
        const auto finer = KnotVector<double>::make(degree, all).value();
        worst = std::max(worst, worst_against(refinement_band<double>(old, finer), refinement_band<Tracked>(old, finer),
                                              refinement_band<Rational>(exact_knots(old), exact_knots(finer))));
        worst = std::max(worst, worst_against(bezier_band<double>(old), bezier_band<Tracked>(old),
                                              bezier_band<Rational>(exact_knots(old))));
      }
  RecordProperty("worst_error_over_bound", std::to_string(worst));
  EXPECT_GT(worst, 1.0 / 50) << "the bound is far from what happens";
}

TEST(RefinementBand, Law6_NeighboursShareTheirEnds) {
  WildNumbers wild(75);
  int meetings = 0;
  for (int degree = 1; degree <= 7; ++degree)
    for (int repeat = 0; repeat < 10; ++repeat)
      for (const auto& knots : strained_double_knots(degree, wild)) {
        const auto old = KnotVector<double>::make(degree, knots).value();
        const auto band = bezier_band<double>(old);
        std::vector<double> points;
        for (int i = 0; i < old.control_count(); ++i) points.push_back(wild.moderate());
        const auto bezier = apply_band(band, points);
        const auto breaks = old.breaks();
        for (std::size_t k = 1; k + 1 < breaks.size(); ++k)
          if (old.multiplicity(breaks[k]) <= degree) {
            EXPECT_EQ(bezier[k * (degree + 1) - 1], bezier[k * (degree + 1)]) << "at knot " << breaks[k];
            ++meetings;
          }
      }
  EXPECT_GT(meetings, 100);
}

}  // namespace
}  // namespace patchproof
