// SPDX-License-Identifier: Apache-2.0
// Repair of curve meshes in rounded numbers, on request: what analyse and fill_faces ask for exactly, and rounding has missed.
//
//   edge ends          moved onto their vertex, or onto the point of the edge that carries their T-node, the next point with them
//   tangents           of all edges that end at a vertex: projected into one plane, by  t − (t·n / n·n) n;  at a T-node with two
//                      edges and more: into a plane that the carrying edge's tangent lies in
//   knots              that stand three times: the point there moved to (1 − s) P_- + s P_+, homogeneous, s = h_-/(h_- + h_+)
//   control vectors    d_R := (d_L·d_R / d_L·d_L) d_L; at a T-node where edges end, both along these edges
//
// Only what is within an angle of its aim is moved there: tangents of the plane, a pair of being opposite, an edge at a knot of
// going on straight. The rest stays, and is listed: such vertices are corners or creases, their edges sharp. Ends are moved
// however far: look at `largest`.
//
// ENSURES   (1) every edge end lies on its node, and all that is not listed in vertices, t_nodes, knots and vectors fulfils its
//           condition exactly;  (2) repairing twice is repairing once: the second time nothing moves;  (3) moves: every control point,
//           weight and control vector that changed, and nothing else did; largest_square: of their lengths (weights aside), exact;
//           largest ≥ its root, within two units in the last place;  (4) what fulfils its condition does not move;  (5) a mesh
//           with smooth edges, each number rounded to a double, has the same kinds of edges after repair.
// REQUIRES  0 ≤ largest_sine < 1.
// ERRORS    as analyse, for edges that cannot be read: bad_degree, wrong_count, decreasing_knots, bad_multiplicity, bad_weight,
//           bad_reference, bad_t_node. ends_apart: edges that end on one another in a ring, so that none can be moved first.
// COST      linear in the mesh.
// SOURCE    our own.
// TEST      tests/mesh/repair_mesh_test.cpp checks (1)–(5).
#pragma once

#include <vector>

#include "patchproof/mesh/curve_mesh.h"

namespace patchproof {

struct RepairOptions {
  Rational largest_sine{1, 1000};  // of the angles between what is and what should be
};

struct RepairMove {
  enum class Part { point, weight, left_vector, right_vector } part = Part::point;
  int edge = 0;
  int index = 0;        // of the control point of the edge, or in mesh.control_vectors
  Vec<Rational, 3> by;  // new − old; of a weight its first component
};

struct EdgeKnot {
  int edge = 0;
  Rational parameter;
};

struct RepairedMesh {
  CurveMesh mesh;
  std::vector<RepairMove> moves;
  Rational largest_square;
  double largest = 0;
  // What is beyond the angle, and stayed.
  std::vector<int> vertices, t_nodes, vectors;
  std::vector<EdgeKnot> knots;
};

Result<RepairedMesh> repair_mesh(const CurveMesh& mesh, const RepairOptions& options = {});

}  // namespace patchproof
