// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/watertight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchproof {
namespace {

CertifiedMesh tetrahedron() {
  CertifiedMesh mesh;
  mesh.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesh.faces = {0, 1, 2, 3};
  return mesh;
}

double volume(const CertifiedMesh& mesh) {
  double out = 0;
  for (const auto& t : mesh.triangles) out += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
  return out;
}

TEST(Watertight, Law1_AnEdgeOfOneTriangleIsACrackUnlessItIsFree) {
  CertifiedMesh mesh = tetrahedron();
  EXPECT_TRUE(check_watertight(mesh).is_closed());
  mesh.triangles.pop_back();
  mesh.faces.pop_back();
  const Watertight open = check_watertight(mesh);
  EXPECT_EQ(open.cracks, 3u);
  EXPECT_FALSE(open.is_watertight());
  mesh.free = {{2, 0}, {0, 3}, {3, 2}};
  const Watertight declared = check_watertight(mesh);
  EXPECT_EQ(declared.cracks, 0u);
  EXPECT_EQ(declared.free, 3u);
  EXPECT_TRUE(declared.is_watertight());
  EXPECT_FALSE(declared.is_closed());
}

TEST(Watertight, Law2_MoreThanTwoTrianglesBranch) {
  CertifiedMesh mesh = tetrahedron();
  mesh.vertices.push_back({{2, 2, 2}});
  mesh.triangles.push_back({0, 1, 4});
  mesh.faces.push_back(4);
  EXPECT_EQ(check_watertight(mesh).branching, 1u);
  EXPECT_FALSE(check_watertight(mesh).is_watertight());
}

TEST(Watertight, Law3_EachEdgeRunsBothWays) {
  CertifiedMesh mesh = tetrahedron();
  EXPECT_TRUE(check_watertight(mesh).oriented);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_FALSE(check_watertight(mesh).oriented);
}

TEST(Watertight, Law4_OnlyTheDoublesCount) {
  CertifiedMesh mesh = tetrahedron();
  mesh.vertices.push_back(mesh.vertices[3]);
  mesh.vertices[0] = {{-0.0, 0, 0}};
  mesh.vertices.push_back({{0, 0, 0}});
  mesh.triangles[1] = {5, 1, 4};
  EXPECT_TRUE(check_watertight(mesh).is_closed());
  mesh.vertices[4][2] = std::nextafter(1.0, 2.0);  // one unit in the last place
  EXPECT_EQ(check_watertight(mesh).cracks, 4u);
}

TEST(Watertight, Law5_OrientTurnsWholeFacesOutwards) {
  CertifiedMesh mesh = tetrahedron();
  for (const std::size_t turned : {0, 2}) std::swap(mesh.triangles[turned][0], mesh.triangles[turned][1]);
  orient(mesh);
  EXPECT_TRUE(check_watertight(mesh).oriented);
  EXPECT_GT(volume(mesh), 0);
  mesh = tetrahedron();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  orient(mesh);
  EXPECT_GT(volume(mesh), 0);
}

TEST(Watertight, Law5_AMoebiusStripIsNotOrientable) {
  CertifiedMesh mesh;
  constexpr int n = 5;
  for (int k = 0; k < n; ++k) mesh.vertices.push_back({{std::cos(k * 1.25), std::sin(k * 1.25), k * 0.1}});
  for (int k = 0; k < n; ++k) {  // five triangles on five vertices
    mesh.triangles.push_back({k, (k + 1) % n, (k + 2) % n});
    mesh.faces.push_back(k);
  }
  orient(mesh);
  EXPECT_FALSE(check_watertight(mesh).oriented);
}

}  // namespace
}  // namespace patchproof
