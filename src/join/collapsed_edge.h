// SPDX-License-Identifier: Apache-2.0
// Edges whose points all coincide, and whether the surface has a tangent plane there. Exact throughout.
#pragma once

#include <optional>
#include <vector>

#include "patchproof/join/continuity.h"
#include "patchproof/join/edge_match.h"
#include "patchproof/join/pieces.h"

namespace patchproof {

// Is every point of the curve the same?
template <ExactField T>
bool is_one_point(const BsplineCurve<T, 4>& row) {
  const Vec<T, 4>& first = row.points().front();
  for (const Vec<T, 4>& p : row.points())
    for (int c = 0; c < 3; ++c)
      if (!(p[c] * first[3] == first[c] * p[3])) return false;
  return true;
}

// All limit normals n(t) along the collapsed edge on one line and in one sense: n × r vanishes for one fixed n(0) = r
// and n · r > 0 throughout.
template <ExactField T>
bool has_tangent_plane(const std::vector<BsplineCurve<T, 4>>& rows) {
  using R = proof_ring_t<T>;
  const RoundingGuard guard;
  const std::vector<T> breaks = rows[0].knots().breaks();
  std::optional<FormVector<R>> reference;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    SideRows<T> piece;
    for (int k = 0; k < 3; ++k) piece[k] = bezier_coefficients(rows[k], breaks[i], breaks[i + 1]);
    const ReducedNormal<R> normal = reduce_normal(side_forms<R>(piece));
    if (!normal.found() || normal.has_factor()) return false;
    if (!reference) {
      reference.emplace();
      for (int c = 0; c < 3; ++c)
        if (!normal.n[c].is_empty()) (*reference)[c] = BinaryForm<R>::constant(normal.n[c][0]);
    }
    if (!vanishes(cross(normal.n, *reference))) return false;
    for (const R& x : dot(normal.n, *reference).coefficients())
      if (*scalar_traits<R>::sign(x) != Sign::positive) return false;
  }
  return true;
}

template <ExactField T>
CollapsedEdge collapsed_edge(const BsplinePatch<T, 4>& patch, int index, EdgeName edge) {
  const auto rows = cross_boundary_rows(patch, edge_line(patch, edge), 2);
  CollapsedEdge out{index, edge, is_one_point(rows[0]), false};
  out.tangent_plane = out.exactly && has_tangent_plane(rows);
  return out;
}

}  // namespace patchproof
