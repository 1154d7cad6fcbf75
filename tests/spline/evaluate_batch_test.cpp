// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/evaluate_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/pieces.h"
#include "validation/corpus/truth.h"

namespace patchproof {
namespace {

using validation::CurveCase;
using validation::KnownCurve;

const std::vector<KnownCurve>& corpus() {
  static const std::vector<KnownCurve> known = validation::with_truth(validation::curve_cases({7, 6}));
  return known;
}

struct Results {
  std::vector<double> numbers[3];
  CurveOutput out;
  explicit Results(std::size_t count, int wanted = 3) {
    VectorArray* arrays[3] = {&out.point, &out.first, &out.second};
    for (int m = 0; m < 3; ++m) {
      numbers[m].assign(3 * count, -1);
      if (m < wanted) *arrays[m] = VectorArray::interleaved(numbers[m].data());
    }
  }
};

CurveBatchOptions options_of(const CurveCase& c, InstructionSet set = InstructionSet::fastest) {
  return {c.side, 1, set};
}

BatchCurve made(const CurveCase& c) {
  auto curve = BatchCurve::make(c.data());
  if (!curve) throw std::runtime_error(c.name + ": " + curve.error().text());
  return *curve;
}

TEST(CurveBatch, Law1EachNumberIsWithinTheBoundOfItsPieceOnEveryInstructionSet) {
  int held = 0;
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownCurve& known : corpus()) {
      const CurveCase& c = known.data;
      const BatchCurve curve = made(c);
      Results r(c.t.size());
      const auto result = curve.evaluate(c.t, r.out, options_of(c, set));
      if (!result) {
        // Only for weights that vanish beside others: no bound was promised.
        ASSERT_EQ(result.error().code, ErrorCode::vanishing_weight) << c.name;
        ASSERT_FALSE(curve.pieces().safe_weights);
        continue;
      }
      const kernels::Axis& axis = curve.pieces().t;
      const double* begins = axis.begins(c.side == Side::left);
      for (std::size_t i = 0; i < c.t.size(); ++i) {
        const auto span = std::upper_bound(begins + 1, begins + axis.count, c.t[i]) - begins - 1;
        for (int m = 0; m < 3; ++m) {
          const double bound = curve.pieces().bounds[span].error[m];
          if (!std::isfinite(bound)) continue;
          for (int k = 0; k < 3; ++k) {
            ASSERT_LE(abs(from_double(r.numbers[m][3 * i + k]) - known.values[i][m][k]), from_double(bound))
                << to_string(set) << " " << c.group << "/" << c.name << " item " << i << " derivative " << m;
            ++held;
          }
        }
      }
    }
  EXPECT_GT(held, 3000);
}

TEST(CurveBatch, Law2SameBitsWhateverThePlaceOrderAndInstructionSet) {
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownCurve& known : corpus()) {
      const CurveCase& c = known.data;
      const BatchCurve curve = made(c);
      const std::size_t n = c.t.size();
      Results all(n), points(n, 1);
      if (!curve.evaluate(c.t, all.out, options_of(c, set)) && !curve.pieces().safe_weights) continue;
      ASSERT_TRUE(curve.evaluate(c.t, points.out, options_of(c, set)));
      ASSERT_EQ(points.numbers[0], all.numbers[0]);
      for (const InstructionSet second : available_instruction_sets())
        if (fuses_multiply_add(set) && fuses_multiply_add(second)) {
          Results other(n);
          ASSERT_TRUE(curve.evaluate(c.t, other.out, options_of(c, second)));
          for (int m = 0; m < 3; ++m) ASSERT_EQ(other.numbers[m], all.numbers[m]) << c.name;
        }
      // Each parameter 21 times in a row (a run), and the runs in falling order.
      std::vector<double> t;
      for (std::size_t i = n; i-- > 0;) t.insert(t.end(), 21, c.t[i]);
      for (const int threads : {1, 3}) {
        Results runs(t.size());
        CurveBatchOptions options = options_of(c, set);
        options.threads = threads;
        ASSERT_TRUE(curve.evaluate(t, runs.out, options));
        for (std::size_t i = 0; i < t.size(); ++i)
          for (int m = 0; m < 3; ++m)
            for (int k = 0; k < 3; ++k)
              ASSERT_EQ(runs.numbers[m][3 * i + k], all.numbers[m][3 * (n - 1 - i / 21) + k]) << c.name;
      }
    }
}

