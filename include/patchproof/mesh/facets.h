// SPDX-License-Identifier: Apache-2.0
// The boundary of a cell complex: the facets that belong to one cell only.
//
//   simplex   facet i lacks v_i and has the sign (−1)^i
//   cuboid    the facet at the begin of axis i has the sign (−1)^{i+1}, the one at its end (−1)^i
//
// A facet of negative sign is written with its last two corners exchanged (a cuboid: with its first axis reversed), so that
// the boundary of positive cells is oriented outwards.
//
// ENSURES   (1) boundary holds, in the order of the cells, each facet that stands in exactly one cell, and names the
//               vertices of the whole complex;
//           (2) the boundary of the boundary of a complex whose cells share whole facets is empty, unless it branches;
//           (3) for positive simplices that fill a region of R^3 the signed volumes of the cones over the boundary from
//               any point sum to the region's volume; a cuboid's facets are oriented alike.
// REQUIRES  cells of dimension 1, 2, … (a vertex has no sign to carry: the boundary of edges is a set of vertices).
// COST      sorts the facets.
// NEIGHBOURS cell_complex.h, extrude.h.
// TEST      tests/mesh/facets_test.cpp checks (1)–(3).
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "patchproof/mesh/cell_complex.h"

namespace patchproof {

// All facets of cell c, one after the other, oriented outwards.
template <class K, std::size_t N>
std::vector<std::vector<int>> facets(const CellComplex<K, N>& complex, std::size_t c) {
  const int d = complex.dimension;
  PATCHPROOF_REQUIRES(d >= 1, "facets: of cells of dimension 1 and more");
  const auto corners = complex.cell(c);
  std::vector<std::vector<int>> out;
  if (complex.kind == CellKind::simplex) {
    for (int i = 0; i <= d; ++i) {
      std::vector<int> facet;
      for (int j = 0; j <= d; ++j)
        if (j != i) facet.push_back(corners[j]);
      if (i % 2 == 1 && d > 1) std::swap(facet[d - 1], facet[d - 2]);
      out.push_back(std::move(facet));
    }
    return out;
  }
  for (int axis = 0; axis < d; ++axis)
    for (const int end : {0, 1}) {
      std::vector<int> facet;
      for (int b = 0; b < 1 << d; ++b)
        if ((b >> axis & 1) == end) facet.push_back(corners[b]);
      if ((axis + end) % 2 == 0 && d > 1)
        for (std::size_t b = 0; b < facet.size(); b += 2) std::swap(facet[b], facet[b + 1]);
      out.push_back(std::move(facet));
    }
  return out;
}

template <class K, std::size_t N>
CellComplex<K, N> boundary(const CellComplex<K, N>& complex) {
  std::vector<std::pair<std::vector<int>, std::vector<int>>> all;  // sorted corners, oriented corners
  std::map<std::vector<int>, int> uses;
  for (std::size_t c = 0; c < complex.cell_count(); ++c)
    for (std::vector<int>& facet : facets(complex, c)) {
      std::vector<int> key = facet;
      std::sort(key.begin(), key.end());
      ++uses[key];
      all.emplace_back(std::move(key), std::move(facet));
    }
  CellComplex<K, N> out{complex.kind, complex.dimension - 1, complex.vertices, {}};
  for (const auto& [key, facet] : all)
    if (uses[key] == 1) out.corners.insert(out.corners.end(), facet.begin(), facet.end());
  return out;
}

}  // namespace patchproof
