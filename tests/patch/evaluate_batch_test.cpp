// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/evaluate_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "kernels/pieces.h"
#include "validation/corpus/truth.h"

namespace patchproof {
namespace {

using validation::KnownSurface;
using validation::SurfaceCase;

const std::vector<KnownSurface>& corpus() {
  // One of each group; `patchproof validate` takes them all.
  static const std::vector<KnownSurface> known = [] {
    std::vector<SurfaceCase> some;
    std::map<std::string, int> of_group;
    for (SurfaceCase& c : validation::surface_cases({7, 3}))
      if (++of_group[c.group] <= 1) some.push_back(std::move(c));
    return validation::with_truth(std::move(some));
  }();
  return known;
}

constexpr int kVectors = 7;  // S, S_u, S_v, S_uu, S_uv, S_vv, normal

// All results of a call, in arrays of xyz.
struct Results {
  std::vector<double> numbers[kVectors];
  SurfaceOutput out;
  explicit Results(std::size_t count, unsigned wanted = 0x7f) {
    VectorArray* arrays[kVectors] = {&out.point, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal};
    for (int m = 0; m < kVectors; ++m) {
      numbers[m].assign(3 * count, -1);
      if (wanted >> m & 1) *arrays[m] = VectorArray::interleaved(numbers[m].data());
    }
  }
};

SurfaceBatchOptions options_of(const SurfaceCase& c, InstructionSet set = InstructionSet::fastest) {
  SurfaceBatchOptions options;
  options.side_u = options.side_v = c.side;
  options.instructions = set;
  return options;
}

BatchSurface made(const SurfaceCase& c) {
  auto surface = BatchSurface::make(c.data());
  if (!surface) throw std::runtime_error(c.name + ": " + surface.error().text());
  return *surface;
}

// The number of the piece that holds (u, v) in the case's side.
std::size_t piece_of(const kernels::SurfacePieces& s, double u, double v, Side side) {
  const auto span = [&](const kernels::Axis& a, double t) {
    const double* begins = a.begins(side == Side::left);
    return std::upper_bound(begins + 1, begins + a.count, t) - begins - 1;
  };
  return static_cast<std::size_t>(span(s.u, u) * s.v.count + span(s.v, v));
}

TEST(EvaluateBatch, Law1EachNumberIsWithinTheBoundOfItsPieceOnEveryInstructionSet) {
  int held = 0;
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownSurface& known : corpus()) {
      const SurfaceCase& c = known.data;
      const BatchSurface surface = made(c);
      Results r(c.u.size(), 0x3f);
      ASSERT_TRUE(surface.evaluate(c.u, c.v, r.out, options_of(c, set))) << c.name;
      for (std::size_t i = 0; i < c.u.size(); ++i) {
        const kernels::PieceBounds& bounds =
            surface.pieces().bounds[piece_of(surface.pieces(), c.u[i], c.v[i], c.side)];
        for (int m = 0; m < 6; ++m) {
          if (!std::isfinite(bounds.error[m])) continue;
          for (int k = 0; k < 3; ++k) {
            const double computed = r.numbers[m][3 * i + k];
            ASSERT_TRUE(std::isfinite(computed)) << c.group << "/" << c.name << " vector " << m;
            const Rational error = abs(from_double(computed) - known.scattered[i].vectors[m][k]);
            ASSERT_LE(error, from_double(bounds.error[m]))
                << to_string(set) << " " << c.group << "/" << c.name << " item " << i << " vector " << m;
            ++held;
          }
        }
      }
    }
  EXPECT_GT(held, 10000);
}

TEST(EvaluateBatch, Law1TheBoundOfPointsStaysBelowItsFormula) {
  int held = 0;
  for (const SurfaceCase& c : validation::surface_cases({7, 1})) {
    if (!c.weights.empty()) continue;
    double largest = 0;
    for (const double x : c.points) largest = std::max(largest, std::fabs(x));
    const double formula =
        3 * (c.degree_u + c.degree_v + 1) * 0x1p-53 * std::ldexp(largest, c.degree_u + c.degree_v) * (1 + 0x1p-30);
    EXPECT_LE(made(c).error_bound(SurfaceVector::point), formula + 0x1p-1040) << c.group << "/" << c.name;
    ++held;
  }
  EXPECT_GT(held, 20);
}

TEST(EvaluateBatch, Law2SameBitsWhateverThePlaceLayoutAndInstructionSet) {
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownSurface& known : corpus()) {
      const SurfaceCase& c = known.data;
      const BatchSurface surface = made(c);
      const SurfaceBatchOptions options = options_of(c, set);
      const std::size_t n = c.u.size();
      Results all(n);
      ASSERT_TRUE(surface.evaluate(c.u, c.v, all.out, options));
      if (fuses_multiply_add(set)) {
        Results other(n);
        for (const InstructionSet second : available_instruction_sets())
          if (fuses_multiply_add(second)) {
            ASSERT_TRUE(surface.evaluate(c.u, c.v, other.out, options_of(c, second)));
            for (int m = 0; m < kVectors; ++m) ASSERT_EQ(all.numbers[m], other.numbers[m]) << c.name << " " << m;
          }
      }
      // One at a time; only points; records; the last items first.
      Results points(n, 1);
      ASSERT_TRUE(surface.evaluate(c.u, c.v, points.out, options));
      ASSERT_EQ(points.numbers[0], all.numbers[0]) << c.name;
      std::vector<double> records(11 * n, -2);
      SurfaceOutput strided;
      strided.point = VectorArray::records(records.data(), 11);
      strided.dv = VectorArray::records(records.data() + 5, 11);
      ASSERT_TRUE(surface.evaluate(c.u, c.v, strided, options));
      for (std::size_t i = 0; i < n; ++i) {
        Results one(1);
        ASSERT_TRUE(surface.evaluate({&c.u[i], 1}, {&c.v[i], 1}, one.out, options));
        for (int k = 0; k < 3; ++k) {
          for (int m = 0; m < kVectors; ++m) ASSERT_EQ(one.numbers[m][k], all.numbers[m][3 * i + k]) << c.name;
          ASSERT_EQ(records[11 * i + k], all.numbers[0][3 * i + k]);
          ASSERT_EQ(records[11 * i + 5 + k], all.numbers[2][3 * i + k]);
          ASSERT_EQ(records[11 * i + 8 + k % 3], -2);  // what was not asked for is not touched
        }
      }
      // 37 times the same parameter is a run in one piece; mixed parameters are scattered.
      std::vector<double> us(37, c.u[0]), vs(37, c.v[0]);
      Results run(37);
      ASSERT_TRUE(surface.evaluate(us, vs, run.out, options));
      for (int m = 0; m < kVectors; ++m)
        for (std::size_t i = 0; i < 37; ++i)
          for (int k = 0; k < 3; ++k) ASSERT_EQ(run.numbers[m][3 * i + k], all.numbers[m][k]) << c.name;
      // Grids.
      const std::size_t rows = c.grid_u.size(), columns = c.grid_v.size();
      Results grid(rows * columns), scattered(rows * columns);
      const auto gridded = surface.evaluate_grid(c.grid_u, c.grid_v, grid.out, options);
      ASSERT_TRUE(gridded) << c.group << "/" << c.name << " " << gridded.error().text();
      std::vector<double> u, v;
      for (std::size_t i = 0; i < rows * columns; ++i) {
        u.push_back(c.grid_u[i / columns]);
        v.push_back(c.grid_v[i % columns]);
      }
      ASSERT_TRUE(surface.evaluate(u, v, scattered.out, options));
      for (int m = 0; m < kVectors; ++m) ASSERT_EQ(grid.numbers[m], scattered.numbers[m]) << c.name << " vector " << m;
    }
}

