// SPDX-License-Identifier: Apache-2.0
// What tests of whole curve meshes share: equality, and the proofs of a filling.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "patchproof/join/certify.h"
#include "patchproof/mesh/prove_fill.h"

namespace patchproof::test {

inline void expect_same(const MeshEdge& a, const MeshEdge& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.degree, b.degree);
  EXPECT_TRUE(a.knots == b.knots && a.points == b.points && a.weights == b.weights) << a.id;
  EXPECT_TRUE(a.begin == b.begin && a.end == b.end) << a.id;
}

inline void expect_same(const MeshFace& a, const MeshFace& b) {
  EXPECT_EQ(a.id, b.id);
  ASSERT_EQ(a.sides.size(), b.sides.size());
  for (std::size_t s = 0; s < a.sides.size(); ++s)
    EXPECT_TRUE(a.sides[s].edge == b.sides[s].edge && a.sides[s].from == b.sides[s].from &&
                a.sides[s].to == b.sides[s].to);
}

// The first vertices, edges, T-nodes and control vectors of `b` are those of `a`.
inline void expect_keeps_parts(const CurveMesh& a, const CurveMesh& b) {
  ASSERT_LE(a.vertices.size(), b.vertices.size());
  ASSERT_LE(a.edges.size(), b.edges.size());
  ASSERT_LE(a.t_nodes.size(), b.t_nodes.size());
  ASSERT_EQ(a.control_vectors.size(), b.control_vectors.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    EXPECT_TRUE(a.vertices[i].id == b.vertices[i].id && a.vertices[i].point == b.vertices[i].point);
  for (std::size_t i = 0; i < a.edges.size(); ++i) expect_same(a.edges[i], b.edges[i]);
  for (std::size_t i = 0; i < a.t_nodes.size(); ++i)
    EXPECT_TRUE(a.t_nodes[i].id == b.t_nodes[i].id && a.t_nodes[i].edge == b.t_nodes[i].edge &&
                a.t_nodes[i].parameter == b.t_nodes[i].parameter);
  for (std::size_t i = 0; i < a.control_vectors.size(); ++i) {
    const ControlVectors &c = a.control_vectors[i], &d = b.control_vectors[i];
    EXPECT_TRUE(c.edge == d.edge && c.parameter == d.parameter && c.left == d.left && c.right == d.right);
  }
}

inline void expect_same(const CurveMesh& a, const CurveMesh& b) {
  expect_keeps_parts(a, b);
  EXPECT_EQ(a.vertices.size(), b.vertices.size());
  EXPECT_EQ(a.edges.size(), b.edges.size());
  EXPECT_EQ(a.t_nodes.size(), b.t_nodes.size());
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) expect_same(a.faces[i], b.faces[i]);
}

inline std::size_t count(const MeshTopology& topology, EdgeKind kind) {
  return static_cast<std::size_t>(std::count(topology.kinds.begin(), topology.kinds.end(), kind));
}

// Filled, and proved: C⁰ everywhere, G¹ across every smooth edge, C¹ inside every patch. How many patches were proved regular,
// with so many boxes looked at in each.
inline int expect_proved(const CurveMesh& mesh, const FillOptions& options = {}, int max_boxes = 20000) {
  const Result<MeshTopology> topology = analyse(mesh);
  if (!topology) return ADD_FAILURE() << topology.error().text(), 0;
  const Result<FilledMesh<Rational>> filled = fill_faces<Rational>(mesh, *topology, options);
  if (!filled) return ADD_FAILURE() << filled.error().text(), 0;
  std::vector<bool> joined(mesh.edges.size());
  for (const MeshJoin& j : mesh_joins(mesh, *topology)) {
    const Certificate certificate = certify_join(carrier(filled->patches[j.join.patch_a], j.edge_a),
                                                 carrier(filled->patches[j.join.patch_b], j.edge_b), j.join);
    joined[j.edge] = true;
    EXPECT_EQ(certificate.c0.verdict, Verdict::proven) << mesh.edges[j.edge].id;
    if (topology->kinds[j.edge] == EdgeKind::smooth) {
      EXPECT_EQ(certificate.g1.verdict, Verdict::proven) << mesh.edges[j.edge].id << ": " << certificate.g1.reason;
    }
  }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    EXPECT_EQ(joined[e], topology->kinds[e] != EdgeKind::boundary) << mesh.edges[e].id;
  int regular = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const GregoryProof proof = prove_patch(filled->patches[f], max_boxes);
    EXPECT_TRUE(proof.is_c1()) << mesh.faces[f].id;
    EXPECT_NE(proof.regular.verdict, Verdict::refuted) << mesh.faces[f].id;
    if (proof.regular.verdict == Verdict::proven) ++regular;
  }
  return regular;
}

}  // namespace patchproof::test
