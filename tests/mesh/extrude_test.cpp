// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/extrude.h"

#include "mesh/mesh_support.h"
#include "patchproof/scalar/quadratic.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Numbers = std::vector<Rational>;
using Corners = std::vector<int>;

CellComplex<Rational, 0> point() { return simplex_grid<Rational>(std::array<int, 0>{}); }

TEST(Extrude, Law1_CountsWithVoids) {
  const auto line = extrude(point(), Numbers{q(1, 2), q(-1, 3), q(2)});
  EXPECT_EQ(line.vertices, (std::vector<Vec<Rational, 1>>{{{q(0)}}, {{q(1, 2)}}, {{q(5, 6)}}, {{q(17, 6)}}}));
  EXPECT_EQ(line.corners, (Corners{0, 1, 2, 3}));
  const auto plane = extrude(line, Numbers{q(-1), q(1, 4), q(1), q(-2)});
  EXPECT_EQ(plane.vertices.size(), 5u * 4u);
  EXPECT_EQ(plane.cell_count(), 2u * 2u * 2u);
  EXPECT_EQ(plane.vertices.back(), (Vec<Rational, 2>{{q(17, 6), q(17, 4)}}));
  const auto solid = extrude(plane, Numbers{q(3)});
  EXPECT_EQ(solid.cell_count(), 3u * plane.cell_count());
  EXPECT_EQ(extrude(plane, Numbers{q(-3), q(-1)}).cell_count(), 0u);
  EXPECT_EQ(extrude(plane, Numbers{}).vertices.size(), plane.vertices.size());
}

TEST(Extrude, Law2And3_SignsAndVolumes) {
  const Numbers pattern{q(1, 2), q(-1, 3), q(2), q(1, 7)};
  const Rational filled = q(1, 2) + q(2) + q(1, 7);
  const auto line = extrude(point(), pattern);
  const auto plane = extrude(line, pattern);
  const auto solid = extrude(plane, pattern);
  const auto fourth = extrude(solid, pattern);
  EXPECT_TRUE(all_positive(line) && all_positive(plane) && all_positive(solid) && all_positive(fourth));
  EXPECT_EQ(total_volume(line), filled);
  EXPECT_EQ(total_volume(plane), filled * filled);
  EXPECT_EQ(total_volume(solid), filled * filled * filled);
  EXPECT_EQ(total_volume(fourth), filled * filled * filled * filled);
}

