// SPDX-License-Identifier: Apache-2.0
// Proofs that the normal of a Gregory patch vanishes nowhere: the square is cut into boxes until on each of them one direction
// has a positive product with all enclosed normals.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/scalar/interval.h"

namespace patchproof {

struct RegularityResult {
  bool proven = false;
  int boxes = 0;
  std::array<Rational, 2> stopped;  // where it was given up
};

// What is called for every box, if anything, with the enclosures of S_u and S_v there: tests hold them against exact values.
using BoxInspector =
    std::function<void(const ParameterBox<Rational>& box, const Vec<Interval, 3>& du, const Vec<Interval, 3>& dv)>;

// REQUIRES a RoundingGuard alive; polynomial: every weight is 1, rational: every weight is positive, the corners agree.
RegularityResult prove_regular_polynomial(const GregoryPatch<Rational>& patch, int max_boxes,
                                          const BoxInspector& inspect = {});
RegularityResult prove_regular_rational(const GregoryPatch<Rational>& patch, int max_boxes,
                                        const BoxInspector& inspect = {});

namespace detail {

// How often a box is halved at most: then it is about as small as the rounding errors.
constexpr int kHalvings = 80;

using IntervalVector = Vec<Interval, 3>;

inline Interval hull(const Interval& a, const Interval& b) {
  return Interval(std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup()));
}

template <std::size_t N>
Vec<Interval, N> hull_of(const std::vector<Vec<Interval, N>>& points) {
  Vec<Interval, N> out = points[0];
  for (const Vec<Interval, N>& p : points)
    for (std::size_t c = 0; c < N; ++c) out[c] = hull(out[c], p[c]);
  return out;
}

// Have all these normals a positive product with the one in their middle?
inline bool is_one_sided(const IntervalVector& normal) {
  Interval along(0);
  for (std::size_t c = 0; c < 3; ++c) {
    const double middle = normal[c].inf() / 2 + normal[c].sup() / 2;
    if (!std::isfinite(middle)) return false;
    along += Interval(middle) * normal[c];
  }
  return along.inf() > 0;
}

// A distance in [0, 1].
inline Interval unit_distance(const Interval& x) {
  return Interval(std::max(0.0, x.inf()), std::min(1.0, std::max(0.0, x.sup())));
}

}  // namespace detail
}  // namespace patchproof
