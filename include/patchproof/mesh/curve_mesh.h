// SPDX-License-Identifier: Apache-2.0
// Curve meshes: a network of cubic B-spline edges with the faces that lie between them, to be filled with patches
// (fill_faces.h).
//
//   vertex          a point where edges end
//   edge            a clamped cubic B-spline over [0, 1], polynomial or rational, C¹ in homogeneous coordinates
//   T-node          a place inside an edge where other edges end, so that one side of the edge has more faces than the other
//   control vectors derivatives across an edge that the surface should have at a place inside it, away from the edge, to its
//                   left and right as seen from outside in the direction of growing parameter
//   face            its sides in counter-clockwise order seen from outside: ranges of edges, run backwards when from > to
//   use             one side of a face, as seen from its edge: the face lies to the left when the side runs forwards
//
// An edge with faces on one side only is a boundary. Else it is smooth when at every node on it all faces there have one
// tangent plane and lie on their sides of the edge, exactly; otherwise it is sharp.
//
// ENSURES   (1) analyse: each part of the mesh is looked at, in the order of the mesh: edges, control vectors, T-nodes, ends,
//               faces, covers, corners; the first thing wrong is the error;
//           (2) uses: one for each side of a face; those on one side of an edge are sorted and tile [0, 1];
//           (3) begin_derivative, end_derivative: the derivative along the neighbouring side of the face, into the face, at
//               lower and upper parameter of the use, by the parameters of the neighbour's patch;
//           (4) kinds: as above.
// ERRORS    bad_degree, wrong_count, decreasing_knots, bad_multiplicity, bad_weight, not_c1, vanishing_tangent (edges);
//           bad_reference, ends_apart, bad_t_node; control_vector_outside, control_vector_twice; wrong_side_count, bad_side,
//           side_ends_nowhere, open_loop, uneven_cover, unused_edge, parallel_tangents. `where` names the edge, node or face
//           by its id, `values` holds the numbers.
// COST      O(n log n) in the size of the mesh.
// SOURCE    K. Konno, H. Chiyokura, G1 connection around complicated curve meshes by using C1 NURBS boundary Gregory patches,
//           IPSJ 1998, with the corrections of docs/errata.md.
// TEST      tests/mesh/curve_mesh_test.cpp checks (1)–(4).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/piecewise.h"
#include "patchproof/vec.h"

namespace patchproof {

struct MeshVertex {
  std::string id;
  Vec<Rational, 3> point;
};

// A vertex or a T-node, by its place in its list.
struct MeshNode {
  enum class Kind { vertex, t_node } kind = Kind::vertex;
  int index = 0;
  friend bool operator==(const MeshNode&, const MeshNode&) = default;
};

struct MeshEdge {
  std::string id;
  int degree = 3;
  std::vector<Rational> knots;
  std::vector<Vec<Rational, 3>> points;
  std::vector<Rational> weights;  // empty: all 1
  MeshNode begin, end;
};

struct TNode {
  std::string id;
  int edge = 0;
  Rational parameter;
};

struct ControlVectors {
  int edge = 0;
  Rational parameter;
  std::optional<Vec<Rational, 3>> left, right;
};

struct FaceSide {
  int edge = 0;
  Rational from, to;
};

struct MeshFace {
  std::string id;
  std::vector<FaceSide> sides;
};

struct CurveMesh {
  std::vector<MeshVertex> vertices;
  std::vector<MeshEdge> edges;
  std::vector<TNode> t_nodes;
  std::vector<ControlVectors> control_vectors;
  std::vector<MeshFace> faces;
};

enum class EdgeKind { boundary, smooth, sharp };
const char* to_string(EdgeKind kind);

struct EdgeUse {
  int face = 0, side = 0, edge = 0;
  Rational from, to;  // as the side runs
  Vec<Rational, 3> begin_derivative, end_derivative;

  bool is_left() const { return from < to; }
  const Rational& begin() const { return is_left() ? from : to; }
  const Rational& end() const { return is_left() ? to : from; }
};

// An edge that ends at a T-node.
struct EdgeEnd {
  int edge = 0;
  bool at_end = false;
};

struct MeshTopology {
  std::vector<Piecewise<Rational, 4>> curves;  // of the edges, homogeneous
  std::vector<EdgeUse> uses;
  std::vector<std::vector<int>> uses_of_face;     // by side
  std::vector<std::vector<int>> left, right;      // the uses of each edge, in order along it
  std::vector<std::vector<int>> t_nodes_on_edge;  // in order along it
  std::vector<std::vector<int>> vectors_on_edge;  // the control vectors, in order along it
  std::vector<std::vector<EdgeEnd>> edges_at_t_node;
  std::vector<EdgeKind> kinds;
};

// any: as split_faces.h takes them; a face that is filled has four sides.
enum class FaceSides { four, any };

// REQUIRES nothing of the mesh.
Result<MeshTopology> analyse(const CurveMesh& mesh, FaceSides sides = FaceSides::four);

// The affine point and derivative of an edge; at a knot from the right, at 1 from the left (the edge is C¹).
Vec<Rational, 3> edge_point(const Piecewise<Rational, 4>& curve, const Rational& t);
Vec<Rational, 3> edge_tangent(const Piecewise<Rational, 4>& curve, const Rational& t);

// Out of the surface, on the use's side of its edge: ± (tangent × derivative into the face).
Vec<Rational, 3> outward_normal(const MeshTopology& topology, const EdgeUse& use, const Rational& t,
                                const Vec<Rational, 3>& into_face);

// n_1 = c n_2 with c > 0; neither zero.
bool same_direction(const Vec<Rational, 3>& a, const Vec<Rational, 3>& b);
bool is_parallel(const Vec<Rational, 3>& a, const Vec<Rational, 3>& b);

}  // namespace patchproof
