// SPDX-License-Identifier: Apache-2.0
// From a transfinite map to the B-spline that it is: the same function, with control points.
//
//   On each box between knots the map is a polynomial; evaluated at power series it gives its coefficients, these give
//   Bézier points, and the pieces are joined on knots of the multiplicity that the map's own blends promise:
//   degree(blend) = p + degree(controls),  degree(sum) = max,  degree(product) = sum of degrees;
//   continuity at a knot = the least of p − multiplicity over the blends that have it.
//
// So Coons, Gordon and transfinite Bézier and B-spline surfaces are certified, refined and evaluated fast like any patch.
//
// ENSURES   (1) the result is identical to the map: patch_over(to_bspline_patch(M)) and M are the same function;
//           (2) its degree in each direction is the one above, but at least 1.
// SCALARS   T: Field, K: OrderedField; exact when both are.
// COST      one evaluation of the map at polynomials for each box.
// SOURCE    as for product.h: K. Mørken, Constr. Approx. 7 (1991) 195–208, for the knots.
// TEST      tests/patch/transfinite_expand_test.cpp checks (1), (2).
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/patch/transfinite_calculus.h"
#include "patchproof/spline/bezier_extraction.h"

namespace patchproof {

// Knots of a spline space in x_s that contains M.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
KnotVector<K> spline_knots(const TransfiniteMap<T, D, N, K>& map, std::size_t s);

// M(t) as a curve.
template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> to_bspline_curve(const TransfiniteMap<T, 1, N, K>& map);

// M(u, v) as a patch; u is coordinate 0.
template <Field T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> to_bspline_patch(const TransfiniteMap<T, 2, N, K>& map);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// What is known of a map as a function of x_s: its degree, and its continuity at inner knots.
template <OrderedField K>
struct SplineSpace {
  int degree = 0;
  std::map<K, int> continuity;

  void knot(const K& t, int c) {
    const auto [at, is_new] = continuity.emplace(t, c);
    if (!is_new) at->second = std::min(at->second, c);
  }
  void join(const SplineSpace& o, int total_degree) {
    degree = total_degree;
    for (const auto& [t, c] : o.continuity) knot(t, c);
  }
};

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
SplineSpace<K> spline_space(const TransfiniteMap<T, D, N, K>& map, std::size_t s) {
  using Node = TransfiniteNode<T, D, N, K>;
  SplineSpace<K> out;
  const auto& kind = map.node().kind;
  if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    for (const auto& control : blend->controls) {
      const SplineSpace<K> inner = spline_space(control, s);
      out.join(inner, std::max(out.degree, inner.degree));
    }
    if (blend->coordinate != s) return out;
    const int p = blend->knots.degree();
    out.degree += p;
    const std::vector<K> all = blend->knots.breaks();
    for (std::size_t i = 1; i + 1 < all.size(); ++i)
      out.knot(all[i], std::max(-1, p - blend->knots.multiplicity(all[i])));
  } else if (const auto* sum = std::get_if<typename Node::Sum>(&kind)) {
    for (const auto& term : sum->terms) {
      const SplineSpace<K> inner = spline_space(term, s);
      out.join(inner, std::max(out.degree, inner.degree));
    }
  } else if (const auto* product = std::get_if<typename Node::Product>(&kind)) {
    out = spline_space(product->factor, s);
    const SplineSpace<K> inner = spline_space(product->map, s);
    out.join(inner, out.degree + inner.degree);
  }
  return out;
}

// Coefficients a_k of Σ a_k y^k on [0, 1] to Bézier points b_i = Σ_{k ≤ i} C(i,k)/C(n,k) a_k.
template <Field T, std::size_t N>
std::vector<Vec<T, N>> to_bezier(const std::vector<Vec<T, N>>& power) {
  const int n = static_cast<int>(power.size()) - 1;
  const std::vector<T> of_n = binomial_row<T>(n);
  std::vector<Vec<T, N>> out;
  for (int i = 0; i <= n; ++i) {
    const std::vector<T> of_i = binomial_row<T>(i);
    Vec<T, N> sum = power[0];
    for (int k = 1; k <= i; ++k) sum += (of_i[k] / of_n[k]) * power[k];
    out.push_back(std::move(sum));
  }
  return out;
}

// join_pieces; a single Bézier piece is what it is.
template <Ring T, std::size_t N, OrderedField K>
std::vector<Vec<T, N>> joined_points(const std::vector<BezierPiece<T, N, K>>& pieces, const KnotVector<K>& knots) {
  return pieces.size() == 1 ? pieces[0].points : join_pieces(pieces, knots).points();
}

