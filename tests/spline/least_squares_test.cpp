// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/least_squares.h"

#include <gtest/gtest.h>

#include <limits>

#include "patchproof/spline/sample_parameters.h"
#include "support/lar_curves.h"
#include "support/rational_literal.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class LeastSquaresTest : public ScalarTest<T> {};
TYPED_TEST_SUITE(LeastSquaresTest, ExactScalars, ScalarNames);

template <class T>
struct Problem {
  KnotVector<T> knots;
  CurveSamples<T, 2> samples;
};

// Any knots, unclamped and repeated ones too; parameters from the domain, some of them knots and ends; positive weights.
template <class T>
Problem<T> random_problem(RandomRationals& random) {
  const int degree = random.integer(0, 4), count = degree + random.integer(1, 6);
  const KnotVector<Rational> knots = KnotVector<Rational>::make(degree, random.knots(degree, count)).value();
  const std::vector<Rational> breaks = knots.breaks();
  std::vector<Rational> at, weights;
  for (int a = count + random.integer(0, 12); a > 0; --a) {
    at.push_back(random.integer(0, 3) == 0
                     ? breaks[random.integer(0, static_cast<int>(breaks.size()) - 1)]
                     : Rational(knots.domain_begin() + (knots.domain_end() - knots.domain_begin()) * random.unit()));
    weights.push_back(Rational(random.integer(1, 9)) / Rational(random.integer(1, 4)));
  }
  const int samples = static_cast<int>(at.size());
  return {make_knots<T>(degree, knots.knots()),
          {make_numbers<T>(at), make_points<T>(random.points<2>(samples)),
           random.integer(0, 1) ? make_numbers<T>(weights) : std::vector<T>{}}};
}

template <class T>
std::vector<std::vector<T>> collocation(const KnotVector<T>& knots, const std::vector<T>& at) {
  std::vector<std::vector<T>> out;
  for (const T& t : at) out.push_back(basis(knots, t));
  return out;
}

template <class T>
int rank(std::vector<std::vector<T>> rows) {
  int found = 0;
  for (std::size_t c = 0; c < rows.front().size(); ++c) {
    std::size_t pivot = found;
    while (pivot < rows.size() && rows[pivot][c] == T(0)) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[found]);
    for (std::size_t r = found + 1; r < rows.size(); ++r) {
      const T factor = rows[r][c] / rows[found][c];
      for (std::size_t k = c; k < rows[r].size(); ++k) rows[r][k] += -(factor * rows[found][k]);
    }
    ++found;
  }
  return found;
}

KnotVector<Rational> crowded_knots() {
  return KnotVector<Rational>::make(3, numbers_of("0 0 0 0 1/100 1/50 3/100 1/25 1 1 1 1")).value();
}

// The combinatorial test and the rank of the matrix say the same, on any knots.
TYPED_TEST(LeastSquaresTest, Law1_MatchedExactlyWhenTheRankIsFull) {
  using T = TypeParam;
  RandomRationals random;
  int singular = 0, regular = 0;
  for (int round = 0; round < 250; ++round) {
    const Problem<T> p = random_problem<T>(random);
    const auto matched = match_samples(p.knots, p.samples.parameters);
    const int n = p.knots.control_count();
    EXPECT_EQ(matched.has_value(), rank(collocation(p.knots, p.samples.parameters)) == n) << "round " << round;
    if (!matched) {
      EXPECT_EQ(matched.error().code, ErrorCode::singular_fit);
      EXPECT_FALSE(matched.error().where.empty());
      ++singular;
      continue;
    }
    ++regular;
    for (int j = 0; j < n; ++j) {
      const T& t = p.samples.parameters[(*matched)[j]];
      EXPECT_TRUE(T(0) < basis(p.knots, t)[j]);
      EXPECT_TRUE(j == 0 || p.samples.parameters[(*matched)[std::max(1, j) - 1]] < t);
    }
  }
  EXPECT_GT(singular, 40);
  EXPECT_GT(regular, 40);
}

TYPED_TEST(LeastSquaresTest, Law1_PositiveFunctionsAreTheOnesThatAreNotZero) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 100; ++round) {
    const Problem<T> p = random_problem<T>(random);
    for (const T& t : p.samples.parameters) {
      const std::vector<T> values = basis(p.knots, t);
      const auto [first, last] = detail::positive_functions(p.knots, p.knots.find_span(t), t);
      for (int j = 0; j < static_cast<int>(values.size()); ++j)
        EXPECT_EQ(first <= j && j <= last, T(0) < values[j]) << j;
    }
  }
}

// Uniform knots and samples: full rank whatever their numbers.
TYPED_TEST(LeastSquaresTest, Law1_UniformSamplesAreEnough) {
  using T = TypeParam;
  for (const int n : {4, 5, 6, 8})
    for (const int m : {n - 1, n, n + 1, 2 * n}) {
      const auto knots = uniform_clamped_knots<T>(3, n).value();
      const auto at = uniform_parameters<T>(m, knots.domain_begin(), knots.domain_end()).value();
      EXPECT_EQ(rank(collocation(knots, at)), std::min(m, n));
      const auto matched = match_samples(knots, at);
      EXPECT_EQ(matched.has_value(), m >= n);
      if (m < n) {
        EXPECT_EQ(matched.error().code, ErrorCode::wrong_count);
      }
    }
}

