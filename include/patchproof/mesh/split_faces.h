// SPDX-License-Identifier: Apache-2.0
// Faces of three, five and more sides, cut into faces of four sides that fill_faces can fill.
//
// A face of n sides becomes n faces about a new vertex, its centre. A spoke runs to it from the middle of each side, a new
// T-node there (or the one that stands there already); face i lies at corner i of the old face:
//
//              side i−1                       sides of face i, from corner i:
//        ───m_{i−1}─────── corner i             corner i to m_i   the first half of side i
//              │              │                 m_i to X          spoke i
//       spoke  │   face i     │ side i          X to m_{i−1}      spoke i − 1, backwards
//       i − 1  │              │                 m_{i−1} to corner i   the second half of side i − 1
//              X ──────────  m_i
//
//   spoke i   the cubic with points P, P + d/3, X + e/3, X:  P = the point of the edge at m_i
//     d       along the field across the edge that a filling of the whole face would have had at m_i: ± a (edge_connection.h)
//             on a smooth edge, the field through the given derivatives on others; towards X where that runs along the edge
//     e       near the projection of P − X into the plane at X, exactly in it; if these are not in the order of the sides,
//             n directions evenly spread in it
//     X       the mean of P_i + d_i/2, about;  the plane at X: across Σ (P_i − X) × (P_{i+1} − X), about
//   lengths   |P − X| · 2/(1 + cos φ) with φ the angle to P − X, at most acos(−1/4): those of the cubic that is nearly an arc of a
//             circle
//
// Choices are rounded to 16 binary digits, never what a proof needs: X lies in the plane of a flat face, d along a, all e in
// one plane, exactly. The tangent planes that the neighbours see do not change, but the vectors across an edge become uneven in
// length, as they do at every T-node: NodeScale::rational evens them out.
//
// ENSURES   (1) faces of four sides, vertices, edges, T-nodes and control vectors stay, and keep their places; new ones
//           follow; a mesh without other faces comes back as it was, so that splitting twice is splitting once;
//           (2) each other face becomes faces of four sides, in its place, as above;  (3) every spoke is smooth, and the kinds of
//           all other edges are as before;  (4) at a centre the spokes' tangents lie in one plane, in the order of the sides,
//           next ones at angles inside (0, π), once round;  (5) at a T-node of a smooth edge d is a multiple > 0 of ± a, so that two
//           spokes from one T-node leave in opposite directions, and along the control vectors that stand there;
//           (6) middles on a circle of a sphere, with d along its meridians and arcs shorter than 100°: X lies on the sphere, up to
//           2^-12 of its radius.
// ERRORS    those of analyse and, for the edges of such faces, of connect_edge; wrong_side_count for two sides;
//           parallel_tangents when no plane can be found at a centre. Later ones (a spoke along its edge) are found by analyse of the
//           result, with the names of its parts: "F.2" for face 2 of F, "F/2" for its spoke 2, "E@1/2" for a T-node.
// COST      linear in the mesh, besides analyse.
// SOURCE    our own, by the condition for vertices of any valence: tangents in one plane, next ones at angles inside (0, π).
// TEST      tests/mesh/split_faces_test.cpp checks (1)–(6).
#pragma once

#include "patchproof/mesh/edge_connection.h"

namespace patchproof {

// options: as for fill_faces; they decide on the directions d.
Result<CurveMesh> split_faces(const CurveMesh& mesh, const FillOptions& options = {});

}  // namespace patchproof
