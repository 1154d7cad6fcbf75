// SPDX-License-Identifier: Apache-2.0
// The judge of decisions about rows: the exact rung, forms over Integer, which share no code with fixed widths or
// residues.
#pragma once

#include "patchproof/join/continuity.h"
#include "patchproof/join/decide_batch.h"
#include "patchproof/join/pieces.h"

namespace patchproof::test {

// The same join as a piece: X = E, X_s = 3 (A − E), Y = F, Y_s = 3 (B − F), in exact numbers.
inline JoinPiece<Rational> exact_piece(const BicubicJoinRows& rows, const BicubicEdge* other = nullptr) {
  const auto points = [&](const BicubicJoinRows::Row& row, const std::array<double, 4>& weights) {
    std::vector<Vec<Rational, 4>> out;
    for (int i = 0; i < 4; ++i) {
      const Rational w = from_double(weights[i]);
      const Rational factor = rows.points == WeightedPoints::cartesian ? w : Rational(1);
      out.push_back(
          {{from_double(row[i][0]) * factor, from_double(row[i][1]) * factor, from_double(row[i][2]) * factor, w}});
    }
    return out;
  };
  const auto weights = [&](int which) {
    return rows.weights ? (*rows.weights)[which] : std::array<double, 4>{1, 1, 1, 1};
  };
  JoinPiece<Rational> piece{0, 1, 0, 1, {}, {}};
  piece.a[0] = points(rows.edge, weights(0));
  piece.b[0] = other != nullptr ? points(other->points, other->weights) : piece.a[0];
  const auto a = points(rows.behind_a, weights(1)), b = points(rows.behind_b, weights(2));
  for (int i = 0; i < 4; ++i) {
    piece.a[1].push_back(Rational(3) * (a[i] - piece.a[0][i]));
    piece.b[1].push_back(Rational(3) * (b[i] - piece.b[0][i]));
  }
  piece.a[2].resize(4);
  piece.b[2].resize(4);
  return piece;
}

struct ExactAnswer {
  bool c0 = false, c1 = false;
  bool coplanar = false;  // C0 and det ≡ 0
  bool smooth = false;    // coplanar, both normals free of zeros, opposed
};
inline ExactAnswer exact_answer(const JoinPiece<Rational>& piece) {
  const RoundingGuard guard;
  const JoinForms<Integer> forms = join_forms<Integer>(piece);
  ExactAnswer answer;
  answer.c0 = is_c0(forms);
  if (!answer.c0) return answer;
  answer.c1 = match_cross_derivatives(forms).equal;
  answer.coplanar = vanishes(coplanarity(forms.a, forms.b));
  if (!answer.coplanar) return answer;
  const ReducedNormal<Integer> a = reduce_normal(forms.a), b = reduce_normal(forms.b);
  const auto regular = [](const ReducedNormal<Integer>& n) {
    return n.found() && n.order == NormalOrder::first && n.ends.at_zero == 0 && n.ends.at_one == 0 && !n.has_factor();
  };
  answer.smooth = regular(a) && regular(b) && *scalar_traits<Integer>::sign(dot(a.n, b.n)[0]) == Sign::negative;
  return answer;
}
inline ExactAnswer exact_answer(const BicubicJoinRows& rows, const BicubicEdge* other = nullptr) {
  return exact_answer(exact_piece(rows, other));
}

}  // namespace patchproof::test
