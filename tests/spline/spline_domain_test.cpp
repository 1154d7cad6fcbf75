// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/spline_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "patchproof/scalar/quadratic.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/bspline_basis.h"
#include "support/curves.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Knots = KnotVector<Rational>;
using Component = DomainComponent<Rational>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

Knots knots_of(int degree, const std::vector<int>& knots) {
  return Knots::make(degree, Numbers(knots.begin(), knots.end())).value();
}

// Knot vectors with every multiplicity at every place.
std::vector<Knots> many_knots(RandomRationals& random) {
  std::vector<Knots> out;
  for (const NamedCurve& c : awkward_curves(random)) out.push_back(c.curve.knots());
  for (int round = 0; round < 40; ++round) {
    const int degree = random.integer(0, 4), count = degree + 1 + random.integer(0, 6);
    out.push_back(Knots::make(degree, random.knots(degree, count)).value());
  }
  return out;
}

std::vector<Numbers> parameters(const Knots& knots, const Rational& cells_per_unit) {
  std::vector<Numbers> out;
  const auto lists = sample_domain(knots, cells_per_unit).value();
  for (const auto& samples : lists) {
    out.emplace_back();
    for (const auto& sample : samples) out.back().push_back(sample.t);
  }
  return out;
}

TEST(SplineDomain, Law1_ComponentsFillTheDomainAndEndAtJumps) {
  RandomRationals random;
  for (const Knots& k : many_knots(random)) {
    const auto parts = components(k);
    EXPECT_EQ(parts.front().begin, k.domain_begin());
    EXPECT_EQ(parts.back().end, k.domain_end());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_LT(parts[i].begin, parts[i].end);
      if (i > 0) {
        EXPECT_EQ(parts[i].begin, parts[i - 1].end);
        EXPECT_GT(k.multiplicity(parts[i].begin), k.degree());
      }
      for (const Rational& t : k.breaks())
        if (parts[i].begin < t && t < parts[i].end) {
          EXPECT_LE(k.multiplicity(t), k.degree());
        }
    }
  }
}

TEST(SplineDomain, Law1_KnownComponents) {
  const auto parts = [](const Knots& k) { return components(k); };
  EXPECT_EQ(parts(knots_of(2, {0, 0, 0, 1, 1, 2, 3, 4, 4, 4})), (std::vector<Component>{{q(0), q(4)}}));
  EXPECT_EQ(parts(knots_of(2, {0, 0, 0, 1, 1, 1, 2, 3, 3, 3})), (std::vector<Component>{{q(0), q(1)}, {q(1), q(3)}}));
  EXPECT_EQ(parts(knots_of(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2})), (std::vector<Component>{{q(0), q(1)}, {q(1), q(2)}}));
  EXPECT_EQ(parts(knots_of(0, {0, 1, 3})), (std::vector<Component>{{q(0), q(1)}, {q(1), q(3)}}));
  EXPECT_EQ(parts(knots_of(2, {0, 1, 2, 3, 4, 5, 6, 7})), (std::vector<Component>{{q(2), q(5)}}));
  // Ends of multiplicity above p + 1 split nothing off.
  EXPECT_EQ(parts(knots_of(2, {0, 0, 0, 0, 0, 1, 2, 2, 2, 2})), (std::vector<Component>{{q(0), q(2)}}));
}

TEST(SplineDomain, Law2_DeadPointsAreThoseWhoseFunctionVanishesOnEverySpan) {
  RandomRationals random;
  for (const Knots& k : many_knots(random)) {
    const std::vector<int> dead = dead_control_points(k);
    EXPECT_TRUE(std::is_sorted(dead.begin(), dead.end()));
    const Numbers breaks = k.breaks();
    for (int i = 0; i < k.control_count(); ++i) {
      bool lives = false;  // a B-spline function is positive inside its support
      for (std::size_t s = 0; s + 1 < breaks.size(); ++s)
        lives = lives || basis_derivative(k, Rational((breaks[s] + breaks[s + 1]) / 2), 0)[i] != 0;
      EXPECT_EQ(std::binary_search(dead.begin(), dead.end(), i), !lives) << "control point " << i;
    }
  }
}

TEST(SplineDomain, Law2_KnownDeadPoints) {
  using Indices = std::vector<int>;
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2})), Indices{3});
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 0, 0, 1, 1, 1, 2, 3, 3, 3})), Indices{});
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 0, 0, 0, 0, 1, 2, 2, 2, 2})), (Indices{0, 1, 6}));
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 0, 0, 1, 1, 1, 1})), Indices{3});
  // A support of positive length that misses the domain [2, 5].
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 1, 2, 2, 3, 4, 5, 5, 6, 7})), (Indices{0, 6}));
  EXPECT_EQ(dead_control_points(knots_of(2, {0, 1, 2, 3, 4, 5, 6, 7})), Indices{});
}

TEST(SplineDomain, Law3_SamplesHoldAllBreaksAndEndExactly) {
  RandomRationals random;
  for (const Knots& k : many_knots(random))
    for (const Rational& density : {q(1, 1000), q(1), q(7, 3), q(16)}) {
      const auto lists = sample_domain(k, density).value();
      const auto parts = components(k);
      ASSERT_EQ(lists.size(), parts.size());
      for (std::size_t c = 0; c < parts.size(); ++c) {
        const auto& samples = lists[c];
        ASSERT_GE(samples.size(), 2u);
        EXPECT_EQ(samples.front(), (DomainSample<Rational>{parts[c].begin, Side::right}));
        EXPECT_EQ(samples.back(), (DomainSample<Rational>{parts[c].end, Side::left}));
        for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
          EXPECT_EQ(samples[i].side, Side::right);
          EXPECT_LT(samples[i].t, samples[i + 1].t);
        }
        for (const Rational& t : k.breaks())
          if (parts[c].begin <= t && t <= parts[c].end) {
            EXPECT_EQ(std::count_if(samples.begin(), samples.end(), [&](const auto& s) { return s.t == t; }), 1);
          }
      }
    }
}

