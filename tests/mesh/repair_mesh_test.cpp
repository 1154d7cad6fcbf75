// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/repair_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "patchproof/contract.h"
#include "patchproof/mesh/split_faces.h"
#include "support/filled_meshes.h"
#include "support/scalars.h"
#include "validation/corpus/curve_meshes.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;
using Part = RepairMove::Part;

// Every vector of the mesh through a linear map, every point through it as well, and every number through `number`.
CurveMesh mapped(CurveMesh mesh, const std::function<Vector(const Vector&)>& map,
                 const std::function<Rational(const Rational&)>& number) {
  const auto apply = [&](Vector& v) {
    v = map(v);
    for (std::size_t c = 0; c < 3; ++c) v[c] = number(v[c]);
  };
  for (MeshVertex& v : mesh.vertices) apply(v.point);
  for (MeshEdge& e : mesh.edges) {
    for (Vector& p : e.points) apply(p);
    for (Rational& t : e.knots) t = number(t);
    for (Rational& w : e.weights) w = number(w);
  }
  for (TNode& t : mesh.t_nodes) t.parameter = number(t.parameter);
  for (ControlVectors& c : mesh.control_vectors) {
    c.parameter = number(c.parameter);
    if (c.left) apply(*c.left);
    if (c.right) apply(*c.right);
  }
  for (MeshFace& f : mesh.faces)
    for (FaceSide& s : f.sides) {
      s.from = number(s.from);
      s.to = number(s.to);
    }
  return mesh;
}

// Sheared so that nothing lies on a grid, then every number rounded to a double (knots and parameters too).
CurveMesh in_doubles(const CurveMesh& mesh) {
  const Rational a(10, 7), b(3, 11), c(1, 13);
  return mapped(
      mesh,
      [&](const Vector& v) {
        return Vector{{a * v[0] + b * v[1], a * v[1] - c * v[2], v[2] + b * v[0] + c * v[1]}};
      },
      [](const Rational& x) { return from_double(nearest_double(x)); });
}

validation::ClosedMeshOptions everything() { return {60, 40, 30, 30, 0}; }

// Laws 1 to 3.
RepairedMesh expect_laws(const CurveMesh& mesh, const RepairOptions& options = {}) {
  const Result<RepairedMesh> repaired = repair_mesh(mesh, options);
  if (!repaired) return ADD_FAILURE() << repaired.error().text(), RepairedMesh{};
  // Exactly the moves lead from one mesh to the other.
  CurveMesh moved = mesh;
  Rational largest_square;
  for (const RepairMove& move : repaired->moves) {
    EXPECT_NE(move.by, Vector{});
    switch (move.part) {
      case Part::point: moved.edges[move.edge].points[move.index] += move.by; break;
      case Part::weight: moved.edges[move.edge].weights[move.index] += move.by[0]; continue;
      case Part::left_vector: *moved.control_vectors[move.index].left += move.by; break;
      case Part::right_vector: *moved.control_vectors[move.index].right += move.by; break;
    }
    largest_square = std::max(largest_square, dot(move.by, move.by));
  }
  test::expect_same(moved, repaired->mesh);
  EXPECT_EQ(repaired->largest_square, largest_square);
  const double largest = repaired->largest;
  EXPECT_GE(from_double(largest) * from_double(largest), largest_square);
  if (largest > 0) {
    const Rational below = from_double(largest * (1 - 0x1p-51));
    EXPECT_LT(below * below, largest_square);
  }
  const Result<RepairedMesh> twice = repair_mesh(repaired->mesh, options);
  if (!twice) return ADD_FAILURE() << twice.error().text(), *repaired;
  EXPECT_TRUE(twice->moves.empty());
  EXPECT_EQ(twice->largest, 0);
  EXPECT_EQ(twice->vertices, repaired->vertices);
  EXPECT_EQ(twice->t_nodes, repaired->t_nodes);
  EXPECT_EQ(twice->vectors, repaired->vectors);
  EXPECT_EQ(twice->knots.size(), repaired->knots.size());
  return *repaired;
}

TEST(RepairMeshTest, Laws1To5_ClosedMeshesRoundedToDoublesBecomeSmoothAgain) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CurveMesh rounded = in_doubles(validation::closed_mesh(2, seed, everything()));
    const Result<MeshTopology> before = analyse(rounded);
    EXPECT_TRUE(!before || test::count(*before, EdgeKind::sharp) > 0);
    const RepairedMesh repaired = expect_laws(rounded);
    EXPECT_GT(repaired.moves.size(), 50u);
    EXPECT_LT(repaired.largest, 1e-14);
    EXPECT_TRUE(repaired.vertices.empty() && repaired.t_nodes.empty() && repaired.vectors.empty() &&
                repaired.knots.empty());
    const Result<MeshTopology> after = analyse(repaired.mesh);
    ASSERT_TRUE(after) << after.error().text();
    EXPECT_EQ(test::count(*after, EdgeKind::smooth), repaired.mesh.edges.size());
  }
}

