// SPDX-License-Identifier: Apache-2.0
// Filling a curve mesh: one NURBS boundary Gregory patch for each face, G¹ across every smooth edge and C¹ inside.
//
//   D     the homogeneous cross-boundary derivative of each use of an edge, by the edge's parameter:
//           smooth edge        D = ± k (a, 0) + h C^h′                    (edge_connection.h)
//           other edges        D = (w b, 0), b through the given derivatives
//   rows  of the U surface of a face with boundary curves C_0(u), C_1(v), C_2(u), C_3(v) in growing parameters:
//           C_3,  C_3 + D_3/3,  C_1 + D_1/3,  C_1          and of its V surface:  C_0, C_0 + D_0/3, C_2 + D_2/3, C_2
//         raised to one degree and refined to common knots; to an inner row m times its boundary row is added when it has a
//         weight that is not positive: this does not change the derivative (m as λ in gregory_patch.h)
//   side 0 of a face becomes v = 0, side 1 u = 1, side 2 v = 1, side 3 u = 0
//
// ENSURES   (1) the patch's edges are the mesh's edges, and its derivatives across them D;  (2) across each smooth edge the
//           patches have one tangent plane and lie on either side of it;  (3) FillMethod::c1: every row is C¹, so that every
//           patch is C¹ on the closed square;  (4) R = double: the knots are rounded, the control points of U and V within the
//           bound that Tracked gives; R = Interval: encloses;  (5) the result does not depend on the number of threads.
// ERRORS    those of connect_edge and of GregoryPatch::make; not those of analyse, which comes before.
// SCALARS   R: Rational, double, Interval, Tracked. Knots, nodes, k and h are always exact.
// COST      linear in the faces; about 1 ms for each in Rational.
// SOURCE    as curve_mesh.h.
// TEST      tests/mesh/fill_faces_test.cpp checks (1)–(5).
#pragma once

#include <optional>
#include <vector>

#include "patchproof/mesh/edge_connection.h"
#include "patchproof/patch/gregory_patch.h"

namespace patchproof {

template <Field R>
struct FilledUse {
  std::optional<UseConnection> connection;  // of a smooth edge
  Piecewise<R, 4, Rational> derivative;     // D over the use's range
};

template <Field R>
struct FilledMesh {
  std::vector<std::optional<EdgeConnection>> connections;  // of the smooth edges
  std::vector<FilledUse<R>> uses;
  std::vector<GregoryPatch<R>> patches;  // one for each face
};

// jobs: threads; 0: one per processor. REQUIRES the topology of this mesh.
template <Field R>
Result<FilledMesh<R>> fill_faces(const CurveMesh& mesh, const MeshTopology& topology, const FillOptions& options = {},
                                 int jobs = 0);

}  // namespace patchproof
