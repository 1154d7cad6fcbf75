// SPDX-License-Identifier: Apache-2.0
// Where a parameter lies between two knots, and how fast it moves there, in the scalar of the control points.
//
//   ratio  (t − a)/(b − a),       rate  k/(b − a)
//
// Exact knots are divided first and converted last, so that a rational parameter costs an enclosure one rounding only.
// Rounded knots, and parameters of another scalar than the knots, are converted first, so that no rounding escapes R's
// bounds.
//
// REQUIRES  a != b.
// ENSURES   (1) in an exact scalar the result is exact;  (2) in an enclosure or a Tracked it accounts for every rounding,
//           whatever the scalar of the knots;  (3) the ratio is 0 at a and 1 at b.
// SCALARS   R: Ring that K and U embed into; Field unless the knots are exact and U is K.
// NEIGHBOURS bspline_basis.h, curve.h, knot_insertion.h are built on it.
#pragma once

#include <concepts>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"

namespace patchproof {

// (t − a)/(b − a).
template <Ring R, class U, OrderedField K>
R knot_ratio(const U& t, const K& a, const K& b) {
  PATCHPROOF_REQUIRES(a != b, "knot_ratio: the two knots coincide");
  if constexpr (std::same_as<U, K> && scalar_traits<K>::is_exact) {
    return embed<R>(K((t - a) / (b - a)));
  } else {
    const R begin = embed<R>(a);
    return (embed<R>(t) - begin) / (embed<R>(b) - begin);
  }
}

// k/(b − a): with k the degree, the factor between differences of control points and derivatives.
template <Ring R, OrderedField K>
R knot_rate(int k, const K& a, const K& b) {
  PATCHPROOF_REQUIRES(a != b, "knot_rate: the two knots coincide");
  if constexpr (scalar_traits<K>::is_exact)
    return embed<R>(K(K(k) / (b - a)));
  else
    return R(k) / (embed<R>(b) - embed<R>(a));
}

}  // namespace patchproof
