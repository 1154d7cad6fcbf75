// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/split_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/filled_meshes.h"
#include "support/scalars.h"
#include "validation/corpus/curve_meshes.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;
using validation::Polyhedron;

constexpr FillOptions kEven{NodeScale::rational, FillMethod::c1};

MeshEdge bezier(int begin, int end, std::vector<Vector> points) {
  MeshEdge edge;
  edge.id = "E" + std::to_string(begin) + std::to_string(end);
  edge.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  edge.points = std::move(points);
  edge.begin.index = begin;
  edge.end.index = end;
  return edge;
}

// One face with straight sides, or with sides through given middles.
CurveMesh one_face(const std::vector<Vector>& corners, const std::vector<Vector>& middles = {}) {
  CurveMesh mesh;
  mesh.faces = {{"F", {}}};
  const int n = static_cast<int>(corners.size());
  for (int i = 0; i < n; ++i) {
    const Vector &a = corners[i], &b = corners[(i + 1) % n];
    const Rational third(1, 3), sixth(1, 6);
    mesh.vertices.push_back({"V" + std::to_string(i), a});
    const Vector inner = middles.empty() ? Vector{} : sixth * (Rational(8) * middles[i] - a - b);
    mesh.edges.push_back(middles.empty() ? bezier(i, (i + 1) % n, {a, a + third * (b - a), b + third * (a - b), b})
                                         : bezier(i, (i + 1) % n, {a, inner, inner, b}));
    mesh.faces[0].sides.push_back({i, 0, 1});
  }
  return mesh;
}

// Of the spokes of a centre, in the order of the sides, away from it.
std::vector<Vector> spokes_at(const CurveMesh& mesh, int vertex) {
  std::vector<Vector> out;
  for (const MeshEdge& edge : mesh.edges)
    if (edge.end.kind == MeshNode::Kind::vertex && edge.end.index == vertex)
      out.push_back(edge.points[edge.points.size() - 2] - edge.points.back());
  return out;
}

void expect_round_once(const std::vector<Vector>& spokes) {
  const std::size_t n = spokes.size();
  ASSERT_GE(n, 3u);
  const Vector normal = cross(spokes[0], spokes[1]), probe = spokes[0];
  int rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector &here = spokes[i], &next = spokes[(i + 1) % n];
    EXPECT_EQ(dot(here, normal), 0);
    EXPECT_GT(dot(cross(here, next), normal), 0);
    // On the side of `probe`'s line where angles are negative, and the next one not.
    const auto is_below = [&](const Vector& v) { return dot(cross(probe, v), normal) < 0; };
    if (is_below(here) && !is_below(next)) ++rounds;
  }
  EXPECT_EQ(rounds, 1);
}

