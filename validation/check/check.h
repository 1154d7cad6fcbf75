// SPDX-License-Identifier: Apache-2.0
// Every kernel on every instruction set that this machine has, held against the exact values of the corpus.
//
//   kernel          what must hold for each number                                          where it is promised
//   S … S_vv, n     |computed − exact| ≤ the a-priori bound of its piece; scattered, grid   patch/evaluate_batch.h (1)
//   same bits       the same number whatever else is asked for, scattered or grid, in       (2)
//                   another layout, on another instruction set with fused multiply-add
//   bounded         |computed − exact| ≤ the bound that comes with the point                (5)
//   interval        lower ≤ exact ≤ upper                                                   (6)
//   rounded         the double nearest to the exact number, bit for bit                     (7)
//   compensated     error ≤ (1/2 + 2^-20) ulp where the terms do not cancel                 (8)
//   C, C', C''      as S, for curves                                                        spline/evaluate_batch.h (1)
//   refine, bezier  |computed − exact| ≤ the bound returned                                 patch/refine_batch.h (1)
//   decide          C1 and G1 as the exact rung decides them                                join/decide_batch.h (1)–(3)
// The bound of a unit normal follows from those of S_u and S_v (surface_check.cpp). A surface or curve of the corpus that
// a kernel refuses is a violation too: each has values in double.
//
// Left out are parameters at which a kernel gives up because of the denominator, and rightly: it is exactly less than what
// rounding can make of it, (3(p + q) + 3) 2^-53 2^(p + q) of the largest weight (law (4) of evaluate_batch.h).
//
// ENSURES  (1) violations are counted by exact comparison of Rationals;  (2) the same options give the same result on the
//          same machine;  (3) a kernel that is off by more than its bound anywhere in the corpus is reported.
// TEST     tests/cli/validate_test.py; --break makes a kernel lie, which must be noticed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/corpus/truth.h"

namespace patchproof::validation {

struct CheckOptions {
  CorpusOptions corpus;
  std::vector<InstructionSet> sets = available_instruction_sets();
  // A lie to see that lies are noticed: every number of this kernel is replaced by its neighbour after so many doubles.
  std::string broken_kernel;
  int broken_by = 0;
};

// What was seen of one kernel, one instruction set, one group of cases.
struct Tally {
  long numbers = 0;  // compared
  long violations = 0;
  long without_bound = 0;       // numbers whose bound is infinite
  double worst_ulp = 0;         // |error| / ulp(exact number)
  double worst_vector_ulp = 0;  // |error| / ulp(largest coordinate of the exact vector)
  double worst_ratio = 0;       // |error| / bound
  std::string worst_place;      // of the ratio
  std::string violation;        // the first
};
void merge(Tally& into, const Tally& more);

struct TallyKey {
  std::string kernel;
  InstructionSet set;
  std::string group;
  friend auto operator<=>(const TallyKey&, const TallyKey&) = default;
};
using Tallies = std::map<TallyKey, Tally>;

// One case; adds to the tallies.
void check_surface(const SurfaceCase& s, const CheckOptions& options, Tallies& tallies);
void check_curve(const CurveCase& c, const CheckOptions& options, Tallies& tallies);
void check_refinement(const SurfaceCase& s, const CheckOptions& options, Tallies& tallies);
// Joins of its own, drawn from the seed.
void check_decisions(const CheckOptions& options, Tallies& tallies);

// The whole corpus, in parallel.
Tallies check_all(const CheckOptions& options);

// The kernels in the order of the table above.
const std::vector<std::string>& kernel_names();

}  // namespace patchproof::validation
