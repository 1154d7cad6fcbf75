// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "patchproof/join/trimmed_join.h"

namespace patchproof {

// A lower bound of the distance of a point from every point of an edge of a trimmed face, whatever is paired with what: above
// `enough`, or no better than what so many halvings of the edge find. Surfaces go on beyond their domains as in trimmed_join.h.
// REQUIRES (debug) a RoundingGuard alive.
double distance_from_edge(const Vec<Rational, 3>& point, const TrimmedSide& side, double enough, int parts = 400);

}  // namespace patchproof
