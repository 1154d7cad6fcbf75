// SPDX-License-Identifier: Apache-2.0
// The generated curve meshes: what they promise, and that every one is filled and proved.
#include "validation/corpus/curve_meshes.h"

#include <gtest/gtest.h>

#include <map>

#include "support/filled_meshes.h"

namespace patchproof {
namespace {

using validation::closed_mesh;
using validation::Polyhedron;

constexpr FillOptions kEven{NodeScale::rational, FillMethod::c1};

void expect_all_smooth(const CurveMesh& mesh) {
  const Result<MeshTopology> topology = analyse(mesh, FaceSides::any);
  ASSERT_TRUE(topology) << topology.error().text();
  EXPECT_EQ(test::count(*topology, EdgeKind::smooth), mesh.edges.size());
}

std::map<int, int> valences(const CurveMesh& mesh) {
  std::map<int, int> of_vertex, out;
  for (const MeshEdge& edge : mesh.edges)
    for (const MeshNode& node : {edge.begin, edge.end})
      if (node.kind == MeshNode::Kind::vertex) ++of_vertex[node.index];
  for (const auto& [vertex, valence] : of_vertex) ++out[valence];
  return out;
}

TEST(ClosedMeshTest, EveryEdgeIsSmoothAndAllKindsOfPartsOccur) {
  for (const int n : {1, 2, 3, 5})
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      SCOPED_TRACE("n = " + std::to_string(n) + ", seed " + std::to_string(seed));
      const CurveMesh mesh = closed_mesh(n, seed, {30, 20, 10, static_cast<int>(seed % 2) * 30, 0});
      expect_all_smooth(mesh);
      EXPECT_GE(mesh.faces.size(), 6u * n * n);
      EXPECT_EQ(valences(mesh)[3], 8);
      EXPECT_EQ(mesh.vertices.size(), 6u * n * n + 2);
      if (n < 5) continue;
      std::size_t with_knots = 0, rational = 0;
      for (const MeshEdge& edge : mesh.edges) {
        with_knots += edge.knots.size() > 8;
        rational += !edge.weights.empty();
      }
      EXPECT_GT(with_knots, mesh.edges.size() / 5);
      EXPECT_GT(mesh.t_nodes.size(), 10u);
      EXPECT_GT(mesh.control_vectors.size(), 20u);
      EXPECT_EQ(rational > 0, seed % 2 == 1);
    }
}

TEST(ClosedMeshTest, FacesCutInTriangles) {
  const CurveMesh mesh = closed_mesh(3, 1, {30, 20, 30, 0, 50});
  expect_all_smooth(mesh);
  std::map<std::size_t, int> sides;
  for (const MeshFace& face : mesh.faces) ++sides[face.sides.size()];
  EXPECT_EQ(sides.size(), 2u);
  EXPECT_GT(sides[3], 20);
  EXPECT_GT(sides[4], 10);
}

TEST(ClosedMeshTest, TheSeedDecides) {
  test::expect_same(closed_mesh(2, 9), closed_mesh(2, 9));
  EXPECT_FALSE(closed_mesh(2, 9).vertices[0].point == closed_mesh(2, 10).vertices[0].point);
}

TEST(ClosedMeshTest, FilledAndProved) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CurveMesh mesh = closed_mesh(3, seed);
    EXPECT_EQ(test::expect_proved(mesh, kEven), static_cast<int>(mesh.faces.size()));
  }
  test::expect_proved(closed_mesh(2, 4, {40, 30, 20, 50, 0}));  // rational edges
}

TEST(PolyhedronMeshTest, FacesAndValences) {
  const auto sides = [](const CurveMesh& mesh) {
    std::map<std::size_t, int> out;
    for (const MeshFace& face : mesh.faces) ++out[face.sides.size()];
    return out;
  };
  const validation::ClosedMeshOptions plain{20, 20, 0, 0, 0};
  const CurveMesh icosahedron = validation::polyhedron_mesh(Polyhedron::icosahedron, 1, plain),
                  football = validation::polyhedron_mesh(Polyhedron::football, 1, plain),
                  third = validation::polyhedron_mesh(Polyhedron::rhombicosidodecahedron, 1, plain);
  for (const CurveMesh* mesh : {&icosahedron, &football, &third}) expect_all_smooth(*mesh);
  EXPECT_EQ(sides(icosahedron), (std::map<std::size_t, int>{{3, 20}}));
  EXPECT_EQ(valences(icosahedron), (std::map<int, int>{{5, 12}}));
  EXPECT_EQ(sides(football), (std::map<std::size_t, int>{{5, 12}, {6, 20}}));
  EXPECT_EQ(valences(football), (std::map<int, int>{{3, 60}}));
  EXPECT_EQ(sides(third), (std::map<std::size_t, int>{{3, 20}, {4, 30}, {5, 12}}));
  EXPECT_EQ(valences(third), (std::map<int, int>{{4, 60}}));
}

TEST(TwoFacesTest, FilledAndProved) {
  std::map<std::size_t, int> knots;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const bool rational : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (rational ? ", rational" : ", polynomial"));
      const CurveMesh mesh = validation::two_faces(seed, rational);
      ASSERT_TRUE(analyse(mesh));
      EXPECT_EQ(analyse(mesh)->kinds[0], EdgeKind::smooth);
      EXPECT_EQ(mesh.edges[0].weights.empty(), !rational);
      ++knots[mesh.edges[0].knots.size()];
      test::expect_proved(mesh, seed % 2 == 0 ? FillOptions{} : kEven, 1);  // too wild to be regular
    }
  EXPECT_EQ(knots.size(), 5u);  // one to five segments
}

}  // namespace
}  // namespace patchproof
