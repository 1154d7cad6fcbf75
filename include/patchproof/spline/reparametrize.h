// SPDX-License-Identifier: Apache-2.0
// The same curve run through differently: backwards, over another domain, or at another pace.
//
//   reverse       C'(t) = C(a + b − t) on the domain [a, b]
//   map_domain    C'(c + (d − c)(t − a)/(b − a)) = C(t)
//   moebius       C'(s) = w(s)^p C(φ(s)),  φ(s) = r s/w(s),  w(s) = 1 − s + r s          on [0, 1]
//                 points d'_i = w(s_{i+1})⋯w(s_{i+p}) d_i on the knots s_j = φ^{-1}(t_j); for a Bézier curve r^i b_i
//
// The Moebius map changes a rational curve's pace, keeps its degree, its ends and its shape: for homogeneous points the
// factor w(s)^p does not matter. For points in space it does: then C' is another curve. On a domain [a, b] the map acts
// on (t − a)/(b − a).
//
// ENSURES   (1) reverse: the identity above, knots mirrored; twice gives the curve back;
//           (2) map_domain: the same points, knots mapped;
//           (3) moebius: the identity above for every piece; multiplicities stay; C'(0) = C(0) and C'(1) = r^p C(1);
//               r then 1/r gives the curve back; r = 1 changes nothing.
//           These hold for exact knots. With rounded knots the ends of the domain are exact and the other knots are
//           rounded; if that breaks their order it is a broken contract.
// SCALARS   T: Ring that K embeds into (Field when K is not exact), K: OrderedField.
// COST      O(p) products per control point.
// SOURCE    E. Lee, M. Lucian, Möbius reparametrizations of rational B-splines, CAGD 8 (1991) 213–215.
// NEIGHBOURS homogeneous.h, bezier_extraction.h (clamp).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/knot_ratio.h"

namespace patchproof {

// Knots mirrored at the middle of the domain.
template <OrderedField K>
KnotVector<K> reverse(const KnotVector<K>& knots);

// The curve backwards on the same domain.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> reverse(const BsplineCurve<T, N, K>& curve);

// Knots whose domain is [begin, end]. REQUIRES begin < end.
template <OrderedField K>
KnotVector<K> map_domain(const KnotVector<K>& knots, const K& begin, const K& end);

// The curve on the domain [begin, end]. REQUIRES begin < end.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> map_domain(const BsplineCurve<T, N, K>& curve, const K& begin, const K& end);

// The curve on the domain [0, 1].
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> to_unit_domain(const BsplineCurve<T, N, K>& curve) {
  return map_domain(curve, K(0), K(1));
}

// The homogeneous Bézier curve on [0, 1] at the pace φ: points r^i b_i. REQUIRES at least one point.
template <Ring T, std::size_t N>
std::vector<Vec<T, N>> moebius(std::vector<Vec<T, N>> points, const T& r);

// The homogeneous curve at the pace φ, on the same domain. REQUIRES r > 0; knots outside the domain are not thrown
// beyond the pole of φ: r + (1 − r)·x > 0 for x = (t_j − a)/(b − a) of every knot (always so for clamped curves).
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> moebius(const BsplineCurve<T, N, K>& curve, const K& r);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Mapped knots; rounded ones may lose their order.
template <OrderedField K>
KnotVector<K> checked_knots(int degree, std::vector<K> knots) {
  Result<KnotVector<K>> result = KnotVector<K>::make(degree, std::move(knots));
  PATCHPROOF_REQUIRES(result.has_value(), "reparametrisation: the knots are too close for their rounded scalar");
  return std::move(*result);
}

}  // namespace detail

template <OrderedField K>
KnotVector<K> reverse(const KnotVector<K>& knots) {
  const K &a = knots.domain_begin(), &b = knots.domain_end();
  std::vector<K> out;
  out.reserve(knots.knots().size());
  for (auto t = knots.knots().rbegin(); t != knots.knots().rend(); ++t)
    out.push_back(*t == a ? b : *t == b ? a : K(a + b - *t));
  return detail::checked_knots(knots.degree(), std::move(out));
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> reverse(const BsplineCurve<T, N, K>& curve) {
  return {reverse(curve.knots()), std::vector<Vec<T, N>>(curve.points().rbegin(), curve.points().rend())};
}

template <OrderedField K>
KnotVector<K> map_domain(const KnotVector<K>& knots, const K& begin, const K& end) {
  PATCHPROOF_REQUIRES(begin < end, "map_domain: begin < end");
  const K &a = knots.domain_begin(), &b = knots.domain_end();
  std::vector<K> out;
  out.reserve(knots.knots().size());
  for (const K& t : knots.knots()) out.push_back(between(knot_ratio<K>(t, a, b), begin, end));
  return detail::checked_knots(knots.degree(), std::move(out));
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> map_domain(const BsplineCurve<T, N, K>& curve, const K& begin, const K& end) {
  return {map_domain(curve.knots(), begin, end), curve.points()};
}

template <Ring T, std::size_t N>
std::vector<Vec<T, N>> moebius(std::vector<Vec<T, N>> points, const T& r) {
  PATCHPROOF_REQUIRES(!points.empty(), "moebius: no control points");
  T power = r;
  for (std::size_t i = 1; i < points.size(); ++i, power = power * r) points[i] = power * points[i];
  return points;
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> moebius(const BsplineCurve<T, N, K>& curve, const K& r) {
  PATCHPROOF_REQUIRES(K(0) < r, "moebius: r > 0");
  const KnotVector<K>& old = curve.knots();
  const K &a = old.domain_begin(), &b = old.domain_end();
  std::vector<K> knots;
  std::vector<T> w;  // at the new knots: r/(r + (1 − r) x)
  for (const K& t : old.knots()) {
    const K x = knot_ratio<K>(t, a, b), pole_distance = between(x, r, K(1));
    PATCHPROOF_REQUIRES(K(0) < pole_distance, "moebius: a knot outside the domain lies beyond the pole");
    knots.push_back(between(K(x / pole_distance), a, b));
    if constexpr (scalar_traits<K>::is_exact)
      w.push_back(embed<T>(K(r / pole_distance)));
    else
      w.push_back(embed<T>(r) / between(knot_ratio<T>(t, a, b), embed<T>(r), T(1)));
  }
  std::vector<Vec<T, N>> points = curve.points();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int j = 1; j <= curve.degree(); ++j) points[i] = w[i + j] * points[i];
  return {detail::checked_knots(curve.degree(), std::move(knots)), std::move(points)};
}

}  // namespace patchproof
