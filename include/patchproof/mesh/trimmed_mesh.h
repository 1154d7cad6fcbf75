// SPDX-License-Identifier: Apache-2.0
// Faces with trimming curves as triangles with a proved error, closed along their edges.
//
// Every edge is sampled once. Each face takes the points of its own parameter curve at the same parameters of the edge, triangulates
// the polygon of them (with further points where it needs them), and the vertices of all faces at one sample are one vertex:
// the point of the first face's surface at the first face's parameter curve. How far it is from the point of another face is
// measured in intervals and added to that face's error.
// Between two samples the parameter curve leaves the polygon by ε_u, ε_v at most (its second derivatives, ⅛ h² sup |c″|); the part of
// the face, or of the mesh, that lies between them is within sup |S_u| ε_u + sup |S_v| ε_v of what it belongs to, and that is added
// to the error of the triangle at this side. What the two regions differ by lies between the curves and their chords, for that is
// all that is swept when one is moved into the other.
// Where the parameter curves of a face leave a gap between points that are one point in space (a pole), the straight line
// between them closes the loop, and all of its points are that vertex.
//
// REQUIRES  a face lies to the left of its parameter curve when `forward`, else to the right; parameter curves of one edge over one
//           range; a triangulator like constrained_delaunay (delaunay.h).
// ENSURES   (1) every point of a face is within `chord` of the triangles, and every point of these of the face;  (2) where the
//               surface has a normal, it is within `angle` of its triangle's (triangles that collapse in a pole have none, and
//               are counted);  (3) chord ≤ request.chord when chord_misses = 0, and the same of the angle;
//           (4) every edge of the mesh has two triangles unless it lies on an edge with one use (check_watertight proves it);
//           (5) the result does not depend on the number of jobs;  (6) faces whose loops do not close or cross are left out, and said
//               in `notes`; then chord_misses > 0.
// ERRORS    usage: as adaptive_mesh;  wrong_count: no face;  bad_number: a vertex is no finite double.
// COST      some 20 µs for each triangle and round; about log₂ of the number of triangles in a face rounds.
// NEIGHBOURS adaptive_mesh.h (patches without trimming), delaunay.h.
// TEST      tests/mesh/trimmed_mesh_test.cpp checks (1)–(6).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/mesh/watertight.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

struct TrimmedFace {
  std::string label;
  const BsplinePatch<Rational, 4>* surface;
};

struct TrimmedUse {
  int face;
  bool forward;
  const BsplineCurve<Rational, 3>* parameters;  // homogeneous (w·u, w·v, w)
};

struct TrimmedEdge {
  std::string label;
  std::vector<TrimmedUse> uses;
  double tolerance = 0;  // ends of edges nearer than this are one vertex where a loop has a gap
};

using Triangulator = std::function<Result<std::vector<std::array<int, 3>>>(const std::vector<Vec<double, 2>>&,
                                                                           const std::vector<std::array<int, 2>>&)>;

Result<CertifiedMesh> trimmed_mesh(const std::vector<TrimmedFace>& faces, const std::vector<TrimmedEdge>& edges,
                                   const MeshRequest& request, const Triangulator& triangulator);

}  // namespace patchproof
