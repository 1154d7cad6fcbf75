// SPDX-License-Identifier: Apache-2.0
// Constrained Delaunay triangulations of points in the plane: of their convex hull, or of what lies inside loops of segments.
//
// Only in the target patchproof::delaunay, which is made of a GPL part of CGAL; nothing else needs it.
//
// ENSURES   (1) every decision is exact for the given doubles;  (2) triangles run against the clock and hold every point;
//               without segments, n points of which k lie on the border of the hull, collinear ones included, give 2n − 2 − k
//               triangles, and no point lies inside the circle through the corners of one;
//           (3) with segments: every segment is a side of triangles, and a triangle is listed when a path from it to the
//               outside crosses an odd number of segments (a segment that is given twice counts twice);
//           (4) points on a straight line, or none, give no triangles.
// ERRORS    bad_number: a point that is not finite;  bad_reference: a segment's end that is no point;  usage: two equal points,
//           segments that cross, or a point inside a segment (in `values` the segments' or points' numbers).
// COST      O(n log n) on points as they come from faces.
// TEST      tests/mesh/delaunay_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/vec.h"

namespace patchproof {

Result<std::vector<std::array<int, 3>>> constrained_delaunay(const std::vector<Vec<double, 2>>& points,
                                                             const std::vector<std::array<int, 2>>& segments);

}  // namespace patchproof
