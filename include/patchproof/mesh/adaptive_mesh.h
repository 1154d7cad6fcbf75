// SPDX-License-Identifier: Apache-2.0
// Patches as triangles with a proved error, closed along their joins.
//
// adaptive  cells are halved, in u, in v or in both, until the bounds of chord_bound.h are below what is asked; a cell that finds
//           vertices of its neighbours on its sides is cut into triangles through all of them, so that nothing hangs
// regular   all Bézier pieces of a patch are cut into the same number of equal cells, as many as the patch needs
//
// Where patches join (edge_match.h) the vertices of either side are vertices of both. A vertex is the point of the first patch at
// its parameters; how far it is from the other patches' points is measured in intervals and added to their error. On a collapsed
// edge all vertices are one, and triangles that have two corners there are left out; their error still counts, and the
// normals of their cells are compared with the triangles that remain of it.
//
// REQUIRES  joins and collapsed edges of just these patches; no torn patch (split_torn).
// ENSURES   (1) every point of a patch is within `chord` of the triangle at its parameters, and every point of a triangle of its
//               patch;  (2) where the patch has a normal, it is within `angle` of the triangle's over the whole cell;
//           (3) chord ≤ request.chord when chord_misses = 0, and the same of the angle;
//           (4) every edge of the mesh has two triangles unless it lies on an edge of a patch that no join reaches
//               (check_watertight proves it);  (5) the triangles of a patch run all against the clock around
//               S_u × S_v or all with it, neighbours alike (orient);
//           (6) the result does not depend on the number of jobs.
// ERRORS    usage: a bound that is no positive number, or more than max_triangles are needed;  bad_number: a vertex is no finite
//           double.
// COST      some 30 µs for each bicubic cell.
// NEIGHBOURS trimmed_mesh.h (faces of CAD parts), tessellate.h (grids without a proof).
// TEST      tests/mesh/adaptive_mesh_test.cpp checks (1)–(6).
#pragma once

#include <vector>

#include "patchproof/error.h"
#include "patchproof/join/edge_match.h"
#include "patchproof/mesh/watertight.h"

namespace patchproof {

enum class CellMethod { adaptive, regular };

template <ExactField T>
Result<CertifiedMesh> adaptive_mesh(const std::vector<const BsplinePatch<T, 4>*>& patches,
                                    const std::vector<Join<T>>& joins, const std::vector<CollapsedEdge>& collapsed,
                                    const MeshRequest& request, CellMethod method = CellMethod::adaptive);

// The parts of a patch between the knot lines across which it may jump (multiplicity above the degree): itself when there are none.
template <ExactField T>
std::vector<BsplinePatch<T, 4>> split_torn(const BsplinePatch<T, 4>& patch);

// ERRORS usage when something is asked that cannot be.
std::optional<Error> check_request(const MeshRequest& request);

}  // namespace patchproof
