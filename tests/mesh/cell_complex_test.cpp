// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/cell_complex.h"

#include "mesh/mesh_support.h"
#include "patchproof/scalar/integer.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Numbers = std::vector<Rational>;
using Corners = std::vector<int>;

template <std::size_t D>
void expect_counts(const std::array<int, D>& shape, std::size_t vertices, std::size_t cuboids, std::size_t simplices) {
  const auto boxes = cuboid_grid<Rational>(shape), tetrahedra = simplex_grid<Rational>(shape);
  EXPECT_EQ(boxes.vertices.size(), vertices);
  EXPECT_EQ(tetrahedra.vertices, boxes.vertices);
  EXPECT_EQ(boxes.cell_count(), cuboids);
  EXPECT_EQ(tetrahedra.cell_count(), simplices);
  EXPECT_EQ(boxes.dimension, static_cast<int>(D));
  EXPECT_EQ(boxes.corners_per_cell(), 1 << D);
  EXPECT_EQ(tetrahedra.corners_per_cell(), static_cast<int>(D) + 1);
  for (const Corners* corners : {&boxes.corners, &tetrahedra.corners})
    for (const int v : *corners) ASSERT_TRUE(0 <= v && v < static_cast<int>(vertices));
}

TEST(CellComplex, Law1_CountsOfGrids) {
  expect_counts(std::array<int, 0>{}, 1, 1, 1);
  expect_counts(std::array{1}, 2, 1, 1);
  expect_counts(std::array{20}, 21, 20, 20);
  expect_counts(std::array{32}, 33, 32, 32);
  expect_counts(std::array{20, 20}, 441, 400, 800);
  expect_counts(std::array{10, 36}, 407, 360, 720);
  expect_counts(std::array{2, 3, 4}, 60, 24, 144);
  expect_counts(std::array{2, 1, 3, 2}, 72, 12, 288);
  expect_counts(std::array{1, 1, 1, 1, 1}, 32, 1, 120);
}

TEST(CellComplex, TheGridOfTwoByTwo) {
  const auto grid = simplex_grid<Rational>(std::array{2, 2});
  std::vector<Vec<Rational, 2>> places;
  for (const Rational& y : {q(0), q(1, 2), q(1)})
    for (const Rational& x : {q(0), q(1, 2), q(1)}) places.push_back({{x, y}});
  EXPECT_EQ(grid.vertices, places);
  EXPECT_EQ(grid.corners, (Corners{0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 3, 4, 6, 4, 7, 6, 4, 5, 7, 5, 8, 7}));
  EXPECT_EQ(cuboid_grid<Rational>(std::array{2, 2}).corners, (Corners{0, 1, 3, 4, 1, 2, 4, 5, 3, 4, 6, 7, 4, 5, 7, 8}));
}

TEST(CellComplex, Law2_TheLastVertexIsTheEnd) {
  for (const int n : {1, 2, 3, 7, 10, 20, 49, 93, 1000}) {
    const auto grid = grid_on<double, 1>(CellKind::cuboid, {n}, {{{0.1, 0.7}}});
    EXPECT_EQ(grid.vertices.front()[0], 0.1);
    EXPECT_EQ(grid.vertices.back()[0], 0.7);
    EXPECT_EQ(cuboid_grid<double>(std::array{n}).vertices.back()[0], 1.0);
  }
  // What a sum of steps does instead.
  double sum = 0;
  for (int i = 0; i < 20; ++i) sum += 1.0 / 20;
  EXPECT_GT(sum, 1.0);
  const auto exact = grid_on<Rational, 2>(CellKind::simplex, {3, 2}, {{{q(1, 3), q(4)}, {q(-1), q(1, 7)}}});
  EXPECT_EQ(exact.vertices[5], (Vec<Rational, 2>{{q(1, 3) + q(11, 3) / 3, q(-3, 7)}}));
  EXPECT_EQ(exact.vertices.back(), (Vec<Rational, 2>{{q(4), q(1, 7)}}));
}

template <std::size_t D>
void expect_a_proper_grid(const std::array<std::vector<Rational>, D>& levels, int outer_facets) {
  const auto grid = grid_through<Rational, D>(CellKind::simplex, levels);
  Rational volume(1);
  for (const Numbers& x : levels) volume = volume * (x.back() - x.front());
  EXPECT_TRUE(all_positive(grid));
  EXPECT_EQ(total_volume(grid), volume);
  EXPECT_EQ(expect_facets_fit(grid), outer_facets);
}

TEST(CellComplex, Law3_SimplicesArePositiveAndShareFacets) {
  const Numbers x{q(-1), q(0), q(1, 3)}, y{q(2), q(5, 2), q(3), q(10)}, z{q(0), q(1)}, t{q(0), q(1), q(7, 3)};
  expect_a_proper_grid<1>({x}, 2);
  expect_a_proper_grid<2>({x, y}, 2 * (2 + 3));
  expect_a_proper_grid<3>({x, y, z}, 2 * 2 * (2 * 3 + 3 + 2));
  expect_a_proper_grid<4>({x, y, z, t}, 2 * 6 * (3 * 1 * 2 + 2 * 1 * 2 + 2 * 3 * 2 + 2 * 3 * 1));
  const auto unit = simplex_grid<Rational>(std::array{20, 20});
  EXPECT_EQ(total_volume(unit), q(1));
  EXPECT_EQ(simplex_grid<Rational>(std::array<int, 0>{}).corners, Corners{0});
}