// Laws 1 to 5 for one mesh.
void expect_laws(const CurveMesh& mesh, const FillOptions& options) {
  const Result<CurveMesh> split = split_faces(mesh, options);
  ASSERT_TRUE(split) << split.error().text();
  const Result<MeshTopology> before = analyse(mesh, FaceSides::any), after = analyse(*split);
  ASSERT_TRUE(before);
  ASSERT_TRUE(after) << after.error().text();
  test::expect_keeps_parts(mesh, *split);
  std::size_t f = 0, centre = mesh.vertices.size(), spoke = mesh.edges.size();
  for (std::size_t old = 0; old < mesh.faces.size(); ++old) {
    const std::vector<FaceSide>& sides = mesh.faces[old].sides;
    const std::size_t n = sides.size();
    if (n == 4) {
      test::expect_same(mesh.faces[old], split->faces[f++]);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i, ++f) {
      const std::vector<FaceSide>& part = split->faces[f].sides;
      ASSERT_EQ(part.size(), 4u);
      const FaceSide &side = sides[i], &last = sides[(i + n - 1) % n];
      EXPECT_TRUE(part[0].edge == side.edge && part[0].from == side.from && part[0].to == (side.from + side.to) / 2);
      EXPECT_TRUE(part[3].edge == last.edge && part[3].from == (last.from + last.to) / 2 && part[3].to == last.to);
      EXPECT_EQ(part[1].edge, static_cast<int>(spoke + i));
      EXPECT_EQ(part[2].edge, static_cast<int>(spoke + (i + n - 1) % n));
      // d, against the field of the mesh before.
      const EdgeUse& use = before->uses[before->uses_of_face[old][i]];
      if (before->kinds[side.edge] != EdgeKind::smooth) continue;
      const auto connection = connect_edge(mesh, *before, side.edge, options);
      ASSERT_TRUE(connection);
      const Vector a = value(connection->basis, Rational((side.from + side.to) / 2));
      const std::vector<Vector>& p = split->edges[part[1].edge].points;
      EXPECT_TRUE(same_direction(p[1] - p[0], use.is_left() ? a : -a));
    }
    const std::vector<Vector> spokes = spokes_at(*split, static_cast<int>(centre++));
    EXPECT_EQ(spokes.size(), n);
    expect_round_once(spokes);
    spoke += n;
  }
  EXPECT_EQ(f, split->faces.size());
  for (std::size_t e = 0; e < split->edges.size(); ++e)
    EXPECT_EQ(after->kinds[e], e < mesh.edges.size() ? before->kinds[e] : EdgeKind::smooth) << split->edges[e].id;
  const Result<CurveMesh> twice = split_faces(*split, options);
  ASSERT_TRUE(twice);
  test::expect_same(*split, *twice);
  std::set<std::string> names;
  for (const MeshEdge& edge : split->edges) EXPECT_TRUE(names.insert(edge.id).second) << edge.id;
}

TEST(SplitFacesTest, Laws1To5_OnClosedMeshesWithTrianglesPentagonsAndHexagons) {
  std::uint64_t seed = 0;
  for (const Polyhedron polyhedron :
       {Polyhedron::icosahedron, Polyhedron::football, Polyhedron::rhombicosidodecahedron}) {
    SCOPED_TRACE("seed " + std::to_string(++seed));
    validation::ClosedMeshOptions some;
    some.rational_edges = seed == 3 ? 40 : 0;
    expect_laws(validation::polyhedron_mesh(polyhedron, seed, some), seed == 2 ? kEven : FillOptions{});
  }
}

TEST(SplitFacesTest, Laws1To5_SidesWithTNodesAndBetweenThem) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CurveMesh mesh = validation::closed_mesh(2, seed, {30, 20, 40, seed == 4 ? 30 : 0, 40});
    EXPECT_GT(mesh.t_nodes.size(), 5u);
    expect_laws(mesh, kEven);
    const CurveMesh split = *split_faces(mesh, kEven);
    if (seed < 3) {
      EXPECT_EQ(test::expect_proved(split, kEven), static_cast<int>(split.faces.size()));
    }
  }
}

TEST(SplitFacesTest, Law1_MeshesOfFourSidedFacesStay) {
  const CurveMesh mesh = validation::closed_mesh(2, 5);
  const Result<CurveMesh> split = split_faces(mesh);
  ASSERT_TRUE(split) << split.error().text();
  test::expect_same(mesh, *split);
}

TEST(SplitFacesTest, Law3_SharpAndBoundaryEdgesStaySharpAndBoundary) {
  CurveMesh mesh = validation::polyhedron_mesh(Polyhedron::football, 4);
  mesh.faces.erase(mesh.faces.begin() + 7);
  std::vector<Vector>& points = mesh.edges[40].points;
  points[1] += Vector{{Rational(1, 8), Rational(1, 9), Rational(1, 10)}};
  const Result<MeshTopology> topology = analyse(mesh, FaceSides::any);
  ASSERT_TRUE(topology) << topology.error().text();
  EXPECT_GT(test::count(*topology, EdgeKind::sharp), 0u);
  EXPECT_GT(test::count(*topology, EdgeKind::boundary), 4u);
  expect_laws(mesh, kEven);
  test::expect_proved(*split_faces(mesh, kEven), kEven);
}

