// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/tessellate_transfinite.h"

#include "mesh/mesh_support.h"
#include "patchproof/mesh/facets.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Solid = TransfiniteMap<Rational, 3, 4>;
using Surface = TransfiniteMap<Rational, 2, 4>;

Vec<Rational, 4> at(int x, int y, int z, int w = 1) { return {{q(x * w), q(y * w), q(z * w), q(w)}}; }

// Along x_0 a quadratic with a jump at 1, along x_1 a straight line, x_2 in the control points of one corner only.
Solid jumping() {
  const auto knots =
      KnotVector<Rational>::make(2, {q(0), q(0), q(0), q(1), q(1), q(1), q(2), q(4), q(4), q(4)}).value();
  const Solid up =
      Solid::bezier(2, {Solid(at(0, 0, 0)), Solid(at(0, 0, 3, 2)), Solid(at(0, 1, 5))}, q(-1), q(1)).value();
  std::vector<Solid> controls;
  for (int i = 0; i < 7; ++i)
    controls.push_back(
        Solid::bezier(1, {i == 2 ? up : Solid(at(i, 0, i % 2)), Solid(at(i, 2 + i % 3, 0, 1 + i % 2))}).value());
  return Solid::blend(0, knots, controls).value();
}

TEST(TessellateTransfinite, Law1_Samples) {
  const auto sampled = sample_map(jumping(), 3);
  ASSERT_EQ(sampled[0].size(), 2u);
  EXPECT_EQ(sampled[0][0].size(), 4u);
  EXPECT_EQ(sampled[0][0].back(), (DomainSample<Rational>{q(1), Side::left}));
  EXPECT_EQ(sampled[0][1].front(), (DomainSample<Rational>{q(1), Side::right}));
  EXPECT_EQ(sampled[0][1].size(), 7u);
  EXPECT_EQ(sampled[0][1][3], (DomainSample<Rational>{q(2), Side::right}));
  EXPECT_EQ(sampled[0][1].back(), (DomainSample<Rational>{q(4), Side::left}));
  EXPECT_EQ(sampled[1], (SampledDomain<Rational>{sample_spans(KnotVector<Rational>::bezier(1), 3)}));
  EXPECT_EQ(sampled[2][0].front().t, q(-1));
  // Nothing depends on anything: the unit cube.
  const auto constant = sample_map(Solid(at(1, 2, 3)), 1);
  for (const auto& direction : constant) EXPECT_EQ(direction, sample_spans(KnotVector<Rational>::bezier(1), 1));
}

TEST(TessellateTransfinite, Law2_VerticesLieOnTheMap) {
  const Solid map = jumping();
  const auto pieces = tessellate(map, 2).value();
  ASSERT_EQ(pieces.size(), 2u);
  const auto grids = domain_grids(sample_map(map, 2));
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(pieces[c].mesh.dimension, 3);
    EXPECT_EQ(pieces[c].mesh.corners, grids[c].complex.corners);
    for (std::size_t k = 0; k < grids[c].sides.size(); ++k) {
      const auto exact =
          project(evaluate(map, ParameterPlace<Rational, 3>(grids[c].complex.vertices[k].c, grids[c].sides[k])));
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(pieces[c].mesh.vertices[k][i], nearest_double(exact[i]), 1e-13);
    }
  }
  EXPECT_NE(pieces[0].mesh.vertices[2], pieces[1].mesh.vertices[0]);  // both limits at the jump
}

TEST(TessellateTransfinite, SurfacesHaveNormals) {
  const auto side = [](int x) { return Surface::bezier(1, {Surface(at(x, 0, 0)), Surface(at(x, 1, 0))}).value(); };
  const auto pieces = tessellate(Surface::bezier(0, {side(0), side(2)}).value(), 2).value();
  ASSERT_EQ(pieces.size(), 1u);
  for (const auto& n : pieces[0].normals) EXPECT_EQ(n, (Vec<double, 3>{{0, 0, 1}}));
}

TEST(TessellateTransfinite, Errors) {
  EXPECT_EQ(tessellate(Solid(Vec<Rational, 4>{{q(1), q(1), q(1), q(0)}}), 1).error().code, ErrorCode::vanishing_weight);
  EXPECT_EQ(tessellate(jumping(), 1000000000).error().code, ErrorCode::usage);
  EXPECT_THROW((void)tessellate(jumping(), 0), contract_error);
}

}  // namespace
}  // namespace patchproof
