// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/trimmed_mesh.h"

#include <deque>

#include "mesh/mesh_proofs.h"
#include "patchproof/mesh/delaunay.h"

#ifdef PATCHPROOF_HAVE_DELAUNAY

namespace patchproof {
namespace {

using namespace test;
using Curve = BsplineCurve<Rational, 3>;

// The unit circle on [0, 4], exactly: (w x, w y, w), C1.
const std::vector<Vec<Rational, 3>>& circle_points() {
  static const std::vector<Vec<Rational, 3>> points = [] {
    std::vector<Vec<Rational, 3>> out;
    const int p[9][3] = {{1, 0, 1},   {1, 1, 1},  {0, 2, 2},  {-1, 1, 1}, {-1, 0, 1},
                         {-1, -1, 1}, {0, -2, 2}, {1, -1, 1}, {1, 0, 1}};
    for (const auto& q : p) out.push_back({{Rational(q[0]), Rational(q[1]), Rational(q[2])}});
    return out;
  }();
  return points;
}

KnotVector<Rational> circle_knots() {
  return KnotVector<Rational>::make_unchecked(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4});
}

Curve circle(const Rational& radius) {
  std::vector<Vec<Rational, 3>> points = circle_points();
  for (auto& p : points) p = {{radius * p[0], radius * p[1], p[2]}};
  return Curve(circle_knots(), points);
}

Curve line(Vec<Rational, 2> a, Vec<Rational, 2> b, const Rational& length) {
  return Curve(KnotVector<Rational>::make_unchecked(1, {0, 0, length, length}), {{{a[0], a[1], 1}}, {{b[0], b[1], 1}}});
}

Patch plane(const Rational& z) {
  std::vector<Vec<Rational, 4>> net;
  for (const int x : {-2, 2})
    for (const int y : {-2, 2}) net.push_back({{Rational(x), Rational(y), z, Rational(1)}});
  const auto knots = KnotVector<Rational>::make_unchecked(1, {-2, -2, 2, 2});
  return Patch(knots, knots, net);
}

Patch cylinder(const Rational& radius, const Rational& height) {
  std::vector<Vec<Rational, 4>> net;
  for (const auto& p : circle_points())
    for (const int top : {0, 1}) net.push_back({{radius * p[0], radius * p[1], p[2] * height * Rational(top), p[2]}});
  return Patch(circle_knots(), clamped(1), net);
}

// Faces and edges that keep what they point to.
struct Solid {
  std::deque<Patch> surfaces;
  std::deque<Curve> curves;
  std::vector<TrimmedFace> faces;
  std::vector<TrimmedEdge> edges;

  int face(Patch surface, const char* label) {
    surfaces.push_back(std::move(surface));
    faces.push_back({label, &surfaces.back()});
    return static_cast<int>(faces.size()) - 1;
  }
  TrimmedUse use(int face, bool forward, Curve curve) {
    curves.push_back(std::move(curve));
    return {face, forward, &curves.back()};
  }
  Result<CertifiedMesh> mesh(const MeshRequest& request) const {
    return trimmed_mesh(faces, edges, request, constrained_delaunay);
  }
};

// A wall around the circle with this radius between z = 0 and z = 2, and its two edges' uses on it.
void add_wall(Solid& s, const Rational& radius, int bottom, int top, bool inwards) {
  const int wall = s.face(cylinder(radius, 2), "wall");
  s.edges.push_back(
      {"bottom", {s.use(bottom, !inwards, circle(radius)), s.use(wall, true, line({{0, 0}}, {{4, 0}}, 4))}});
  s.edges.push_back({"top", {s.use(top, !inwards, circle(radius)), s.use(wall, false, line({{0, 1}}, {{4, 1}}, 4))}});
  s.edges.push_back(
      {"seam", {s.use(wall, true, line({{4, 0}}, {{4, 1}}, 1)), s.use(wall, false, line({{0, 0}}, {{0, 1}}, 1))}});
}

// A thick tube.
Solid tube() {
  Solid s;
  const int bottom = s.face(plane(0), "bottom"), top = s.face(plane(2), "top");
  add_wall(s, Rational(3, 2), bottom, top, false);
  add_wall(s, Rational(1, 2), bottom, top, true);
  return s;
}

Solid dome() {
  Solid s;
  const int face = s.face(octant(), "dome");
  s.edges.push_back({"equator", {s.use(face, true, line({{0, 0}}, {{1, 0}}, 1))}});
  s.edges.push_back({"left", {s.use(face, false, line({{0, 0}}, {{0, 1}}, 1))}});
  s.edges.push_back({"right", {s.use(face, true, line({{1, 0}}, {{1, 1}}, 1))}});
  return s;
}

TEST(TrimmedMesh, Law1_3_SamplesOfTheFacesLieWithinTheProvedError) {
  const MeshRequest request{.chord = 0.01};
  const auto mesh = tube().mesh(request);
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_TRUE(is_proved(*mesh, request));
  double truth = 0;
  for (int k = 0; k < 200; ++k) {
    const double a = k * 6.283185307179586 / 200;
    for (const double r : {0.5, 0.7, 1.0, 1.5}) {
      if (r == 0.5 || r == 1.5) truth = std::max(truth, distance_to({{r * std::cos(a), r * std::sin(a), 0.7}}, *mesh));
      for (const double z : {0.0, 2.0})
        truth = std::max(truth, distance_to({{r * std::cos(a), r * std::sin(a), z}}, *mesh));
    }
  }
  EXPECT_LE(truth, mesh->chord * (1 + 1e-9));
  EXPECT_GT(truth, mesh->chord / 10);
  for (const auto& v : mesh->vertices) {  // and the other way round: nothing is where no face is
    const double r = std::hypot(v[0], v[1]);
    EXPECT_LE(r, 1.5 + 1e-12);
    EXPECT_GE(r, 0.5 - 1e-12);
  }
}

TEST(TrimmedMesh, Law2_Normals) {
  const MeshRequest request{.chord = 0.5, .angle = 5};
  const auto mesh = tube().mesh(request);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(is_proved(*mesh, request));
  for (const auto& t : mesh->triangles) {
    const auto& a = mesh->vertices[t[0]];
    Vec<double, 3> n = cross(mesh->vertices[t[1]] - a, mesh->vertices[t[2]] - a);
    const double size = std::sqrt(dot(n, n));
    if (std::abs(n[2]) > 0.5 * size) continue;
    for (const int v : t) {
      const auto& p = mesh->vertices[v];
      EXPECT_GE(std::abs(n[0] * p[0] + n[1] * p[1]) / (size * std::hypot(p[0], p[1])),
                std::cos(mesh->angle * 3.1416 / 180));
    }
  }
}

TEST(TrimmedMesh, Law4_ATubeIsClosed) {
  for (const double chord : {0.1, 0.01, 0.001}) {
    const auto mesh = tube().mesh({.chord = chord});
    ASSERT_TRUE(mesh);
    const Watertight w = check_watertight(*mesh);
    EXPECT_TRUE(w.is_closed()) << w.cracks;
    EXPECT_TRUE(w.oriented);
    EXPECT_EQ(static_cast<long>(mesh->vertices.size()) - static_cast<long>(w.edges) +
                  static_cast<long>(mesh->triangles.size()),
              0);
    double volume = 0;
    for (const auto& t : mesh->triangles)
      volume += dot(mesh->vertices[t[0]], cross(mesh->vertices[t[1]], mesh->vertices[t[2]])) / 6;
    EXPECT_NEAR(volume, 2 * 3.14159265 * (2.25 - 0.25), 30 * chord);
  }
}

TEST(TrimmedMesh, Law2_4_APoleIsOneVertex) {
  const MeshRequest request{.chord = 0.003, .angle = 8};
  const auto mesh = dome().mesh(request);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(is_proved(*mesh, request));
  EXPECT_GT(mesh->collapsed, 0u);
  const Watertight w = check_watertight(*mesh);
  EXPECT_TRUE(w.is_watertight());
  EXPECT_EQ(std::count(mesh->vertices.begin(), mesh->vertices.end(), Vec<double, 3>{{0, 0, 1}}), 1);
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 12; ++j)
      EXPECT_LE(distance_to(point(octant(), i / 12.0, j / 12.0), *mesh), mesh->chord * (1 + 1e-9));
}