// The negative control: cutting prisms over corners that were exchanged for orientation leaves sides that do not fit.
TEST(CellComplex, Law3_ATestThatCanFail) {
  auto grid = simplex_grid<Rational>(std::array{1, 1});
  std::swap(grid.corners[0], grid.corners[1]);
  EXPECT_FALSE(all_positive(grid));
  int equal_signs = 0;
  for (const auto& [facet, signs] : facet_signs(grid)) equal_signs += signs.size() == 2 && signs[0] == signs[1];
  EXPECT_EQ(equal_signs, 1);
}

TEST(CellComplex, Law4_ProductsOfGrids) {
  const Numbers x{q(-1), q(0), q(1, 3)}, y{q(2), q(5, 2)}, z{q(0), q(1), q(3)};
  const auto of = [](auto... levels) {
    return grid_through<Rational, sizeof...(levels)>(CellKind::cuboid, {levels...});
  };
  EXPECT_EQ(product(of(x), of(y)), of(x, y));
  EXPECT_EQ(product(product(of(x), of(y)), of(z)), of(x, y, z));
  EXPECT_EQ(product(of(x), product(of(y), of(z))), of(x, y, z));
  const auto point = grid_through<Rational, 0>(CellKind::cuboid, {});
  EXPECT_EQ(product(point, of(x, y)), of(x, y));
  EXPECT_EQ(product(of(x, y), point), of(x, y));
  EXPECT_THROW(product(simplex_grid<Rational>(std::array{2}), of(x)), contract_error);
}

TEST(CellComplex, Law5_CuboidsCutIntoSimplices) {
  const auto check = [](auto shape) {
    const auto cut = to_simplices(cuboid_grid<Rational>(shape));
    EXPECT_EQ(cut, simplex_grid<Rational>(shape));
  };
  check(std::array<int, 0>{});
  check(std::array{3});
  check(std::array{3, 2});
  check(std::array{2, 1, 3});
  check(std::array{2, 1, 2, 1});
  EXPECT_THROW(to_simplices(simplex_grid<Rational>(std::array{2, 2})), contract_error);
}

TEST(CellComplex, Law6_MapsMoveVerticesOnly) {
  const auto grid = simplex_grid<Rational>(std::array{4, 2});
  // Onto a cylinder that closes: the seam keeps its two columns of vertices.
  const auto mapped = map_vertices(grid, [](const Vec<Rational, 2>& p) {
    const Rational s = p[0] * (q(1) - p[0]);
    return Vec<Rational, 3>{{s, s * p[0], p[1]}};
  });
  EXPECT_EQ(mapped.corners, grid.corners);
  EXPECT_EQ(mapped.kind, CellKind::simplex);
  EXPECT_EQ(mapped.vertices.size(), grid.vertices.size());
  EXPECT_EQ(mapped.vertices[0], mapped.vertices[4]);
  EXPECT_EQ(mapped.vertices[6], (Vec<Rational, 3>{{q(3, 16), q(3, 64), q(1, 2)}}));
  const auto merged = merge_equal_vertices(mapped);
  EXPECT_EQ(merged.vertices.size(), mapped.vertices.size() - 3);
  EXPECT_EQ(merged.cell_count(), mapped.cell_count());
}

TEST(CellComplex, Law7_MergingKeepsPlacesAndOrder) {
  CellComplex<Rational, 1> lines{
      CellKind::simplex, 1, {{{q(3)}}, {{q(1)}}, {{q(3)}}, {{q(2)}}, {{q(1)}}, {{q(1)}}}, {0, 1, 2, 3, 4, 5}};
  const auto merged = merge_equal_vertices(lines);
  EXPECT_EQ(merged.vertices, (std::vector<Vec<Rational, 1>>{{{q(3)}}, {{q(1)}}, {{q(2)}}}));
  EXPECT_EQ(merged.corners, (Corners{0, 1, 0, 2, 1, 1}));
  EXPECT_EQ(merge_equal_vertices(merged), merged);
  // Near is not equal.
  const Rational near = q(1) + Rational(1) / Rational(Integer(1) << 80);
  const CellComplex<Rational, 1> two{CellKind::simplex, 1, {{{q(1)}}, {{near}}}, {0, 1}};
  EXPECT_EQ(merge_equal_vertices(two), two);
  // Two squares side by side share an edge after merging, and only then.
  const auto square = [](int x) {
    return grid_on<Rational, 2>(CellKind::simplex, {1, 1}, {{{q(x), q(x + 1)}, {q(0), q(1)}}});
  };
  auto pair = square(0);
  const auto right = square(1);
  for (const int v : right.corners) pair.corners.push_back(v + 4);
  pair.vertices.insert(pair.vertices.end(), right.vertices.begin(), right.vertices.end());
  EXPECT_EQ(expect_facets_fit(pair), 8);
  EXPECT_EQ(expect_facets_fit(merge_equal_vertices(pair)), 6);
  EXPECT_EQ(merge_equal_vertices(pair).vertices.size(), 6u);
  EXPECT_EQ(merge_equal_vertices(CellComplex<Rational, 2>{}).vertices.size(), 0u);
}

TEST(CellComplex, BrokenContracts) {
  EXPECT_THROW(cuboid_grid<Rational>(std::array{2, 0}), contract_error);
  EXPECT_THROW(simplex_grid<Rational>(std::array{-1}), contract_error);
  EXPECT_THROW((grid_on<Rational, 1>(CellKind::cuboid, {2}, {{{q(1), q(1)}}})), contract_error);
  EXPECT_THROW((grid_through<Rational, 1>(CellKind::cuboid, {Numbers{q(0)}})), contract_error);
  EXPECT_THROW((grid_through<Rational, 1>(CellKind::cuboid, {Numbers{q(0), q(2), q(2)}})), contract_error);
}

}  // namespace
}  // namespace patchproof
