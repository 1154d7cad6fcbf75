// SPDX-License-Identifier: Apache-2.0
// Grids of spline domains: products of sampled domains whose vertices carry their parameters and their sides.
//
//   A spline may jump at an inner knot of multiplicity ≥ p + 1. Its domain is therefore cut into components, and there is
//   one grid for each choice of a component in every direction. The last parameter of a component has Side::left: the map
//   is evaluated there as the limit from inside, so that no cell reaches across a jump.
//
// sample_spans cuts each non-empty span into the same number of cells, whatever its length (sample_domain of
// spline_domain.h: by length).
//
// ENSURES   (1) sample_spans: cells_per_span cells in each span; one list for each component; it begins with the
//               component's begin and ends with exactly its end, Side::left; all others have Side::right, and all breaks
//               are among them;
//           (2) domain_grids: one grid for each choice of components, those of direction 0 running fastest, over exactly
//               the samples of the components, vertices as in cell_complex.h, sides[v] beside vertex v;
//           (3) map_domain calls the map once for each vertex, with its parameters and sides, and leaves the cells;
//           (4) with the map of a spline, an image in one component is continuous, and both limits at a jump appear, each
//               in its own component.
// REQUIRES  cells_per_span ≥ 1; samples as sample_spans and sample_domain make them; parameters that increase strictly
//           (exact knots always, doubles when no span is as short as rounding).
// SCALARS   K: OrderedField; the map returns a Vec of any scalar and length.
// COST      one call of the map for each vertex.
// NEIGHBOURS spline_domain.h, cell_complex.h, tessellate.h.
// TEST      tests/mesh/domain_grid_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "patchproof/mesh/cell_complex.h"
#include "patchproof/spline/spline_domain.h"

namespace patchproof {

// The samples of each component of one direction.
template <OrderedField K>
using SampledDomain = std::vector<std::vector<DomainSample<K>>>;

template <OrderedField K, std::size_t D>
struct DomainGrid {
  CellComplex<K, D> complex;               // vertices: parameters
  std::vector<std::array<Side, D>> sides;  // of each vertex
  std::array<std::size_t, D> component{};  // which one, in each direction
};

template <OrderedField K>
SampledDomain<K> sample_spans(const KnotVector<K>& knots, int cells_per_span);

template <OrderedField K, std::size_t D>
std::vector<DomainGrid<K, D>> domain_grids(const std::array<SampledDomain<K>, D>& directions,
                                           CellKind kind = CellKind::cuboid);

// The complex whose vertices are f(parameters, sides).
template <OrderedField K, std::size_t D, class F>
auto map_domain(const DomainGrid<K, D>& grid, F f);

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField K>
SampledDomain<K> sample_spans(const KnotVector<K>& knots, int cells_per_span) {
  PATCHPROOF_REQUIRES(cells_per_span >= 1, "sample_spans: at least one cell in each span");
  const std::vector<K> breaks = knots.breaks();
  SampledDomain<K> out;
  std::size_t s = 0;
  for (const DomainComponent<K>& component : components(knots)) {
    std::vector<DomainSample<K>> samples;
    for (; s + 1 < breaks.size() && breaks[s] < component.end; ++s)
      for (int j = 0; j < cells_per_span; ++j)
        samples.push_back(
            {j == 0 ? breaks[s] : breaks[s] + (breaks[s + 1] - breaks[s]) * K(j) / K(cells_per_span), Side::right});
    samples.push_back({component.end, Side::left});
    out.push_back(std::move(samples));
  }
  return out;
}

template <OrderedField K, std::size_t D>
std::vector<DomainGrid<K, D>> domain_grids(const std::array<SampledDomain<K>, D>& directions, CellKind kind) {
  std::vector<DomainGrid<K, D>> out;
  std::size_t choices = 1;
  for (const SampledDomain<K>& direction : directions) choices *= direction.size();
  for (std::size_t choice = 0; choice < choices; ++choice) {
    DomainGrid<K, D> grid;
    std::array<std::vector<K>, D> levels;
    std::size_t rest = choice;
    for (std::size_t axis = 0; axis < D; ++axis) {
      grid.component[axis] = rest % directions[axis].size();
      rest /= directions[axis].size();
      for (const DomainSample<K>& sample : directions[axis][grid.component[axis]]) levels[axis].push_back(sample.t);
    }
    grid.complex = grid_through(kind, levels);
    for (std::size_t v = 0; v < grid.complex.vertices.size(); ++v) {
      std::array<Side, D> sides{};
      rest = v;
      for (std::size_t axis = 0; axis < D; ++axis) {
        sides[axis] = directions[axis][grid.component[axis]][rest % levels[axis].size()].side;
        rest /= levels[axis].size();
      }
      grid.sides.push_back(sides);
    }
    out.push_back(std::move(grid));
  }
  return out;
}

template <OrderedField K, std::size_t D, class F>
auto map_domain(const DomainGrid<K, D>& grid, F f) {
  std::size_t v = 0;
  return map_vertices(grid.complex, [&](const Vec<K, D>& x) { return f(x.c, grid.sides[v++]); });
}

}  // namespace patchproof
