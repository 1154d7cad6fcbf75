// SPDX-License-Identifier: Apache-2.0
// The greatest primes below 2^28 and 2^47, as the distance to that power. Enough for every join: decide_lanes.h.
#pragma once

namespace patchproof::kernels {

constexpr unsigned kBelow28[16] = {57, 89, 95, 119, 125, 143, 165, 183, 213, 273, 285, 299, 309, 323, 327, 335};
constexpr unsigned kBelow47[10] = {115, 127, 147, 279, 297, 339, 435, 541, 619, 649};

}  // namespace patchproof::kernels
