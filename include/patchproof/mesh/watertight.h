// SPDX-License-Identifier: Apache-2.0
// Triangles of several faces, the error that is proved of them, and whether they close.
//
// Faces share the vertices of the edges where they meet: one vertex is one triple of doubles. Every edge of the mesh then belongs
// to exactly two triangles, or to one where the model itself has a free edge. Nothing is near enough to be the same: vertices are
// compared as doubles, so that a program which reads the triangles one by one finds the same neighbours.
//
// ENSURES   (1) an edge with one triangle that is not listed as free is a crack;  (2) an edge with more than two triangles branches;
//           (3) oriented: each edge with two triangles is run through once in each direction;
//           (4) the answer depends on the vertices' coordinates only, not on how often one is listed;
//           (5) orient turns no single triangle, and all of a face alike; an orientable mesh comes out oriented, closed parts
//               with their outside to the right side.
// COST      sorts the edges.
// NEIGHBOURS chord_bound.h, adaptive_mesh.h, trimmed_mesh.h.
// TEST      tests/mesh/watertight_test.cpp checks (1)–(5).
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "patchproof/vec.h"

namespace patchproof {

// What is asked of a mesh.
struct MeshRequest {
  double chord = 0.01;  // model units, > 0
  double angle = 180;   // degrees; 180: nothing is asked
  std::size_t max_triangles = std::size_t{1} << 24;
  int jobs = 0;  // threads; 0: one for each processor
};

struct CertifiedMesh {
  std::vector<Vec<double, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> faces;                // of each triangle
  std::vector<std::array<int, 2>> free;  // edges of triangles that lie on a free edge of the model
  double chord = 0;           // proved: every point of the surfaces is as near to the triangles, and they to it
  double angle = 0;           // proved, in degrees; 180: not proved
  std::size_t collapsed = 0;  // triangles that are none, for two corners are one vertex; left out
  double gap = 0;             // the largest distance between a vertex and its place on a face; part of `chord`
  std::size_t chord_misses = 0, angle_misses = 0;  // triangles for which what was asked is not proved
  std::vector<std::string> notes;                  // where, and what else is to be known
};

struct Watertight {
  std::size_t edges = 0, free = 0, cracks = 0, branching = 0;
  bool oriented = true;
  bool is_watertight() const { return cracks == 0 && branching == 0; }
  bool is_closed() const { return is_watertight() && free == 0; }
};

Watertight check_watertight(const CertifiedMesh& mesh);

// Turns whole faces, so that neighbours run through their common edge in opposite directions where that can be, and then what
// hangs together so that the volume below its triangles is not negative.
void orient(CertifiedMesh& mesh);

}  // namespace patchproof
