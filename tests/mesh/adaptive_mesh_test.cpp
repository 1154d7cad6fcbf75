// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/adaptive_mesh.h"

#include <numeric>

#include "mesh/mesh_proofs.h"
#include "patchproof/patch/patch_knots.h"

namespace patchproof {
namespace {

using namespace test;

Result<CertifiedMesh> mesh_of(const std::vector<Patch>& patches, const MeshRequest& request,
                              CellMethod method = CellMethod::adaptive) {
  std::vector<const Patch*> all;
  for (const Patch& p : patches) all.push_back(&p);
  const auto match = match_edges(all);
  return adaptive_mesh(all, match.joins, match.collapsed, request, method);
}

// The octant turned about the z axis and mirrored: a whole sphere.
std::vector<Patch> sphere() {
  std::vector<Patch> out;
  for (const int x : {1, -1})
    for (const int y : {1, -1})
      for (const int z : {1, -1})
        out.push_back(map_points(octant(), [&](const Vec<Rational, 4>& p) {
          return Vec<Rational, 4>{{Rational(x) * p[0], Rational(y) * p[1], Rational(z) * p[2], p[3]}};
        }));
  return out;
}

// Two patches side by side; the second has other knots along the common edge.
std::vector<Patch> two_sides() {
  const auto f = [](int i, int j) { return (3 * i + j * j) % 5; };
  const Patch left = graph(clamped(3), clamped(3, {Rational(1, 2)}), f);
  Patch right = graph(clamped(2), clamped(3, {Rational(1, 2)}), [&](int i, int j) { return i == 0 ? f(3, j) : 0; });
  std::vector<Vec<Rational, 4>> net = right.net();
  for (auto& p : net) p[0] = p[0] + Rational(3);
  right = Patch(right.knots(Direction::u), right.knots(Direction::v), net);
  return {left, map_rows(right, Direction::v, [](const auto& c) { return insert_knot(c, Rational(1, 3), 1); })};
}

// The long side of one patch against two that share it.
std::vector<Patch> t_junction() {
  const auto flat = [](Rational x0, Rational x1, Rational y0, Rational y1, Rational lift) {
    std::vector<Vec<Rational, 4>> net;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        net.push_back({{x0 + (x1 - x0) * Rational(i, 2), y0 + (y1 - y0) * Rational(j, 2), i == 1 ? lift : Rational(0),
                        Rational(1)}});
    return Patch(clamped(2), clamped(2), net);
  };
  return {flat(0, 1, 0, 1, 0), flat(1, 2, 0, Rational(1, 3), 1), flat(1, 2, Rational(1, 3), 1, 2)};
}

double farthest(const std::vector<Patch>& patches, const CertifiedMesh& mesh, int n) {
  double out = 0;
  for (const Patch& p : patches)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) out = std::max(out, distance_to(point(p, double(i) / n, double(j) / n), mesh));
  return out;
}

TEST(AdaptiveMesh, Law1_3_SamplesLieWithinTheProvedError) {
  for (const auto& patches : {sphere(), two_sides(), t_junction(), {bumpy()}})
    for (const CellMethod method : {CellMethod::adaptive, CellMethod::regular}) {
      const MeshRequest request{.chord = 0.06};
      const auto mesh = mesh_of(patches, request, method);
      ASSERT_TRUE(mesh) << mesh.error().text();
      EXPECT_TRUE(is_proved(*mesh, request));
      const double truth = farthest(patches, *mesh, 11);
      EXPECT_LE(truth, mesh->chord * (1 + 1e-9));
      EXPECT_GT(truth, mesh->chord / 30);  // a bound that is far off is a mistake too
    }
}

TEST(AdaptiveMesh, Law2_NormalsOfASphereAreNearThoseOfItsTriangles) {
  const MeshRequest request{.chord = 0.1, .angle = 8};
  const auto mesh = mesh_of(sphere(), request);
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(is_proved(*mesh, request));
  EXPECT_GT(mesh->collapsed, 0u);
  for (const auto& t : mesh->triangles) {
    const auto& a = mesh->vertices[t[0]];
    Vec<double, 3> n = cross(mesh->vertices[t[1]] - a, mesh->vertices[t[2]] - a);
    for (const int v : t)  // outside is away from the centre
      EXPECT_GE(dot(n, mesh->vertices[v]) / std::sqrt(dot(n, n)), std::cos(mesh->angle * 3.1416 / 180));
  }
}

TEST(AdaptiveMesh, Law4_NothingHangsBetweenPatches) {
  for (const CellMethod method : {CellMethod::adaptive, CellMethod::regular}) {
    const auto closed = mesh_of(sphere(), {.chord = 0.01}, method);
    ASSERT_TRUE(closed);
    EXPECT_TRUE(check_watertight(*closed).is_closed());
    EXPECT_TRUE(check_watertight(*closed).oriented);
    const auto count = static_cast<long>(closed->vertices.size()), faces = static_cast<long>(closed->triangles.size());
    EXPECT_EQ(count - static_cast<long>(check_watertight(*closed).edges) + faces, 2);  // Euler
    for (const auto& patches : {two_sides(), t_junction()}) {
      const auto open = mesh_of(patches, {.chord = 0.08, .angle = 25}, method);
      ASSERT_TRUE(open);
      const Watertight w = check_watertight(*open);
      EXPECT_TRUE(w.is_watertight()) << w.cracks;
      EXPECT_GT(w.free, 0u);
      const auto n = static_cast<long>(open->vertices.size()) - static_cast<long>(w.edges) +
                     static_cast<long>(open->triangles.size());
      EXPECT_EQ(n, 1);  // one disk: nothing is open inside
    }
  }
}

TEST(AdaptiveMesh, Law4_AGapThatIsJoinedIsPartOfTheError) {
  std::vector<Patch> patches = two_sides();
  std::vector<Vec<Rational, 4>> net = patches[1].net();
  for (auto& p : net) p[2] = p[2] + Rational(1, 1000);
  patches[1] = Patch(patches[1].knots(Direction::u), patches[1].knots(Direction::v), net);
  const std::vector<const Patch*> all{&patches[0], &patches[1]};
  const auto match = match_edges(all, 0.01);
  ASSERT_EQ(match.joins.size(), 1u);
  const auto mesh = adaptive_mesh(all, match.joins, match.collapsed, {.chord = 0.01});
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_watertight(*mesh).is_watertight());
  EXPECT_NEAR(mesh->gap, 0.001, 1e-9);
  EXPECT_LE(farthest(patches, *mesh, 11), mesh->chord);
  const auto fine = adaptive_mesh(all, match.joins, match.collapsed, {.chord = 0.0005});
  ASSERT_TRUE(fine);
  EXPECT_GT(fine->chord_misses, 0u);  // it cannot be had, and is said
  EXPECT_FALSE(fine->notes.empty());
}

