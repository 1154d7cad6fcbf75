// SPDX-License-Identifier: Apache-2.0
// Certify: for a join of two patches, the exact classes C0, C1, C2, G1 and certified bounds of gap and normal angle.
//
//   Certificate c = certify_join(a, b, join);
//   c.g1.verdict                    // proven, refuted (with a witness) or undecided (with a reason)
//   c.gap.lower, c.gap.upper        // the largest distance of paired points over the whole edge lies between them
//   c.angle.lower, c.angle.upper    // likewise the largest angle between the normals, in degrees [0, 180]
//
// The ladder (filter.h): interval arithmetic may refute equality and bound deviations; exact integers (or Q(√d)) decide.
//
// REQUIRES  the denominators of both patches have no zero on their domains (patch/denominator.h certifies it).
// ENSURES   (1) proven and refuted are theorems about the control points as given;  (2) lower ≤ sup ≤ upper, lower attained
//           at `at`;  (3) an exact zero is reported as [0, 0];  (4) the verdicts do not change under translation, rational
//           rotation, scaling, swapping or reversing sides, degree elevation, knot insertion;  (5) without C0, the other
//           classes are refuted and the deviations speak;  (6) the result does not depend on the number of threads.
// SCALARS   T: Rational, Quadratic.
// COST      microseconds to a millisecond per bicubic join; request.seconds_per_join bounds the search for tight bounds.
#pragma once

#include <functional>
#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/join/join.h"

namespace patchproof {

template <ExactField T>
Certificate certify_join(const BsplinePatch<T, 4>& a, const BsplinePatch<T, 4>& b, const Join<T>& join,
                         const Request& request = {});

// All joins of a set of patches, in the order of `joins`, on `jobs` threads (0: one per processor).
// progress(done) is called now and then from any thread, when given.
template <ExactField T>
std::vector<Certificate> certify_joins(const std::vector<const BsplinePatch<T, 4>*>& patches,
                                       const std::vector<Join<T>>& joins, const Request& request = {}, int jobs = 0,
                                       const std::function<void(std::size_t)>& progress = {});

}  // namespace patchproof
