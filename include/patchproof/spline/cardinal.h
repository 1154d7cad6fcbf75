// SPDX-License-Identifier: Apache-2.0
// Cardinal functions of a spline space: L_0 … L_n with L_i(x_k) = 1 for i = k and 0 otherwise, at n + 1 sites x_k.
//
//   L_i = Σ_m A_mi N_m,   A = B⁻¹,   B_km = N_m(x_k)
//
// A curve through points p_k at the sites has the control points Σ_k A_mk p_k; on Bézier knots the L_i are Lagrange's
// polynomials.
//
// ENSURES   (1) the functions are cardinal;  (2) Σ_i L_i = 1, and interpolation reproduces every spline of the space.
// SCALARS   K: ExactField.
// ERRORS    wrong_count unless there are as many sites as functions;  outside_domain: a site outside the domain;
//           usage: the sites do not determine a spline. In growing order they do exactly when N_k(x_k) > 0 for all k (I.
//           Schoenberg, A. Whitney).
// COST      O(n³) operations.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter XIII.
// TEST      tests/spline/cardinal_test.cpp checks (1), (2).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

// result[m][i]: control point m of L_i.
template <ExactField K>
Result<std::vector<std::vector<K>>> cardinal_controls(const KnotVector<K>& knots, const std::vector<K>& sites);

// ---------------------------------------------------------------------------------------------------------------------

// Gauss–Jordan elimination on (B | 1).
template <ExactField K>
Result<std::vector<std::vector<K>>> cardinal_controls(const KnotVector<K>& knots, const std::vector<K>& sites) {
  const std::size_t n = knots.control_count();
  if (sites.size() != n)
    return Error{ErrorCode::wrong_count, "", "the knots need " + std::to_string(n) + " sites",
                 std::to_string(sites.size())};
  std::vector<std::vector<K>> rows;
  for (std::size_t k = 0; k < n; ++k) {
    if (!knots.in_domain(sites[k]))
      return Error{ErrorCode::outside_domain, "", "site " + std::to_string(k) + " lies outside the domain",
                   to_text(sites[k])};
    rows.push_back(basis(knots, sites[k]));
    rows[k].resize(2 * n, K(0));
    rows[k][n + k] = K(1);
  }
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    while (pivot < n && rows[pivot][column] == K(0)) ++pivot;
    if (pivot == n) return Error{ErrorCode::usage, "", "the sites do not determine a spline on these knots", ""};
    std::swap(rows[pivot], rows[column]);
    const K factor = rows[column][column];
    for (K& x : rows[column]) x = x / factor;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == column || rows[r][column] == K(0)) continue;
      const K times = rows[r][column];
      for (std::size_t c = column; c < 2 * n; ++c) rows[r][c] = rows[r][c] - times * rows[column][c];
    }
  }
  for (auto& row : rows) row.erase(row.begin(), row.begin() + n);
  return rows;
}

}  // namespace patchproof
