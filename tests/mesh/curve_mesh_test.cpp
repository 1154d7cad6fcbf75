// SPDX-License-Identifier: Apache-2.0
// The refusals of the reference meshes are in tests/validation/gregory_test.cpp; these are others.
#include "patchproof/mesh/curve_mesh.h"

#include <gtest/gtest.h>

#include <climits>
#include <cmath>

#include "support/graph_mesh.h"

namespace patchproof::test {
namespace {

void expect_error(const CurveMesh& mesh, ErrorCode code, const std::string& where, FaceSides sides = FaceSides::four) {
  const Result<MeshTopology> topology = analyse(mesh, sides);
  ASSERT_FALSE(topology) << "expected " << to_string(code) << " at " << where;
  EXPECT_EQ(topology.error().code, code) << topology.error().text();
  EXPECT_EQ(topology.error().where, where) << topology.error().text();
  EXPECT_FALSE(topology.error().message.empty());
}
template <class Change>
void expect_error_after(Change change, ErrorCode code, const std::string& where) {
  CurveMesh mesh = two_columns({.to_left = {"1/3"_q}, .to_right = {"1/2"_q}}).mesh;
  ASSERT_TRUE(analyse(mesh));
  change(mesh);
  expect_error(mesh, code, where);
}

TEST(CurveMesh, EmptyMeshes) {
  CurveMesh mesh;
  for (const FaceSides sides : {FaceSides::four, FaceSides::any}) {
    const Result<MeshTopology> topology = analyse(mesh, sides);
    ASSERT_TRUE(topology);
    EXPECT_TRUE(topology->uses.empty() && topology->kinds.empty() && topology->curves.empty());
  }
  mesh.vertices.push_back({"alone", {}});
  EXPECT_TRUE(analyse(mesh));
  mesh.faces.push_back({"nothing", {}});
  expect_error(mesh, ErrorCode::wrong_side_count, "face nothing", FaceSides::any);
}

TEST(CurveMesh, Law1_IndicesOutOfRangeEverywhere) {
  for (const int bad : {-1, INT_MIN, 1000, INT_MAX}) {
    const auto vectors = [&](CurveMesh& m) { m.control_vectors.push_back({bad, "1/2"_q, {}, {}}); };
    expect_error_after(vectors, ErrorCode::bad_reference, "control vectors 0");
    expect_error_after([&](CurveMesh& m) { m.t_nodes[1].edge = bad; }, ErrorCode::bad_t_node, "T-node T1");
    for (const auto kind : {MeshNode::Kind::vertex, MeshNode::Kind::t_node}) {
      expect_error_after([&](CurveMesh& m) { m.edges[2].begin = {kind, bad}; }, ErrorCode::bad_reference, "edge E2");
      expect_error_after([&](CurveMesh& m) { m.edges[3].end = {kind, bad}; }, ErrorCode::bad_reference, "edge E3");
    }
    expect_error_after([&](CurveMesh& m) { m.faces[2].sides[3].edge = bad; }, ErrorCode::bad_side, "face F2");
  }
  // One beyond the last.
  expect_error_after([](CurveMesh& m) { m.faces[0].sides[0].edge = static_cast<int>(m.edges.size()); },
                     ErrorCode::bad_side, "face F0");
  expect_error_after([](CurveMesh& m) { m.t_nodes[0].edge = static_cast<int>(m.edges.size()); }, ErrorCode::bad_t_node,
                     "T-node T0");
  expect_error_after([](CurveMesh& m) { m.edges[0].end.index = static_cast<int>(m.vertices.size()); },
                     ErrorCode::bad_reference, "edge E0");
}

TEST(CurveMesh, Law1_Edges) {
  const auto change = [](auto f, ErrorCode code) {
    expect_error_after([&](CurveMesh& m) { f(m.edges[1]); }, code, "edge E1");
  };
  for (const int degree : {2, 4, 0, -1}) change([&](MeshEdge& e) { e.degree = degree; }, ErrorCode::bad_degree);
  change([](MeshEdge& e) { e.points.pop_back(); }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e.points.clear(); }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e = MeshEdge{e.id, 3, {}, {}, {}, {}, {}}; }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e = MeshEdge{e.id, 3, {0, 0, 1, 1}, {}, {}, {}, {}}; }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e.knots.push_back(1); }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e.weights = {1, 1, 1}; }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { e.weights = {1, 1, 1, 1, 1}; }, ErrorCode::wrong_count);
  change([](MeshEdge& e) { std::swap(e.knots[3], e.knots[4]); }, ErrorCode::decreasing_knots);
  change([](MeshEdge& e) { e.knots.assign(8, 0); }, ErrorCode::empty_domain);
  change([](MeshEdge& e) { e.knots[0] = -1; }, ErrorCode::bad_multiplicity);
  change(
      [](MeshEdge& e) {
        for (Rational& t : e.knots) t *= 2;
      },
      ErrorCode::bad_multiplicity);
  change(
      [](MeshEdge& e) {
        for (Rational& t : e.knots) t += 1;
      },
      ErrorCode::bad_multiplicity);
  change(
      [](MeshEdge& e) {  // ends one time too often
        e.knots.insert(e.knots.begin(), 0);
        e.points.push_back(e.points.back());
      },
      ErrorCode::bad_multiplicity);
  change(
      [](MeshEdge& e) {  // a jump
        e.knots.insert(e.knots.begin() + 4, 4, "1/2"_q);
        e.points.insert(e.points.end(), 4, e.points.back());
      },
      ErrorCode::bad_multiplicity);
  for (const Rational& w : {Rational(0), Rational(-1), "-1/99999999999"_q})
    change([&](MeshEdge& e) { e.weights = {1, 1, w, 1}; }, ErrorCode::bad_weight);
  change([](MeshEdge& e) { e.points[1] = e.points[0]; }, ErrorCode::vanishing_tangent);
  change([](MeshEdge& e) { e.points[2] = e.points[3]; }, ErrorCode::vanishing_tangent);
  change([](MeshEdge& e) { e.points[3][2] += Rational(1, Integer(1) << 200); }, ErrorCode::ends_apart);
  change([](MeshEdge& e) { e.points[0][0] -= Rational(1, Integer(1) << 200); }, ErrorCode::ends_apart);
  // C¹ as a curve of points, but not in homogeneous coordinates.
  change(
      [](MeshEdge& e) {
        const Point3 p = e.points[0], d = "1/6"_q * (e.points[3] - p);
        e.knots = {0, 0, 0, 0, "1/2"_q, "1/2"_q, "1/2"_q, 1, 1, 1, 1};
        e.points.clear();
        for (int i = 0; i <= 6; ++i) e.points.push_back(p + Rational(i) * d);
        e.weights = {1, 1, 1, 2, 1, 1, 1};
      },
      ErrorCode::not_c1);
}