TEST(CurveBatch, Laws3And4EndsSidesAndParametersOutside) {
  const std::vector<double> knots = {0, 0, 1, 1, 2, 2}, points = {0, 0, 0, 1, 0, 0, 5, 0, 0, 7, 0, 0};
  const BatchCurve curve = *BatchCurve::make({1, knots, points, {}});
  EXPECT_EQ(curve.domain_begin(), 0);
  EXPECT_EQ(curve.domain_end(), 2);
  for (const Side side : {Side::left, Side::right}) {
    std::vector<double> t = {0, 1, 2}, x(3), y(3), z(3);
    CurveOutput out;
    out.point = VectorArray::separate(x.data(), y.data(), z.data());
    ASSERT_TRUE(curve.evaluate(t, out, {side, 1, InstructionSet::fastest}));
    EXPECT_EQ(x, (std::vector<double>{0, side == Side::left ? 1.0 : 5.0, 7}));
    for (const double bad : {-0.5, 2.0000001, std::numeric_limits<double>::quiet_NaN()}) {
      std::vector<double> many(500, 0.5);
      many[301] = bad;
      const auto result = curve.evaluate(many, CurveOutput{}, {side, 1, InstructionSet::fastest});
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::outside_domain);
      EXPECT_EQ(result.error().where, "parameter 301");
    }
  }
  const std::vector<double> weights = {1, -1, 1, 1};
  const BatchCurve pole = *BatchCurve::make({1, knots, points, weights});
  std::vector<double> t(300, 0.25), xyz(900);
  t[277] = 0.5;
  for (const InstructionSet set : available_instruction_sets()) {
    CurveOutput out;
    out.point = VectorArray::interleaved(xyz.data());
    const auto result = pole.evaluate(t, out, {Side::right, 1, set});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::vanishing_weight);
    EXPECT_EQ(result.error().where, "parameter 277");
  }
}

TEST(CurveBatch, ManySpansAreAllFound) {
  for (const int spans : {8191, 8192, 8193, 100000}) {
    std::vector<double> knots = {0}, points;
    for (int i = 0; i <= spans; ++i) knots.push_back(i);
    knots.push_back(spans);
    for (int i = 0; i <= spans; ++i) points.insert(points.end(), {i * 2.0, i % 3 * 1.0, 0});
    const BatchCurve curve = *BatchCurve::make({1, knots, points, {}});
    std::vector<double> t = {0, 0.5, spans - 0.5, double(spans)};
    for (int i = 1; i < spans; i += 997) t.push_back(i + 0.25);
    Results r(t.size(), 1);
    ASSERT_TRUE(curve.evaluate(t, r.out, {}));
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(r.numbers[0][3 * i], 2 * t[i]);
  }
}

TEST(CurveBatch, ManyCloseKnotsAreFoundInTheirOwnSpans) {
  // 300 knots within 1e-6 of each other beside a span of length 1: buckets alone cannot separate them.
  std::vector<double> knots(4, 0.0), points;
  for (int i = 0; i < 300; ++i) knots.push_back(0.5 + i * 3e-9);
  knots.resize(knots.size() + 4, 1.0);
  for (std::size_t i = 0; i + 4 < knots.size(); ++i) points.insert(points.end(), {double(i), double(i % 7), 1});
  const CurveData data{3, knots, points, {}};
  const BatchCurve curve = *BatchCurve::make(data);
  const auto exact = validation::exact_curve(data);
  std::vector<double> t = {0, 0.25, 0.5, 1};
  for (int i = 0; i < 300; i += 7) {
    t.push_back(knots[4 + i]);
    t.push_back(std::nextafter(knots[4 + i], 0));
  }
  for (const InstructionSet set : available_instruction_sets()) {
    Results r(t.size(), 1);
    ASSERT_TRUE(curve.evaluate(t, r.out, {Side::right, 1, set}));
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto truth = validation::exact_values(exact, t[i], Side::right, 0);
      EXPECT_LE(abs(from_double(r.numbers[0][3 * i]) - truth[0][0]), from_double(curve.error_bound(0)));
    }
  }
}

}  // namespace
}  // namespace patchproof
