// SPDX-License-Identifier: Apache-2.0
// Patches from data: the B-spline patch that comes nearest to a grid of samples, exactly.
//
//   minimise  Σ_a Σ_b w_a x_b |S(u_a, v_b) − s_ab|²
//   net = (Aᵀ W A)⁻¹ Aᵀ W · s · X B (Bᵀ X B)⁻¹,     A_{a,i} = N_i(u_a),  B_{b,j} = N_j(v_b)
//
// Every row of the grid is fitted along v, then every column of the control points found is fitted along u: two curve problems
// (spline/least_squares.h) in place of one with all control points, and the same minimum, because the matrix of the products
// N_i(u_a) N_j(v_b) is the Kronecker product of A and B.
//
// ENSURES   (1) the residuals are orthogonal to all products:  Σ w_a x_b N_i(u_a) N_j(v_b) (S(u_a, v_b) − s_ab) = 0;
//           (2) samples of a patch on these knots give back its net;
//           (3) a direction with as many samples as control points is interpolated; when both are, S(u_a, v_b) = s_ab;
//           (4) swapping the directions of the grid swaps those of the patch.
// ERRORS    as least_squares.h, `where` begins with "along u" or "along v"; wrong_count also for a grid of another size.
// SCALARS   T: ExactField (Rational, Quadratic).
// COST      that of a curve fit in each direction, and as many solutions as the grid has rows and the net has columns.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter XVII (tensor products).
// NEIGHBOURS spline/sample_parameters.h (parameters and knots).
// TEST      tests/patch/fit_patch_test.cpp
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/least_squares.h"
#include "patchproof/vec.h"

namespace patchproof {

template <ExactField T, std::size_t N>
struct GridSamples {
  std::vector<T> u, v;                            // parameters of the rows and of the columns
  std::vector<Vec<T, N>> points;                  // sample (a, b) at a · |v| + b
  std::vector<T> weights_u = {}, weights_v = {};  // of rows and columns, positive; empty: all 1
};

template <ExactField T, std::size_t N>
Result<BsplinePatch<T, N>> fit_patch(const KnotVector<T>& knots_u, const KnotVector<T>& knots_v,
                                     const GridSamples<T, N>& grid);

// ---------------------------------------------------------------------------------------------------------------------

template <ExactField T, std::size_t N>
Result<BsplinePatch<T, N>> fit_patch(const KnotVector<T>& knots_u, const KnotVector<T>& knots_v,
                                     const GridSamples<T, N>& grid) {
  if (grid.points.size() != grid.u.size() * grid.v.size())
    return Error{ErrorCode::wrong_count, "",
                 "a grid of " + std::to_string(grid.u.size()) + " x " + std::to_string(grid.v.size()) +
                     " parameters has as many samples",
                 std::to_string(grid.points.size())};
  const auto along = [](const char* direction, const Error& error) {
    return Error{error.code, direction + (error.where.empty() ? "" : ", " + error.where), error.message, error.values};
  };
  const auto solver_u = LeastSquares<T>::make(knots_u, grid.u, grid.weights_u);
  if (!solver_u) return along("along u", solver_u.error());
  const auto solver_v = LeastSquares<T>::make(knots_v, grid.v, grid.weights_v);
  if (!solver_v) return along("along v", solver_v.error());

  using Points = std::vector<Vec<T, N>>;
  const std::size_t rows = grid.u.size(), columns = grid.v.size();
  const int n = knots_u.control_count(), m = knots_v.control_count();
  std::vector<Points> found(m, Points(rows));  // column j of the rows' control points
  for (std::size_t a = 0; a < rows; ++a) {
    const auto begin = grid.points.begin() + static_cast<std::ptrdiff_t>(a * columns);
    const Points row = solver_v->control_points(Points(begin, begin + static_cast<std::ptrdiff_t>(columns)));
    for (int j = 0; j < m; ++j) found[j][a] = row[j];
  }
  Points net(static_cast<std::size_t>(n) * m);
  for (int j = 0; j < m; ++j) {
    const Points column = solver_u->control_points(found[j]);
    for (int i = 0; i < n; ++i) net[static_cast<std::size_t>(i) * m + j] = column[i];
  }
  return BsplinePatch<T, N>(knots_u, knots_v, std::move(net));
}

}  // namespace patchproof