TEST(SplineDomain, Law3_KnownSamples) {
  const auto from_to = [](int begin, int end, int per_unit) {
    Numbers out;
    for (int i = begin * per_unit; i <= end * per_unit; ++i) out.push_back(q(i, per_unit));
    return out;
  };
  EXPECT_EQ(parameters(knots_of(2, {0, 1, 2, 3, 4, 5, 6, 7}), q(4)), std::vector<Numbers>{from_to(2, 5, 4)});
  EXPECT_EQ(parameters(knots_of(2, {0, 0, 0, 1, 1, 1, 2, 3, 3, 3}), q(2)),
            (std::vector<Numbers>{from_to(0, 1, 2), from_to(1, 3, 2)}));
  EXPECT_EQ(parameters(knots_of(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2}), q(2)),
            (std::vector<Numbers>{from_to(0, 1, 2), from_to(1, 2, 2)}));
  EXPECT_EQ(parameters(knots_of(2, {10, 10, 10, 11, 11, 11}), q(4)), std::vector<Numbers>{from_to(10, 11, 4)});
}

TEST(SplineDomain, Law4_CellsAreShortButNotShorterThanNeeded) {
  RandomRationals random;
  for (const Knots& k : many_knots(random))
    for (const Rational& density : {q(1, 1000), q(1), q(7, 3), q(16)})
      for (const Numbers& list : parameters(k, density))
        for (std::size_t i = 0; i + 1 < list.size(); ++i) {
          const Rational cell = list[i + 1] - list[i];
          EXPECT_LE(cell * density, 1);
          const int span = k.find_span(list[i]);
          const Rational length = k[span + 1] - k[span], count = length / cell;
          if (count != 1) {
            EXPECT_GT(density * length, count - 1);
          }
        }
}

// The ceiling of numbers just below, at and above an integer, of powers of two and in Q(√2).
TEST(SplineDomain, Law4_CeilingIsExact) {
  const Rational tiny = Rational(1) / Rational(Integer(1) << 200);
  for (const int n : {1, 2, 3, 4, 5, 7, 8, 9, 1000, 1023, 1024, 1025}) {
    EXPECT_EQ(detail::ceiling_up_to<Rational>(q(n) - tiny, 2000), n);
    EXPECT_EQ(detail::ceiling_up_to<Rational>(q(n), 2000), n);
    EXPECT_EQ(detail::ceiling_up_to<Rational>(q(n) + tiny, 2000), n + 1);
    EXPECT_EQ(detail::ceiling_up_to<Rational>(q(n), n), n);
    EXPECT_EQ(detail::ceiling_up_to<Rational>(q(n) + tiny, n), n + 1);
  }
  EXPECT_EQ(detail::ceiling_up_to<Rational>(tiny, 5), 1);
  EXPECT_EQ(detail::ceiling_up_to<Quadratic>(Quadratic(q(0), q(100), 2), 1000), 142);
  EXPECT_EQ(detail::ceiling_up_to<double>(2.5, 1000), 3);
}

TEST(SplineDomain, TooManyCellsAreRefusedAndNotCut) {
  const Knots k = knots_of(1, {0, 0, 2, 5, 5});
  ASSERT_TRUE(sample_domain(k, q(1), 5).has_value());
  EXPECT_EQ(sample_domain(k, q(1), 5)->front().size(), 6u);
  for (const auto& [density, limit] : {std::pair{q(1), 4}, {q(1), 1}, {q(1), 2}, {q(1000000000), 1000}}) {
    const auto refused = sample_domain(k, density, limit);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
  // A domain as long as a file may say; no cell is made before the refusal.
  const Knots huge = Knots::make(1, {q(0), q(0), Rational(Integer(1) << 4000), Rational(Integer(1) << 4000)}).value();
  EXPECT_FALSE(sample_domain(huge, q(32)).has_value());
  EXPECT_TRUE(sample_domain(huge, Rational(q(1) / Rational(Integer(1) << 3998))).has_value());
}

TEST(SplineDomain, DoublesAreSampledToo) {
  const auto k = KnotVector<double>::make(2, {0, 0, 0, 0.1, 0.3, 0.3, 0.3}).value();
  const auto lists = sample_domain(k, 160.0).value();
  ASSERT_EQ(lists.size(), 1u);
  EXPECT_EQ(lists[0].size(), 49u);
  EXPECT_EQ(lists[0].back().t, 0.3);
  EXPECT_EQ(lists[0][16].t, 0.1);
}

TEST(SplineDomain, Contracts) {
  const Knots k = knots_of(1, {0, 0, 1, 1});
  EXPECT_THROW((void)sample_domain(k, q(0)), contract_error);
  EXPECT_THROW((void)sample_domain(k, q(-1)), contract_error);
  EXPECT_THROW((void)sample_domain(k, q(1), 0), contract_error);
  EXPECT_THROW((void)sample_domain(k, q(1), 1 << 30), contract_error);
}

// A closed quadratic on uniform knots: the domain is one period, strictly inside the knots.
TEST(SplineDomain, PeriodicKnotsHaveOneComponentAndNoDeadPoint) {
  const Knots k = periodic_knots(2, Numbers{q(2), q(3), q(4), q(5), q(6)}).value();
  EXPECT_EQ(k, knots_of(2, {0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(components(k), (std::vector<Component>{{q(2), q(6)}}));
  EXPECT_TRUE(dead_control_points(k).empty());
}

}  // namespace
}  // namespace patchproof::test