TEST(CurveMesh, Law1_TNodes) {
  for (const Rational& t : {Rational(0), Rational(1), Rational(-1), "3/2"_q})
    expect_error_after([&](CurveMesh& m) { m.t_nodes[0].parameter = t; }, ErrorCode::bad_t_node, "T-node T0");
  // Two at one place: whether or not an edge ends there, in either order.
  const auto twin = [](CurveMesh& m) { m.t_nodes.push_back({"twin", m.t_nodes[0].edge, m.t_nodes[0].parameter}); };
  expect_error_after(twin, ErrorCode::bad_t_node, "T-node twin");
  expect_error_after(
      [](CurveMesh& m) {
        m.t_nodes.insert(m.t_nodes.begin(), {"twin", m.t_nodes[0].edge, m.t_nodes[0].parameter});
      },
      ErrorCode::bad_t_node, "T-node T0");
  // At which no face has a corner.
  expect_error_after(
      [](CurveMesh& m) {
        m.t_nodes.push_back({"idle", 0, "1/7"_q});
      },
      ErrorCode::bad_t_node, "T-node idle");
}

TEST(CurveMesh, Law1_ControlVectors) {
  const Point3 d{{1, 0, 0}};
  for (const Rational& t : {Rational(0), Rational(1), Rational(-2), "7/6"_q})
    expect_error_after(
        [&](CurveMesh& m) {
          m.control_vectors.push_back({2, t, d, -d});
        },
        ErrorCode::control_vector_outside, "edge E2");
  expect_error_after(
      [&](CurveMesh& m) {
        m.control_vectors = {{2, "2/4"_q, d, -d}, {2, "1/3"_q, d, -d}, {2, "1/2"_q, {}, {}}};
      },
      ErrorCode::control_vector_twice, "edge E2");
}

