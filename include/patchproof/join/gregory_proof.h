// SPDX-License-Identifier: Apache-2.0
// What can be proved of one NURBS boundary Gregory patch by itself.
//
//   matched    S^c has the points and first derivatives of S^u on v = 0, 1, and of S^v on u = 0, 1: for each of the four rows
//                Q_0 = P_0,   3 (Q_1 − Q_0) − (k/x_1)(P_1 − P_0) = μ P_0   with one μ for the four,   and likewise at 1
//              so that on its edges S is what the U or the V surface is there, with its derivatives
//   corners    at each corner both surfaces have one point and the same first derivatives
//   c1         the U and the V surface are C¹ across every inner knot line (their rows may jump by multiples of themselves); with matched and corners S is C¹ on the closed square
//   positive   the 32 weights of the C surface and those of the rows are positive: no denominator vanishes
//   regular    S_u × S_v vanishes nowhere on the closed square. Box by box a direction r with (S_u × S_v)·r > 0, by
//                S = P + Σ g_pq d_pq,   P = S^u + S^v − (C surface of the Q⁰),   d = Q⁰ − Q¹ at the four inner places,
//                g = 9 x (1−x)² y (1−y)² y²/(x² + y²),   x, y the distances from the corner in u and v
//              Bernstein hulls of P_u and P_v, and the closed forms g_x = y s(2s−1)…, s = y²/(x² + y²) in [0, 1], which stay
//              bounded up to the corner.
//
// ENSURES  (1) matched, corners, c1, positive: exact;  (2) regular proven: a theorem; refuted: at the parameters in `witness`
//          the normal is exactly zero; undecided: with a reason, always where matched, corners or positive fail.
// SCALARS  Rational.
// COST     some tenths of a millisecond; at most max_boxes boxes for regularity.
// TEST     tests/join/gregory_proof_test.cpp checks (1) and (2).
#pragma once

#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/patch/boundary.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

struct GregoryProof {
  bool matched = false, corners = false, c1 = false, positive = false;
  ExactClass regular;
  int boxes = 0;  // looked at for it

  bool is_c1() const { return matched && corners && c1 && positive; }
};

GregoryProof prove_patch(const GregoryPatch<Rational>& patch, int max_boxes = 20000);

// Each of them, on `jobs` threads (0: one per processor).
std::vector<GregoryProof> prove_patches(const std::vector<const GregoryPatch<Rational>*>& patches, int jobs = 0);

// The surface that S and its first derivatives agree with on an edge: the V surface for v_min and v_max, else the U surface.
template <ExactField T>
const BsplinePatch<T, 4>& carrier(const GregoryPatch<T>& patch, EdgeName edge) {
  return edge == EdgeName::v_min || edge == EdgeName::v_max ? patch.v_surface() : patch.u_surface();
}

}  // namespace patchproof
