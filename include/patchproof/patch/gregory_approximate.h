// SPDX-License-Identifier: Apache-2.0
// NURBS boundary Gregory patches as B-spline patches with positive weights, nearly, with bounds of how nearly: for formats and
// kernels that refuse the zero weights of gregory_expand.h.
//
// For a polynomial patch the C surface is that of the mean net (Q⁰ + Q¹)/2 plus, for each quadrant (p, q),
//
//   d_pq g(x, y),   g = B_1(x) B_1(y) ( x²/(x² + y²) − 1/2 ),   d_pq = Q⁰ − Q¹ of the inner point,  x, y: distances from the corner
//
// and only g is no polynomial. It is replaced by the bicubic C¹ spline H on n × n equal cells with the values, first and mixed
// derivatives of g at all nodes but (0, 0), where the mixed one is 0, the mean of its two limits:
//
//   S~ = S^u + S^v − C_mean − Σ_pq d_pq H          S − S~ = Σ_pq d_pq (H − g)
//
// ENSURES  (1) surface: S~, every weight 1, degrees (max(3, d_u), max(3, d_v)), knots: those of U and V and multiples of 1/n;
//          (2) its edges are those of S, and its cross-boundary derivatives but within 1/n of a corner;
//          (3) |S − S~| ≤ point_deviation everywhere;  (4) the normals of S and S~ differ by at most normal_angle (radians), when
//          there is one: else they are not bounded, in max_boxes boxes;  (5) a patch without blended quadrants is itself, with
//          deviations 0;  (6) value, slope: |H − g| and |∂(H − g)/∂x| on each cell; those by y are those of the mirrored cell.
// ERRORS   approximate: unsupported (weights: the edges of such a patch have no common net).  make: REQUIRES 1 ≤ cells ≤ 64.
// SCALARS  T: Rational, Quadratic. Bounds are doubles, rounded upward.
// COST     with 8 cells: make 0.1 s, approximate 0.05 s for a bicubic patch.
// SOURCE   bicubic Hermite interpolation; g − H = N / (2 (x² + y²)) with a polynomial N, bounded by Bernstein coefficients on
//          boxes that shrink towards (0, 0), and in the last one by |g| ≤ 1.36 r², |g_x| ≤ 9 (r + r²), r its side.
// TEST     tests/patch/gregory_approximate_test.cpp checks (1)–(6).
#pragma once

#include <optional>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

// H, and how far it is from g.
class BlendSpline {
 public:
  static BlendSpline make(int cells);

  int cells() const { return cells_; }
  const BsplinePatch<Rational, 1>& spline() const { return spline_; }
  // On [i/n, (i+1)/n] × [j/n, (j+1)/n].
  double value(int i, int j) const { return value_[i * cells_ + j]; }
  double slope(int i, int j) const { return slope_[i * cells_ + j]; }

 private:
  BlendSpline(int cells, BsplinePatch<Rational, 1> spline) : cells_(cells), spline_(std::move(spline)) {}
  int cells_;
  BsplinePatch<Rational, 1> spline_;
  std::vector<double> value_, slope_;
};

template <ExactField T>
struct ApproximatedGregory {
  BsplinePatch<T, 4> surface;
  double point_deviation = 0;
  std::optional<double> normal_angle;
};

template <ExactField T>
Result<ApproximatedGregory<T>> approximate(const GregoryPatch<T>& patch, const BlendSpline& blend,
                                           int max_boxes = 20000);

}  // namespace patchproof
