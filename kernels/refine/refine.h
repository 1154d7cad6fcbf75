// SPDX-License-Identifier: Apache-2.0
// The two banded products of a refinement, for each instruction set.
#pragma once

#include <cstddef>

namespace patchproof::kernels::refine {

// Row i is Σ_k coefficients[i · taps + k] · (old number first[i] + k). first does not decrease.
struct Band {
  int taps = 0, rows = 0;
  int group = 0;  // rows of one piece; divides rows
  const int* first = nullptr;
  const double* coefficients = nullptr;
};

struct Job {
  Band u, v;
  int count_u = 0, count_v = 0;     // of the old net
  const double* points = nullptr;   // 3 numbers each
  const double* weights = nullptr;  // or none
  double* out = nullptr;            // 3 numbers each, 4 with weights
  double* scratch = nullptr;        // scratch_size(*this) doubles, fastest at a multiple of 64 bytes
  const double** lines = nullptr;   // room for u.taps
};

// Columns of the result that are handled together, so that the working memory stays in cache.
inline constexpr int kTileRows = 128;
// Old points that are handled together, at least those of one row.
constexpr int tile_points(int taps) { return taps > kTileRows ? taps : kTileRows; }
// Refined lines kept at a time: the taps of one row and two more, a power of two.
constexpr int ring_lines(int taps) {
  int n = 4;
  while (n < taps + 2) n *= 2;
  return n;
}
// A piece of a line begins at a multiple of 8 numbers.
constexpr int padded_size(int numbers) { return (numbers + 7) / 8 * 8; }
// The longest refined line of a tile, with room for a vector behind its end. `size`: 3 or 4 numbers for each point.
constexpr int line_size(const Band& v, int size) {
  const int tile = v.rows < kTileRows ? v.rows : kTileRows;
  if (v.group > tile) return padded_size(tile * size) + 8;
  return tile / v.group * padded_size(v.group * size) + 8;
}
constexpr std::size_t scratch_size(const Job& job) {
  const int points = tile_points(job.v.taps) < job.count_v ? tile_points(job.v.taps) : job.count_v;
  return static_cast<std::size_t>(ring_lines(job.u.taps)) * line_size(job.v, job.weights != nullptr ? 4 : 3) +
         std::size_t{8} * points;
}

struct Table {
  void (*refine)(const Job&);
  // The largest |x|; not finite when any x is not.
  double (*largest)(const double* x, std::size_t count);
};

extern const Table kPortable;
#if defined(PATCHPROOF_KERNELS_X86)
extern const Table kSse4, kAvx2, kAvx512;
#elif defined(PATCHPROOF_KERNELS_NEON)
extern const Table kNeon;
#endif

}  // namespace patchproof::kernels::refine
