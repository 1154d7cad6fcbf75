// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/domain_grid.h"

#include "mesh/mesh_support.h"
#include "patchproof/patch/bspline_patch.h"
#include "support/patches.h"

namespace patchproof {
namespace {

using namespace patchproof::test;

using Numbers = std::vector<Rational>;
using Samples = std::vector<DomainSample<Rational>>;

KnotVector<Rational> knots_of(int degree, const Numbers& knots) {
  return KnotVector<Rational>::make(degree, knots).value();
}

// Quadratic, with a jump at 1; cubic and smooth; linear, unclamped, with a jump at 2.
const KnotVector<Rational> jumps = knots_of(2, {q(0), q(0), q(0), q(1), q(1), q(1), q(3), q(4), q(4), q(4)});
const KnotVector<Rational> smooth = knots_of(3, {q(-1), q(0), q(0), q(1, 2), q(2), q(3), q(3), q(5)});
const KnotVector<Rational> steps = knots_of(1, {q(0), q(1), q(2), q(2), q(7, 2), q(5)});

TEST(DomainGrid, Law1_SamplesOfSpans) {
  const auto sampled = sample_spans(jumps, 2);
  ASSERT_EQ(sampled.size(), 2u);
  EXPECT_EQ(sampled[0], (Samples{{q(0), Side::right}, {q(1, 2), Side::right}, {q(1), Side::left}}));
  EXPECT_EQ(
      sampled[1],
      (Samples{
          {q(1), Side::right}, {q(2), Side::right}, {q(3), Side::right}, {q(7, 2), Side::right}, {q(4), Side::left}}));
  EXPECT_EQ(sample_spans(smooth, 3),
            (SampledDomain<Rational>{
                {{q(1, 2), Side::right}, {q(1), Side::right}, {q(3, 2), Side::right}, {q(2), Side::left}}}));
  EXPECT_EQ(sample_spans(jumps, 1)[1].size(), 3u);
  EXPECT_EQ(sample_spans(knots_of(0, {q(0), q(1), q(3)}), 1).size(), 2u);  // degree 0 jumps at every knot
  EXPECT_THROW(sample_spans(jumps, 0), contract_error);
}

TEST(DomainGrid, Law2_OneGridForEachChoiceOfComponents) {
  const std::array directions{sample_spans(jumps, 2), sample_spans(smooth, 3), sample_spans(steps, 1)};
  for (const CellKind kind : {CellKind::cuboid, CellKind::simplex}) {
    const auto grids = domain_grids(directions, kind);
    ASSERT_EQ(grids.size(), 2u * 1 * 2);
    for (std::size_t g = 0; g < grids.size(); ++g) {
      const auto& grid = grids[g];
      EXPECT_EQ(grid.component, (std::array<std::size_t, 3>{g % 2, 0, g / 2}));
      std::array<Numbers, 3> levels;
      for (int axis = 0; axis < 3; ++axis)
        for (const auto& s : directions[axis][grid.component[axis]]) levels[axis].push_back(s.t);
      EXPECT_EQ(grid.complex, grid_through(kind, levels));
      ASSERT_EQ(grid.sides.size(), grid.complex.vertices.size());
      for (std::size_t v = 0; v < grid.sides.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(grid.sides[v][axis] == Side::left, grid.complex.vertices[v][axis] == levels[axis].back());
    }
  }
  const auto point = domain_grids(std::array<SampledDomain<Rational>, 0>{});
  ASSERT_EQ(point.size(), 1u);
  EXPECT_EQ(point[0].complex.cell_count(), 1u);
}

TEST(DomainGrid, Law3_TheMapIsCalledForEachVertex) {
  const auto grids = domain_grids(std::array{sample_spans(jumps, 1), sample_spans(smooth, 2)});
  std::size_t calls = 0;
  const auto image = map_domain(grids[1], [&](const std::array<Rational, 2>& x, const std::array<Side, 2>& sides) {
    EXPECT_EQ(sides, grids[1].sides[calls++]);
    return Vec<Rational, 3>{{x[0], x[1], x[0] * x[1]}};
  });
  EXPECT_EQ(calls, grids[1].complex.vertices.size());
  EXPECT_EQ(image.corners, grids[1].complex.corners);
  EXPECT_EQ(image.vertices[1], (Vec<Rational, 3>{{q(3), q(1, 2), q(3, 2)}}));
}

TEST(DomainGrid, Law4_BothLimitsOfACurveAppear) {
  const BsplineCurve<Rational, 1> curve(jumps, {{{q(0)}}, {{q(1)}}, {{q(5)}}, {{q(9)}}, {{q(7)}}, {{q(3)}}, {{q(4)}}});
  const auto grids = domain_grids(std::array{sample_spans(jumps, 4)});
  ASSERT_EQ(grids.size(), 2u);
  const auto place = [&](const std::array<Rational, 1>& t, const std::array<Side, 1>& side) {
    return evaluate(curve, t[0], side[0]);
  };
  EXPECT_EQ(map_domain(grids[0], place).vertices.back()[0], q(5));
  EXPECT_EQ(map_domain(grids[1], place).vertices.front()[0], q(9));
  // Without the sides the first component would end on the other branch.
  const auto careless = [&](const std::array<Rational, 1>& t, const auto&) { return evaluate(curve, t[0]); };
  EXPECT_EQ(map_domain(grids[0], careless).vertices.back()[0], q(9));
}

TEST(DomainGrid, Law4_SurfacesAndSolids) {
  RandomRationals random;
  const BsplinePatch<Rational, 3> patch(jumps, steps, random.points<3>(7 * 4));
  const auto grids = domain_grids(std::array{sample_spans(jumps, 1), sample_spans(steps, 2)});
  ASSERT_EQ(grids.size(), 4u);
  const auto place = [&](const std::array<Rational, 2>& x, const std::array<Side, 2>& sides) {
    return evaluate(patch, x[0], x[1], sides[0], sides[1]);
  };
  std::vector<CellComplex<Rational, 3>> images;
  for (const auto& grid : grids) images.push_back(map_domain(grid, place));
  // The corner (1, 2) has four limits, one in each component.
  EXPECT_EQ(images[0].vertices.back(), evaluate(patch, q(1), q(2), Side::left, Side::left));
  EXPECT_EQ(images[3].vertices.front(), evaluate(patch, q(1), q(2), Side::right, Side::right));
  EXPECT_EQ(images[1].vertices[images[1].vertices.size() - 3], evaluate(patch, q(1), q(2), Side::right, Side::left));
  EXPECT_EQ(images[2].vertices[1], evaluate(patch, q(1), q(2), Side::left, Side::right));
  EXPECT_NE(images[0].vertices.back(), images[3].vertices.front());
  // A solid: the patch swept along a curve of the third parameter.
  const BsplineCurve<Rational, 3> path(jumps, random.points<3>(7));
  const auto solids = domain_grids(std::array{sample_spans(jumps, 1), sample_spans(steps, 1), sample_spans(jumps, 1)});
  ASSERT_EQ(solids.size(), 8u);
  const auto last = map_domain(solids[3], [&](const auto& x, const auto& sides) {
    return evaluate(patch, x[0], x[1], sides[0], sides[1]) + evaluate(path, x[2], sides[2]);
  });
  EXPECT_EQ(last.dimension, 3);
  EXPECT_EQ(last.vertices.back(), evaluate(patch, q(4), q(7, 2)) + evaluate(path, q(1), Side::left));
}

TEST(DomainGrid, SamplesByLengthServeAsWell) {
  const auto sampled = sample_domain(jumps, q(2));
  const auto grids = domain_grids(std::array{sampled.value()});
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].complex.cell_count(), 2u);
  EXPECT_EQ(grids[1].complex.cell_count(), 6u);
}

}  // namespace
}  // namespace patchproof