// One simplex with its corners in every order: the sign is handed on, the volume is h times the simplex's.
template <std::size_t N>
void expect_sign_is_inherited(std::vector<Vec<Rational, N>> places) {
  Corners order(N + 1);
  std::iota(order.begin(), order.end(), 0);
  do {
    const CellComplex<Rational, N> one{CellKind::simplex, static_cast<int>(N), places, order};
    const auto prism = extrude(one, Numbers{q(2, 3), q(5)});
    const Rational below = signed_volume(one, 0);
    Rational first(0);
    ASSERT_EQ(prism.cell_count(), 2 * (N + 1));
    for (std::size_t c = 0; c < prism.cell_count(); ++c) {
      EXPECT_EQ(signed_volume(prism, c) < 0, below < 0);
      if (c <= N) first += signed_volume(prism, c);
    }
    EXPECT_EQ(first, below * q(2, 3));
    EXPECT_EQ(total_volume(prism), below * (q(2, 3) + q(5)));
    expect_facets_fit(prism);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Extrude, Law2And3_WhateverTheOrderOfTheCorners) {
  expect_sign_is_inherited<0>({{}});
  expect_sign_is_inherited<1>({{{q(3)}}, {{q(-1)}}});
  expect_sign_is_inherited<2>({{{q(0), q(0)}}, {{q(2), q(1, 3)}}, {{q(1), q(4)}}});
  expect_sign_is_inherited<3>({{{q(0), q(0), q(1)}}, {{q(2), q(1), q(0)}}, {{q(1), q(4), q(2)}}, {{q(0), q(1), q(7)}}});
  expect_sign_is_inherited<4>({{{q(0), q(0), q(1), q(1)}},
                               {{q(2), q(1), q(0), q(0)}},
                               {{q(1), q(4), q(2), q(1)}},
                               {{q(0), q(1), q(7), q(0)}},
                               {{q(1), q(1), q(1), q(9)}}});
}

// A fan of triangles whose corners stand in no common order: the sides of the prisms must be cut alike all the same.
TEST(Extrude, Law4_PrismsShareTheirSides) {
  const std::vector<Vec<Rational, 2>> places{
      {{q(0), q(0)}}, {{q(1), q(0)}}, {{q(0), q(1)}}, {{q(-1), q(0)}}, {{q(0), q(-1)}}};
  const CellComplex<Rational, 2> fan{CellKind::simplex, 2, places, {2, 0, 1, 0, 2, 3, 3, 4, 0, 4, 1, 0}};
  ASSERT_TRUE(all_positive(fan));
  const auto solid = extrude(fan, Numbers{q(1), q(1)});
  EXPECT_TRUE(all_positive(solid));
  // Top and bottom of four triangles, four sides of two squares each.
  EXPECT_EQ(expect_facets_fit(solid), 2 * 4 + 4 * 2 * 2);
  EXPECT_EQ(total_volume(solid), q(4));
  const auto fourth = extrude(solid, Numbers{q(1, 2)});
  EXPECT_TRUE(all_positive(fourth));
  EXPECT_EQ(expect_facets_fit(fourth), 2 * 24 + 3 * 24);
}

// Windows cut over corners as they stand, exchanged ones among them: positive as well, and yet they do not fit.
TEST(Extrude, Law4_WithoutSortingTheSidesDoNotFit) {
  const auto base = simplex_grid<Rational>(std::array{2, 2});
  CellComplex<Rational, 3> careless = extrude(base, Numbers{q(1)});
  careless.corners.clear();
  for (std::size_t c = 0; c < base.cell_count(); ++c) {
    Corners sequence(base.cell(c).begin(), base.cell(c).end());
    for (int i = 0; i < 3; ++i) sequence.push_back(sequence[i] + 9);
    for (int k = 0; k < 3; ++k)
      careless.corners.insert(careless.corners.end(), sequence.begin() + k, sequence.begin() + k + 4);
  }
  EXPECT_TRUE(all_positive(careless));
  EXPECT_EQ(total_volume(careless), q(1));
  int single = 0;
  for (const auto& [facet, signs] : facet_signs(careless)) single += signs.size() == 1;
  EXPECT_GT(single, 2 * 8 + 8 * 2);
  EXPECT_EQ(expect_facets_fit(extrude(base, Numbers{q(1)})), 2 * 8 + 8 * 2);
}

TEST(Extrude, Law5_GridsByExtrusion) {
  const auto ones = [](int n) { return Numbers(n, Rational(1)); };
  const auto extruded = extrude(extrude(extrude(point(), ones(2)), ones(3)), ones(4));
  const auto grid = grid_on<Rational, 3>(CellKind::simplex, {2, 3, 4}, {{{q(0), q(2)}, {q(0), q(3)}, {q(0), q(4)}}});
  EXPECT_EQ(extruded, grid);
  EXPECT_EQ(extrude(grid, ones(2)).corners, simplex_grid<Rational>(std::array{2, 3, 4, 2}).corners);
}

TEST(Extrude, OtherScalars) {
  const Quadratic root(Rational(0), Rational(1), 2);
  const auto line = extrude(simplex_grid<Quadratic>(std::array<int, 0>{}), std::vector<Quadratic>{root, -root});
  EXPECT_EQ(line.vertices[2][0], root + root);
  EXPECT_EQ(signed_volume(line, 0), root);
  const auto plane = extrude(line, std::vector<Quadratic>{root});
  EXPECT_EQ(signed_volume(plane, 0) + signed_volume(plane, 1), Quadratic(2));
  EXPECT_EQ(extrude(simplex_grid<double>(std::array{3}), std::vector<double>{0.5}).vertices.back()[1], 0.5);
}

TEST(Extrude, SignedVolumeOfFlatSimplicesIsZero) {
  const CellComplex<Rational, 2> flat{
      CellKind::simplex, 2, {{{q(0), q(0)}}, {{q(1), q(2)}}, {{q(3), q(6)}}}, {0, 1, 2}};
  EXPECT_EQ(signed_volume(flat, 0), q(0));
  const CellComplex<Rational, 2> upright{
      CellKind::simplex, 2, {{{q(1), q(1)}}, {{q(1), q(3)}}, {{q(0), q(1)}}}, {0, 1, 2}};
  EXPECT_EQ(signed_volume(upright, 0), q(1));
}

TEST(Extrude, BrokenContracts) {
  EXPECT_THROW(extrude(cuboid_grid<Rational>(std::array{2, 2}), Numbers{q(1)}), contract_error);
  EXPECT_THROW(extrude(point(), Numbers{q(1), q(0)}), contract_error);
  EXPECT_THROW(signed_volume(cuboid_grid<Rational>(std::array{1}), 0), contract_error);
  EXPECT_THROW(signed_volume(simplex_grid<Rational>(std::array{1}), 1), contract_error);
}

}  // namespace
}  // namespace patchproof