TEST(RepairMeshTest, Law5_TheRepairedMeshIsFilledAndProved) {
  test::expect_proved(expect_laws(in_doubles(validation::closed_mesh(1, 3, everything()))).mesh);
}

TEST(RepairMeshTest, Law5_TNodesWithEdgesOnBothSides) {
  for (const auto polyhedron : {validation::Polyhedron::icosahedron, validation::Polyhedron::football}) {
    const CurveMesh mesh = *split_faces(validation::polyhedron_mesh(polyhedron, 8));
    const RepairedMesh repaired = expect_laws(in_doubles(mesh));
    EXPECT_LT(repaired.largest, 1e-14);
    const Result<MeshTopology> topology = analyse(repaired.mesh);
    ASSERT_TRUE(topology) << topology.error().text();
    EXPECT_EQ(test::count(*topology, EdgeKind::smooth), mesh.edges.size());
  }
}

TEST(RepairMeshTest, Law5_ControlVectorsAtATNodeFollowItsEdges) {
  for (const bool both_sides : {false, true}) {
    CurveMesh mesh = both_sides ? *split_faces(validation::polyhedron_mesh(validation::Polyhedron::icosahedron, 3))
                                : validation::closed_mesh(2, 1);
    const MeshTopology exact = *analyse(mesh);
    ASSERT_FALSE(mesh.t_nodes.empty());
    for (std::size_t t = 0; t < mesh.t_nodes.size(); ++t) {
      const int e = mesh.t_nodes[t].edge;
      const EdgeConnection connection = *connect_edge(mesh, exact, e);
      const Vector a = value(connection.basis, mesh.t_nodes[t].parameter);
      std::erase_if(mesh.control_vectors,
                    [&](const ControlVectors& c) { return c.edge == e && c.parameter == mesh.t_nodes[t].parameter; });
      mesh.control_vectors.push_back({e, mesh.t_nodes[t].parameter, Rational(1, 3) * a, Rational(-1, 2) * a});
    }
    ASSERT_TRUE(fill_faces<Rational>(mesh, *analyse(mesh)));
    const RepairedMesh repaired = expect_laws(in_doubles(mesh));
    EXPECT_TRUE(repaired.vectors.empty());
    const Result<MeshTopology> topology = analyse(repaired.mesh);
    ASSERT_TRUE(topology) << topology.error().text();
    const auto filled = fill_faces<Rational>(repaired.mesh, *topology);
    EXPECT_TRUE(filled) << filled.error().text();
  }
}

TEST(RepairMeshTest, Law4_ExactMeshesDoNotMove) {
  for (const std::uint64_t seed : {1, 2})
    for (const CurveMesh& mesh : {validation::closed_mesh(2, seed, everything()), validation::two_faces(seed, true),
                                  *split_faces(validation::polyhedron_mesh(validation::Polyhedron::football, seed))}) {
      const RepairedMesh repaired = expect_laws(mesh);
      EXPECT_TRUE(repaired.moves.empty());
      EXPECT_EQ(repaired.largest_square, 0);
    }
}

TEST(RepairMeshTest, WhatIsBeyondTheAngleStaysAndIsListed) {
  CurveMesh mesh = validation::closed_mesh(2, 1, {0, 0, 0, 0, 0});
  // A corner at the node where edge 0 begins, about 1/20 of the tangent's length out of the plane.
  const int corner = mesh.edges[0].begin.index;
  const Vector tangent = mesh.edges[0].points[1] - mesh.edges[0].points[0];
  mesh.edges[0].points[1] += Rational(1, 20) * mesh.vertices[corner].point;
  // A kink of an edge, and a pair of control vectors that is not opposite.
  MeshEdge& bent = mesh.edges[7];
  const Vector p = bent.points[0], q = bent.points[3], third = Rational(1, 3) * (bent.points[1] - p);
  bent.knots = {0, 0, 0, 0, {1, 2}, {1, 2}, {1, 2}, 1, 1, 1, 1};
  const Vector joint = Rational(1, 2) * (p + q) + third;
  bent.points = {
      p, bent.points[1], joint - third, joint, joint + Rational(1, 2) * third + Rational(1, 60) * p, bent.points[2], q};
  const Vector left{{1, 2, 3}};
  mesh.control_vectors.push_back({3, Rational(1, 2), left, Vector{{-1, -2, -2}}});
  mesh.control_vectors.push_back({4, Rational(1, 2), left, left});
  const RepairedMesh repaired = expect_laws(mesh);
  EXPECT_EQ(repaired.vertices, std::vector<int>{corner});
  EXPECT_EQ(repaired.vectors, (std::vector<int>{0, 1}));
  ASSERT_EQ(repaired.knots.size(), 1u);
  EXPECT_EQ(repaired.knots[0].edge, 7);
  EXPECT_EQ(repaired.knots[0].parameter, Rational(1, 2));
  EXPECT_TRUE(repaired.moves.empty());

  // With a wider angle they move, by about what is wrong; vectors that point the same way never do.
  const RepairedMesh wide = expect_laws(mesh, {Rational(9, 10)});
  EXPECT_TRUE(wide.vertices.empty() && wide.knots.empty());
  EXPECT_EQ(wide.vectors, std::vector<int>{1});
  EXPECT_GT(wide.largest, 0.05);
  EXPECT_LT(wide.largest, 1);
  EXPECT_TRUE(is_parallel(*wide.mesh.control_vectors[0].left, *wide.mesh.control_vectors[0].right));
  EXPECT_EQ(*wide.mesh.control_vectors[0].left, left);
  EXPECT_NE(tangent, Vector{});
}