TEST(SplitFacesTest, Law3_FilledClosedMeshesAreProvedSmoothAndRegular) {
  for (const Polyhedron polyhedron :
       {Polyhedron::icosahedron, Polyhedron::football, Polyhedron::rhombicosidodecahedron}) {
    const CurveMesh mesh = *split_faces(validation::polyhedron_mesh(polyhedron, 1), kEven);
    EXPECT_EQ(test::expect_proved(mesh, kEven), static_cast<int>(mesh.faces.size()));
  }
}

TEST(SplitFacesTest, Law4_FacesThatAreNotStarShapedGetEvenDirections) {
  const CurveMesh mesh = one_face({{{0, 0, 0}}, {{9, 0, 0}}, {{9, 1, 0}}, {{1, 1, 0}}, {{1, 9, 0}}, {{0, 9, 0}}});
  const Result<CurveMesh> split = split_faces(mesh);
  ASSERT_TRUE(split) << split.error().text();
  expect_round_once(spokes_at(*split, 6));
}

TEST(SplitFacesTest, Law5_SpokesFromOneTNodeAreOppositeAndRunAlongControlVectors) {
  CurveMesh mesh = validation::polyhedron_mesh(Polyhedron::icosahedron, 6, {0, 0, 0, 0, 0});
  const Piecewise<Rational, 4> curve = analyse(mesh, FaceSides::any)->curves[3];
  const Vector out = edge_point(curve, Rational(1, 2)), along = edge_tangent(curve, Rational(1, 2));
  const Vector left = cross(out, along) + Rational(1, 2) * along;
  mesh.control_vectors.push_back({3, Rational(1, 2), left, Rational(-2) * left});
  expect_laws(mesh, {});
  const CurveMesh split = *split_faces(mesh);
  const MeshTopology topology = *analyse(split);
  int checked = 0;
  for (std::size_t t = 0; t < split.t_nodes.size(); ++t) {
    const std::vector<EdgeEnd>& ends = topology.edges_at_t_node[t];
    ASSERT_EQ(ends.size(), 2u);
    const auto direction = [&](int e) { return split.edges[e].points[1] - split.edges[e].points[0]; };
    EXPECT_TRUE(same_direction(direction(ends[0].edge), -direction(ends[1].edge)));
    if (split.t_nodes[t].edge != 3) continue;
    ++checked;
    EXPECT_TRUE(is_parallel(direction(ends[0].edge), left));
  }
  EXPECT_EQ(checked, 1);
}

TEST(SplitFacesTest, Law5_ATNodeThatStandsThereIsUsed) {
  // The icosahedron with one face split already has T-nodes at the middles of the edges to three others.
  CurveMesh mesh = validation::polyhedron_mesh(Polyhedron::icosahedron, 7);
  const std::vector<MeshFace> faces = mesh.faces;
  CurveMesh first = mesh;
  const CurveMesh all = *split_faces(mesh);
  // Split only face 0: take its parts, and the others as they were.
  first.vertices.push_back(all.vertices[12]);
  first.edges.insert(first.edges.end(), all.edges.begin() + 30, all.edges.begin() + 33);
  first.t_nodes.assign(all.t_nodes.begin(), all.t_nodes.begin() + 3);
  first.faces.assign(all.faces.begin(), all.faces.begin() + 3);
  first.faces.insert(first.faces.end(), faces.begin() + 1, faces.end());
  const Result<CurveMesh> split = split_faces(first);
  ASSERT_TRUE(split) << split.error().text();
  EXPECT_EQ(split->t_nodes.size(), all.t_nodes.size());
  EXPECT_EQ(split->faces.size(), 60u);
  const MeshTopology topology = *analyse(*split);
  EXPECT_EQ(test::count(topology, EdgeKind::smooth), split->edges.size());
  for (const std::vector<EdgeEnd>& ends : topology.edges_at_t_node) EXPECT_EQ(ends.size(), 2u);
}

