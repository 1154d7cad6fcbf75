// SPDX-License-Identifier: Apache-2.0
// Knot insertion and removal: the same curve on more knots, or on fewer.
//
//   C(t) = Σ d_i N_{i,p}(t),  t_k the last knot ≤ t.  A new knot t gives
//     d'_i = d_i for i ≤ k − p,   d'_i = d_{i−1} for i > k,   and between them
//     d'_i = (1 − a_i) d_{i−1} + a_i d_i,   a_i = (t − t_i)/(t_{i+p} − t_i).
//   Removal solves these equations for the d_i; there is one more equation than unknowns.
//
// REQUIRES  t in the domain. Any multiplicity is legal, and knots may be unclamped.
// ENSURES   (1) the curve is unchanged: every polynomial piece is the same;
//           (2) the multiplicity of t grows by `times`;
//           (3) inserting t then s equals inserting s then t;
//           (4) refine(c, finer) has the knots `finer`;
//           (5) removing an inserted knot gives back the curve, and its points when each of them has influence;
//           (6) removal answers nothing when the curve is not smooth enough at t, when t is no knot, and when the
//               domain would change;
//           (7) after remove_redundant_knots no knot of the domain can be removed.
//           Not guaranteed: among points without influence (a knot of multiplicity above p + 1 has some) removal drops
//           any one. At the ends of an unclamped curve it also asks that the points outside agree.
// SCALARS   insertion: T Ring, K OrderedField; all combinations are convex. Removal: T and K exact fields.
// COST      insertion: O(p) new points per knot and one pass over the rest.
// SOURCE    W. Boehm, Inserting new knots into B-spline curves, CAD 12 (1980) 199–201.
// NEIGHBOURS bezier_extraction.h (insertion to full multiplicity), degree.h.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/knot_ratio.h"

