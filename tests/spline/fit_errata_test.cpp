// SPDX-License-Identifier: Apache-2.0
// Errata of "From B-Spline to GERBS Curve and Surface" about B-splines and their least-squares fit. Each test holds the printed
// formula and the wrong value it gives, and the right one from this library. docs/errata.md refers to the tests by name.
#include <gtest/gtest.h>

#include "patchproof/spline/least_squares.h"
#include "patchproof/spline/sample_parameters.h"
#include "support/lar_curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;

// Equation (1): degree 3, eight control points.
KnotVector<Rational> paper_knots() { return uniform_clamped_knots<Rational>(3, 8).value(); }

Rational sum_of(const Numbers& x) {
  Rational sum(0);
  for (const Rational& v : x) sum += v;
  return sum;
}

struct Ramps {
  Rational w1, w2m, w2, w3mm, w3m, w3;  // w_{1,i}, w_{2,i−1}, w_{2,i}, w_{3,i−2}, w_{3,i−1}, w_{3,i}
};

// Equation (4), on span i.
Ramps ramps(const KnotVector<Rational>& knots, int i, const Rational& t) {
  const auto w = [&](int d, int j) { return Rational((t - knots[j]) / (knots[j + d] - knots[j])); };
  return {w(1, i), w(2, i - 1), w(2, i), w(3, i - 2), w(3, i - 1), w(3, i)};
}

// Equation (3) as printed; w_{3,i−t} is read as w_{3,i−1}.
Numbers printed_cubic(const Ramps& r) {
  const Rational one(1);
  return {(one - r.w1) * (one - r.w2m) * (one - r.w3mm),
          (one - r.w1) * (one - r.w2m) * (one - r.w3m) + (one - r.w1) * r.w2m + r.w1 * (one - r.w2) * (one - r.w3m),
          (one - r.w1) * r.w2m + r.w1 * (one - r.w2) * r.w3m, r.w1 * r.w2 * r.w3};
}

// With the brackets that were meant, and still one term short.
Numbers bracketed_cubic(const Ramps& r) {
  const Rational one(1), middle = (one - r.w1) * r.w2m + r.w1 * (one - r.w2);
  return {(one - r.w1) * (one - r.w2m) * (one - r.w3mm),
          (one - r.w1) * (one - r.w2m) * (one - r.w3m) + middle * (one - r.w3m), middle * r.w3m, r.w1 * r.w2 * r.w3};
}

Numbers right_cubic(const Ramps& r) {
  const Rational one(1), middle = (one - r.w1) * r.w2m + r.w1 * (one - r.w2);
  return {(one - r.w1) * (one - r.w2m) * (one - r.w3mm), (one - r.w1) * (one - r.w2m) * r.w3mm + middle * (one - r.w3m),
          middle * r.w3m + r.w1 * r.w2 * (one - r.w3), r.w1 * r.w2 * r.w3};
}

TEST(FitErrata, Erratum_E_GERBS_01_TheFourCubicFunctions) {
  const KnotVector<Rational> knots = paper_knots();
  const Rational t = Rational(5) / Rational(2);
  const Ramps r = ramps(knots, knots.find_span(t), t);
  EXPECT_EQ(printed_cubic(r), numbers_of("1/48 5/8 9/16 1/48"));
  EXPECT_EQ(sum_of(printed_cubic(r)), Rational("59/48"));
  EXPECT_EQ(bracketed_cubic(r), numbers_of("1/48 7/16 3/8 1/48"));
  EXPECT_EQ(sum_of(bracketed_cubic(r)), Rational("41/48"));
  EXPECT_EQ(basis_in_span<Rational>(knots, 5, t), numbers_of("1/48 23/48 23/48 1/48"));
  for (const Rational& s : numbers_of("0 1/3 1 5/2 17/4 5")) {
    const int span = knots.find_span(s);
    EXPECT_EQ(right_cubic(ramps(knots, span, s)), basis_in_span<Rational>(knots, span, s)) << s;
  }
}

// Σ_{i=1..n} with 1-based knots makes the domain [t_3, t_8] end one span early; 0-based it is [t_d, t_n].
TEST(FitErrata, Erratum_E_GERBS_02_TheDomainIsCountedFromZero) {
  const KnotVector<Rational> knots = paper_knots();
  const auto one_based = [&](int i) { return knots[i - 1]; };
  EXPECT_EQ(one_based(3), Rational(0));
  EXPECT_EQ(one_based(8), Rational(4));
  EXPECT_EQ(knots.domain_begin(), Rational(0));
  EXPECT_EQ(knots.domain_end(), Rational(5));
  // The sum from 1 leaves out the first control point, which is the whole value at the begin.
  const Numbers at_begin = basis(knots, Rational(0));
  EXPECT_EQ(sum_of(Numbers(at_begin.begin() + 1, at_begin.end())), Rational(0));
  EXPECT_EQ(sum_of(at_begin), Rational(1));
}