TEST(EvaluateBatch, Law2SameBitsForAnyCountOffsetAndNumberOfThreads) {
  const SurfaceCase& c = corpus().back().data;
  const BatchSurface surface = made(c);
  const std::size_t n = 40000;
  std::vector<double> u(n), v(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = c.u[i % c.u.size()];
    v[i] = c.v[(i / 7) % c.v.size()];
  }
  Results all(n);
  ASSERT_TRUE(surface.evaluate(u, v, all.out, options_of(c)));
  for (const int threads : {0, 2, 3}) {
    Results r(n);
    SurfaceBatchOptions options = options_of(c);
    options.threads = threads;
    ASSERT_TRUE(surface.evaluate(u, v, r.out, options));
    for (int m = 0; m < kVectors; ++m) ASSERT_EQ(r.numbers[m], all.numbers[m]);
  }
  for (std::size_t count = 0; count < 40; ++count)
    for (std::size_t offset = 0; offset < 9; ++offset) {
      // Room before and behind must stay untouched, at every alignment.
      std::vector<double> xyz(3 * count + 12, -7), separate(3 * (count + 2), -7);
      SurfaceOutput out;
      out.point = VectorArray::interleaved(xyz.data() + offset);
      out.du = VectorArray::separate(separate.data(), separate.data() + count + 2, separate.data() + 2 * count + 4);
      ASSERT_TRUE(surface.evaluate({u.data() + offset, count}, {v.data() + offset, count}, out, options_of(c)));
      for (std::size_t i = 0; i < xyz.size(); ++i)
        ASSERT_EQ(xyz[i], i < offset || i >= offset + 3 * count ? -7 : all.numbers[0][3 * offset + (i - offset)]);
      for (std::size_t i = 0; i < count + 2; ++i)
        ASSERT_EQ(separate[i], i < count ? all.numbers[1][3 * (offset + i)] : -7);
    }
}

