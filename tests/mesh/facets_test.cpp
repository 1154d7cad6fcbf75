// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/facets.h"

#include "mesh/mesh_support.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Corners = std::vector<int>;

// Σ det(a − o, b − o, c − o)/6 over the triangles: the volume that they enclose when their facets fit.
Rational enclosed(const CellComplex<Rational, 3>& triangles, const Vec<Rational, 3>& o) {
  Rational sum(0);
  for (std::size_t c = 0; c < triangles.cell_count(); ++c) {
    const auto at = [&](int i) { return triangles.vertices[triangles.cell(c)[i]] - o; };
    sum += dot(cross(at(0), at(1)), at(2)) / 6;
  }
  return sum;
}

TEST(Facets, Law1_CountsOnTheBoundaryOfGrids) {
  const auto cuboids = boundary(cuboid_grid<Rational>(std::array{2, 3, 4}));
  EXPECT_EQ(cuboids.cell_count(), 2u * (6 + 12 + 8));
  EXPECT_EQ(cuboids.dimension, 2);
  EXPECT_EQ(cuboids.vertices.size(), 60u);
  EXPECT_EQ(boundary(simplex_grid<Rational>(std::array{2, 3, 4})).cell_count(), 2u * 2 * (6 + 12 + 8));
  EXPECT_EQ(boundary(cuboid_grid<Rational>(std::array{5, 3})).cell_count(), 16u);
  EXPECT_EQ(boundary(simplex_grid<Rational>(std::array{5, 3})).cell_count(), 16u);
  EXPECT_EQ(boundary(cuboid_grid<Rational>(std::array{4})).corners, (Corners{0, 4}));
  EXPECT_EQ(boundary(simplex_grid<Rational>(std::array{4})).corners, (Corners{0, 4}));
  EXPECT_THROW(boundary(cuboid_grid<Rational>(std::array<int, 0>{})), contract_error);
}

TEST(Facets, Law2_TheBoundaryHasNoBoundary) {
  const auto check = [](const auto& complex) {
    EXPECT_EQ(boundary(boundary(complex)).cell_count(), 0u);
    EXPECT_GT(boundary(complex).cell_count(), 0u);
  };
  check(cuboid_grid<Rational>(std::array{2, 3}));
  check(simplex_grid<Rational>(std::array{2, 3}));
  check(cuboid_grid<Rational>(std::array{2, 1, 2}));
  check(simplex_grid<Rational>(std::array{2, 1, 2}));
  check(simplex_grid<Rational>(std::array{1, 2, 1, 2}));
}

TEST(Facets, Law3_TheBoundaryEnclosesTheVolume) {
  const std::array<int, 3> shape{2, 1, 3};
  const std::array<std::array<Rational, 2>, 3> box{{{q(-1), q(2)}, {q(0), q(1, 3)}, {q(5), q(7)}}};
  for (const Vec<Rational, 3>& o : {Vec<Rational, 3>{{q(0), q(0), q(0)}}, Vec<Rational, 3>{{q(7), q(-2), q(1, 9)}}}) {
    EXPECT_EQ(enclosed(boundary(grid_on(CellKind::simplex, shape, box)), o), q(2));
    EXPECT_EQ(enclosed(to_simplices(boundary(grid_on(CellKind::cuboid, shape, box))), o), q(2));
  }
  // An L-shaped region by extrusion, so that the boundary is no box.
  auto corner = simplex_grid<Rational>(std::array{2, 2});
  corner.corners.resize(corner.corners.size() - 6);
  EXPECT_EQ(enclosed(boundary(extrude(corner, {q(1), q(2)})), {{q(3), q(1), q(4)}}), q(3, 4) * 3);
  // In the plane: twice the area is the sum of the edges' cross products.
  for (const CellKind kind : {CellKind::cuboid, CellKind::simplex}) {
    const auto edges = boundary(grid_on<Rational, 2>(kind, {3, 2}, {{{q(1), q(4)}, {q(2), q(9, 2)}}}));
    Rational doubled(0);
    for (std::size_t c = 0; c < edges.cell_count(); ++c) {
      const auto &a = edges.vertices[edges.cell(c)[0]], &b = edges.vertices[edges.cell(c)[1]];
      doubled += a[0] * b[1] - a[1] * b[0];
    }
    EXPECT_EQ(doubled, q(15));
  }
}

}  // namespace
}  // namespace patchproof
