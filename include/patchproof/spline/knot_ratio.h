// SPDX-License-Identifier: Apache-2.0
// Where a parameter lies between two knots, in the scalar of the control points:  (t − a)/(b − a).
//
// REQUIRES  a != b.
// ENSURES   (1) in an exact scalar the result is exact;  (2) in an enclosure or a Tracked it accounts for every rounding,
//           whatever the scalar of the knots: exact knots are divided first and converted last, rounded ones are converted
//           first and divided in R;  (3) 0 at a and 1 at b.
// SCALARS   R: Ring that K embeds into; Field when K is not exact.
// NEIGHBOURS bspline_basis.h (the same with knots given by their index).
#pragma once

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"

namespace patchproof {

template <Ring R, OrderedField K>
R knot_ratio(const K& t, const K& a, const K& b) {
  PATCHPROOF_REQUIRES(a != b, "knot_ratio: the two knots coincide");
  if constexpr (scalar_traits<K>::is_exact) {
    return embed<R>(K((t - a) / (b - a)));
  } else {
    const R begin = embed<R>(a);
    return (embed<R>(t) - begin) / (embed<R>(b) - begin);
  }
}

}  // namespace patchproof
