// SPDX-License-Identifier: Apache-2.0
// What a patch does along one of its isoparametric lines: the line's curve and its cross-boundary derivatives.
//
// On the line u = c (v = c), looked at from one side, let n be the parameter distance from the line into that side. Then
//     rows[k](t) = ∂^k S / ∂n^k   at n = 0,   as a curve in the other parameter t,
// so rows[0] is the boundary curve and rows[1] the cross-boundary derivative, pointing into the patch.
//
// ENSURES  (1) rows[k](t) equals (±1)^k times the k-th partial derivative of S from that side, for every t;
//          (2) bezier_coefficients(C, a, b) are the Bernstein coefficients of C on [a, b].
// SCALARS  T: Ring, K: OrderedField (control values and knots). Homogeneous patches give homogeneous rows.
// NEIGHBOURS bspline_patch.h; join/join_polynomials.h forms the polynomials of a join from these rows.
#pragma once

#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// The four edges of a patch. `u_min` is the line u = first parameter of the domain, traversed along growing v; and so on.
enum class EdgeName { u_min, u_max, v_min, v_max };
const char* to_string(EdgeName edge);  // "u_min", …

// The line `constant` = value, looked at from the left (parameters below value) or the right of it.
template <OrderedField K>
struct IsoLine {
  Direction constant;
  K value;
  Side side;
};

template <Ring T, std::size_t N, OrderedField K>
IsoLine<K> edge_line(const BsplinePatch<T, N, K>& patch, EdgeName edge) {
  const Direction d = edge == EdgeName::u_min || edge == EdgeName::u_max ? Direction::u : Direction::v;
  const bool at_begin = edge == EdgeName::u_min || edge == EdgeName::v_min;
  const KnotVector<K>& knots = patch.knots(d);
  return {d, at_begin ? knots.domain_begin() : knots.domain_end(), at_begin ? Side::right : Side::left};
}

inline Direction other(Direction d) { return d == Direction::u ? Direction::v : Direction::u; }

// rows[0…order]. REQUIRES line.value in the domain, and a part of the domain on that side of it.
template <Ring T, std::size_t N, OrderedField K>
std::vector<BsplineCurve<T, N, K>> cross_boundary_rows(const BsplinePatch<T, N, K>& patch, const IsoLine<K>& line,
                                                       int order);

// REQUIRES a < b, both in one span (no knot strictly between them). COST p² combinations; none on a whole Bézier piece.
template <Ring T, std::size_t N, OrderedField K>
std::vector<Vec<T, N>> bezier_coefficients(const BsplineCurve<T, N, K>& curve, const K& a, const K& b);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring T, std::size_t N, OrderedField K>
std::vector<BsplineCurve<T, N, K>> cross_boundary_rows(const BsplinePatch<T, N, K>& patch, const IsoLine<K>& line,
                                                       int order) {
  const KnotVector<K>& across = patch.knots(line.constant);
  const KnotVector<K>& along = patch.knots(other(line.constant));
  PATCHPROOF_REQUIRES(across.in_domain(line.value), "cross_boundary_rows: the line lies outside the domain");
  PATCHPROOF_REQUIRES(line.side == Side::right ? line.value < across.domain_end() : across.domain_begin() < line.value,
                      "cross_boundary_rows: the patch has nothing on this side of the line");
  const int p = across.degree(), span = across.find_span(line.value, line.side);
  const auto weights = basis_derivatives_in_span<K>(across, span, line.value, order);
  const auto point = [&](int across_index, int along_index) -> const Vec<T, N>& {
    return line.constant == Direction::u ? patch.point(across_index, along_index)
                                         : patch.point(along_index, across_index);
  };
  std::vector<BsplineCurve<T, N, K>> rows;
  for (int k = 0; k <= order; ++k) {
    std::vector<Vec<T, N>> points(along.control_count());
    bool first = true;
    for (int i = 0; i <= p; ++i) {
      const K inward = line.side == Side::left && k % 2 == 1 ? -weights[k][i] : weights[k][i];
      if (inward == K(0)) continue;
      const bool one = inward == K(1);
      const T weight = embed<T>(inward);
      for (int j = 0; j < along.control_count(); ++j) {
        const Vec<T, N>& d = point(span - p + i, j);
        if (first)
          points[j] = one ? d : weight * d;
        else
          points[j] += one ? d : weight * d;
      }
      first = false;
    }
    rows.emplace_back(along, std::move(points));
  }
  return rows;
}

template <Ring T, std::size_t N, OrderedField K>
std::vector<Vec<T, N>> bezier_coefficients(const BsplineCurve<T, N, K>& curve, const K& a, const K& b) {
  const KnotVector<K>& knots = curve.knots();
  const int p = knots.degree(), span = knots.find_span(a, Side::right);
  PATCHPROOF_REQUIRES(a < b && b <= knots[span + 1], "bezier_coefficients: [a, b] must lie in one span");
  const auto first = curve.points().begin() + (span - p);
  std::vector<Vec<T, N>> d(first, first + p + 1);
  // Local knots 1…2p around the span. Two passes of de Boor's recursion: at a (keep the right side of the triangle), then
  // at b on the knots (a, …, a, t_{span+1}, …) (keep the diagonal). Result i is the blossom at (a^(p−i), b^i).
  std::vector<K> local(2 * p + 1);
  for (int i = 1; i <= 2 * p; ++i) local[i] = knots[span - p + i];
  const auto at_a = [&](int i) { return local[i] == a; };
  bool left_done = true;
  for (int i = 1; i <= p; ++i) left_done = left_done && at_a(i);
  if (!left_done) {
    std::vector<Vec<T, N>> kept(p + 1);
    for (int r = 1; r <= p; ++r) {
      kept[p - r + 1] = d[p];
      for (int j = p; j >= r; --j) {
        const T alpha = embed<T>(K((a - local[j]) / (local[j + p - r + 1] - local[j])));
        d[j] = d[j - 1] + alpha * (d[j] - d[j - 1]);
      }
    }
    kept[0] = d[p];
    d = std::move(kept);
    for (int i = 1; i <= p; ++i) local[i] = a;
  }
  bool right_done = true;
  for (int i = p + 1; i <= 2 * p; ++i) right_done = right_done && local[i] == b;
  if (right_done) return d;
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const T alpha = embed<T>(K((b - local[j]) / (local[j + p - r + 1] - local[j])));
      d[j] = d[j - 1] + alpha * (d[j] - d[j - 1]);
    }
  return d;
}

}  // namespace patchproof
