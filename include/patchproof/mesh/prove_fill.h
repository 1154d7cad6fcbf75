// SPDX-License-Identifier: Apache-2.0
// The proofs of a filled curve mesh: every edge between two faces, and every patch by itself.
//
//   joins     one for each piece of an edge that one face to its left and one to its right share: whole edges, and at T-nodes the
//             overlaps of their ranges. The patches' edges are paired by the parameter of the mesh edge, and what is certified are
//             the U or V surfaces that carry them (gregory_proof.h: matched).
//   patches   prove_patch
//
// ENSURES   (1) joins: they cover each edge with faces on both sides once;  (2) certificates as certify_join gives them: for a
//           smooth edge C0 and G1 proven;  (3) the result does not depend on the number of threads.
// COST      about 1 ms for each edge.
// TEST      tests/mesh/prove_fill_test.cpp checks (1)–(3).
#pragma once

#include <vector>

#include "patchproof/join/certificate.h"
#include "patchproof/join/gregory_proof.h"
#include "patchproof/join/join.h"
#include "patchproof/mesh/fill_faces.h"

namespace patchproof {

// A join between the patches of two faces. `join` names faces by their numbers, and lines of the surfaces that carry the edges.
struct MeshJoin {
  int edge = 0;
  EdgeName edge_a = EdgeName::u_min, edge_b = EdgeName::u_min;
  Join<Rational> join;
};

// The edge of a patch that side 0, 1, 2 or 3 of its face becomes.
EdgeName edge_of_side(int side);

std::vector<MeshJoin> mesh_joins(const CurveMesh& mesh, const MeshTopology& topology);

struct FillProof {
  std::vector<MeshJoin> joins;
  std::vector<Certificate> certificates;  // of the joins
  std::vector<GregoryProof> patches;
};

// jobs: threads; 0: one per processor.
FillProof prove_fill(const CurveMesh& mesh, const MeshTopology& topology,
                     const std::vector<GregoryPatch<Rational>>& patches, const Request& request = {}, int jobs = 0);

}  // namespace patchproof