std::vector<Numbers> rows_of(const KnotVector<Rational>& knots, const Numbers& at) {
  std::vector<Numbers> out;
  for (const Rational& t : at) out.push_back(basis(knots, t));
  return out;
}

// Does A c = p have a solution? By elimination of (A p).
bool is_solvable(std::vector<Numbers> rows, const Numbers& p) {
  for (std::size_t a = 0; a < rows.size(); ++a) rows[a].push_back(p[a]);
  const std::size_t n = rows.front().size() - 1;
  std::size_t found = 0;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = found;
    while (pivot < rows.size() && rows[pivot][c] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[found]);
    for (std::size_t r = found + 1; r < rows.size(); ++r) {
      const Rational factor = rows[r][c] / rows[found][c];
      for (std::size_t k = c; k <= n; ++k) rows[r][k] -= factor * rows[found][k];
    }
    ++found;
  }
  for (std::size_t r = found; r < rows.size(); ++r)
    if (rows[r][n] != 0) return false;
  return true;
}

// "A c = p" is over-determined; the least-squares solution exists, and its residual is orthogonal to A and not 0.
TEST(FitErrata, Erratum_E_GERBS_03_TheSystemIsTheNormalEquations) {
  const auto knots = uniform_clamped_knots<Rational>(3, 5).value();
  const Numbers at = uniform_parameters<Rational>(9, Rational(0), Rational(2)).value();
  Numbers quartic;
  CurveSamples<Rational, 1> samples{at, {}};
  for (const Rational& t : at) {
    quartic.push_back(t * t * t * t);
    samples.points.push_back({{quartic.back()}});
  }
  EXPECT_FALSE(is_solvable(rows_of(knots, at), quartic));
  EXPECT_TRUE(is_solvable(rows_of(knots, at), at));  // t itself is in the space
  const auto fit = fit_curve(knots, samples).value();
  EXPECT_EQ(fit.points()[2][0], Rational("-104171/140064"));
  bool any = false;
  for (std::size_t a = 0; a < at.size(); ++a) any = any || evaluate(fit, at[a])[0] != quartic[a];
  EXPECT_TRUE(any);
}

// More samples than control points, and AᵀA is singular all the same.
TEST(FitErrata, Erratum_E_GERBS_03_MoreSamplesAreNotEnough) {
  const auto knots = KnotVector<Rational>::make(3, numbers_of("0 0 0 0 1/100 1/50 3/100 1/25 1 1 1 1")).value();
  CurveSamples<Rational, 1> samples{uniform_parameters<Rational>(11, Rational(0), Rational(1)).value(),
                                    std::vector<Vec<Rational, 1>>(11)};
  const std::vector<Numbers> rows = rows_of(knots, samples.parameters);
  for (const Numbers& row : rows)
    for (const int j : {1, 2, 3}) EXPECT_EQ(row[j], Rational(0));  // three columns of zeros: rank 5
  const auto fit = fit_curve(knots, samples);
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::singular_fit);
  EXPECT_EQ(fit.error().where, "control point 1");
}

// Algorithm 1: the span search t_i ≤ t < t_{i+1} finds none at the last sample, or one beyond the matrix; and the rows have
// d + 1 numbers that are not 0, not one.
TEST(FitErrata, Erratum_E_GERBS_04_TheLastSampleBelongsToTheLastSpan) {
  const auto knots = uniform_clamped_knots<Rational>(3, 5).value();
  const Rational end = knots.domain_end();
  const int n = knots.control_count();
  int printed = 0;  // the last i with t_i ≤ t, as a search for "t < t_{i+1}" leaves it
  while (printed + 1 < static_cast<int>(knots.knots().size()) && knots[printed] <= end) ++printed;
  EXPECT_GE(printed, n);  // columns i − d … i of an m × n matrix end at n − 1
  EXPECT_EQ(knots.find_span(end), n - 1);
  const auto at = uniform_parameters<Rational>(9, knots.domain_begin(), end).value();
  const auto solver = LeastSquares<Rational>::make(knots, at).value();
  EXPECT_EQ(solver.first(8), n - 4);
  EXPECT_EQ(solver.basis(8, 3), Rational(1));
  int beside = 0;
  for (const Numbers& row : rows_of(knots, at)) {
    int live = 0;
    for (const Rational& v : row) live += v == 0 ? 0 : 1;
    EXPECT_LE(live, 4);
    beside += live > 1 ? 1 : 0;
  }
  EXPECT_EQ(beside, 7);  // all but the ends: banded, not diagonal
}

}  // namespace
}  // namespace patchproof::test