TEST(LeastSquaresErrors, SingularFitsSayWhereAndWhy) {
  const auto at = uniform_parameters<Rational>(11, Rational(0), Rational(1)).value();
  const Error one = match_samples(crowded_knots(), at).error();
  EXPECT_EQ(one.text(),
            "control point 1: its function has no sample at which it is positive [knots 0 to 1/50; samples at none] "
            "(singular_fit)");
  const Error three = match_samples(KnotVector<Rational>::bezier(2), numbers_of("0 1/2 1/2 1/2 0")).error();
  EXPECT_EQ(three.text(),
            "control points 1 to 2: their functions need 2 samples at different parameters, and have 1 [knots 0 to 1; "
            "samples at 1/2] (singular_fit)");
  const auto dead = KnotVector<Rational>::make(1, numbers_of("0 0 1 1 1 2 2")).value();
  const Error never = match_samples(dead, numbers_of("0 1/2 1 5/4 3/2 2")).error();
  EXPECT_EQ(never.code, ErrorCode::singular_fit);
  EXPECT_EQ(never.where, "control point 2");
}

TEST(LeastSquaresErrors, EachBadInputHasItsCode) {
  const auto knots = KnotVector<Rational>::bezier(1);
  const std::vector<Vec<Rational, 1>> points{{{Rational(1)}}, {{Rational(2)}}};
  using Samples = CurveSamples<Rational, 1>;
  const auto code = [&](const Samples& s) { return fit_curve(knots, s).error().code; };
  EXPECT_EQ(code(Samples{numbers_of("0 1 1"), points}), ErrorCode::wrong_count);
  EXPECT_EQ(code(Samples{numbers_of("0 1"), points, numbers_of("1")}), ErrorCode::wrong_count);
  EXPECT_EQ(code(Samples{numbers_of("0 1"), points, numbers_of("1 0")}), ErrorCode::bad_weight);
  EXPECT_EQ(code(Samples{numbers_of("0 1"), points, numbers_of("-1 1")}), ErrorCode::bad_weight);
  EXPECT_EQ(code(Samples{numbers_of("0 3/2"), points}), ErrorCode::outside_domain);
  EXPECT_EQ(code(Samples{numbers_of("1 1"), points}), ErrorCode::singular_fit);
  EXPECT_EQ(fit_curve(knots, Samples{{}, {}}).error().code, ErrorCode::wrong_count);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(match_samples(KnotVector<double>::bezier(1), {0.0, nan}).error().code, ErrorCode::outside_domain);
}

TYPED_TEST(LeastSquaresTest, Law2_ResidualsAreOrthogonal) {
  using T = TypeParam;
  RandomRationals random;
  int fitted = 0;
  for (int round = 0; round < 120; ++round) {
    const Problem<T> p = random_problem<T>(random);
    const auto curve = fit_curve(p.knots, p.samples);
    if (!curve) continue;
    ++fitted;
    const auto rows = collocation(p.knots, p.samples.parameters);
    for (int j = 0; j < p.knots.control_count(); ++j) {
      Vec<T, 2> sum;
      for (std::size_t a = 0; a < rows.size(); ++a) {
        const T weighted = p.samples.weights.empty() ? rows[a][j] : p.samples.weights[a] * rows[a][j];
        sum += weighted * (evaluate(*curve, p.samples.parameters[a]) - p.samples.points[a]);
      }
      EXPECT_EQ(sum, (Vec<T, 2>{})) << "round " << round << ", function " << j;
    }
  }
  EXPECT_GT(fitted, 20);
}

TYPED_TEST(LeastSquaresTest, Law3_SplinesAreReproduced) {
  using T = TypeParam;
  RandomRationals random;
  int fitted = 0;
  for (int round = 0; round < 120; ++round) {
    Problem<T> p = random_problem<T>(random);
    const BsplineCurve<T, 2> curve(p.knots, make_points<T>(random.points<2>(p.knots.control_count())));
    for (std::size_t a = 0; a < p.samples.points.size(); ++a)
      p.samples.points[a] = evaluate(curve, p.samples.parameters[a]);
    const auto found = fit_curve(p.knots, p.samples);
    if (!found) continue;
    ++fitted;
    EXPECT_EQ(found->points(), curve.points()) << "round " << round;
  }
  EXPECT_GT(fitted, 20);
}

