// SPDX-License-Identifier: Apache-2.0
// The polynomial pieces of a B-spline curve, cutting it, and putting it together again.
//
//   On every non-empty span [a, b] of the domain C is a polynomial of degree p; its Bézier points are the values of the
//   polynomial's blossom at (a,…,a,b,…,b). Conversely d_i is the blossom of any piece in the support of N_{i,p} at
//   (t_{i+1},…,t_{i+p}).
//
// ENSURES   (1) extract_bezier: piece j is C on its span, identically; the pieces follow each other without gaps;
//           (2) join_pieces(extract_bezier(c), c.knots()) has the control points of c, where they have influence;
//           (3) restrict(c, a, b) is C on [a, b] with clamped knots; split(c, t) are the two sides of t, and the left
//               one ends in the left limit;
//           (4) clamp(c) is C on the same domain, each end a knot of multiplicity exactly p + 1;
//           (5) a periodic curve closes with all its derivatives up to degree − multiplicity of the first knot, and
//               starting the period at another knot turns its pieces round, nothing else.
//           Not guaranteed: what join_pieces puts into control points without influence.
// SCALARS   T: Ring (Field when the knots are not exact). K: OrderedField.
// COST      O(p²) points per span.
// SOURCE    L. Ramshaw, Blossoms are polar forms, CAGD 6 (1989) 323–358.
// NEIGHBOURS knot_insertion.h (does the work), bernstein.h (what to do with a piece).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/knot_insertion.h"

namespace patchproof {

// A Bézier curve on [begin, end]: Σ points_i B_i^p((t − begin)/(end − begin)).
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
struct BezierPiece {
  K begin, end;
  std::vector<Vec<T, N>> points;

