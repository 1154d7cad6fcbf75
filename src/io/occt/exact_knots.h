// SPDX-License-Identifier: Apache-2.0
// Numbers and knots of Open CASCADE taken exactly.
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/scalar/rational.h"
#include "patchproof/spline/knot_vector.h"

namespace patchproof::occt {

inline std::optional<Rational> exact(double x) {
  if (!std::isfinite(x)) return std::nullopt;
  return from_double(x);
}

template <class Knots, class Multiplicities>
Result<KnotVector<Rational>> knots_of(int degree, const Knots& knots, const Multiplicities& multiplicities) {
  std::vector<Rational> all;
  for (int i = knots.Lower(); i <= knots.Upper(); ++i) {
    const auto t = exact(knots(i));
    if (!t) return Error{ErrorCode::bad_number, "", "a knot is not finite", ""};
    all.insert(all.end(), multiplicities(i), *t);
  }
  return KnotVector<Rational>::make(degree, std::move(all));
}

}  // namespace patchproof::occt
