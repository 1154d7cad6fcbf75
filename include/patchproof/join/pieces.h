// SPDX-License-Identifier: Apache-2.0
// A join cut into pieces on which both sides are polynomial (or rational), each side as Bernstein rows on [0, 1].
//
// The cuts are the nodes of the pairing, the knots of A and the knots of B carried over to A: an exact common refinement,
// also for reversed edges, T-junctions and unequal degrees.
//
// ENSURES  (1) row k of side A on piece i is ∂^k/∂n^k of A's homogeneous surface, as a function of the common local
//          parameter in [0, 1]; side B likewise, through the pairing;  (2) pieces cover the pairing's range without gaps.
// COST     p² combinations per row and piece; nothing but copies on whole Bézier edges.
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "patchproof/deadline.h"
#include "patchproof/join/join.h"
#include "patchproof/join/join_polynomials.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/spline/reparametrize.h"

namespace patchproof {

// Homogeneous Bernstein coefficients (w·x, w·y, w·z, w) of the line (row 0) and of its first two cross derivatives.
template <Ring T>
using SideRows = std::array<std::vector<Vec<T, 4>>, 3>;

template <ExactField T>
struct JoinPiece {
  T a_begin, a_end, b_begin, b_end;  // parameters on line A and line B that the local parameters 0 and 1 stand for
  SideRows<T> a, b;
};

template <ExactField T>
std::vector<JoinPiece<T>> join_pieces(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b, const Join<T>& join);

// The ring in which exact join polynomials are formed fastest: cleared integers for rationals.
template <ExactField T>
using proof_ring_t = std::conditional_t<std::is_same_v<T, Rational>, Integer, T>;

// The side's forms over R; exact rings get the rows times one positive constant. A side whose weights are all equal gets
// a constant weight form. REQUIRES the weight does not vanish on the piece; a negative one is made positive.
template <Ring R, ExactField T>
SideForms<R> side_forms(const SideRows<T>& rows);

template <Ring R, ExactField T>
JoinForms<R> join_forms(const JoinPiece<T>& piece) {
  return {side_forms<R>(piece.a), side_forms<R>(piece.b)};
}

// Moves the origin to o: (X, w) becomes (X − o w, w) in all rows.
template <ExactField T>
void shift_origin(SideRows<T>& rows, const Vec<T, 3>& o) {
  for (auto& row : rows)
    for (Vec<T, 4>& p : row) {
      if (*scalar_traits<T>::sign(p[3]) == Sign::zero) continue;
      for (int c = 0; c < 3; ++c) p[c] = p[c] - o[c] * p[3];
    }
}

// ---------------------------------------------------------------------------------------------------------------------

template <ExactField T>
std::vector<JoinPiece<T>> join_pieces(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b, const Join<T>& join) {
  const Pairing<T>& pairing = join.pairing;
  PATCHPROOF_REQUIRES(pairing.a.size() >= 2 && pairing.a.size() == pairing.b.size(),
                      "join_pieces: the pairing needs nodes");
  const auto rows_a = cross_boundary_rows(a, join.line_a, 2);
  const auto rows_b = cross_boundary_rows(b, join.line_b, 2);
  std::vector<JoinPiece<T>> pieces;
  for (std::size_t i = 0; i + 1 < pairing.a.size(); ++i) {
    const T &a0 = pairing.a[i], &a1 = pairing.a[i + 1], &b0 = pairing.b[i], &b1 = pairing.b[i + 1];
    std::vector<std::pair<T, T>> cuts{{a0, b0}};  // (parameter on A, parameter on B)
    for (const T& t : rows_a[0].knots().breaks())
      if (a0 < t && t < a1) cuts.emplace_back(t, b0 + (t - a0) / (a1 - a0) * (b1 - b0));
    for (const T& t : rows_b[0].knots().breaks())
      if ((b0 < t && t < b1) || (b1 < t && t < b0)) cuts.emplace_back(a0 + (t - b0) / (b1 - b0) * (a1 - a0), t);
    cuts.emplace_back(a1, b1);
    PATCHPROOF_REQUIRES(pairing.kind != PairingKind::rational_linear || cuts.size() == 2,
                        "join_pieces: a rational linear pairing needs edges without inner knots");
    std::sort(cuts.begin(), cuts.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [](const auto& x, const auto& y) { return x.first == y.first; }),
               cuts.end());
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      check_deadline();
      JoinPiece<T> piece{cuts[c].first, cuts[c + 1].first, cuts[c].second, cuts[c + 1].second, {}, {}};
      const bool reversed = piece.b_end < piece.b_begin;
      for (int k = 0; k < 3; ++k) {
        piece.a[k] = bezier_coefficients(rows_a[k], piece.a_begin, piece.a_end);
        piece.b[k] = reversed ? bezier_coefficients(rows_b[k], piece.b_end, piece.b_begin)
                              : bezier_coefficients(rows_b[k], piece.b_begin, piece.b_end);
        if (reversed) std::reverse(piece.b[k].begin(), piece.b[k].end());
        if (pairing.kind == PairingKind::rational_linear) piece.b[k] = moebius(std::move(piece.b[k]), pairing.ratio);
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

namespace detail {

template <Ring R, ExactField T>
SideRows<R> rows_over(const SideRows<T>& rows) {
  if constexpr (std::is_same_v<R, T>) {
    return rows;
  } else if constexpr (std::is_same_v<R, Integer>) {
    Integer denominator(1);
    for (const auto& row : rows)
      for (const Vec<T, 4>& p : row)
        for (const T& x : p.c)
          mpz_lcm(denominator.backend().data(), denominator.backend().data(), mpq_denref(x.backend().data()));
    SideRows<R> out;
    for (int k = 0; k < 3; ++k) {
      out[k].resize(rows[k].size());
      for (std::size_t i = 0; i < rows[k].size(); ++i)
        for (int c = 0; c < 4; ++c) {
          const mpq_t& q = rows[k][i][c].backend().data();
          mpz_t& z = out[k][i][c].backend().data();
          mpz_divexact(z, denominator.backend().data(), mpq_denref(q));
          mpz_mul(z, z, mpq_numref(q));
        }
    }
    return out;
  } else {
    SideRows<R> out;
    for (int k = 0; k < 3; ++k)
      for (const Vec<T, 4>& p : rows[k])
        out[k].push_back({{embed<R>(p[0]), embed<R>(p[1]), embed<R>(p[2]), embed<R>(p[3])}});
    return out;
  }
}

}  // namespace detail

template <Ring R, ExactField T>
SideForms<R> side_forms(const SideRows<T>& rows) {
  const auto zero = [](const T& x) { return *scalar_traits<T>::sign(x) == Sign::zero; };
  const std::vector<Vec<T, 4>>& line = rows[0];
  const bool constant_weight =
      std::all_of(line.begin(), line.end(), [&](const Vec<T, 4>& p) { return p[3] == line[0][3]; });
  const bool negative = *scalar_traits<T>::sign(line[0][3]) == Sign::negative;
  SideRows<R> over = detail::rows_over<R>(rows);
  SideForms<R> forms;
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 4; ++c) {
      BinaryForm<R>& form = c < 3 ? forms.position[k][c] : forms.weight[k];
      if (c == 3 && k == 0 && constant_weight) {
        form = BinaryForm<R>::constant(over[0][0][3]);
      } else if (std::all_of(rows[k].begin(), rows[k].end(), [&](const Vec<T, 4>& p) { return zero(p[c]); })) {
        continue;  // the empty form
      } else {
        std::vector<R> coefficients;
        coefficients.reserve(over[k].size());
        for (Vec<R, 4>& p : over[k]) coefficients.push_back(std::move(p[c]));
        form = BinaryForm<R>::from_bernstein(std::move(coefficients));
      }
      if (negative) form = -form;
    }
  }
  return forms;
}

}  // namespace patchproof