TEST(CurveMesh, Law1_Faces) {
  const auto sides = [](auto f, ErrorCode code) {
    expect_error_after([&](CurveMesh& m) { f(m.faces[1].sides); }, code, "face F1");
  };
  using Sides = std::vector<FaceSide>;
  sides([](Sides& s) { s.pop_back(); }, ErrorCode::wrong_side_count);
  sides([](Sides& s) { s.push_back(s[0]); }, ErrorCode::wrong_side_count);
  sides([](Sides& s) { s.clear(); }, ErrorCode::wrong_side_count);
  sides([](Sides& s) { s[1].to = s[1].from; }, ErrorCode::bad_side);
  sides([](Sides& s) { s[1].to = 2; }, ErrorCode::bad_side);
  sides([](Sides& s) { s[1].from = "-1/3"_q; }, ErrorCode::bad_side);
  sides([](Sides& s) { s[1].from = "1/4"_q; }, ErrorCode::side_ends_nowhere);
  sides([](Sides& s) { std::swap(s[0].from, s[0].to); }, ErrorCode::open_loop);
  sides([](Sides& s) { std::swap(s[0], s[2]); }, ErrorCode::open_loop);
  // Turned over: it lies on the wrong side of its edges.
  CurveMesh turned = two_columns().mesh;
  std::reverse(turned.faces[0].sides.begin(), turned.faces[0].sides.end());
  for (FaceSide& s : turned.faces[0].sides) std::swap(s.from, s.to);
  expect_error(turned, ErrorCode::uneven_cover, "edge E0");
  // Given twice.
  CurveMesh twice = two_columns().mesh;
  twice.faces.push_back({"again", twice.faces[0].sides});
  expect_error(twice, ErrorCode::uneven_cover, "edge E0");
  expect_error_after([](CurveMesh& m) { m.faces.erase(m.faces.begin()); }, ErrorCode::uneven_cover, "edge E0");
  expect_error_after([](CurveMesh& m) { m.faces.erase(m.faces.begin() + 1); }, ErrorCode::uneven_cover, "edge E0");
  expect_error_after(
      [](CurveMesh& m) {
        m.edges.push_back(m.edges[1]);
        m.edges.back().id = "spare";
      },
      ErrorCode::unused_edge, "edge spare");
}

// Of several things wrong the first in the order of the header is the error.
TEST(CurveMesh, Law1_TheFirstThingWrong) {
  CurveMesh mesh = two_columns({.to_left = {"1/3"_q}}).mesh;
  mesh.faces[0].sides.pop_back();
  expect_error(mesh, ErrorCode::wrong_side_count, "face F0");
  mesh.edges[4].end.index = -1;
  expect_error(mesh, ErrorCode::bad_reference, "edge E4");
  mesh.t_nodes[0].parameter = 0;
  expect_error(mesh, ErrorCode::bad_t_node, "T-node T0");
  mesh.control_vectors.push_back({0, 2, {}, {}});
  expect_error(mesh, ErrorCode::control_vector_outside, "edge E0");
  mesh.edges[5].degree = 2;
  expect_error(mesh, ErrorCode::bad_degree, "edge E5");
  mesh.edges[1].degree = 4;
  expect_error(mesh, ErrorCode::bad_degree, "edge E1");
}

// A regular polygon's role is played by any convex one, with a middle point when it has two corners.
GraphMesh polygon(int n) {
  GraphMesh g;
  const std::vector<Place2> all{{0, 0}, {4, 0}, {6, 3}, {3, 6}, {-1, 4}};
  std::vector<MeshNode> nodes;
  for (int i = 0; i < n; ++i) nodes.push_back(g.vertex(all[i][0], all[i][1]));
  std::vector<FaceSide> sides;
  for (int i = 0; i < n; ++i) sides.push_back({g.edge(nodes[i], nodes[(i + 1) % n]), 0, 1});
  if (n == 2)
    for (const std::size_t k : {1u, 2u}) g.mesh.edges[0].points[k][1] -= 2;  // a lens
  g.face(sides);
  return g;
}

