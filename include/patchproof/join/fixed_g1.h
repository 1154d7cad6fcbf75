// SPDX-License-Identifier: Apache-2.0
// Is one bicubic join G1? Decided exactly in integers of a fixed width, without allocation.
//
// E, A, B: the control points of the common edge and of the rows behind it in the two patches, a Bernstein basis of
// degree 3 along the edge. Coordinates and weights are doubles, so one power of two makes whole numbers of all
// coordinates, a second one of all weights (a diagonal map of space: it changes no answer). Then, in scaled Bernstein form,
//     polynomial   x_t ~ c = ΔE (degree 2),  x_s ~ a = A − E,  y_s ~ b = B − E (degree 3)
//                  det = c · (a × b);        n_A = c × a,  n_B = c × b
//     rational     E ∧ E_t ~ the line (D, M), D = E_w E_t − E_t,w E, M = E × E_t (Plücker coordinates, degree 4 only)
//                  det = D · (A × B) + M · (A_w B − B_w A);      n_A = D × A + A_w M,  n_B = D × B + B_w M
//     refuted        det is not the zero form: somewhere x_t, x_s, y_s are independent, so the tangent planes differ
//     proven_smooth  det is the zero form and n_A, n_B ≠ 0 everywhere, on one line, opposed: shown either by one
//                    direction r with n_A · r > 0 > n_B · r, or by n_A · n_B < 0, in all Bernstein coefficients
//     cannot_tell    det is the zero form, but neither test shows regularity and side (zeros of normals, cusps, strong
//                    bends): ask continuity.h
//
// WIDTHS  Rows have L limbs; whole numbers of the rows below 2^b in size are accepted when b ≤ 64 L − 5, L = 1 or 2.
//   Every sum below is bounded by the sum of the sizes of its terms, so partial sums are as well; and
//   Σ_{i+j=k} C(m,i) C(n,j) = C(m+n,k). Polynomial: |a|, |b|, |c| ≤ 2^(b+1), times binomials ≤ 3: below 2^(b+3).
//     a × b       ≤ 2 · 2^(2b+2) · C(6,3)            = 20 · 2^(2b+3)  < 2^(2b+8)     2L limbs:  2b + 8 ≤ 128 L − 2
//     det         ≤ 3 · 2^(b+1) · 2^(2b+3) · C(8,4)  = 210 · 2^(3b+4) < 2^(3b+12)    3L limbs:  3b + 12 ≤ 192 L − 3
//     n_A, n_B    ≤ 2^(2b+3) · C(5,2)                                 < 2^(2b+7)     2L limbs
//     n_A · n_B   ≤ 3 · 2^(4b+6) · C(10,5)           = 756 · 2^(4b+6) < 2^(4b+16)    4L limbs:  4b + 16 ≤ 256 L − 4
//     with |r| ≤ 2^31:  r × c ≤ 2^32 · 2 · 2^(b+1)                    < 2^(b+35)     L + 1 limbs
//     n · r       ≤ 2^32 · 3 · 10 · 2^(2b+2)                          < 2^(2b+39)    2L + 1 limbs
//   Rational, with |E|, |A|, |B| < 2^b, times binomials and the factors of E ∧ E_t ≤ 3: below 2^(b+2).
//     D, M        ≤ 2 · 2^(2b) · (1, 2, 4, 2, 1)                      ≤ 2^(2b+3)     2L limbs
//     A ∧ B       ≤ 2 · 2^(2b) · C(6,3)                               < 2^(2b+6)     2L limbs
//     det         ≤ 6 · 2^(4b+2) · 152                                < 2^(4b+12)    4L limbs:  4b + 12 ≤ 256 L − 8
//                   (152 = the largest coefficient of (1,2,4,2,1) times (1,6,15,20,15,6,1))
//     n_A, n_B    ≤ 3 · 2^(3b+1) · 21                                 < 2^(3b+7)     3L limbs:  3b + 7 ≤ 192 L − 8
//                   (21 = the largest coefficient of (1,2,4,2,1) times (1,3,3,1))
//     n_A · n_B   ≤ 3 · 8 · 2^(6b+14)                                 < 2^(6b+19)    6L limbs:  6b + 19 ≤ 384 L − 11
//     with |r| ≤ 2^31:  r × D, r · M ≤ 3 · 2^31 · 2^(2b+3)            < 2^(2b+36)    2L + 1 limbs
//     n · r       ≤ 3 · 2^31 · 2^(3b+7)                               < 2^(3b+40)    3L + 1 limbs
//
// REQUIRES  all numbers are finite.
// ENSURES   (1) refuted: det ≢ 0, so the join is not G1;  (2) proven_smooth: the join is G1 and regular along the edge;
//           (3) refuted if and only if det ≢ 0, so cannot_tell is left to joins with one tangent plane wherever normals
//           exist;  (4) empty exactly when the whole numbers are too long for L = 2, or an edge weight is not positive;
//           (5) multiplying all coordinates by one power of two changes nothing.
// COST      about 500 word products for a polynomial join of up to 59 bits. No heap.
// SOURCE    determinants: join_polynomials.h. Meeting lines and the plane of a line and a point in Plücker coordinates:
//           H. Pottmann, J. Wallner, Computational Line Geometry (2001), ch. 2.
#pragma once

#include <array>
#include <optional>

#include "patchproof/join/pieces.h"

namespace patchproof {

// The points a weighted row holds: x and the weight w, or (w·x, w) as computed.
enum class WeightedPoints { cartesian, homogeneous };

struct BicubicJoinRows {
  using Row = std::array<std::array<double, 3>, 4>;
  Row edge{}, behind_a{}, behind_b{};
  // Of edge, behind_a, behind_b; none: all 1.
  std::optional<std::array<std::array<double, 4>, 3>> weights = std::nullopt;
  WeightedPoints points = WeightedPoints::cartesian;  // without weights they are the same
};

enum class FixedG1 { proven_smooth, refuted, cannot_tell };

// The two sides are REQUIRED to share the edge: that is C0, and given by the rows. Empty: not representable.
std::optional<FixedG1> decide_fixed_g1(const BicubicJoinRows& rows);

// The rows of a piece: E = X, A = X + c X_s, c > 0 constant, and so for B. Numbers that are no doubles are cleared of their
// denominators: coordinates by one common factor, weights by another (decimals with few digits become short numbers).
// Empty when a side is not of degree 3 along the edge, when the sides' edges are not one row up to a constant factor, or
// when a number is no double then either.
// ENSURES  (6) the rows join as the piece does.   REQUIRES the piece is C0.
std::optional<BicubicJoinRows> bicubic_join_rows(const JoinPiece<Rational>& piece);

}  // namespace patchproof