TEST(TrimmedMesh, Law5_TheSameForAnyNumberOfJobs) {
  const auto one = tube().mesh({.chord = 0.01, .jobs = 1}), many = tube().mesh({.chord = 0.01, .jobs = 4});
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->triangles, many->triangles);
  EXPECT_TRUE(one->vertices == many->vertices);
}

TEST(TrimmedMesh, Law6_AFaceThatDoesNotCloseIsSaid) {
  Solid s = tube();
  s.edges.pop_back();  // the seam of the inner wall
  const auto mesh = s.mesh({.chord = 0.01});
  ASSERT_TRUE(mesh);
  EXPECT_GT(mesh->chord_misses, 0u);
  ASSERT_EQ(mesh->notes.size(), 1u);
  EXPECT_NE(mesh->notes[0].find("do not close"), std::string::npos);
  EXPECT_FALSE(check_watertight(*mesh).is_watertight());
}

TEST(TrimmedMesh, Law6_LoopsThatCrossAreSaid) {
  Solid s;
  const int face = s.face(plane(0), "plane");
  for (const int shift : {0, 1}) {
    std::vector<Vec<Rational, 3>> points = circle(Rational(1, 2)).points();
    for (auto& p : points) p[0] = p[0] + p[2] * Rational(shift, 2);
    s.edges.push_back({"circle", {s.use(face, true, Curve(circle_knots(), points))}});
  }
  const auto mesh = s.mesh({.chord = 0.01});
  ASSERT_TRUE(mesh);
  EXPECT_GT(mesh->chord_misses, 0u);
  ASSERT_EQ(mesh->notes.size(), 1u);
  EXPECT_NE(mesh->notes[0].find("loops"), std::string::npos);
}

TEST(TrimmedMesh, AnEdgeBesideTheFaceIsPartOfTheError) {
  Solid s = tube();
  s.curves.push_back(circle(Rational(1501, 1000)));  // the bottom's own idea of the edge
  s.edges[0].uses[0].parameters = &s.curves.back();
  const auto mesh = s.mesh({.chord = 0.01});
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_watertight(*mesh).is_closed());
  EXPECT_NEAR(mesh->gap, 0.001, 1e-4);
  EXPECT_EQ(mesh->chord_misses, 0u);
  const auto fine = s.mesh({.chord = 0.0005});
  ASSERT_TRUE(fine);
  EXPECT_GT(fine->chord_misses, 0u);
}

TEST(TrimmedMesh, BadRequestsAreNamed) {
  EXPECT_EQ(tube().mesh({.chord = 0}).error().code, ErrorCode::usage);
  EXPECT_EQ(tube().mesh({.chord = 1e-5, .max_triangles = 100}).error().code, ErrorCode::usage);
  EXPECT_EQ(Solid().mesh({.chord = 1}).error().code, ErrorCode::wrong_count);
}

}  // namespace
}  // namespace patchproof

#else

TEST(TrimmedMesh, NeedsATriangulator) { GTEST_SKIP() << "built without patchproof::delaunay"; }

#endif
