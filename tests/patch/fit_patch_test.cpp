// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/fit_patch.h"

#include <gtest/gtest.h>

#include "patchproof/spline/sample_parameters.h"
#include "support/lar_curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class FitPatch : public ScalarTest<T> {};
TYPED_TEST_SUITE(FitPatch, ExactScalars, ScalarNames);

template <class T>
struct Problem {
  KnotVector<T> u, v;
  GridSamples<T, 3> grid;
};

// Uneven knots and parameters, weights in every other problem.
template <class T>
Problem<T> random_problem(RandomRationals& random) {
  const auto direction = [&](std::vector<T>& at, std::vector<T>& weights, bool weighted) {
    const int degree = random.integer(0, 3), count = degree + random.integer(1, 3);
    Rational next = random();
    for (int a = count + random.integer(1, 3); a > 0; --a) {
      at.push_back(make<T>(next));
      if (weighted) weights.push_back(make<T>(Rational(random.integer(1, 9)) / Rational(4)));
      next += Rational(random.integer(1, 7)) / Rational(3);
    }
    return averaged_knots(degree, count, at).value();
  };
  GridSamples<T, 3> grid;
  const bool weighted = random.integer(0, 1) == 1;
  const auto u = direction(grid.u, grid.weights_u, weighted), v = direction(grid.v, grid.weights_v, weighted);
  grid.points = make_points<T>(random.points<3>(static_cast<int>(grid.u.size() * grid.v.size())));
  return {u, v, std::move(grid)};
}

TYPED_TEST(FitPatch, Law1_ResidualsAreOrthogonal) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Problem<T> p = random_problem<T>(random);
    const auto patch = fit_patch(p.u, p.v, p.grid).value();
    std::vector<Vec<T, 3>> sums(patch.net().size());
    for (std::size_t a = 0; a < p.grid.u.size(); ++a)
      for (std::size_t b = 0; b < p.grid.v.size(); ++b) {
        const auto residual = evaluate(patch, p.grid.u[a], p.grid.v[b]) - p.grid.points[a * p.grid.v.size() + b];
        const T weight = p.grid.weights_u.empty() ? T(1) : p.grid.weights_u[a] * p.grid.weights_v[b];
        const auto row = basis(p.u, p.grid.u[a]), column = basis(p.v, p.grid.v[b]);
        for (std::size_t i = 0; i < row.size(); ++i)
          for (std::size_t j = 0; j < column.size(); ++j)
            sums[i * column.size() + j] += (weight * row[i] * column[j]) * residual;
      }
    for (const Vec<T, 3>& sum : sums) EXPECT_EQ(sum, (Vec<T, 3>{})) << "round " << round;
  }
}

TYPED_TEST(FitPatch, Law2_PatchesAreReproduced) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    Problem<T> p = random_problem<T>(random);
    const BsplinePatch<T, 3> patch(p.u, p.v,
                                   make_points<T>(random.points<3>(p.u.control_count() * p.v.control_count())));
    for (std::size_t a = 0; a < p.grid.u.size(); ++a)
      for (std::size_t b = 0; b < p.grid.v.size(); ++b)
        p.grid.points[a * p.grid.v.size() + b] = evaluate(patch, p.grid.u[a], p.grid.v[b]);
    EXPECT_EQ(fit_patch(p.u, p.v, p.grid).value().net(), patch.net()) << "round " << round;
  }
}

TYPED_TEST(FitPatch, Law3_AsManySamplesAreInterpolated) {
  using T = TypeParam;
  RandomRationals random;
  GridSamples<T, 3> grid{make_numbers<T>(numbers_of("0 1 3 4 7")), make_numbers<T>(numbers_of("-1 -1/2 0 2")),
                         make_points<T>(random.points<3>(20))};
  const auto patch =
      fit_patch(averaged_knots(3, 5, grid.u).value(), averaged_knots(2, 4, grid.v).value(), grid).value();
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < 4; ++b) EXPECT_EQ(evaluate(patch, grid.u[a], grid.v[b]), grid.points[a * 4 + b]);
}

TYPED_TEST(FitPatch, Law4_DirectionsSwap) {
  using T = TypeParam;
  RandomRationals random;
  for (int round = 0; round < 10; ++round) {
    const Problem<T> p = random_problem<T>(random);
    GridSamples<T, 3> swapped{p.grid.v, p.grid.u, {}, p.grid.weights_v, p.grid.weights_u};
    for (std::size_t b = 0; b < p.grid.v.size(); ++b)
      for (std::size_t a = 0; a < p.grid.u.size(); ++a)
        swapped.points.push_back(p.grid.points[a * p.grid.v.size() + b]);
    EXPECT_EQ(fit_patch(p.v, p.u, swapped).value().net(), swap_directions(fit_patch(p.u, p.v, p.grid).value()).net());
  }
}

TEST(FitPatchErrors, EachHasItsCodeAndDirection) {
  const auto line = KnotVector<Rational>::bezier(1);
  GridSamples<Rational, 1> grid{numbers_of("0 1"), numbers_of("0 0"), std::vector<Vec<Rational, 1>>(4)};
  const Error v = fit_patch(line, line, grid).error();
  EXPECT_EQ(v.code, ErrorCode::singular_fit);
  EXPECT_EQ(v.where, "along v, control point 1");
  std::swap(grid.u, grid.v);
  EXPECT_EQ(fit_patch(line, line, grid).error().where, "along u, control point 1");
  grid.u = numbers_of("0 2");
  EXPECT_EQ(fit_patch(line, line, grid).error().code, ErrorCode::outside_domain);
  grid.u = numbers_of("0 1");
  grid.weights_u = numbers_of("1 0");
  EXPECT_EQ(fit_patch(line, line, grid).error().code, ErrorCode::bad_weight);
  grid.weights_u.clear();
  grid.points.pop_back();
  EXPECT_EQ(fit_patch(line, line, grid).error().code, ErrorCode::wrong_count);
}

}  // namespace
}  // namespace patchproof::test
