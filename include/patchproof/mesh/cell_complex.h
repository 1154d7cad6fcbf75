// SPDX-License-Identifier: Apache-2.0
// Cell complexes: vertices with exact coordinates and cells that name them; grids, their products and their maps.
//
//   cuboid    2^d corners; corner b = Σ b_i 2^i lies at the end of axis i where b_i = 1, so axis 0 runs fastest
//   simplex   d + 1 corners v_0 … v_d; positive when det(v_1 − v_0, …, v_d − v_0) > 0
//
// A grid over levels x_i[0] < x_i[1] < … along each axis i has its vertices with axis 0 running fastest and its cells in
// the same order; as simplices each cuboid is cut into d! of them, all positive, so that neighbours share whole facets.
// d = 0 is one vertex and one cell.
//
// ENSURES   (1) a grid of shape (n_0, …, n_{d−1}) has Π(n_i + 1) vertices and Π n_i cuboids or d! Π n_i simplices;
//           (2) grid_on puts vertex j of n at a + (b − a) j/n, and the last one at b itself, in every scalar (a sum of n
//               steps 1/n misses 1 in doubles);
//           (3) the simplices of a grid are positive and their volumes sum to the grid's; every inner facet belongs to two
//               of them, with opposite orientation;
//           (4) product of two grids is the grid over the levels of both; the grid of d = 0 is neutral;
//           (5) to_simplices(grid of cuboids) is the grid of simplices over the same levels;
//           (6) map_vertices changes no cell and merges nothing; (7) merge_equal_vertices leaves each place once, in the
//               order of first appearance, and no cell changes its place; a cell may then name a vertex twice.
// REQUIRES  at least one cell along each axis, levels that increase strictly, fewer than 2^31 vertices.
// SCALARS   K: OrderedField; the coordinates of a mapped complex may be of any type.
// COST      linear in the output; merge_equal_vertices sorts.
// SOURCE    A. Paoluzzi, Geometric Programming for Computer-Aided Design, ch. 4 (simplicial maps, grids).
// NEIGHBOURS extrude.h (prisms over any simplicial complex), facets.h (boundary), domain_grid.h (grids of spline domains).
// TEST      tests/mesh/cell_complex_test.cpp checks (1)–(7).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/vec.h"

namespace patchproof {

enum class CellKind { cuboid, simplex };

template <class K, std::size_t N>
struct CellComplex {
  CellKind kind = CellKind::cuboid;
  int dimension = 0;  // of the cells, not of the space
  std::vector<Vec<K, N>> vertices;
  std::vector<int> corners;  // those of cell 0, then those of cell 1, …

