// SPDX-License-Identifier: Apache-2.0
// The B-spline basis functions of one span as power series about a point of ours.
//
//   N_{span−p+j, p}(t) = Σ_i M_ij s^i,   s = (t − centre) · scale,   i, j = 0…p
//
// REQUIRES p ≤ span < n, t_span < t_{span+1}, scale ≠ 0.
// ENSURES  (1) the identity above holds for all t (exactly for exact T);  (2) Σ_j M_0j = 1 and Σ_j M_ij = 0 for i ≥ 1.
// SCALARS  T: Field that K embeds into. K: OrderedField.
// COST     O(p³) operations.
// SOURCE   the recursion of bspline_basis.h, on polynomials instead of numbers.
// TEST     tests/spline/power_form_test.cpp checks (1), (2).
#pragma once

#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

// M row by row: M_ij at i·(p + 1) + j.
template <Field T, OrderedField K>
std::vector<T> basis_power_form(const KnotVector<K>& knots, int span, const K& centre, const K& scale);

// ---------------------------------------------------------------------------------------------------------------------

template <Field T, OrderedField K>
std::vector<T> basis_power_form(const KnotVector<K>& knots, int span, const K& centre, const K& scale) {
  const int p = knots.degree(), order = p + 1;
  PATCHPROOF_REQUIRES(p <= span && span < knots.control_count() && knots[span] < knots[span + 1],
                      "basis_power_form: the span is empty or outside the domain");
  const T c = embed<T>(centre), step = T(1) / embed<T>(scale);  // t = c + s · step
  std::vector<T> m(static_cast<std::size_t>(order) * order);
  m[0] = T(1);
  // Degree k from degree k − 1, whose functions stand in columns 0…k−1: column j is N_{span−k+j, k}.
  for (int k = 1; k <= p; ++k) {
    std::vector<T> next(m.size());
    for (int j = 0; j < k; ++j) {  // N_{span−k+1+j, k−1} rises over its support and goes to column j+1, and falls to j
      const T begin = embed<T>(knots[span - k + 1 + j]), end = embed<T>(knots[span + 1 + j]), width = end - begin;
      for (int i = 0; i < k; ++i) {
        const T& coefficient = m[i * order + j];
        const T per_width = coefficient / width;
        next[i * order + j + 1] += per_width * (c - begin);
        next[i * order + j] += per_width * (end - c);
        next[(i + 1) * order + j + 1] += per_width * step;
        next[(i + 1) * order + j] += -(per_width * step);
      }
    }
    m = std::move(next);
  }
  return m;
}

}  // namespace patchproof
