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

TEST(EvaluateBatch, Law4TheFirstZeroOfTheDenominatorIsNamedAlsoInLaterTilesOfAGrid) {
  // w = (1 − 2u)(1 − 2v): of the grid {1/4, 1/2} × 300 columns with v = 1/2 in column 280, item 280 comes first.
  const std::vector<double> line = {0, 0, 1, 1}, weights = {1, -1, -1, 1},
                            points = {0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1};
  const BatchSurface surface = *BatchSurface::make({1, 1, line, line, points, weights});
  std::vector<double> u = {0.25, 0.5}, v(300, 0.125);
  v[280] = 0.5;
  Results g(600);
  const auto grid = surface.evaluate_grid(u, v, g.out);
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.error().where, "parameter 280");
  // A zero before a parameter outside the domain, in one tile.
  std::vector<double> us(200, 0.25), vs(200, 0.125);
  us[100] = 0.5;
  us[101] = std::numeric_limits<double>::quiet_NaN();
  Results r(200);
  const auto scattered = surface.evaluate(us, vs, r.out);
  ASSERT_FALSE(scattered);
  EXPECT_EQ(scattered.error().code, ErrorCode::vanishing_weight);
  EXPECT_EQ(scattered.error().where, "parameter 100");
}

TEST(EvaluateBatch, WeightsThatVanishBesideOthersGiveAnErrorOrANumberButNoNaN) {
  // u = 1: all weights there are ε. The exact x is 4.
  const std::vector<double> line = {0, 0, 1, 1}, points = {1, 0, 0, 1, 1, 0, 4, 0, 0, 4, 1, 0}, u = {1, 0.5, 1},
                            v = {0.5, 0.5, 0};
  for (const double e : {0x1p-30, 0x1p-52, 0x1p-53, 0x1p-54, 0x1p-60, 1e-30, 1e-300, 0x1p-1074}) {
    const std::vector<double> weights = {1, 1, e, e};
    const SurfaceData data{1, 1, line, line, points, weights};
    const BatchSurface surface = *BatchSurface::make(data);
    const auto patch = validation::exact_patch(data);
    for (const InstructionSet set : available_instruction_sets()) {
      SurfaceBatchOptions options;
      options.instructions = set;
      Results r(3), lower(3, 1), upper(3, 1), bounded(3, 1), rounded(3, 1);
      std::vector<double> bound(3);
      const auto plain = surface.evaluate(u, v, r.out, options);
      const bool bounds = surface.evaluate_bounded(u, v, bounded.out.point, bound.data(), options).has_value();
      const bool intervals = surface.evaluate_interval(u, v, lower.out.point, upper.out.point, options).has_value();
      ASSERT_TRUE(surface.evaluate_correctly_rounded(u, v, rounded.out.point, options)) << e;
      for (int i = 0; i < 3; ++i) {
        const auto exact = validation::exact_values(patch, u[i], v[i], Side::right, 0).vectors[0];
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ(rounded.numbers[0][3 * i + k], nearest_double(exact[k])) << e;
          if (plain) {
            EXPECT_TRUE(std::isfinite(r.numbers[0][3 * i + k])) << e << " " << to_string(set);
          }
          if (bounds && std::isfinite(bound[i])) {
            EXPECT_LE(abs(from_double(bounded.numbers[0][3 * i + k]) - exact[k]), from_double(bound[i])) << e;
          }
          if (intervals) {
            const double low = lower.numbers[0][3 * i + k], high = upper.numbers[0][3 * i + k];
            EXPECT_FALSE(std::isnan(low) || std::isnan(high)) << e;
            EXPECT_TRUE(low == -std::numeric_limits<double>::infinity() || from_double(low) <= exact[k]) << e;
            EXPECT_TRUE(high == std::numeric_limits<double>::infinity() || from_double(high) >= exact[k]) << e;
          }
        }
      }
      EXPECT_TRUE(e < 0x1p-50 || plain) << e;
    }
  }
}

TEST(EvaluateBatch, WeightsLostToUnderflowAreNotForgotten) {
  const std::vector<double> line = {0, 0, 1, 1}, half = {0.5};
  struct Case {
    std::vector<double> points, weights;
  };
  const Case cases[] = {{{0, 0, 0, 0, 0, 0, 0, 0, 0, 0x1p1023, 0, 0}, {1, 1, 1, 0x1p-1074}},
                        {{1, 0, 0, 1, 0, 0, 1, 0, 0, 0x1p1023, 0, 0}, {1, 1, 1, 3 * 0x1p-1074}},
                        {{1, 0, 0, 1, 0, 0, 1, 0, 0, 0x1p1023, 0, 0}, {0x1p1023, 1, 1, 0x1p-1000}}};
  for (const Case& c : cases) {
    const SurfaceData data{1, 1, line, line, c.points, c.weights};
    const BatchSurface surface = *BatchSurface::make(data);
    const auto exact = validation::exact_values(validation::exact_patch(data), 0.5, 0.5, Side::right, 0).vectors[0];
    for (const InstructionSet set : available_instruction_sets()) {
      SurfaceBatchOptions options;
      options.instructions = set;
      Results rounded(1, 1), bounded(1, 1);
      double bound = -1;
      ASSERT_TRUE(surface.evaluate_correctly_rounded(half, half, rounded.out.point, options));
      EXPECT_EQ(rounded.numbers[0][0], nearest_double(exact[0]));
      ASSERT_TRUE(surface.evaluate_bounded(half, half, bounded.out.point, &bound, options));
      EXPECT_LE(abs(from_double(bounded.numbers[0][0]) - exact[0]), from_double(bound));
    }
  }
}

TEST(EvaluateBatch, EachPieceHasItsOwnScaleOfNormals) {
  // A large piece, then one of size 1e-160: its normal exists all the same.
  const std::vector<double> knots = {0, 0, 1, 1, 2, 2}, line = {0, 0, 1, 1};
  std::vector<double> points;
  for (const double x : {0.0, 1.0, 0.0, 1e-160})
    for (const double y : {0.0, x == 1e-160 || points.size() >= 12 ? 1e-160 : 1.0})
      points.insert(points.end(), {x, y, 0});
  const BatchSurface surface = *BatchSurface::make({1, 1, knots, line, points, {}});
  const std::vector<double> u = {0.5, 1.5, 1.25}, v = {0.5, 0.5, 0.25};
  Results r(3);
  const auto summary = surface.evaluate(u, v, r.out);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->undefined_normals, 0u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(r.numbers[6][3 * i + 2], 1, 1e-15);
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
