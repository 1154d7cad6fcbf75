// SPDX-License-Identifier: Apache-2.0
// Extrusion of simplicial complexes along a new axis, and exact signed volumes.
//
//   pattern h_1 … h_n:  levels z_0 = 0, z_s = z_{s−1} + |h_s|.  A slab with h_s > 0 is filled with prisms over all cells, one
//   with h_s < 0 stays empty.
//   A prism over v_0 … v_d is cut into the d + 1 windows (v_k, …, v_d, v'_0, …, v'_k), its corners in the order of their
//   indices.
//   signed volume of a simplex in R^d:  det(v_1 − v_0, …, v_d − v_0) / d!
//
// The windows of a positive simplex alternate in sign when d is odd. Where a window's sign is wrong, its last two corners
// are exchanged; but the next extrusion sorts the corners again before it cuts, since two prisms cut a common side alike
// only when they see its corners in the same order.
//
// ENSURES   (1) (n + 1)·|V| vertices, level by level; (d + 1)·|C| cells for each filled slab;
//           (2) each new simplex has the sign of the simplex below it, for every d and however its corners are ordered;
//           (3) the volumes over one cell in one filled slab sum to its volume times h_s, exactly in an exact scalar;
//           (4) when the cells below share whole facets, so do the new ones;
//           (5) extruding the point d times by n_i cells gives the grid of simplices of that shape, up to its scale.
// REQUIRES  simplices; no h_s is 0.
// SCALARS   K: OrderedField. In doubles the levels are rounded sums: use grid_on of cell_complex.h where ends matter.
// COST      linear in the output; signed_volume O(d³).
// SOURCE    A. Paoluzzi, Geometric Programming for Computer-Aided Design, ch. 4; V. Ferrucci, A. Paoluzzi, Extrusion and
//           boundary evaluation for multidimensional polyhedra, CAD 23 (1991).
// NEIGHBOURS cell_complex.h, facets.h.
// TEST      tests/mesh/extrude_test.cpp checks (1)–(5).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/mesh/cell_complex.h"

namespace patchproof {

// The prisms over the complex, cut into simplices of one dimension more.
template <OrderedField K, std::size_t N>
CellComplex<K, N + 1> extrude(const CellComplex<K, N>& complex, const std::vector<K>& pattern);

// REQUIRES simplices of dimension N, c < cell_count().
template <OrderedField K, std::size_t N>
K signed_volume(const CellComplex<K, N>& complex, std::size_t c);

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField K, std::size_t N>
CellComplex<K, N + 1> extrude(const CellComplex<K, N>& complex, const std::vector<K>& pattern) {
  PATCHPROOF_REQUIRES(complex.kind == CellKind::simplex, "extrude: of a complex of simplices");
  PATCHPROOF_REQUIRES(complex.vertices.empty() || pattern.size() + 1 < (std::size_t{1} << 31) / complex.vertices.size(),
                      "extrude: fewer than 2^31 vertices");
  CellComplex<K, N + 1> out{CellKind::simplex, complex.dimension + 1, {}, {}};
  std::vector<bool> filled;
  K z(0);
  const auto add_level = [&] {
    for (const Vec<K, N>& x : complex.vertices) {
      Vec<K, N + 1> raised;
      std::copy(x.c.begin(), x.c.end(), raised.c.begin());
      raised[N] = z;
      out.vertices.push_back(std::move(raised));
    }
  };
  add_level();
  for (const K& h : pattern) {
    PATCHPROOF_REQUIRES(h != K(0), "extrude: no slab has height 0");
    filled.push_back(K(0) < h);
    z += filled.back() ? h : K(-h);
    add_level();
  }
  out.corners = detail::prisms(complex.corners, complex.dimension, static_cast<int>(complex.vertices.size()), filled);
  return out;
}

template <OrderedField K, std::size_t N>
K signed_volume(const CellComplex<K, N>& complex, std::size_t c) {
  PATCHPROOF_REQUIRES(complex.kind == CellKind::simplex && complex.dimension == static_cast<int>(N),
                      "signed_volume: of simplices that fill their space");
  PATCHPROOF_REQUIRES(c < complex.cell_count(), "signed_volume: no such cell");
  const auto corners = complex.cell(c);
  std::array<Vec<K, N>, N> edges;
  for (std::size_t i = 0; i < N; ++i) edges[i] = complex.vertices[corners[i + 1]] - complex.vertices[corners[0]];
  K volume(1);
  for (std::size_t i = 0; i < N; ++i) {  // elimination by rows
    std::size_t pivot = i;
    while (pivot < N && edges[pivot][i] == K(0)) ++pivot;
    if (pivot == N) return K(0);
    if (pivot != i) {
      std::swap(edges[pivot], edges[i]);
      volume = -volume;
    }
    volume = volume * edges[i][i] / K(static_cast<int>(i) + 1);
    for (std::size_t r = i + 1; r < N; ++r) edges[r] = edges[r] - K(edges[r][i] / edges[i][i]) * edges[i];
  }
  return volume;
}

}  // namespace patchproof