  int corners_per_cell() const { return kind == CellKind::cuboid ? 1 << dimension : dimension + 1; }
  std::size_t cell_count() const { return corners.size() / corners_per_cell(); }
  // The corners of cell c, as indices of vertices. REQUIRES c < cell_count().
  std::span<const int> cell(std::size_t c) const {
    return std::span<const int>(corners).subspan(c * corners_per_cell(), corners_per_cell());
  }
  friend bool operator==(const CellComplex&, const CellComplex&) = default;
};

// The grid over the given levels. Reads: levels[i] are the coordinates along axis i, at least two of them.
template <OrderedField K, std::size_t D>
CellComplex<K, D> grid_through(CellKind kind, const std::array<std::vector<K>, D>& levels);

// The grid of n_i equal cells along axis i of the box Π [a_i, b_i]. REQUIRES a_i < b_i.
template <OrderedField K, std::size_t D>
CellComplex<K, D> grid_on(CellKind kind, const std::array<int, D>& shape, const std::array<std::array<K, 2>, D>& box);

// The same on [0, 1]^d.
template <OrderedField K, std::size_t D>
CellComplex<K, D> cuboid_grid(const std::array<int, D>& shape);
template <OrderedField K, std::size_t D>
CellComplex<K, D> simplex_grid(const std::array<int, D>& shape);

// A × B: a vertex for each pair (those of A run fastest), a cell for each pair of cells. REQUIRES both of cuboids.
template <class K, std::size_t N, std::size_t M>
CellComplex<K, N + M> product(const CellComplex<K, N>& a, const CellComplex<K, M>& b);

// Each cuboid cut into d! simplices. REQUIRES cuboids; neighbours whose axes run alike then share whole facets.
template <class K, std::size_t N>
CellComplex<K, N> to_simplices(const CellComplex<K, N>& complex);

// The complex with every vertex x moved to f(x), a Vec of any length and scalar.
template <class K, std::size_t N, class F>
auto map_vertices(const CellComplex<K, N>& complex, F f);

// Equal vertices become one. Coordinates are compared exactly: nothing is near enough to be the same.
template <OrderedField K, std::size_t N>
CellComplex<K, N> merge_equal_vertices(const CellComplex<K, N>& complex);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The prisms over simplices of dimension d (corners in any order) between consecutive levels, `level_size` vertices apart.
// Each prism is cut into the d + 1 windows of v_0 … v_d v'_0 … v'_d with the v in increasing order: prisms that share a
// side then cut it alike. Window k of a positive simplex has the sign (−1)^{kd}; where the sign is not that of the simplex,
// the last two corners are exchanged.
inline std::vector<int> prisms(const std::vector<int>& corners, int d, int level_size,
                               const std::vector<bool>& filled) {
  std::vector<int> out;
  std::vector<int> sequence(2 * d + 2);
  for (std::size_t slab = 0; slab < filled.size(); ++slab) {
    if (!filled[slab]) continue;
    const int below = static_cast<int>(slab) * level_size;
    for (std::size_t first = 0; first < corners.size(); first += d + 1) {
      std::copy_n(corners.begin() + first, d + 1, sequence.begin());
      bool negative = false;
      for (int i = 1; i <= d; ++i)  // insertion sort, counting exchanges
        for (int j = i; j > 0 && sequence[j] < sequence[j - 1]; --j) {
          std::swap(sequence[j], sequence[j - 1]);
          negative = !negative;
        }
      for (int i = 0; i <= d; ++i) sequence[d + 1 + i] = sequence[i] + below + level_size;
      for (int i = 0; i <= d; ++i) sequence[i] += below;
      for (int k = 0; k <= d; ++k) {
        out.insert(out.end(), sequence.begin() + k, sequence.begin() + k + d + 2);
        if (negative != (k * d % 2 == 1)) std::swap(out[out.size() - 1], out[out.size() - 2]);
      }
    }
  }
  return out;
}

// The d! positive simplices of the cuboid with the given cells along its axes.
inline std::vector<int> grid_simplices(std::span<const int> shape) {
  std::vector<int> corners{0};
  int vertices = 1;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    corners = prisms(corners, static_cast<int>(axis), vertices, std::vector<bool>(shape[axis], true));
    vertices *= shape[axis] + 1;
  }
  return corners;
}

inline std::vector<int> grid_cuboids(std::span<const int> shape) {
  std::vector<int> corners{0};
  int vertices = 1;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    std::vector<int> next;
    const std::size_t per_cell = std::size_t{1} << axis;
    for (int slab = 0; slab < shape[axis]; ++slab)
      for (std::size_t first = 0; first < corners.size(); first += per_cell)
        for (const int level : {slab, slab + 1})
          for (std::size_t b = 0; b < per_cell; ++b) next.push_back(corners[first + b] + level * vertices);
    corners = std::move(next);
    vertices *= shape[axis] + 1;
  }
  return corners;
}

}  // namespace detail

template <OrderedField K, std::size_t D>
CellComplex<K, D> grid_through(CellKind kind, const std::array<std::vector<K>, D>& levels) {
  std::array<int, D> shape{};
  std::int64_t count = 1;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::vector<K>& x = levels[axis];
    PATCHPROOF_REQUIRES(x.size() >= 2, "a grid has at least one cell along each axis");
    for (std::size_t i = 1; i < x.size(); ++i)
      PATCHPROOF_REQUIRES(x[i - 1] < x[i], "the levels of a grid increase strictly");
    count *= static_cast<std::int64_t>(x.size());
    PATCHPROOF_REQUIRES(x.size() < (1u << 31) && count < (std::int64_t{1} << 31), "a grid of fewer than 2^31 vertices");
    shape[axis] = static_cast<int>(x.size()) - 1;
  }
  CellComplex<K, D> out{kind, static_cast<int>(D), {}, {}};
  out.corners = kind == CellKind::cuboid ? detail::grid_cuboids(shape) : detail::grid_simplices(shape);
  out.vertices.reserve(count);
  for (std::int64_t v = 0; v < count; ++v) {
    Vec<K, D> x;
    std::int64_t rest = v;
    for (std::size_t axis = 0; axis < D; ++axis) {
      x[axis] = levels[axis][rest % (shape[axis] + 1)];
      rest /= shape[axis] + 1;
    }
    out.vertices.push_back(std::move(x));
  }
  return out;
}

