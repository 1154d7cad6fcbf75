// SPDX-License-Identifier: Apache-2.0
// How far a surface is from flat triangles, and its normals from theirs, proved over whole cells of the parameters.
//
// Let a triangle (or any triangulation of a cell) interpolate S at its corners, linear in the parameters, in a box of the sizes
// h_u, h_v. By Taylor's formula at the point with the barycentric weights λ, where the first order cancels,
//     |S − L| ≤ ½ Σ λ_i |D²S| (p_i − p)²  ≤  ⅛ (M_uu h_u² + 2 M_uv h_u h_v + M_vv h_v²),      M = sup |∂²S| over the box,
// for Σ λ_i (u_i − u)² is the variance of numbers in a range of the length h_u. Where S is C0 only across a knot line, a jump J
// of the derivative adds at most ½ J h. Corners moved from S by δ_i add max δ_i at most.
// The M are the largest control vectors of the second derivatives in Bernstein form on the box; of rational pieces those of the
// numerators
//     w³ S_uu = w (w A_uu − w_uu A) − 2 w_u (w A_u − w_u A),   w³ S_uv = w (w A_uv − w_uv A) − w_u (w A_v − w_v A) − w_v (w A_u − w_u A)
// multiplied out, over the least w³. The normals over the box lie in the convex cone of the control vectors of
//     w³ S_u × S_v = w A_u × A_v − w_u A × A_v − w_v A_u × A.
//
// REQUIRES  weights whose denominator has no zero (readers certify it). Boxes with begin < end in both directions.
// ENSURES   (1) bound(box).chord(h_u, h_v) ≥ |S − L| for every triangle in the box that has its corners on S;
//           (2) angle(hull, n) ≥ the angle between n and S_u × S_v at every point of the box where that is not zero, and is 180
//               where the cone does not tell;  (3) point(u, v) encloses S(u, v);  (4) bounds of planar parts whose parameters are
//               affine are of the size of rounding;  (5) halving a box of a smooth piece divides chord() by about 4;
//           (6) speeds: M of |S_u| and |S_v| bound the first derivatives.
// SCALARS   T: Rational, Quadratic.
// COST      about 10 µs for a box of a bicubic piece, 60 µs when it is rational; building: one Bézier extraction.
// SOURCE    D. Filip, R. Magedson, R. Markot, Surface algorithms using bounds on derivatives, CAGD 3 (1986) 295–311 (the ⅛).
// TEST      tests/mesh/chord_bound_test.cpp checks (1)–(6).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/interval.h"

namespace patchproof {

// What is known of S over a box.
struct SurfaceHull {
  double uu = 0, uv = 0, vv = 0;  // sup |S_uu|, |S_uv|, |S_vv|
  double u = 0, v = 0;            // sup |S_u|, |S_v|
  double jump_u = 0, jump_v = 0;  // sums of the jumps of S_u, S_v across the knot lines inside
  std::vector<std::array<std::array<double, 2>, 3>> normals;  // control vectors of the normals' cone, as intervals

  // ⅛ (M_uu h_u² + 2 M_uv h_u h_v + M_vv h_v²) + ½ (J_u h_u + J_v h_v). REQUIRES a RoundingGuard alive.
  double chord(double size_u, double size_v) const;
};

// In degrees. REQUIRES a RoundingGuard alive.
double angle_bound(const SurfaceHull& hull, const Vec<Interval, 3>& normal);

// In which parameters boxes are given: the knots' own, or such that the breaks are 0, 1, 2, … (exact whatever the knots are).
enum class PieceParameters { knots, spans };

class SurfacePieces {
 public:
  template <ExactField T>
  static SurfacePieces of(const BsplinePatch<T, 4>& patch, PieceParameters parameters);

  int count(Direction d) const { return static_cast<int>((d == Direction::u ? u_ : v_).size()) - 1; }
  ParameterBox<double> domain() const;
  // The breaks, rounded.
  std::vector<double> breaks(Direction d) const;
  // Outside the domain the outermost polynomials are continued. REQUIRES a RoundingGuard alive.
  Vec<Interval, 3> point(double u, double v) const;
  SurfaceHull bound(const ParameterBox<double>& box) const;

  // Bernstein coefficients on the unit square, v running fastest: of each the intervals of x, y, z as (−inf, sup), so that
  // averages are the same operations, rounded upward, on six numbers.
  struct Net {
    int degree_u = 0, degree_v = 0;
    std::vector<std::array<double, 6>> points;
  };
  struct Piece {
    Net position, weight;                 // A − w c and, when it is not 1, w (in the first component)
    Net uu, uv, vv, u, v, normal;         // numerators over w³ and (first derivatives) w²
    Net jump_u, jump_v;                   // numerators over w² of the jumps across u = begin, v = begin; empty: none
    bool torn_u = false, torn_v = false;  // S itself may jump there
    bool rational = false;
  };

 private:
  struct Range {
    int first, last;
  };
  Range touched(const std::vector<Interval>& breaks, double begin, double end) const;

  std::vector<Interval> u_, v_;
  std::vector<Piece> pieces_;  // those of the first u interval first
  Vec<double, 3> centre_{};
};

}  // namespace patchproof