TYPED_TEST(LeastSquaresTest, Law4_AsManySamplesAreInterpolated) {
  using T = TypeParam;
  RandomRationals random;
  for (const int degree : {0, 1, 2, 3, 5}) {
    const int n = degree + 6;
    std::vector<T> at;
    for (int a = 0; a < n; ++a) at.push_back(make<T>(Rational(a * a + 3 * a) / Rational(7)));
    const auto points = make_points<T>(random.points<3>(n));
    const auto curve = interpolate_curve(averaged_knots(degree, n, at).value(), CurveSamples<T, 3>{at, points}).value();
    for (int a = 0; a < n; ++a) EXPECT_EQ(evaluate(curve, at[a]), points[a]) << degree << ", " << a;
  }
  const CurveSamples<T, 1> three{make_numbers<T>(numbers_of("0 1/2 1")), std::vector<Vec<T, 1>>(3)};
  EXPECT_EQ(interpolate_curve(KnotVector<T>::bezier(1), three).error().code, ErrorCode::wrong_count);
}

// More samples than control points: the ends are not interpolated.
TYPED_TEST(LeastSquaresTest, Law4_ButNotWhenThereAreMore) {
  using T = TypeParam;
  const CurveSamples<T, 1> samples{make_numbers<T>(numbers_of("0 1/2 1")), {{{T(0)}}, {{T(1)}}, {{T(0)}}}};
  const auto line = fit_curve(KnotVector<T>::bezier(1), samples).value();
  EXPECT_EQ(line.points()[0][0], make<T>("1/3"_q));
  EXPECT_EQ(line.points()[1][0], make<T>("1/3"_q));
}

TYPED_TEST(LeastSquaresTest, Law5_AffineMaps) {
  using T = TypeParam;
  RandomRationals random;
  const auto map = [](const Vec<T, 2>& p) {
    return Vec<T, 2>{{T(2) * p[0] - T(3) * p[1] + T(5), p[0] + make<T>("1/3"_q) * p[1] - T(1)}};
  };
  for (int round = 0; round < 40; ++round) {
    Problem<T> p = random_problem<T>(random);
    const auto curve = fit_curve(p.knots, p.samples);
    if (!curve) continue;
    for (Vec<T, 2>& point : p.samples.points) point = map(point);
    const auto mapped = fit_curve(p.knots, p.samples).value();
    for (int j = 0; j < p.knots.control_count(); ++j) EXPECT_EQ(mapped.points()[j], map(curve->points()[j]));
  }
}

TYPED_TEST(LeastSquaresTest, Law6_BandedFactors) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 40; ++round) {
    const int n = random.integer(1, 9), width = random.integer(0, 3);
    // Σ v vᵀ over vectors v of width + 1 numbers, and 1 on the diagonal.
    std::vector<std::vector<T>> full(n, std::vector<T>(n, T(0)));
    for (int i = 0; i < n; ++i) full[i][i] = T(1);
    for (int first = 0; first + width < n; ++first) {
      const std::vector<T> v = make_numbers<T>(random.numbers(width + 1));
      for (int i = 0; i <= width; ++i)
        for (int j = 0; j <= width; ++j) full[first + i][first + j] += v[i] * v[j];
    }
    std::vector<T> band;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k <= width; ++k) band.push_back(k <= i ? full[i][i - k] : T(7));
    const auto factored = BandedLdlt<T>::factor(n, width, band);
    ASSERT_TRUE(factored.has_value());
    const auto b = make_points<T>(random.points<2>(n));
    const auto x = factored->solve(b);
    for (int i = 0; i < n; ++i) {
      Vec<T, 2> sum;
      for (int j = 0; j < n; ++j) sum += full[i][j] * x[j];
      EXPECT_EQ(sum, b[i]);
    }
  }
  EXPECT_FALSE(BandedLdlt<T>::factor(2, 1, make_numbers<T>(numbers_of("1 0 1 1"))).has_value());  // singular
  EXPECT_FALSE(BandedLdlt<T>::factor(1, 0, make_numbers<T>(numbers_of("-1"))).has_value());
  EXPECT_THROW((BandedLdlt<T>::factor(2, 1, {}).has_value()), contract_error);
}

TEST(LeastSquaresExact, RootsAreExact) {
  const Quadratic root(Rational(0), Rational(1), 2);
  const CurveSamples<Quadratic, 1> samples{{Quadratic(0), Quadratic(1) / root, Quadratic(1)},
                                           {{{Quadratic(0)}}, {{Quadratic(1)}}, {{root}}}};
  const auto curve = fit_curve(KnotVector<Quadratic>::bezier(2), samples).value();
  for (int a = 0; a < 3; ++a) EXPECT_EQ(evaluate(curve, samples.parameters[a]), samples.points[a]);
}

TEST(LeastSquaresExact, OneSetUpServesManySamples) {
  RandomRationals random;
  const auto knots = uniform_clamped_knots<Rational>(2, 5).value();
  const auto at = uniform_parameters<Rational>(9, knots.domain_begin(), knots.domain_end()).value();
  const auto solver = LeastSquares<Rational>::make(knots, at).value();
  for (int round = 0; round < 3; ++round) {
    const auto points = random.points<3>(9);
    EXPECT_EQ(solver.control_points(points), fit_curve(knots, CurveSamples<Rational, 3>{at, points}).value().points());
  }
  EXPECT_THROW((solver.control_points(random.points<3>(8))), contract_error);
}

}  // namespace
}  // namespace patchproof::test