TEST(CurveMesh, Law1_FacesOfAnyNumberOfSides) {
  for (const int n : {2, 3, 4, 5}) {
    const GraphMesh g = polygon(n);
    const Result<MeshTopology> topology = analyse(g.mesh, FaceSides::any);
    ASSERT_TRUE(topology) << topology.error().text();
    ASSERT_EQ(topology->uses.size(), static_cast<std::size_t>(n));
    for (const EdgeKind kind : topology->kinds) EXPECT_EQ(kind, EdgeKind::boundary);
    for (int s = 0; s < n && n != 2; ++s) {
      const EdgeUse& use = topology->uses[s];
      const std::vector<FaceSide>& sides = g.mesh.faces[0].sides;
      const Place2 before = g.direction(sides[(s + n - 1) % n]), after = g.direction(sides[(s + 1) % n]);
      EXPECT_EQ(use.begin_derivative, g.lifted(g.at(s, 0), {-before[0], -before[1]}));
      EXPECT_EQ(use.end_derivative, g.lifted(g.at(s, 1), after));
    }
    if (n != 4) expect_error(g.mesh, ErrorCode::wrong_side_count, "face F0");
  }
  CurveMesh one = polygon(3).mesh;
  one.faces[0].sides.resize(1);
  expect_error(one, ErrorCode::wrong_side_count, "face F0", FaceSides::any);
  CurveMesh flat = polygon(2).mesh;  // a lens without inside: its sides are one line
  flat.edges[0].points[1] = flat.edges[1].points[2];
  flat.edges[0].points[2] = flat.edges[1].points[1];
  expect_error(flat, ErrorCode::parallel_tangents, "face F0", FaceSides::any);
}

TEST(CurveMesh, Law2And3_UsesTileTheirEdgesAndKnowTheirNeighbours) {
  // T-nodes in the list in any order.
  for (const bool reversed : {false, true}) {
    GraphMesh g = two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q},
                               .w0 = 2,
                               .to_left = {"1/5"_q, "1/2"_q, "4/5"_q},
                               .to_right = {"1/2"_q, "2/3"_q}});
    if (reversed) {
      std::reverse(g.mesh.t_nodes.begin(), g.mesh.t_nodes.end());
      for (MeshEdge& e : g.mesh.edges)
        for (MeshNode* node : {&e.begin, &e.end})
          if (node->kind == MeshNode::Kind::t_node)
            node->index = static_cast<int>(g.mesh.t_nodes.size()) - 1 - node->index;
    }
    const Result<MeshTopology> topology = analyse(g.mesh);
    ASSERT_TRUE(topology) << topology.error().text();
    ASSERT_EQ(topology->left[0].size(), 4u);
    ASSERT_EQ(topology->right[0].size(), 3u);
    std::size_t count = 0;
    for (std::size_t e = 0; e < g.mesh.edges.size(); ++e)
      for (const auto* side : {&topology->left[e], &topology->right[e]}) {
        Rational covered(0);
        for (const int index : *side) {
          const EdgeUse& use = topology->uses[index];
          EXPECT_EQ(use.edge, static_cast<int>(e));
          EXPECT_EQ(use.is_left(), side == &topology->left[e]);
          EXPECT_EQ(use.begin(), covered);
          covered = use.end();
        }
        EXPECT_TRUE(side->empty() || covered == 1);
        count += side->size();
      }
    EXPECT_EQ(count, topology->uses.size());
    EXPECT_EQ(count, 4 * g.mesh.faces.size());
    for (std::size_t f = 0; f < g.mesh.faces.size(); ++f)
      for (int s = 0; s < 4; ++s) {
        const EdgeUse& use = topology->uses[topology->uses_of_face[f][s]];
        const std::vector<FaceSide>& sides = g.mesh.faces[f].sides;
        EXPECT_EQ(use.face, static_cast<int>(f));
        EXPECT_EQ(use.side, s);
        EXPECT_EQ(use.edge, sides[s].edge);
        const Place2 before = g.direction(sides[(s + 3) % 4]), after = g.direction(sides[(s + 1) % 4]);
        const Point3 at_from = g.lifted(g.at(use.edge, use.from), {-before[0], -before[1]}),
                     at_to = g.lifted(g.at(use.edge, use.to), after);
        EXPECT_EQ(use.is_left() ? use.begin_derivative : use.end_derivative, at_from);
        EXPECT_EQ(use.is_left() ? use.end_derivative : use.begin_derivative, at_to);
      }
    std::vector<Rational> order;
    for (const int node : topology->t_nodes_on_edge[0]) order.push_back(g.mesh.t_nodes[node].parameter);
    EXPECT_EQ(order, (std::vector<Rational>{"1/5"_q, "1/2"_q, "2/3"_q, "4/5"_q}));
    EXPECT_EQ(topology->edges_at_t_node[topology->t_nodes_on_edge[0][1]].size(), 2u);
  }
}