namespace patchproof {

// The same curve with the knot t inserted `times` times. REQUIRES t in the domain, times >= 0.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> insert_knot(const BsplineCurve<T, N, K>& curve, const K& t, int times = 1);

// The same curve with t of at least the given multiplicity. REQUIRES t in the domain.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> raise_multiplicity(const BsplineCurve<T, N, K>& curve, const K& t, int multiplicity);

// The same curve on finer knots. REQUIRES the same degree and domain; every knot of the curve stands in `finer` at
// least as often; knots outside the domain are the same.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> refine(const BsplineCurve<T, N, K>& curve, const KnotVector<K>& finer);

// The same curve with the multiplicity of t lowered by one, or nothing when there is no such curve.
template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplineCurve<T, N, K>> remove_knot(const BsplineCurve<T, N, K>& curve, const K& t);

// The same curve on the fewest knots: every knot of the domain removed as often as possible.
template <ExactField T, std::size_t N, ExactField K>
BsplineCurve<T, N, K> remove_redundant_knots(const BsplineCurve<T, N, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Knots and points while knots are being inserted, changed in place.
template <Ring T, std::size_t N, OrderedField K>
struct CurveUnderRefinement {
  int degree;
  K domain_end;
  std::vector<K> knots;
  std::vector<Vec<T, N>> points;

  explicit CurveUnderRefinement(const BsplineCurve<T, N, K>& curve)
      : degree(curve.degree()),
        domain_end(curve.knots().domain_end()),
        knots(curve.knots().knots()),
        points(curve.points()) {}

  void insert(const K& t, int times) {
    const int p = degree;
    // At the end of the domain there is no curve to the right to continue: take the last knot < t there.
    const bool at_end = t == domain_end;
    const auto above =
        at_end ? std::lower_bound(knots.begin(), knots.end(), t) : std::upper_bound(knots.begin(), knots.end(), t);
    int k = static_cast<int>(above - knots.begin()) - 1;
    for (; times > 0; --times) {
      std::vector<Vec<T, N>> mixed;
      mixed.reserve(p);
      for (int i = k - p + 1; i <= k; ++i) {
        if (knots[i] == t)  // weights 0 and 1 need no arithmetic: the points stay bit for bit
          mixed.push_back(points[i - 1]);
        else if (knots[i + p] == t)
          mixed.push_back(points[i]);
        else
          mixed.push_back(between(knot_ratio<T>(t, knots[i], knots[i + p]), points[i - 1], points[i]));
      }
      points.insert(points.begin() + k, Vec<T, N>(points[k]));
      std::move(mixed.begin(), mixed.end(), points.begin() + (k - p + 1));
      knots.insert(knots.begin() + k + 1, K(t));
      if (!at_end) ++k;
    }
  }
  void raise(const K& t, int multiplicity) {
    const auto copies = std::equal_range(knots.begin(), knots.end(), t);
    insert(t, multiplicity - static_cast<int>(copies.second - copies.first));
  }
  BsplineCurve<T, N, K> finish() && {
    return {KnotVector<K>::make_unchecked(degree, std::move(knots)), std::move(points)};
  }
};

}  // namespace detail

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> insert_knot(const BsplineCurve<T, N, K>& curve, const K& t, int times) {
  PATCHPROOF_REQUIRES(curve.knots().in_domain(t) && times >= 0, "insert_knot: a knot of the domain, times >= 0");
  detail::CurveUnderRefinement<T, N, K> work(curve);
  work.insert(t, times);
  return std::move(work).finish();
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> raise_multiplicity(const BsplineCurve<T, N, K>& curve, const K& t, int multiplicity) {
  return insert_knot(curve, t, std::max(0, multiplicity - curve.knots().multiplicity(t)));
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> refine(const BsplineCurve<T, N, K>& curve, const KnotVector<K>& finer) {
  detail::CurveUnderRefinement<T, N, K> work(curve);
  for (const K& t : finer.breaks()) {
    PATCHPROOF_REQUIRES(curve.knots().in_domain(t), "refine: a new knot lies outside the domain");
    work.raise(t, finer.multiplicity(t));
  }
  BsplineCurve<T, N, K> result = std::move(work).finish();
  PATCHPROOF_REQUIRES(result.knots() == finer, "refine: the new knots do not contain the old ones");
  return result;
}

template <ExactField T, std::size_t N, ExactField K>
std::optional<BsplineCurve<T, N, K>> remove_knot(const BsplineCurve<T, N, K>& curve, const K& t) {
  const KnotVector<K>& old_knots = curve.knots();
  const int p = curve.degree(), n = old_knots.control_count() - 1, s = old_knots.multiplicity(t);
  if (s == 0 || n < p + 1 || !old_knots.in_domain(t)) return std::nullopt;
  const std::vector<K>& all = old_knots.knots();
  const int first = static_cast<int>(std::lower_bound(all.begin(), all.end(), t) - all.begin());
  std::vector<K> fewer = all;
  fewer.erase(fewer.begin() + first);
  if (fewer[p] != old_knots.domain_begin() || fewer[n] != old_knots.domain_end()) return std::nullopt;
  const KnotVector<K> knots = KnotVector<K>::make_unchecked(p, std::move(fewer));

  if (s > p + 1) {  // a point whose basis function has the support [t, t]
    std::vector<Vec<T, N>> points = curve.points();
    points.erase(points.begin() + first);
    return BsplineCurve<T, N, K>(knots, std::move(points));
  }

  // Solve Boehm's equations from the left as long as a_i != 0, take the other points from the right, then ask whether
  // the one equation left over holds.
  const std::vector<Vec<T, N>>& old = curve.points();
  const int k = knots.find_span(t, t == knots.domain_end() ? Side::left : Side::right);
  std::vector<Vec<T, N>> points(old.begin(), old.end() - 1);
  for (int i = k - p + 1; i < n; ++i) {
    if (i >= k || knots[i + 1] == t) {
      points[i] = old[i + 1];
    } else {
      const T above = knot_ratio<T>(t, knots[i], knots[i + p]);
      points[i] = (T(1) / above) * (old[i] - (T(1) - above) * points[i - 1]);
    }
  }
  BsplineCurve<T, N, K> result(knots, std::move(points));
  if (insert_knot(result, t).points() != old) return std::nullopt;
  return result;
}

template <ExactField T, std::size_t N, ExactField K>
BsplineCurve<T, N, K> remove_redundant_knots(const BsplineCurve<T, N, K>& curve) {
  BsplineCurve<T, N, K> result = curve;
  for (const K& t : curve.knots().breaks())
    while (std::optional<BsplineCurve<T, N, K>> shorter = remove_knot(result, t)) result = std::move(*shorter);
  return result;
}

}  // namespace patchproof