  int degree() const { return static_cast<int>(points.size()) - 1; }
};

// The pieces of the curve, one for each non-empty span of its domain, in order.
template <Ring T, std::size_t N, OrderedField K>
std::vector<BezierPiece<T, N, K>> extract_bezier(const BsplineCurve<T, N, K>& curve);

// The curve on the given knots that consists of these pieces. REQUIRES pieces in order, of the degree of `knots`; each
// break of `knots` is an end of a piece; the pieces join as smoothly as the multiplicities say, and are one polynomial
// where they share a span. Nothing checks the smoothness: without it the result is another curve.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> join_pieces(const std::vector<BezierPiece<T, N, K>>& pieces, const KnotVector<K>& knots);

// The same with every inner break of multiplicity p + 1, so that no smoothness is asked for.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> join_pieces(const std::vector<BezierPiece<T, N, K>>& pieces);

// C on [a, b], clamped. REQUIRES domain_begin <= a < b <= domain_end.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> restrict(const BsplineCurve<T, N, K>& curve, const K& a, const K& b);

// The parts of C before and after t, clamped. REQUIRES domain_begin < t < domain_end.
template <Ring T, std::size_t N, OrderedField K>
std::pair<BsplineCurve<T, N, K>, BsplineCurve<T, N, K>> split(const BsplineCurve<T, N, K>& curve, const K& t);

// The same curve with clamped ends, without points that have no influence at the ends.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> clamp(const BsplineCurve<T, N, K>& curve);

// The knots of a closed spline from the m + 1 knots of one period, first and last standing for the same place:
// t_{i+m} = t_i + period. The domain is one period.
// ERRORS   wrong_count: fewer than 2 knots.  bad_degree, decreasing_knots, empty_domain as for KnotVector::make.
template <OrderedField K>
Result<KnotVector<K>> periodic_knots(int degree, const std::vector<K>& period_knots);

// The closed curve with m control points on m + 1 knots of one period; an unclamped curve whose points repeat.
// ERRORS   those of periodic_knots; wrong_count unless there is one point for each knot but the last.
template <Ring T, std::size_t N, OrderedField K>
Result<BsplineCurve<T, N, K>> make_periodic(int degree, const std::vector<K>& period_knots,
                                            const std::vector<Vec<T, N>>& points);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring T, std::size_t N, OrderedField K>
std::vector<BezierPiece<T, N, K>> extract_bezier(const BsplineCurve<T, N, K>& curve) {
  const int p = curve.degree();
  detail::CurveUnderRefinement<T, N, K> work(curve);
  for (const K& t : curve.knots().breaks()) work.raise(t, p);
  const BsplineCurve<T, N, K> full = std::move(work).finish();
  const KnotVector<K>& knots = full.knots();
  std::vector<BezierPiece<T, N, K>> pieces;
  for (int k = p; k < knots.control_count(); ++k)
    if (knots[k] < knots[k + 1])
      pieces.push_back({knots[k], knots[k + 1],
                        std::vector<Vec<T, N>>(full.points().begin() + (k - p), full.points().begin() + k + 1)});
  return pieces;
}

namespace detail {

// The non-empty span of the domain nearest to the middle of the support of N_i: there the blossom is least
// extrapolated. It lies in the support whenever that holds such a span; otherwise the point has no influence.
template <OrderedField K>
int middle_span(const KnotVector<K>& knots, int i) {
  const int p = knots.degree(), middle = i + p / 2;
  for (int reach = 0; reach <= p; ++reach)
    for (const int k : {middle + reach, middle - reach})
      if (p <= k && k < knots.control_count() && knots[k] < knots[k + 1]) return k;
  return middle;
}

}  // namespace detail

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> join_pieces(const std::vector<BezierPiece<T, N, K>>& pieces, const KnotVector<K>& knots) {
  const int p = knots.degree(), n = knots.control_count();
  // piece_of[k]: the piece that begins span k, and the nearest one for an empty span and outside the domain.
  std::vector<std::size_t> piece_of(n + p);
  std::size_t next = 0;
  for (int k = 0; k < n + p; ++k) {
    piece_of[k] = next == 0 ? 0 : piece_of[k - 1];
    if (k < p || k >= n || !(knots[k] < knots[k + 1])) continue;
    piece_of[k] = next;
    bool fits = next < pieces.size() && pieces[next].begin == knots[k];
    while (next < pieces.size() && pieces[next].end < knots[k + 1]) ++next;
    fits = fits && next < pieces.size() && pieces[next].end == knots[k + 1] && pieces[next].degree() == p;
    PATCHPROOF_REQUIRES(fits, "join_pieces: the pieces do not fit the knots");
    ++next;
  }
  PATCHPROOF_REQUIRES(next == pieces.size(), "join_pieces: more pieces than spans");

  std::vector<Vec<T, N>> points;
  points.reserve(n);
  for (int i = 0; i < n; ++i) {
    const BezierPiece<T, N, K>& piece = pieces[piece_of[detail::middle_span(knots, i)]];
    std::vector<T> arguments;
    arguments.reserve(p);
    for (int j = i + 1; j <= i + p; ++j) arguments.push_back(knot_ratio<T>(knots[j], piece.begin, piece.end));
    points.push_back(blossom(piece.points, arguments));
  }
  return {knots, std::move(points)};
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> join_pieces(const std::vector<BezierPiece<T, N, K>>& pieces) {
  PATCHPROOF_REQUIRES(!pieces.empty(), "join_pieces: no pieces");
  const int p = pieces.front().degree();
  std::vector<K> knots(p + 1, pieces.front().begin);
  std::vector<Vec<T, N>> points;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    PATCHPROOF_REQUIRES(pieces[i].degree() == p && pieces[i].begin < pieces[i].end && knots.back() == pieces[i].begin,
                        "join_pieces: the pieces do not follow each other, or differ in degree");
    knots.insert(knots.end(), p + 1, pieces[i].end);
    points.insert(points.end(), pieces[i].points.begin(), pieces[i].points.end());
  }
  return {KnotVector<K>::make_unchecked(p, std::move(knots)), std::move(points)};
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> restrict(const BsplineCurve<T, N, K>& curve, const K& a, const K& b) {
  PATCHPROOF_REQUIRES(curve.knots().in_domain(a) && curve.knots().in_domain(b) && a < b,
                      "restrict: a < b, both in the domain");
  const int p = curve.degree();
  const BsplineCurve<T, N, K> full = raise_multiplicity(raise_multiplicity(curve, a, p), b, p);
  const int first = full.knots().find_span(a, Side::right), last = full.knots().find_span(b, Side::left);
  const std::vector<K>& old = full.knots().knots();
  std::vector<K> knots(p + 1, a);
  knots.insert(knots.end(), old.begin() + first + 1, old.begin() + last + 1);
  knots.insert(knots.end(), p + 1, b);
  return {KnotVector<K>::make_unchecked(p, std::move(knots)),
          std::vector<Vec<T, N>>(full.points().begin() + (first - p), full.points().begin() + last + 1)};
}

template <Ring T, std::size_t N, OrderedField K>
std::pair<BsplineCurve<T, N, K>, BsplineCurve<T, N, K>> split(const BsplineCurve<T, N, K>& curve, const K& t) {
  return {restrict(curve, curve.knots().domain_begin(), t), restrict(curve, t, curve.knots().domain_end())};
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> clamp(const BsplineCurve<T, N, K>& curve) {
  return restrict(curve, curve.knots().domain_begin(), curve.knots().domain_end());
}

template <OrderedField K>
Result<KnotVector<K>> periodic_knots(int degree, const std::vector<K>& period_knots) {
  if (period_knots.size() < 2)
    return Error{ErrorCode::wrong_count, "", "a period needs at least 2 knots", std::to_string(period_knots.size())};
  if (degree < 0) return Error{ErrorCode::bad_degree, "", "the degree is negative", std::to_string(degree)};
  const int m = static_cast<int>(period_knots.size()) - 1;
  const K period = period_knots.back() - period_knots.front();
  std::vector<K> knots;
  for (int i = -degree; i < 0; ++i) {
    const int turns = (m - 1 - i) / m;  // −i rounded up to whole periods
    knots.push_back(period_knots[i + turns * m] - K(turns) * period);
  }
  knots.insert(knots.end(), period_knots.begin(), period_knots.end());
  for (int i = m + 1; i <= m + degree; ++i) knots.push_back(period_knots[i % m] + K(i / m) * period);
  return KnotVector<K>::make(degree, std::move(knots));
}

template <Ring T, std::size_t N, OrderedField K>
Result<BsplineCurve<T, N, K>> make_periodic(int degree, const std::vector<K>& period_knots,
                                            const std::vector<Vec<T, N>>& points) {
  Result<KnotVector<K>> knots = periodic_knots(degree, period_knots);
  if (!knots) return knots.error();
  if (points.size() + 1 != period_knots.size())
    return Error{ErrorCode::wrong_count, "",
                 "the period needs " + std::to_string(period_knots.size() - 1) + " control points",
                 std::to_string(points.size())};
  std::vector<Vec<T, N>> repeated;
  for (int i = 0; i < knots->control_count(); ++i) repeated.push_back(points[i % points.size()]);
  return BsplineCurve<T, N, K>::make(std::move(*knots), std::move(repeated));
}

}  // namespace patchproof