TEST(CurveMesh, Law4_SmoothUntilTheLastBitOfATangentChanges) {
  GraphMesh g = two_columns({.to_left = {"1/3"_q, "1/2"_q}, .to_right = {"1/2"_q}});
  const auto kinds = [&] { return analyse(g.mesh).value().kinds; };
  const std::vector<EdgeKind> before = kinds();
  for (std::size_t e = 0; e < g.mesh.edges.size(); ++e) {
    const bool inner = e == 0 || g.mesh.edges[e].begin.kind == MeshNode::Kind::t_node;
    EXPECT_EQ(before[e], inner ? EdgeKind::smooth : EdgeKind::boundary) << e;
  }
  // One bit out of the plane: at the ends of edge 0 and at a T-node from which edges leave to both sides it counts, at another
  // T-node not, for there the edge that ends gives the plane to all faces.
  for (std::size_t e = 1; e < g.mesh.edges.size(); ++e) {
    MeshEdge& edge = g.mesh.edges[e];
    if (std::any_of(g.mesh.t_nodes.begin(), g.mesh.t_nodes.end(),
                    [&](const TNode& n) { return n.edge == static_cast<int>(e); }))
      continue;  // edges end on it
    bool meets = edge.begin == g.mesh.edges[0].begin || edge.begin == g.mesh.edges[0].end;
    for (std::size_t other = 1; other < g.mesh.edges.size(); ++other)
      meets = meets || (other != e && before[e] == EdgeKind::smooth && g.mesh.edges[other].begin == edge.begin);
    const Rational z = edge.points[1][2];
    edge.points[1][2] = from_double(std::nextafter(nearest_double(z), 1e9));
    if (edge.points[1][2] == z) edge.points[1][2] += Rational(1, Integer(1) << 60);
    EXPECT_EQ(kinds()[0], meets ? EdgeKind::sharp : EdgeKind::smooth) << "edge " << e;
    edge.points[1][2] = z;
    // Longer in its own direction, it stays in the plane; backwards, the face folds over.
    const Point3 p = edge.points[1];
    edge.points[1] = p + Rational(1, Integer(1) << 60) * (p - edge.points[0]);
    EXPECT_EQ(kinds()[0], EdgeKind::smooth) << "edge " << e;
    edge.points[1] = edge.points[0] - (p - edge.points[0]);
    EXPECT_EQ(kinds()[0], meets ? EdgeKind::sharp : EdgeKind::smooth) << "edge " << e;
    edge.points[1] = p;
  }
  EXPECT_EQ(kinds(), before);
  EXPECT_STREQ(to_string(EdgeKind::boundary), "boundary");
  EXPECT_STREQ(to_string(EdgeKind::smooth), "smooth");
  EXPECT_STREQ(to_string(EdgeKind::sharp), "sharp");
}

TEST(CurveMesh, PointsTangentsAndNormalsOfEdges) {
  const GraphMesh g = two_columns({.inner = {"1/4"_q, "1/2"_q, "1/2"_q}, .w0 = 3, .w1 = "1/2"_q});
  const MeshTopology topology = analyse(g.mesh).value();
  for (const Rational& t : {Rational(0), "1/4"_q, "1/3"_q, "1/2"_q, Rational(1)}) {
    const Place2 at = g.at(0, t);
    const Point3 tangent = g.lifted(at, g.direction({0, 0, 1}));
    EXPECT_EQ(edge_point(topology.curves[0], t), g.lifted(at));
    EXPECT_EQ(edge_tangent(topology.curves[0], t), tangent);
    const Point3 to_left = g.lifted(at, {-1, "1/3"_q}), to_right = g.lifted(at, {2, -1}),
                 normal = cross(g.lifted(at, {1, 0}), g.lifted(at, {0, 1}));
    EXPECT_TRUE(same_direction(outward_normal(topology, topology.uses[topology.left[0][0]], t, to_left), normal));
    EXPECT_TRUE(same_direction(outward_normal(topology, topology.uses[topology.right[0][0]], t, to_right), normal));
    EXPECT_TRUE(same_direction(outward_normal(topology, topology.uses[topology.left[0][0]], t, to_right), -normal));
  }
  const Point3 x{{1, -2, 3}}, zero{};
  EXPECT_TRUE(same_direction(x, "1/7"_q * x) && is_parallel(x, -x));
  EXPECT_FALSE(same_direction(x, -x) || same_direction(x, zero) || same_direction(zero, zero));
  EXPECT_FALSE(is_parallel(x, x + Point3{{0, 0, Rational(1, Integer(1) << 300)}}));
}

}  // namespace
}  // namespace patchproof::test