// The map on the box that begins at `begin`, as polynomials of the fractions of the box's sides.
template <Field T, std::size_t D, std::size_t N, OrderedField K>
Vec<PowerSeries<T, D>, N> on_unit_box(const TransfiniteMap<T, D, N, K>& map, const std::array<K, D>& begin,
                                      const std::array<K, D>& end) {
  std::array<PowerSeries<T, D>, D> x;
  for (std::size_t s = 0; s < D; ++s) {
    const T a = embed<T>(begin[s]);
    x[s] = PowerSeries<T, D>(a) + PowerSeries<T, D>(embed<T>(end[s]) - a) * PowerSeries<T, D>::variable(s, T(0));
  }
  return evaluate_at<PowerSeries<T, D>>(map, ParameterPlace<K, D>(begin), x);
}

}  // namespace detail

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
KnotVector<K> spline_knots(const TransfiniteMap<T, D, N, K>& map, std::size_t s) {
  const detail::SplineSpace<K> space = detail::spline_space(map, s);
  const int degree = std::max(1, space.degree);
  std::vector<K> knots(degree + 1, map.domain_begin(s));
  for (const auto& [t, c] : space.continuity) knots.insert(knots.end(), degree - c, t);
  knots.insert(knots.end(), degree + 1, map.domain_end(s));
  return KnotVector<K>::make_unchecked(degree, std::move(knots));
}

template <Field T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> to_bspline_curve(const TransfiniteMap<T, 1, N, K>& map) {
  const KnotVector<K> knots = spline_knots(map, 0);
  const std::vector<K> all = knots.breaks();
  std::vector<BezierPiece<T, N, K>> pieces;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const auto series = detail::on_unit_box<T, 1, N, K>(map, {all[i]}, {all[i + 1]});
    std::vector<Vec<T, N>> power(knots.degree() + 1);
    for (int k = 0; k <= knots.degree(); ++k)
      for (std::size_t c = 0; c < N; ++c) power[k][c] = series[c].coefficient({k});
    pieces.push_back({all[i], all[i + 1], detail::to_bezier(power)});
  }
  return {knots, detail::joined_points(pieces, knots)};
}

template <Field T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> to_bspline_patch(const TransfiniteMap<T, 2, N, K>& map) {
  const KnotVector<K> knots_u = spline_knots(map, 0), knots_v = spline_knots(map, 1);
  const std::vector<K> us = knots_u.breaks(), vs = knots_v.breaks();
  const int p = knots_u.degree(), q = knots_v.degree(), rows = knots_u.control_count();
  // lines[i]: the pieces along v of row i of the net.
  std::vector<std::vector<BezierPiece<T, N, K>>> lines(rows);
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    // columns[b]: the pieces along u that carry Bézier point b of span j of v.
    std::vector<std::vector<BezierPiece<T, N, K>>> columns(q + 1);
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const auto series = detail::on_unit_box<T, 2, N, K>(map, {us[i], vs[j]}, {us[i + 1], vs[j + 1]});
      std::vector<std::vector<Vec<T, N>>> net;  // power of u, Bézier point along v
      for (int k = 0; k <= p; ++k) {
        std::vector<Vec<T, N>> power(q + 1);
        for (int l = 0; l <= q; ++l)
          for (std::size_t c = 0; c < N; ++c) power[l][c] = series[c].coefficient({k, l});
        net.push_back(detail::to_bezier(power));
      }
      for (int b = 0; b <= q; ++b) {
        std::vector<Vec<T, N>> power;
        for (int k = 0; k <= p; ++k) power.push_back(net[k][b]);
        columns[b].push_back({us[i], us[i + 1], detail::to_bezier(power)});
      }
    }
    std::vector<std::vector<Vec<T, N>>> points;
    for (const auto& column : columns) points.push_back(detail::joined_points(column, knots_u));
    for (int row = 0; row < rows; ++row) {
      BezierPiece<T, N, K> piece{vs[j], vs[j + 1], {}};
      for (int b = 0; b <= q; ++b) piece.points.push_back(points[b][row]);
      lines[row].push_back(std::move(piece));
    }
  }
  std::vector<Vec<T, N>> net;
  for (const auto& line : lines) {
    const std::vector<Vec<T, N>> points = detail::joined_points(line, knots_v);
    net.insert(net.end(), points.begin(), points.end());
  }
  return {knots_u, knots_v, std::move(net)};
}

}  // namespace patchproof