TEST(RepairMeshTest, Law1_EndsAreMovedWithTheirTangents) {
  CurveMesh mesh = validation::two_faces(2, false);
  const MeshEdge before = mesh.edges[3];
  const Vector by{{Rational(1, 100), 0, Rational(-1, 50)}};
  mesh.edges[3].points[0] += by;
  const RepairedMesh repaired = expect_laws(mesh);
  ASSERT_EQ(repaired.moves.size(), 2u);
  EXPECT_EQ(repaired.moves[0].by, -by);
  EXPECT_EQ(repaired.moves[1].by, -by);
  EXPECT_EQ(repaired.largest_square, dot(by, by));
  EXPECT_EQ(repaired.mesh.edges[3].points[1] - repaired.mesh.edges[3].points[0],
            before.points[1] - before.points[0] - by);
}

TEST(RepairMeshTest, Law1_KnotsOfRationalEdgesBecomeSmoothInHomogeneousCoordinates) {
  CurveMesh mesh;
  for (std::uint64_t seed = 1; mesh.edges.empty() || mesh.edges[0].knots.size() < 11; ++seed)
    mesh = validation::two_faces(seed, true);
  mesh.edges[0].weights[3] *= Rational(10001, 10000);
  mesh.edges[0].points[3][0] += Rational(1, 10000);
  EXPECT_EQ(analyse(mesh).error().code, ErrorCode::not_c1);
  const RepairedMesh repaired = expect_laws(mesh);
  ASSERT_EQ(repaired.moves.size(), 2u);
  EXPECT_EQ(repaired.moves[1].part, Part::weight);
  EXPECT_EQ(repaired.largest_square, Rational(1, 100000000));
  EXPECT_TRUE(analyse(repaired.mesh));
}

TEST(RepairMeshTest, Errors) {
  const CurveMesh good = validation::two_faces(2, false);
  const auto expect_error = [&](ErrorCode code, const std::function<void(CurveMesh&)>& change) {
    CurveMesh mesh = good;
    change(mesh);
    const Result<RepairedMesh> repaired = repair_mesh(mesh);
    ASSERT_FALSE(repaired);
    EXPECT_EQ(repaired.error().code, code) << repaired.error().text();
    EXPECT_FALSE(repaired.error().where.empty());
  };
  expect_error(ErrorCode::bad_degree, [](CurveMesh& m) { m.edges[1].degree = 2; });
  expect_error(ErrorCode::wrong_count, [](CurveMesh& m) { m.edges[1].points.pop_back(); });
  expect_error(ErrorCode::wrong_count, [](CurveMesh& m) { m.edges[1].points.clear(), m.edges[1].knots.clear(); });
  expect_error(ErrorCode::wrong_count, [](CurveMesh& m) { m.edges[1].weights = {1}; });
  expect_error(ErrorCode::decreasing_knots, [](CurveMesh& m) { m.edges[3].knots[4] = Rational(3, 4); });
  expect_error(ErrorCode::bad_multiplicity, [](CurveMesh& m) { m.edges[1].knots[0] = -1; });
  expect_error(ErrorCode::bad_weight, [](CurveMesh& m) { m.edges[1].weights = {1, 0, 1, 1}; });
  expect_error(ErrorCode::bad_reference, [](CurveMesh& m) { m.edges[1].end.index = 77; });
  expect_error(ErrorCode::bad_reference, [](CurveMesh& m) { m.edges[1].begin = {MeshNode::Kind::t_node, 0}; });
  expect_error(ErrorCode::bad_reference, [](CurveMesh& m) {
    m.control_vectors = {{-1, Rational(1, 2), std::nullopt, std::nullopt}};
  });
  expect_error(ErrorCode::bad_t_node, [](CurveMesh& m) { m.t_nodes = {{"T", 9, Rational(1, 2)}}; });
  expect_error(ErrorCode::bad_t_node, [](CurveMesh& m) { m.t_nodes = {{"T", 1, Rational(1)}}; });
  // Two edges that end on each other.
  expect_error(ErrorCode::ends_apart, [](CurveMesh& m) {
    m.t_nodes = {{"T0", 1, Rational(1, 2)}, {"T1", 2, Rational(1, 2)}};
    m.edges[1].end = {MeshNode::Kind::t_node, 1};
    m.edges[2].end = {MeshNode::Kind::t_node, 0};
  });
  EXPECT_THROW((void)repair_mesh(good, {Rational(1)}), contract_error);
}

}  // namespace
}  // namespace patchproof