TEST(AdaptiveMesh, Law5_APatchKeepsOneSide) {
  const auto mesh = mesh_of({bumpy()}, {.chord = 0.05});
  ASSERT_TRUE(mesh);
  int up = 0;
  for (const auto& t : mesh->triangles) {
    const auto& a = mesh->vertices[t[0]];
    up += cross(mesh->vertices[t[1]] - a, mesh->vertices[t[2]] - a)[2] > 0;
  }
  EXPECT_TRUE(up == 0 || up == static_cast<int>(mesh->triangles.size()));
}

TEST(AdaptiveMesh, Law6_TheSameForAnyNumberOfJobs) {
  const auto one = mesh_of(sphere(), {.chord = 0.01, .angle = 8, .jobs = 1}),
             many = mesh_of(sphere(), {.chord = 0.01, .angle = 8, .jobs = 4});
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->triangles, many->triangles);
  EXPECT_TRUE(one->vertices == many->vertices);
  EXPECT_EQ(one->chord, many->chord);
}

TEST(AdaptiveMesh, ANormalWithoutALimitIsSaid) {
  // A cone whose tip is inside of the patch's edge: the angle cannot be had there, and the work ends.
  std::vector<Vec<Rational, 4>> net;
  for (const int x : {0, 1, 2})
    for (const int r : {0, 1})
      net.push_back({{Rational(r * (x - 1)), Rational(r * (x == 1 ? 3 : 0)), Rational(r), Rational(1)}});
  const Patch cone(clamped(2), clamped(1), net);
  const auto mesh = mesh_of({cone}, {.chord = 0.01, .angle = 2});
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->chord_misses, 0u);
  Vec<Rational, 4> twice = net[1];
  net[3] = net[5] = twice;  // now the normal is zero everywhere
  const auto line = mesh_of({Patch(clamped(2), clamped(1), net)}, {.chord = 0.01, .angle = 2});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->chord_misses, 0u);
  EXPECT_EQ(line->triangles.size() > 0 ? line->angle_misses > 0 : true, true);
}

TEST(AdaptiveMesh, TornPatchesAreMeshedInParts) {
  std::vector<Rational> knots{0, 0, 1, 1, 2, 2};
  std::vector<Vec<Rational, 4>> net;
  for (const int x : {0, 1, 1, 2})
    for (const int y : {0, 1})
      net.push_back({{Rational(x), Rational(y), Rational(net.size() >= 4 ? 5 : 0), Rational(1)}});
  const Patch torn(KnotVector<Rational>::make_unchecked(1, knots), clamped(1), net);
  const auto parts = split_torn(torn);
  ASSERT_EQ(parts.size(), 2u);
  const auto mesh = mesh_of(parts, {.chord = 0.01});
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), 4u);
  EXPECT_EQ(mesh->vertices.size(), 8u);
  EXPECT_EQ(split_torn(bumpy()).size(), 1u);
}

TEST(AdaptiveMesh, BadRequestsAreNamed) {
  for (const MeshRequest& request :
       {MeshRequest{.chord = 0}, MeshRequest{.chord = -1}, MeshRequest{.chord = std::nan("")},
        MeshRequest{.chord = 1e300 * 1e300}, MeshRequest{.chord = 1, .angle = 0},
        MeshRequest{.chord = 1, .angle = std::nan("")}, MeshRequest{.chord = 1, .angle = 181},
        MeshRequest{.chord = 1e-6, .angle = 180, .max_triangles = 1000}}) {
    const auto mesh = mesh_of({bumpy()}, request);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace patchproof
