// SPDX-License-Identifier: Apache-2.0
// The product of two B-splines: a scalar function times a curve, as one B-spline of the sum of the degrees.
//
//   Where f has degree p and a knot of multiplicity m, and C degree q and a knot of multiplicity n, f·C is continuous
//   of order min(p − m, q − n), so its knot needs multiplicity max(m + q, n + p), at most p + q + 1.
//
// REQUIRES  the same domain.
// ENSURES   (1) every polynomial piece of the result is the product of the pieces of f and C;
//           (2) its degree is p + q and its knots are those above, clamped;
//           (3) f = 1 (of degree 0) gives C again;
//           (4) products are bilinear, and f·(g·C) and (f·g)·C have the same pieces.
// SCALARS   T: Field, K: OrderedField.
// COST      O((p + q)²) points per control point.
// SOURCE    K. Mørken, Some identities for products and degree raising of splines, Constr. Approx. 7 (1991) 195–208
//           (the knots; ours goes by pieces).
// NEIGHBOURS bernstein.h (product of pieces), degree.h (f = 1 of degree > 0).
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// f · C.
template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> product(const BsplineCurve<T, 1, K>& f, const BsplineCurve<T, N, K>& curve);

// The knots of f · C. REQUIRES the same domain.
template <OrderedField K>
KnotVector<K> product_knots(const KnotVector<K>& f, const KnotVector<K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

template <OrderedField K>
KnotVector<K> product_knots(const KnotVector<K>& f, const KnotVector<K>& curve) {
  PATCHPROOF_REQUIRES(f.domain_begin() == curve.domain_begin() && f.domain_end() == curve.domain_end(),
                      "product: the domains differ");
  const int p = f.degree(), q = curve.degree();
  std::vector<K> breaks;
  const std::vector<K> of_f = f.breaks(), of_curve = curve.breaks();
  std::set_union(of_f.begin(), of_f.end(), of_curve.begin(), of_curve.end(), std::back_inserter(breaks));
  std::vector<K> knots;
  for (const K& t : breaks) {
    const int m = f.multiplicity(t), n = curve.multiplicity(t);
    const bool is_end = t == f.domain_begin() || t == f.domain_end();
    const int multiplicity = std::max(m > 0 ? m + q : 0, n > 0 ? n + p : 0);
    knots.insert(knots.end(), is_end ? p + q + 1 : std::min(p + q + 1, multiplicity), t);
  }
  return KnotVector<K>::make_unchecked(p + q, std::move(knots));
}

template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> product(const BsplineCurve<T, 1, K>& f, const BsplineCurve<T, N, K>& curve) {
  const KnotVector<K> knots = product_knots(f.knots(), curve.knots());
  // Common breaks, so that the pieces correspond.
  detail::CurveUnderRefinement<T, 1, K> finer_f(f);
  detail::CurveUnderRefinement<T, N, K> finer_curve(curve);
  for (const K& t : knots.breaks()) {
    finer_f.raise(t, 1);
    finer_curve.raise(t, 1);
  }
  const auto pieces_of_f = extract_bezier(std::move(finer_f).finish());
  std::vector<BezierPiece<T, N, K>> pieces = extract_bezier(std::move(finer_curve).finish());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<T> factor;
    for (const Vec<T, 1>& point : pieces_of_f[i].points) factor.push_back(point[0]);
    pieces[i].points = product(factor, pieces[i].points);
  }
  return join_pieces(pieces, knots);
}

}  // namespace patchproof
