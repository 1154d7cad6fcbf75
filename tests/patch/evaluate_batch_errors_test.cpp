// SPDX-License-Identifier: Apache-2.0
// Laws (3) and (4) of evaluate_batch.h, bad data and unusual degrees.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "kernels/pieces.h"
#include "support/batch_results.h"
#include "validation/corpus/truth.h"

namespace patchproof {
namespace {

using test::Results;

const std::vector<double> kBezier = {0, 0, 0, 1, 1, 1};
std::vector<double> saddle() {
  std::vector<double> points;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) points.insert(points.end(), {double(i), double(j), double(i * j)});
  return points;
}

TEST(EvaluateBatch, Law3EndsBelongToTheDomainAndSidesChooseAtKnots) {
  // Degree 1 with a jump at 1: knots 0 0 1 1 2 2 along u.
  const std::vector<double> jump = {0, 0, 1, 1, 2, 2}, line = {0, 0, 1, 1};
  std::vector<double> points;
  for (const double x : {0.0, 1.0, 5.0, 7.0})
    for (int j = 0; j < 2; ++j) points.insert(points.end(), {x, double(j), 0});
  const BatchSurface surface = *BatchSurface::make({1, 1, jump, line, points, {}});
  const std::vector<double> u = {0, 1, 2}, v = {0, 1, 1};
  for (const InstructionSet set : available_instruction_sets())
    for (const Side side : {Side::left, Side::right}) {
      Results r(3);
      SurfaceBatchOptions options;
      options.instructions = set;
      options.side_u = side;
      ASSERT_TRUE(surface.evaluate(u, v, r.out, options));
      EXPECT_EQ(r.numbers[0], (std::vector<double>{0, 0, 0, side == Side::left ? 1.0 : 5.0, 1, 0, 7, 1, 0}));
      EXPECT_EQ(r.numbers[1][3], side == Side::left ? 1 : 2);
    }
}

TEST(EvaluateBatch, Law4ParametersOutsideTheDomainAreNamed) {
  const BatchSurface surface = *BatchSurface::make({2, 2, kBezier, kBezier, saddle(), {}});
  for (const double bad :
       {-1e-300, 1.0000000000000002, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::size_t place : {std::size_t{0}, std::size_t{5}, std::size_t{300}, std::size_t{699}})
      for (const bool in_u : {true, false}) {
        std::vector<double> u(700, 0.25), v(700, 0.5);
        (in_u ? u : v)[place] = bad;
        Results r(700);
        const auto result = surface.evaluate(u, v, r.out);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::outside_domain);
        EXPECT_EQ(result.error().where, "parameter " + std::to_string(place));
        EXPECT_NE(result.error().values.find("(u, v) = ("), std::string::npos);
        EXPECT_EQ(r.numbers[0][3 * 699], -1);  // nothing behind the index's tile
        const auto grid = surface.evaluate_grid(u, v, SurfaceOutput{});
        ASSERT_FALSE(grid);
        EXPECT_EQ(grid.error().where, (in_u ? "u[" : "v[") + std::to_string(place) + "]");
        EXPECT_FALSE(surface.evaluate_bounded(u, v, r.out.point, nullptr));
        EXPECT_FALSE(surface.evaluate_correctly_rounded(u, v, r.out.point));
      }
}

TEST(EvaluateBatch, Law4ZerosOfTheDenominatorAreNamed) {
  // w = 1 − 2u: zero at u = 1/2.
  const std::vector<double> line = {0, 0, 1, 1}, weights = {1, 1, -1, -1},
                            points = {0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1};
  const BatchSurface surface = *BatchSurface::make({1, 1, line, line, points, weights});
  for (const InstructionSet set : available_instruction_sets()) {
    SurfaceBatchOptions options;
    options.instructions = set;
    std::vector<double> u(600, 0.25), v(600, 0.125);
    Results r(600);
    ASSERT_TRUE(surface.evaluate(u, v, r.out, options));
    EXPECT_EQ(r.numbers[0][0], -0.5);  // (1·0·3/4 − 1·1·1/4)/(1/2)
    u[417] = 0.5;
    for (const auto& result :
         {surface.evaluate(u, v, r.out, options), surface.evaluate_correctly_rounded(u, v, r.out.point, options)}) {
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::vanishing_weight);
      EXPECT_EQ(result.error().where, "parameter 417");
    }
    std::vector<double> grid_u = {0, 0.5, 1}, grid_v = {0, 1};
    Results g(6);
    const auto result = surface.evaluate_grid(grid_u, grid_v, g.out, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().where, "parameter 2");
  }
}

