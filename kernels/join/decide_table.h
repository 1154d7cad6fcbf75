// SPDX-License-Identifier: Apache-2.0
// What one instruction set's file offers to the dispatch of kernels/join/decide_batch.cpp.
#pragma once

namespace patchproof::kernels {

// One bit for each lane. A lane in none of filter, modular, coplanar was not decided. The others speak of coplanar
// lanes.
struct LaneAnswers {
  unsigned filter = 0;    // det ≠ 0 by the floating filter
  unsigned modular = 0;   // det ≠ 0 modulo a prime
  unsigned coplanar = 0;  // det ≡ 0, proved
  unsigned opposed = 0;   // n_A · n_B < 0 along the edge, proved: smooth
  unsigned c1 = 0;        // C1, proved
  unsigned not_c1 = 0;    // refuted
};

// How far to go; parts are timed by the benchmark.
enum class Depth { filter, zero_test, all };

// points[i]: the 36 coordinates of join i (edge, behind_a, behind_b), weights[i]: its 12 weights. Rounding to nearest.
struct DecideTable {
  int lanes;
  LaneAnswers (*polynomial)(const double* const* points, Depth depth);
  LaneAnswers (*rational)(const double* const* points, const double* const* weights, bool cartesian, Depth depth);
};

// Each is defined in the file of that name; calling one on a processor without the instructions ends the program.
extern const DecideTable kDecideAvx2, kDecideAvx512, kDecideIfma;

}  // namespace patchproof::kernels
