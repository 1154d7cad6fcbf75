// SPDX-License-Identifier: Apache-2.0
// The rungs of the ladder. Each is a function of its own that tests call and reports name.
//
//   interval   forms in interval arithmetic: may refute equality and bound deviations; never proves equality
//   fixed      bicubic joins of doubles, integers of fixed width: decides the determinant of G1, mostly the side too
//   exact      forms over Integer ("integer") or Q(√d) ("quadratic"): decides every class
//
// ENSURES  (1) what the interval or the fixed rung answers, the exact rung answers too;  (2) the interval and the exact
//          rung's bounds enclose the supremum.
// REQUIRES a RoundingGuard alive.
#pragma once

#include <optional>
#include <vector>

#include "patchproof/join/continuity.h"
#include "patchproof/join/deviation.h"
#include "patchproof/join/fixed_g1.h"
#include "patchproof/join/pieces.h"

namespace patchproof {

// Are all coefficients within 2^±60, so that no product of a join polynomial leaves the range of doubles?
bool fits_interval_rung(const std::vector<JoinForms<Interval>>& forms);

// Some piece's points differ certainly.
bool interval_rung_refutes_c0(const std::vector<JoinForms<Interval>>& forms);

// refuted when a piece is, proven_smooth when all pieces are, cannot_tell when a piece leaves it open; empty when no
// piece is refuted and one is not representable. REQUIRES the join is C0. Needs no RoundingGuard.
std::optional<FixedG1> fixed_rung_decides_g1(const std::vector<JoinPiece<Rational>>& pieces);

template <Ring R>
DeviationBound bound_gap(const std::vector<JoinForms<R>>& forms, const Budget& budget) {
  std::vector<DeviationPiece> pieces;
  for (const JoinForms<R>& f : forms)
    pieces.push_back(deviation_piece(point_difference(f.a, f.b), f.a.weight[0] * f.b.weight[0]));
  return bound_deviation(pieces, Deviation::gap, budget);
}

// First-order normals as they are: not converged where one of them vanishes.
DeviationBound interval_rung_bound_angle(const std::vector<JoinForms<Interval>>& forms, Deviation what,
                                         const Budget& budget);

// Reduced normals: converges wherever limit normals exist. REQUIRES all normals found.
template <ExactRing R>
DeviationBound exact_rung_bound_angle(const std::vector<std::pair<ReducedNormal<R>, ReducedNormal<R>>>& normals,
                                      Deviation what, const Budget& budget) {
  std::vector<DeviationPiece> pieces;
  for (const auto& [a, b] : normals) {
    BinaryForm<R> factor = a.factor * b.factor;
    // Zeros without a change of sign would leave the orientation open however often the piece is halved.
    if (factor.degree() > 0) factor = detail::to_ring<R>({odd_part(over_field(factor)), {}, {}})[0];
    pieces.push_back(deviation_piece(cross(b.n, a.n), -dot(a.n, b.n), factor));
  }
  return bound_deviation(pieces, what, budget);
}

}  // namespace patchproof
