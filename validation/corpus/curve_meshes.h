// SPDX-License-Identifier: Apache-2.0
// Curve meshes to be filled, of any size and exact: the same for a seed on every machine. Every edge between two faces is smooth.
//
//   closed_mesh     a ball: the grid of n × n faces on each side of a cube, drawn to a sphere and disturbed. Vertices of valence 4,
//                   and of valence 3 at the cube's corners; 6 n² faces and more: faces with T-nodes become two or three.
//   two_faces       two faces that share an edge of one to five segments with random knots, C¹ only; its tangents, at the ends the
//                   derivatives into the faces, and pairs of control vectors on and off the knots are random
//   polyhedron_mesh  a ball with the faces of a polyhedron, to be split (mesh/split_faces.h):
//                   icosahedron               20 triangles, five at each vertex
//                   football                  12 pentagons, 20 hexagons, three at each vertex (truncated icosahedron)
//                   rhombicosidodecahedron    20 triangles, 30 quadrilaterals, 12 pentagons, four at each vertex
//
// Edges may have up to three inner knots, unevenly spaced, with multiplicities 1 to 3, and weights from 1 to 3/2. Points lie on a
// dyadic grid; the tangents at a vertex are integer multiples of dyadic numbers in one plane (mesh/tangent_plane.h).
#pragma once

#include <cstdint>

#include "patchproof/mesh/curve_mesh.h"

namespace patchproof::validation {

// Shares in per cent.
struct ClosedMeshOptions {
  int knotted_edges = 30;
  int edges_with_control_vectors = 20;
  int split_faces = 10;  // with T-nodes; a third of them have T-nodes on their T-edge too
  int rational_edges = 0;
  int faces_cut_in_triangles = 0;  // to be split (mesh/split_faces.h)
};

// REQUIRES faces_per_side ≥ 1.
CurveMesh closed_mesh(int faces_per_side, std::uint64_t seed, const ClosedMeshOptions& options = {});

enum class Polyhedron { icosahedron, football, rhombicosidodecahedron };
CurveMesh polyhedron_mesh(Polyhedron polyhedron, std::uint64_t seed, const ClosedMeshOptions& options = {});

CurveMesh two_faces(std::uint64_t seed, bool rational);

}  // namespace patchproof::validation