TEST(EvaluateBatch, Law2LargeAlignedOutputsThatAreStreamedAreTheSame) {
  const std::size_t n = 200003;  // beyond the size from which stores bypass the cache, with a tail
  const std::vector<double> knots = {0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<double> points;
  for (int i = 0; i < 48; ++i) points.push_back(std::sin(7.0 * i));
  const BatchSurface surface = *BatchSurface::make({3, 3, knots, knots, points, {}});
  std::vector<double> u(n), v(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = static_cast<double>(i) / n;
    v[i] = static_cast<double>(i * 7919 % n) / n;
  }
  std::unique_ptr<double, void (*)(void*)> aligned(
      static_cast<double*>(std::aligned_alloc(64, (3 * n * sizeof(double) + 63) / 64 * 64)), std::free);
  std::vector<double> plain(3 * n + 1);
  for (const InstructionSet set : available_instruction_sets()) {
    SurfaceBatchOptions options;
    options.instructions = set;
    SurfaceOutput a, b;
    a.normal = VectorArray::interleaved(aligned.get());
    b.normal = VectorArray::interleaved(plain.data() + 1);
    ASSERT_TRUE(surface.evaluate(u, v, a, options));
    ASSERT_TRUE(surface.evaluate(u, v, b, options));
    ASSERT_TRUE(std::equal(plain.begin() + 1, plain.end(), aligned.get()));
  }
}

// |S_u × S_v| to a few units of its last place.
double cross_length(const validation::SurfaceTruth& truth) {
  const auto &a = truth.vectors[1], &b = truth.vectors[2];
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double minor = nearest_double(a[i] * b[j] - a[j] * b[i]);
    length = std::hypot(length, minor);
  }
  return length;
}

TEST(EvaluateBatch, NormalsAreUnitVectorsCloseToTheExactOnesAndCountedWhereThereIsNone) {
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownSurface& known : corpus()) {
      const SurfaceCase& c = known.data;
      const BatchSurface surface = made(c);
      Results r(c.u.size());
      const auto summary = surface.evaluate(c.u, c.v, r.out, options_of(c, set));
      ASSERT_TRUE(summary);
      std::size_t none = 0;
      for (std::size_t i = 0; i < c.u.size(); ++i) {
        const double* n = &r.numbers[6][3 * i];
        const double length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        none += length == 0;
        if (length != 0) {
          ASSERT_NEAR(length, 1, 1e-15) << c.name;
        }
        if (!known.scattered[i].has_normal) continue;
        // |n − exact| ≤ 2 (e_u |S_v| + e_v |S_u| + …)/|S_u × S_v|: held where that is small.
        const auto& bounds = surface.pieces().bounds[piece_of(surface.pieces(), c.u[i], c.v[i], c.side)];
        const auto size = [&](int m) {
          double out = 0;
          for (int k = 0; k < 3; ++k) out += std::fabs(nearest_double(known.scattered[i].vectors[m][k]));
          return out;
        };
        const double su = size(1), sv = size(2), area = cross_length(known.scattered[i]);
        const double bound =
            4 * (bounds.error[1] * (sv + bounds.error[2]) + bounds.error[2] * su + 0x1p-51 * su * sv) / area;
        if (!(bound < 0.1)) continue;
        for (int k = 0; k < 3; ++k)
          ASSERT_LE(std::fabs(n[k] - nearest_double(known.scattered[i].normal[k])), bound + 0x1p-50)
              << to_string(set) << " " << c.group << "/" << c.name << " item " << i;
      }
      EXPECT_EQ(summary->undefined_normals, none) << c.name;
    }
}

TEST(EvaluateBatch, Laws5And6PointsWithTheirBoundsAndEnclosures) {
  for (const InstructionSet set : available_instruction_sets())
    for (const KnownSurface& known : corpus()) {
      const SurfaceCase& c = known.data;
      const BatchSurface surface = made(c);
      const std::size_t n = c.u.size();
      Results plain(n, 1), bounded(n, 1), lower(n, 1), upper(n, 1);
      std::vector<double> bound(n, -1);
      ASSERT_TRUE(surface.evaluate(c.u, c.v, plain.out, options_of(c, set)));
      ASSERT_TRUE(surface.evaluate_bounded(c.u, c.v, bounded.out.point, bound.data(), options_of(c, set)));
      ASSERT_TRUE(surface.evaluate_interval(c.u, c.v, lower.out.point, upper.out.point, options_of(c, set)));
      ASSERT_EQ(plain.numbers[0], bounded.numbers[0]) << c.name;
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_FALSE(std::isnan(bound[i]) || bound[i] < 0) << c.name;
        for (int k = 0; k < 3; ++k) {
          const Rational& exact = known.scattered[i].vectors[0][k];
          if (std::isfinite(bound[i])) {
            ASSERT_LE(abs(from_double(bounded.numbers[0][3 * i + k]) - exact), from_double(bound[i]))
                << to_string(set) << " " << c.group << "/" << c.name << " item " << i;
          }
          const double low = lower.numbers[0][3 * i + k], high = upper.numbers[0][3 * i + k];
          ASSERT_LE(low, high);
          if (std::isfinite(low) && std::isfinite(high)) {
            ASSERT_LE(from_double(low), exact) << c.name;
            ASSERT_GE(from_double(high), exact) << c.name;
          }
        }
      }
    }
}

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
