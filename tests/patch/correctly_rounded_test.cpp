// SPDX-License-Identifier: Apache-2.0
// Laws (7) and (8) of evaluate_batch.h.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "patchproof/patch/evaluate_batch.h"
#include "validation/corpus/truth.h"

namespace patchproof {
namespace {

std::vector<double> rounded(const BatchSurface& surface, const std::vector<double>& u, const std::vector<double>& v,
                            InstructionSet set, Side side = Side::right) {
  std::vector<double> out(3 * u.size());
  SurfaceBatchOptions options;
  options.instructions = set;
  options.side_u = options.side_v = side;
  const auto result = surface.evaluate_correctly_rounded(u, v, VectorArray::interleaved(out.data()), options);
  if (!result) throw std::runtime_error(result.error().text());
  return out;
}

TEST(CorrectlyRounded, Law7EveryPointOfTheCorpusIsTheNearestDouble) {
  for (const validation::SurfaceCase& c : validation::surface_cases({9, 8})) {
    const auto surface = BatchSurface::make(c.data());
    ASSERT_TRUE(surface);
    const auto patch = validation::exact_patch(c.data());
    std::vector<Vec<Rational, 3>> exact;
    for (std::size_t i = 0; i < c.u.size(); ++i)
      exact.push_back(validation::exact_values(patch, c.u[i], c.v[i], c.side, 0).vectors[0]);
    for (const InstructionSet set : available_instruction_sets()) {
      const auto out = rounded(*surface, c.u, c.v, set, c.side);
      for (std::size_t i = 0; i < c.u.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          ASSERT_EQ(out[3 * i + k], nearest_double(exact[i][k]))
              << to_string(set) << " " << c.group << "/" << c.name << " item " << i;
          ASSERT_FALSE(out[3 * i + k] == 0 && std::signbit(out[3 * i + k]));
        }
    }
  }
}

TEST(CorrectlyRounded, Law7TiesGoToTheEvenDouble) {
  // A bilinear patch whose x at u = 1/2 lies exactly between two doubles, y just above and z just below such a middle.
  const std::vector<double> line = {0, 0, 1, 1};
  const double ulp = 0x1p-52, hair = 0x1p-160;
  std::vector<double> points;
  for (const double end : {1.0, 1 + ulp})
    for (int j = 0; j < 2; ++j) points.insert(points.end(), {end, 1 + ulp, end});
  const BatchSurface even = *BatchSurface::make({1, 1, line, line, points, {}});
  // (1 + 1 + ulp)/2 is a tie between 1 (even) and 1 + ulp.
  const std::vector<double> half(17, 0.5);
  for (const InstructionSet set : available_instruction_sets()) {
    const auto out = rounded(even, half, half, set);
    for (int i = 0; i < 17; ++i) EXPECT_EQ(out[3 * i], 1.0);
  }
  // The tie between 1 + ulp (odd) and 1 + 2 ulp goes up; moved by a hair it goes where the hair points. The hair is a
  // third row of a quadratic patch, so that the sum needs far more than 106 bits.
  const std::vector<double> curve = {0, 0, 0, 1, 1, 1};
  for (const double move : {0.0, hair, -hair}) {
    std::vector<double> net;
    for (const double x : {1 + ulp, 2 * move, 1 + 2 * ulp})
      for (int j = 0; j < 2; ++j) net.insert(net.end(), {x, -x, 0});
    const BatchSurface surface = *BatchSurface::make({2, 1, curve, line, net, {}});
    // S(1/2) = (a + 2b + c)/4 = (2 + 3 ulp)/4 + move: between doubles of spacing ulp/2: 1/2 + 3/4 ulp is a tie.
    for (const InstructionSet set : available_instruction_sets()) {
      const auto out = rounded(surface, half, half, set);
      const double expected = move < 0 ? 0.5 + ulp / 2 : move > 0 ? 0.5 + ulp : 0.5 + ulp;
      EXPECT_EQ(out[0], expected) << to_string(set) << " " << move;
      EXPECT_EQ(out[1], -expected);
      EXPECT_EQ(out[2], 0);
    }
  }
}

TEST(CorrectlyRounded, Law7RationalTiesAndCancellation) {
  // Weights 1, 3: x = (1·a + 3·b)/4 at u = 1/2, with a and b that cancel to the last bit.
  const std::vector<double> line = {0, 0, 1, 1};
  const double a = 3.0, b = -1.0 - 0x1p-52;
  const std::vector<double> points = {a, 1, 0, a, 1, 0, b, 1, 0, b, 1, 0}, weights = {1, 1, 3, 3};
  const BatchSurface surface = *BatchSurface::make({1, 1, line, line, points, weights});
  const std::vector<double> half = {0.5}, third = {1.0 / 3};
  for (const InstructionSet set : available_instruction_sets()) {
    EXPECT_EQ(rounded(surface, half, half, set)[0], -3 * 0x1p-54);
    EXPECT_EQ(rounded(surface, half, third, set)[1], 1.0);
  }
}

TEST(CorrectlyRounded, Law8CompensatedPointsAreWithinHalfAnUlpAndABit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> d(-1, 1), weight(0.25, 4), t(0, 1);
  for (const bool rational : {false, true})
    for (const int degree : {1, 2, 3, 5, 8}) {
      std::vector<double> knots(degree + 1, 0.0), points, weights;
      knots.resize(2 * degree + 2, 1.0);
      for (int i = 0; i < (degree + 1) * (degree + 1); ++i) {
        for (int k = 0; k < 3; ++k) points.push_back(d(random));
        if (rational) weights.push_back(weight(random));
      }
      const SurfaceData data{degree, degree, knots, knots, points, weights};
      const BatchSurface surface = *BatchSurface::make(data);
      const auto patch = validation::exact_patch(data);
      std::vector<double> u(40), v(40), out(120);
      for (int i = 0; i < 40; ++i) {
        u[i] = t(random);
        v[i] = t(random);
      }
      for (const InstructionSet set : available_instruction_sets()) {
        SurfaceBatchOptions options;
        options.instructions = set;
        ASSERT_TRUE(surface.evaluate_compensated(u, v, VectorArray::interleaved(out.data()), options));
        for (int i = 0; i < 40; ++i) {
          const auto exact = validation::exact_values(patch, u[i], v[i], Side::right, 0).vectors[0];
          for (int k = 0; k < 3; ++k)
            EXPECT_LE(validation::in_ulps(validation::deviation(out[3 * i + k], exact[k]), exact[k]), 0.5 + 0x1p-20);
        }
      }
    }
}

}  // namespace
}  // namespace patchproof
