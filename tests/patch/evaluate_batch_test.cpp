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
#include "support/batch_results.h"
#include "validation/corpus/truth.h"

namespace patchproof {
namespace {

using test::kVectors;
using test::Results;
using validation::KnownSurface;
using validation::SurfaceCase;

const std::vector<KnownSurface>& corpus() {
  // One of each group; `patchproof validate` takes them all.
  static const std::vector<KnownSurface> known = [] {
    std::vector<SurfaceCase> some;
    std::map<std::string, int> of_group;
    for (SurfaceCase& c : validation::surface_cases({9, 3}))
      if (++of_group[c.group] <= 1) some.push_back(std::move(c));
    return validation::with_truth(std::move(some));
  }();
  return known;
}

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
  for (const SurfaceCase& c : validation::surface_cases({9, 1})) {
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

}  // namespace
}  // namespace patchproof