template <OrderedField K, std::size_t D>
CellComplex<K, D> grid_on(CellKind kind, const std::array<int, D>& shape, const std::array<std::array<K, 2>, D>& box) {
  std::array<std::vector<K>, D> levels;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto& [a, b] = box[axis];
    const int n = shape[axis];
    PATCHPROOF_REQUIRES(n >= 1 && a < b, "grid_on: at least one cell along each axis of a box with a < b");
    levels[axis].push_back(a);
    for (int j = 1; j < n; ++j) levels[axis].push_back(a + (b - a) * K(j) / K(n));
    levels[axis].push_back(b);
  }
  return grid_through(kind, levels);
}

template <OrderedField K, std::size_t D>
CellComplex<K, D> cuboid_grid(const std::array<int, D>& shape) {
  std::array<std::array<K, 2>, D> box;
  box.fill({K(0), K(1)});
  return grid_on(CellKind::cuboid, shape, box);
}

template <OrderedField K, std::size_t D>
CellComplex<K, D> simplex_grid(const std::array<int, D>& shape) {
  std::array<std::array<K, 2>, D> box;
  box.fill({K(0), K(1)});
  return grid_on(CellKind::simplex, shape, box);
}

template <class K, std::size_t N, std::size_t M>
CellComplex<K, N + M> product(const CellComplex<K, N>& a, const CellComplex<K, M>& b) {
  PATCHPROOF_REQUIRES(a.kind == CellKind::cuboid && b.kind == CellKind::cuboid, "product: of complexes of cuboids");
  PATCHPROOF_REQUIRES(a.vertices.empty() || b.vertices.size() < (std::size_t{1} << 31) / a.vertices.size(),
                      "product: fewer than 2^31 vertices");
  CellComplex<K, N + M> out{CellKind::cuboid, a.dimension + b.dimension, {}, {}};
  out.vertices.reserve(a.vertices.size() * b.vertices.size());
  for (const Vec<K, M>& y : b.vertices)
    for (const Vec<K, N>& x : a.vertices) {
      Vec<K, N + M> both;
      std::copy(x.c.begin(), x.c.end(), both.c.begin());
      std::copy(y.c.begin(), y.c.end(), both.c.begin() + N);
      out.vertices.push_back(std::move(both));
    }
  out.corners.reserve(a.corners.size() * b.corners.size());
  const int count = static_cast<int>(a.vertices.size());
  for (std::size_t j = 0; j < b.cell_count(); ++j)
    for (std::size_t i = 0; i < a.cell_count(); ++i)
      for (const int w : b.cell(j))
        for (const int v : a.cell(i)) out.corners.push_back(w * count + v);
  return out;
}

template <class K, std::size_t N>
CellComplex<K, N> to_simplices(const CellComplex<K, N>& complex) {
  PATCHPROOF_REQUIRES(complex.kind == CellKind::cuboid, "to_simplices: of a complex of cuboids");
  const std::vector<int> ones(complex.dimension, 1), pattern = detail::grid_simplices(ones);
  CellComplex<K, N> out{CellKind::simplex, complex.dimension, complex.vertices, {}};
  out.corners.reserve(complex.cell_count() * pattern.size());
  for (std::size_t c = 0; c < complex.cell_count(); ++c)
    for (const int b : pattern) out.corners.push_back(complex.cell(c)[b]);
  return out;
}

template <class K, std::size_t N, class F>
auto map_vertices(const CellComplex<K, N>& complex, F f) {
  using Image = std::remove_cvref_t<decltype(f(complex.vertices[0]))>;
  using Scalar = typename decltype(Image::c)::value_type;
  CellComplex<Scalar, Image::size()> out{complex.kind, complex.dimension, {}, complex.corners};
  out.vertices.reserve(complex.vertices.size());
  for (const Vec<K, N>& x : complex.vertices) out.vertices.push_back(f(x));
  return out;
}

template <OrderedField K, std::size_t N>
CellComplex<K, N> merge_equal_vertices(const CellComplex<K, N>& complex) {
  const int count = static_cast<int>(complex.vertices.size());
  std::vector<int> order(count), first(count), renamed(count);
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int i, int j) { return complex.vertices[i].c < complex.vertices[j].c; };
  std::stable_sort(order.begin(), order.end(), less);
  // first[v]: the first vertex at the place of v; equal vertices stand together, in their old order.
  for (int k = 0; k < count; ++k)
    first[order[k]] = k > 0 && !less(order[k - 1], order[k]) ? first[order[k - 1]] : order[k];
  CellComplex<K, N> out{complex.kind, complex.dimension, {}, complex.corners};
  for (int v = 0; v < count; ++v) {
    if (first[v] == v) {
      renamed[v] = static_cast<int>(out.vertices.size());
      out.vertices.push_back(complex.vertices[v]);
    } else {
      renamed[v] = renamed[first[v]];
    }
  }
  for (int& v : out.corners) v = renamed[v];
  return out;
}

}  // namespace patchproof