TEST(SplitFacesTest, Law6_OnASphereTheCentreLiesOnIt) {
  for (const int n : {3, 5, 6, 7})
    for (const double theta : {0.2, 0.7, 1.2, 1.7}) {
      SCOPED_TRACE(std::to_string(n) + " sides, " + std::to_string(theta));
      std::vector<Vector> corners, middles;
      const auto at = [&](double longitude, double r, double z) {
        return Vector{{from_double(r * std::cos(longitude)), from_double(r * std::sin(longitude)), from_double(z)}};
      };
      const double step = 2 * M_PI / n;
      for (int i = 0; i < n; ++i) {
        middles.push_back(at(i * step, std::sin(theta), std::cos(theta)));
        corners.push_back(at((i - 0.5) * step, std::sin(theta) / std::cos(step / 2), std::cos(theta) - 0.05));
      }
      CurveMesh mesh = one_face(corners, middles);
      for (int i = 0; i < n; ++i)
        mesh.control_vectors.push_back(
            {i, Rational(1, 2), Rational(3) * at(i * step, -std::cos(theta), std::sin(theta)), std::nullopt});
      const Result<CurveMesh> split = split_faces(mesh);
      ASSERT_TRUE(split) << split.error().text();
      const Vector centre = split->vertices[n].point;
      EXPECT_NEAR(nearest_double(centre[0]), 0, 0x1p-12);
      EXPECT_NEAR(nearest_double(centre[1]), 0, 0x1p-12);
      EXPECT_NEAR(nearest_double(centre[2]), 1, 0x1p-12);
      // The spokes are nearly arcs of great circles.
      for (int i = 0; i < n; ++i) {
        const Piecewise<Rational, 4> curve = analyse(*split)->curves[n + i];
        for (const Rational& t : {Rational(1, 4), Rational(1, 2), Rational(3, 4)})
          EXPECT_NEAR(nearest_double(dot(edge_point(curve, t), edge_point(curve, t))), 1, 4e-3);
      }
    }
}

TEST(SplitFacesTest, FlatFacesStayFlat) {
  const Vector x{{2, 1, Rational(1, 3)}}, y{{-1, Rational(5, 7), 1}}, origin{{Rational(1, 9), 4, 5}};
  const auto at = [&](int a, int b) { return origin + Rational(a) * x + Rational(b) * y; };
  const CurveMesh mesh = one_face({at(0, 0), at(5, -1), at(7, 3), at(3, 6), at(-1, 4)});
  const Result<CurveMesh> split = split_faces(mesh);
  ASSERT_TRUE(split) << split.error().text();
  for (const MeshEdge& edge : split->edges)
    for (const Vector& p : edge.points) EXPECT_EQ(dot(p - origin, cross(x, y)), 0);
}

TEST(SplitFacesTest, Errors) {
  CurveMesh two = one_face({{{0, 0, 0}}, {{1, 0, 0}}});
  two.edges[1].points = {{{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0, 0, 0}}};
  const Result<CurveMesh> of_two = split_faces(two);
  ASSERT_FALSE(of_two);
  EXPECT_EQ(of_two.error().code, ErrorCode::wrong_side_count);

  const std::vector<Vector> corners{{{0, 0, 0}}, {{4, 0, 0}}, {{0, 4, 0}}};
  const Result<CurveMesh> on_a_line = split_faces(one_face(corners, {{{1, 1, 1}}, {{2, 2, 2}}, {{4, 4, 4}}}));
  ASSERT_FALSE(on_a_line);
  EXPECT_EQ(on_a_line.error().code, ErrorCode::parallel_tangents);
  EXPECT_EQ(on_a_line.error().where, "face F");

  CurveMesh broken = one_face(corners);
  broken.edges[1].degree = 2;
  EXPECT_EQ(split_faces(broken).error().code, ErrorCode::bad_degree);

  CurveMesh bent = validation::polyhedron_mesh(Polyhedron::icosahedron, 1, {0, 0, 0, 0, 0});
  bent.control_vectors.push_back({0, Rational(1, 3), Vector{{1, 0, 0}}, Vector{{0, 1, 0}}});
  EXPECT_EQ(split_faces(bent).error().code, ErrorCode::control_vectors_bent);
}

}  // namespace
}  // namespace patchproof
