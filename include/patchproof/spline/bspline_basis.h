// SPDX-License-Identifier: Apache-2.0
// The B-spline functions N_{i,p} of a knot vector and their derivatives of any order.
//
//   N_{j,r}(t) = w_{j,r} N_{j,r−1} + (1 − w_{j+1,r}) N_{j+1,r−1},       w_{j,r} = (t − t_j)/(t_{j+r} − t_j)
//   N'_{j,r}   = r (N_{j,r−1}/(t_{j+r} − t_j) − N_{j+1,r−1}/(t_{j+r+1} − t_{j+1})),       0/0 = 0
//
// On a span [t_i, t_{i+1}] only N_{i−p,p} … N_{i,p} live, and they are polynomials. Computed there, every denominator
// contains the span and is positive, so repeated knots of any multiplicity need no special case: a function whose support
// has length zero (more than p + 1 equal knots) belongs to no span and stays 0, as the convention 0/0 = 0 wants.
//
// The parameter of the …_in_span functions may be of another scalar than the knots: an Interval, a Tracked, a Ball. It is
// not checked to lie in the span; outside, the result is the polynomial piece of the span, continued.
//
// REQUIRES  in_span: degree ≤ span < control_count and t_span < t_{span+1}. Otherwise: t in the domain.
// ENSURES   (1) the functions are ≥ 0 and sum to 1 on the domain, its ends included;
//           (2) N_i is 0 outside [t_i, t_{i+p+1}], and identically 0 when that has length zero;
//           (3) at a knot of multiplicity m the values from the left and from the right agree up to derivative p − m; at
//               m ≥ p + 1 a function may jump, and Side says which limit is meant;
//           (4) the k-th derivatives are those of the polynomial pieces, 0 for k > p, and sum to 0 for k > 0;
//           (5) on Bézier knots of [0, 1] they are the Bernstein polynomials.
// SCALARS   K: OrderedField. R, the result: Ring that K embeds into; Field unless t is of the exact type K itself.
// COST      O(p²) per order of derivative; the functions over all knots add O(n + log m).
// SOURCE    C. de Boor, A Practical Guide to Splines, chapters IX–X.
#pragma once

#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/knot_ratio.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof {

// The order-th derivatives at t of the p + 1 functions N_{span−p} … N_span.
template <Ring R, OrderedField K, class U>
std::vector<R> basis_derivative_in_span(const KnotVector<K>& knots, int span, const U& t, int order);

// Their values at t.
template <Ring R, OrderedField K, class U>
std::vector<R> basis_in_span(const KnotVector<K>& knots, int span, const U& t) {
  return basis_derivative_in_span<R>(knots, span, t, 0);
}

// result[k][j]: the k-th derivative of N_{span−p+j} at t, k = 0…order.
template <Ring R, OrderedField K, class U>
std::vector<std::vector<R>> basis_derivatives_in_span(const KnotVector<K>& knots, int span, const U& t, int order) {
  std::vector<std::vector<R>> out;
  for (int k = 0; k <= order; ++k) out.push_back(basis_derivative_in_span<R>(knots, span, t, k));
  return out;
}

// The order-th derivatives at t of all functions N_0 … N_{n−1}, as limits from `side`.
template <OrderedField K>
std::vector<K> basis_derivative(const KnotVector<K>& knots, const K& t, int order, Side side = Side::right) {
  const int span = knots.find_span(t, side);
  const std::vector<K> live = basis_derivative_in_span<K>(knots, span, t, order);
  std::vector<K> out(knots.control_count(), K(0));
  for (int j = 0; j <= knots.degree(); ++j) out[span - knots.degree() + j] = live[j];
  return out;
}

// The values at t of all functions N_0 … N_{n−1}, as limits from `side`.
template <OrderedField K>
std::vector<K> basis(const KnotVector<K>& knots, const K& t, Side side = Side::right) {
  return basis_derivative(knots, t, 0, side);
}

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <OrderedField K>
void require_span(const KnotVector<K>& knots, int span) {
  PATCHPROOF_REQUIRES(knots.degree() <= span && span < knots.control_count() && knots[span] < knots[span + 1],
                      "the span must be a non-empty one of the domain");
}

}  // namespace detail

// From degree r − 1 to r, N_{j,r−1} feeds N_{j−1,r} and N_{j,r}: with 1 − w and w when values are wanted, with ∓ its rate
// when one more derivative is. The derivatives come last: the k-th derivatives in degree p need values in degree p − k.
template <Ring R, OrderedField K, class U>
std::vector<R> basis_derivative_in_span(const KnotVector<K>& knots, int span, const U& t, int order) {
  detail::require_span(knots, span);
  PATCHPROOF_REQUIRES(order >= 0, "basis_derivative: the order is not negative");
  const int p = knots.degree();
  if (order > p) return std::vector<R>(p + 1, R(0));
  std::vector<R> functions{R(1)};
  for (int r = 1; r <= p; ++r) {
    std::vector<R> raised(r + 1, R(0));
    for (int l = 0; l < r; ++l) {
      const int j = span - r + 1 + l;
      if (r <= p - order) {
        const R w = knot_ratio<R>(t, knots[j], knots[j + r]);
        raised[l] += (R(1) - w) * functions[l];
        raised[l + 1] = w * functions[l];
      } else {
        const R change = knot_rate<R>(r, knots[j], knots[j + r]) * functions[l];
        raised[l] += -change;
        raised[l + 1] = change;
      }
    }
    functions = std::move(raised);
  }
  return functions;
}

}  // namespace patchproof
