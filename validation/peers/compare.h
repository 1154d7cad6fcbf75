// SPDX-License-Identifier: Apache-2.0
// A peer against the exact values of the corpus: its worst errors, in units of the last place.
//
// The error of a vector is the largest error of its coordinates, in units of the last place of the exact vector's largest
// coordinate. Left out are: vectors that are exactly 0 (they have no last place), values beyond the largest double, and
// at a knot whatever jumps there (peers may take either side).
//
// Each peer runs each group of cases in a process of its own, with a limit of time, so that one that crashes or hangs on
// a hard case loses that case and nothing else.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "validation/corpus/truth.h"
#include "validation/peers/peer.h"

namespace patchproof::peers {

enum class Arrangement { scattered, grid, curve };
inline constexpr std::array<Quantities, 4> kAllQuantities{Quantities::points, Quantities::first, Quantities::normals,
                                                          Quantities::second};

const char* to_string(Arrangement a);
const char* to_string(Quantities q);

// Plain data: it crosses a pipe.
struct Score {
  long vectors = 0;  // compared
  double worst = 0;  // in ulp; infinite for NaN and infinities
  int offered = 0;   // cases that the peer evaluated
};
// Compares one vector of an item with its exact value, as said above.
void add_vector(Score& score, const Placed& placed, std::ptrdiff_t item, int vector,
                const validation::ExactVector& exact);
// The vectors that `q` adds to those of lower order; their places are those of a record for `q`.
void add_vectors(Score& score, Quantities q, const Placed& placed, std::ptrdiff_t item,
                 const validation::SurfaceTruth& exact);

struct CaseScores {
  std::array<Score, 4> by_quantity;  // indexed as kAllQuantities; each counts only the vectors that it adds
  int refused = 0;                   // cases that the peer would not prepare
  int crashed = 0, timed_out = 0;    // cases that killed it
};
CaseScores operator+(const CaseScores& a, const CaseScores& b);

struct Row {
  std::string peer, variant, group;
  Arrangement arrangement;
  int cases = 0;
  CaseScores scores;
};

struct Known {
  std::vector<validation::KnownSurface> surfaces;
  std::vector<validation::KnownCurve> curves;
};

// One row for each variant, group and arrangement. `seconds`: the limit for one group.
std::vector<Row> compare(const Peer& peer, const Known& known, unsigned seconds);

}  // namespace patchproof::peers
