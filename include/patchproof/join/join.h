// SPDX-License-Identifier: Apache-2.0
// A join: two isoparametric lines of patches, and which point of one is paired with which point of the other.
//
// The pairing is data, and part of every result: an increasing list of parameters t of line A and, for each, the parameter
// τ of line B (decreasing when the join is reversed), with τ affine in between. One piece [t_0, t_1] covers whole edges
// and T-junctions. A piece may instead carry a rational linear map: with x = (t − t_0)/(t_1 − t_0) and
// y = (τ − τ_0)/(τ_1 − τ_0),  y = r x / (1 − x + r x).  Any pairing gives valid upper bounds; a proof of C0 needs the right one.
#pragma once

#include <string>
#include <vector>

#include "patchproof/patch/boundary.h"

namespace patchproof {

enum class JoinKind {
  isoparametric,  // edge to edge of two patches
  t_junction,     // at least one of the edges only in part
  seam,           // two edges of one patch
  knot_line,      // a line inside one patch where its knots allow a kink or a gap
  trimmed         // an edge of trimmed faces (trimmed_join.h)
};

enum class PairingKind {
  identity,         // equal parameters, up to a shift and reversal
  affine,           // different speeds
  rational_linear,  // y = r x/(1 − x + r x)
  piecewise_linear  // found numerically and frozen
};

template <OrderedField K>
struct Pairing {
  PairingKind kind = PairingKind::identity;
  std::vector<K> a, b;  // nodes on line A (increasing) and on line B (strictly monotone), at least two
  K ratio = K(1);       // r, for rational_linear only; then there are just two nodes

  bool reversed() const { return b.back() < b.front(); }
};

template <OrderedField K>
struct Join {
  JoinKind kind = JoinKind::isoparametric;
  int patch_a = 0, patch_b = 0;  // 0-based
  IsoLine<K> line_a, line_b;
  Pairing<K> pairing;
};

const char* to_string(JoinKind kind);
const char* to_string(PairingKind kind);

}  // namespace patchproof
