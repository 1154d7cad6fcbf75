// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/filter.h"

namespace patchproof {

bool fits_interval_rung(const std::vector<JoinForms<Interval>>& forms) {
  constexpr double kLargest = 0x1p60, kSmallest = 0x1p-60;
  const auto fits = [&](const BinaryForm<Interval>& f) {
    for (const Interval& x : f.coefficients()) {
      const double size = std::max(x.sup(), -x.inf());
      if (size != 0 && (size > kLargest || size < kSmallest)) return false;
    }
    return true;
  };
  for (const JoinForms<Interval>& f : forms)
    for (const SideForms<Interval>* side : {&f.a, &f.b})
      for (int k = 0; k < 3; ++k)
        if (!fits(side->weight[k]) || !fits(side->position[k][0]) || !fits(side->position[k][1]) ||
            !fits(side->position[k][2]))
          return false;
  return true;
}

bool interval_rung_refutes_c0(const std::vector<JoinForms<Interval>>& forms) {
  for (const JoinForms<Interval>& f : forms)
    for (const BinaryForm<Interval>& c : point_difference(f.a, f.b)) {
      const std::optional<bool> zero = is_zero(c);
      if (zero && !*zero) return true;
    }
  return false;
}

std::optional<FixedG1> fixed_rung_decides_g1(const std::vector<JoinPiece<Rational>>& pieces) {
  std::optional<FixedG1> all = FixedG1::proven_smooth;
  for (const JoinPiece<Rational>& piece : pieces) {
    const std::optional<BicubicJoinRows> rows = bicubic_join_rows(piece);
    const std::optional<FixedG1> here = rows ? decide_fixed_g1(*rows) : std::nullopt;
    if (here == FixedG1::refuted) return here;
    if (!here || (all && *here == FixedG1::cannot_tell)) all = here;
  }
  return all;
}

DeviationBound interval_rung_bound_angle(const std::vector<JoinForms<Interval>>& forms, Deviation what,
                                         const Budget& budget) {
  std::vector<DeviationPiece> pieces;
  for (const JoinForms<Interval>& f : forms) {
    const FormVector<Interval> a = normal(f.a), b = normal(f.b);
    pieces.push_back(deviation_piece(cross(b, a), -dot(a, b)));
  }
  return bound_deviation(pieces, what, budget);
}

}  // namespace patchproof