TEST(EvaluateBatch, DegreesFarBeyondTheUsualWorkInEveryCall) {
  const int p = 2, q = 40;
  std::vector<double> ku(p + 1, 0.0), kv(q + 1, 0.0), points, xs;
  ku.resize(2 * p + 2, 1.0);
  kv.resize(2 * q + 2, 1.0);
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j) points.insert(points.end(), {double(i), j / 40.0, std::cos(3.0 * i + j)});
  const SurfaceData data{p, q, ku, kv, points, {}};
  const BatchSurface surface = *BatchSurface::make(data);
  const auto patch = validation::exact_patch(data);
  const std::vector<double> u = {0, 0.3, 1}, v = {0, 0.1, 0.5, 0.99, 1};
  for (const InstructionSet set : available_instruction_sets()) {
    SurfaceBatchOptions options;
    options.instructions = set;
    Results grid(15), rounded(15, 1);
    ASSERT_TRUE(surface.evaluate_grid(u, v, grid.out, options));
    std::vector<double> us, vs;
    for (int i = 0; i < 15; ++i) {
      us.push_back(u[i / 5]);
      vs.push_back(v[i % 5]);
    }
    ASSERT_TRUE(surface.evaluate_correctly_rounded(us, vs, rounded.out.point, options));
    for (int i = 0; i < 15; ++i) {
      const auto exact = validation::exact_values(patch, us[i], vs[i], Side::right, 0).vectors[0];
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(rounded.numbers[0][3 * i + k], nearest_double(exact[k]));
        EXPECT_LE(abs(from_double(grid.numbers[0][3 * i + k]) - exact[k]),
                  from_double(surface.pieces().bounds[0].error[0]));
      }
    }
  }
}

TEST(EvaluateBatch, BadDataIsRefusedWithItsPlace) {
  const auto code = [](const SurfaceData& data) {
    const auto made = BatchSurface::make(data);
    return made ? std::string("none") : std::string(to_string(made.error().code)) + " " + made.error().where;
  };
  const std::vector<double> points = saddle(), falling = {0, 0, 1, 0.5, 1, 1}, empty = {1, 1, 1, 1, 1, 1};
  std::vector<double> nan = points, weights(9, 1.0);
  nan[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code({2, 2, kBezier, kBezier, points, {}}), "none");
  EXPECT_EQ(code({-1, 2, kBezier, kBezier, points, {}}), "bad_degree knots_u");
  EXPECT_EQ(code({2, 2, falling, kBezier, points, {}}), "decreasing_knots knots_u");
  EXPECT_EQ(code({2, 2, kBezier, empty, points, {}}), "empty_domain knots_v");
  EXPECT_EQ(code({2, 3, kBezier, kBezier, points, {}}), "wrong_count knots_v");
  EXPECT_EQ(code({2, 2, kBezier, kBezier, {points.data(), 24}, {}}), "wrong_count points");
  EXPECT_EQ(code({2, 2, kBezier, kBezier, points, {weights.data(), 8}}), "wrong_count weights");
  EXPECT_EQ(code({2, 2, kBezier, kBezier, nan, {}}), "bad_number points[4]");
  weights[3] = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(code({2, 2, kBezier, kBezier, points, weights}), "bad_number weights[3]");
  weights.assign(9, 0.0);
  EXPECT_EQ(code({2, 2, kBezier, kBezier, points, weights}), "bad_number weights");
  std::vector<double> huge(27, 1.7e308), wide = {-1e308, -1e308, -1e308, 1e308, 1e308, 1e308};
  huge[3] = -1.7e308;
  EXPECT_EQ(code({2, 2, kBezier, kBezier, huge, {}}).substr(0, 10), "bad_number");
  EXPECT_EQ(code({2, 2, wide, kBezier, points, {}}), "bad_number knots_u");
}

}  // namespace
}  // namespace patchproof
