// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/filter.h"

namespace patchproof {

bool interval_rung_refutes_c0(const std::vector<JoinForms<Interval>>& forms) {
  for (const JoinForms<Interval>& f : forms)
    for (const BinaryForm<Interval>& c : point_difference(f.a, f.b)) {
      const std::optional<bool> zero = is_zero(c);
      if (zero && !*zero) return true;
    }
  return false;
}

DeviationBound interval_rung_bound_angle(const std::vector<JoinForms<Interval>>& forms, const Budget& budget) {
  std::vector<DeviationPiece> pieces;
  for (const JoinForms<Interval>& f : forms) {
    const FormVector<Interval> a = normal(f.a), b = normal(f.b);
    pieces.push_back(deviation_piece(cross(b, a), -dot(a, b)));
  }
  return bound_deviation(pieces, Deviation::angle, budget);
}

}  // namespace patchproof
