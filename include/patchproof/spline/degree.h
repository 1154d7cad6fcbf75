// SPDX-License-Identifier: Apache-2.0
// Degree elevation and reduction of B-spline curves: the same curve as a spline of a higher or a lower degree.
//
//   Each polynomial piece is raised in Bézier form; a knot of multiplicity m becomes one of multiplicity m + times, so
//   the continuity p − m stays.
//
// ENSURES   (1) elevation leaves every polynomial piece unchanged and adds `times` to the degree;
//           (2) every knot of the domain has `times` more copies, and the knots before and after the domain are as many
//               as the degree needs;
//           (3) reduction undoes elevation: the same knots and points for a clamped curve whose points all have
//               influence, the same pieces for every curve;
//           (4) reduction answers nothing exactly when some piece has a higher degree than asked for, or the degree
//               would be negative. A knot vanishes where the lower degree has no room for a break.
//           Not guaranteed: what points without influence hold.
// SCALARS   elevation: T Field, K OrderedField. Reduction: T and K exact fields.
// COST      O(q²) points per control point, q the higher degree.
// SOURCE    H. Prautzsch, Degree elevation of B-spline curves, CAGD 1 (1984) 193–198 (the knots; ours goes by pieces).
// NEIGHBOURS bernstein.h (one piece), bezier_extraction.h.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// The same curve with the degree raised by `times`. REQUIRES times >= 0.
template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> elevate_degree(const BsplineCurve<T, N, K>& curve, int times = 1);

// The same curve with the degree lowered by `times`, when there is one. REQUIRES times >= 0.
template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplineCurve<T, N, K>> reduce_degree(const BsplineCurve<T, N, K>& curve, int times = 1);

// The knots of a spline of degree p + change with the same continuity at every knot: each knot of the domain has
// `change` more copies (an inner one may vanish, an end stays). REQUIRES p + change >= 0.
template <OrderedField K>
KnotVector<K> change_degree(const KnotVector<K>& knots, int change);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// `change` more copies of each knot, none when that would be negative.
template <OrderedField K>
std::vector<K> change_multiplicities(const std::vector<K>& knots, int change) {
  std::vector<K> out;
  for (auto it = knots.begin(); it != knots.end();) {
    const auto next = std::find_if(it, knots.end(), [&](const K& t) { return t != *it; });
    out.insert(out.end(), std::max(0, static_cast<int>(next - it) + change), *it);
    it = next;
  }
  return out;
}

// The knots from an end of the domain outwards, for a spline of degree q. `copies`: of the end now; `idle`: the number
// of points beyond the last one with influence; `outside`: the knots further out.
template <OrderedField K>
std::vector<K> change_end(const K& end, int copies, int idle, const std::vector<K>& outside, int change, int q) {
  copies = std::max(1, copies + change);
  std::vector<K> out(copies, end);
  const std::vector<K> more = change_multiplicities(outside, change);
  out.insert(out.end(), more.begin(), more.end());
  // q + 1 knots bound the domain; a point stays idle only while the end has copies for it.
  out.resize(q + 1 + std::min(idle, copies - 1), K(out.back()));
  return out;
}

}  // namespace detail

template <OrderedField K>
KnotVector<K> change_degree(const KnotVector<K>& knots, int change) {
  const int p = knots.degree(), n = knots.control_count(), q = p + change;
  PATCHPROOF_REQUIRES(q >= 0, "change_degree: the degree would be negative");
  const K &begin = knots.domain_begin(), &end = knots.domain_end();
  const int first = knots.find_span(begin), last = knots.find_span(end, Side::left);
  const int begin_copies = knots.multiplicity(begin), end_copies = knots.multiplicity(end);
  const std::vector<K>& all = knots.knots();

  const std::vector<K> before(all.rend() - (first + 1 - begin_copies), all.rend());
  const std::vector<K> inner(all.begin() + first + 1, all.begin() + last + 1);
  const std::vector<K> after(all.begin() + last + 1 + end_copies, all.end());

  std::vector<K> out = detail::change_end(begin, begin_copies, first - p, before, change, q);
  std::reverse(out.begin(), out.end());
  const std::vector<K> changed = detail::change_multiplicities(inner, change);
  out.insert(out.end(), changed.begin(), changed.end());
  const std::vector<K> tail = detail::change_end(end, end_copies, n - 1 - last, after, change, q);
  out.insert(out.end(), tail.begin(), tail.end());
  return KnotVector<K>::make_unchecked(q, std::move(out));
}

template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> elevate_degree(const BsplineCurve<T, N, K>& curve, int times) {
  PATCHPROOF_REQUIRES(times >= 0, "elevate_degree: times >= 0");
  std::vector<BezierPiece<T, N, K>> pieces = extract_bezier(curve);
  for (BezierPiece<T, N, K>& piece : pieces) piece.points = elevate_degree(std::move(piece.points), times);
  return join_pieces(pieces, change_degree(curve.knots(), times));
}

template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplineCurve<T, N, K>> reduce_degree(const BsplineCurve<T, N, K>& curve, int times) {
  PATCHPROOF_REQUIRES(times >= 0, "reduce_degree: times >= 0");
  if (times > curve.degree()) return std::nullopt;
  std::vector<BezierPiece<T, N, K>> pieces = extract_bezier(curve);
  for (BezierPiece<T, N, K>& piece : pieces)
    for (int i = 0; i < times; ++i) {
      std::optional<std::vector<Vec<T, N>>> lower = reduce_degree(piece.points);
      if (!lower) return std::nullopt;
      piece.points = std::move(*lower);
    }
  return join_pieces(pieces, change_degree(curve.knots(), -times));
}

}  // namespace patchproof
