// SPDX-License-Identifier: Apache-2.0
// Calculus on transfinite maps (transfinite.h): what is again a transfinite map, and when two of them are the same function.
//
//   fix(M, s, t)(x) = M(x with x_s = t)            the boundary curve of a surface, the face of a solid
//   derivative(M, s) = ∂_s M                       the product rule, on the tree; a blend's part by differences of controls
//   linear_image(M, f) = f(M)                      f linear, on every constant
//   identical(M_1, M_2)                            on every box between knots both are polynomials: compared by coefficients
//
// identical is a proof, for every parameter at once; it is how Coons and Gordon surfaces show that they contain their
// curves.
//
// ENSURES   (1) fix and derivative evaluate to M's value and derivative, from either side of every knot;  (2) fix and
//           derivative in different coordinates commute;  (3) identical(a, b) exactly when a and b have the same value at
//           every parameter from every side, and the same domain in the coordinates that both depend on;  (4) identical_points: the same for the affine points of maps
//           to homogeneous points, whatever the factor between them.
// SCALARS   T: Ring, K: OrderedField; identical: exact T and K.
// COST      identical: the product of the numbers of pieces, times polynomial multiplications of the maps' degrees.
// TEST      tests/patch/transfinite_calculus_test.cpp checks (1)–(4).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "patchproof/patch/transfinite.h"

namespace patchproof {

// M with x_s = t held, as the limit from `side`; it no longer depends on x_s. REQUIRES t in the domain.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> fix(const TransfiniteMap<T, D, N, K>& map, std::size_t s, const K& t,
                               Side side = Side::right);

// ∂_s M.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> derivative(const TransfiniteMap<T, D, N, K>& map, std::size_t s);

// f(M). REQUIRES f linear: f(a + b) = f(a) + f(b), f(λa) = λ f(a).
template <Ring T, std::size_t D, std::size_t N, OrderedField K, class F>
auto linear_image(const TransfiniteMap<T, D, N, K>& map, const F& f);

// Component c, as a map into T^1.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, 1, K> component(const TransfiniteMap<T, D, N, K>& map, std::size_t c) {
  return linear_image(map, [c](const Vec<T, N>& p) { return Vec<T, 1>{{p[c]}}; });
}

// The distinct knots in x_s of all blends of M, in order, ends included; the ends of the domain at least.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
std::vector<K> breaks(const TransfiniteMap<T, D, N, K>& map, std::size_t s);

// The same function.
template <ExactField T, std::size_t D, std::size_t N, ExactField K>
bool identical(const TransfiniteMap<T, D, N, K>& a, const TransfiniteMap<T, D, N, K>& b);

// The same points A/w, compared as A·w' = A'·w. REQUIRES weights that are not zero polynomials on any piece.
template <ExactField T, std::size_t D, std::size_t M, ExactField K>
bool identical_points(const TransfiniteMap<T, D, M, K>& a, const TransfiniteMap<T, D, M, K>& b);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <Ring T, std::size_t N>
Vec<T, N> zero_point() {
  Vec<T, N> out;
  for (std::size_t c = 0; c < N; ++c) out[c] = T(0);
  return out;
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
void collect_breaks(const TransfiniteMap<T, D, N, K>& map, std::size_t s, std::vector<K>& out) {
  using Node = TransfiniteNode<T, D, N, K>;
  if (!map.dependence(s)) return;
  const auto& kind = map.node().kind;
  if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    if (blend->coordinate == s) {
      const std::vector<K> own = blend->knots.breaks();
      out.insert(out.end(), own.begin(), own.end());
    }
    for (const auto& control : blend->controls) collect_breaks(control, s, out);
  } else if (const auto* sum = std::get_if<typename Node::Sum>(&kind)) {
    for (const auto& term : sum->terms) collect_breaks(term, s, out);
  } else if (const auto* product = std::get_if<typename Node::Product>(&kind)) {
    collect_breaks(product->factor, s, out);
    collect_breaks(product->map, s, out);
  }
}

// Calls visit(piece, x) for each box between the given breaks, x being the parameters as polynomials, until it says no.
template <Ring T, std::size_t D, OrderedField K, class Visit>
bool all_pieces(const std::array<std::vector<K>, D>& breaks, Visit visit) {
  std::array<PowerSeries<T, D>, D> x;
  for (std::size_t s = 0; s < D; ++s) x[s] = PowerSeries<T, D>::variable(s, T(0));
  std::array<std::size_t, D> index{};
  for (;;) {
    std::array<K, D> at;
    for (std::size_t s = 0; s < D; ++s) at[s] = breaks[s][index[s]];
    if (!visit(ParameterPlace<K, D>(std::move(at)), x)) return false;
    std::size_t s = D;
    while (s > 0 && ++index[s - 1] + 1 == breaks[s - 1].size()) index[--s] = 0;
    if (s == 0) return true;
  }
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K, class Same>
bool same_on_all_pieces(const TransfiniteMap<T, D, N, K>& a, const TransfiniteMap<T, D, N, K>& b, Same same) {
  std::array<std::vector<K>, D> all;
  for (std::size_t s = 0; s < D; ++s) {
    if (a.dependence(s) && b.dependence(s) && *a.dependence(s) != *b.dependence(s)) return false;
    const auto& longer = a.dependence(s) ? a : b;
    all[s] = {longer.domain_begin(s), longer.domain_end(s)};
    collect_breaks(a, s, all[s]);
    collect_breaks(b, s, all[s]);
    std::sort(all[s].begin(), all[s].end());
    all[s].erase(std::unique(all[s].begin(), all[s].end()), all[s].end());
  }
  return all_pieces<T, D, K>(all, [&](const ParameterPlace<K, D>& piece, const auto& x) {
    using Series = PowerSeries<T, D>;
    return same(evaluate_at<Series>(a, piece, x), evaluate_at<Series>(b, piece, x));
  });
}

}  // namespace detail

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> fix(const TransfiniteMap<T, D, N, K>& map, std::size_t s, const K& t, Side side) {
  using Map = TransfiniteMap<T, D, N, K>;
  using Node = TransfiniteNode<T, D, N, K>;
  if (!map.dependence(s)) return map;
  const auto& kind = map.node().kind;
  const auto sum_of = [](std::vector<Map> terms) {
    Map sum = terms[0];
    for (std::size_t i = 1; i < terms.size(); ++i) sum = sum + terms[i];
    return sum;
  };
  std::vector<Map> parts;
  if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    if (blend->coordinate != s) {
      for (const Map& control : blend->controls) parts.push_back(fix(control, s, t, side));
      return *Map::blend(blend->coordinate, blend->knots, std::move(parts));
    }
    const int span = blend->knots.find_span(t, side), p = blend->knots.degree();
    const std::vector<T> live = basis_in_span<T>(blend->knots, span, t);
    for (int l = 0; l <= p; ++l) parts.push_back(live[l] * fix(blend->controls[span - p + l], s, t, side));
    return sum_of(std::move(parts));
  }
  if (const auto* sum = std::get_if<typename Node::Sum>(&kind)) {
    for (const Map& term : sum->terms) parts.push_back(fix(term, s, t, side));
    return sum_of(std::move(parts));
  }
  const auto& factors = std::get<typename Node::Product>(kind);
  return product(fix(factors.factor, s, t, side), fix(factors.map, s, t, side));
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
TransfiniteMap<T, D, N, K> derivative(const TransfiniteMap<T, D, N, K>& map, std::size_t s) {
  using Map = TransfiniteMap<T, D, N, K>;
  using Node = TransfiniteNode<T, D, N, K>;
  const Map zero(detail::zero_point<T, N>());
  if (!map.dependence(s)) return zero;
  const auto& kind = map.node().kind;
  if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    const KnotVector<K>& knots = blend->knots;
    const std::vector<Map>& controls = blend->controls;
    const int p = knots.degree(), n = knots.control_count();
    std::vector<Map> changing;  // Σ N_i ∂_s C_i
    bool controls_depend = false;
    for (const Map& control : controls) {
      controls_depend = controls_depend || control.dependence(s).has_value();
      changing.push_back(derivative(control, s));
    }
    std::vector<Map> rates;  // Σ N'_i C_i on the knots without the first and the last one; see derivative_curve
    KnotVector<K> inner = knots;
    if (blend->coordinate != s) return *Map::blend(blend->coordinate, knots, std::move(changing));
    if (p == 0) {
      rates.assign(n, zero);
    } else {
      for (int i = 0; i + 1 < n; ++i)
        rates.push_back(knots[i + 1] < knots[i + p + 1]
                            ? knot_rate<T>(p, knots[i + 1], knots[i + p + 1]) * (controls[i + 1] - controls[i])
                            : zero);
      inner = KnotVector<K>::make_unchecked(p - 1, {knots.knots().begin() + 1, knots.knots().end() - 1});
    }
    const Map moving = *Map::blend(s, std::move(inner), std::move(rates));
    return controls_depend ? moving + *Map::blend(s, knots, std::move(changing)) : moving;
  }
  if (const auto* sum = std::get_if<typename Node::Sum>(&kind)) {
    Map out = derivative(sum->terms[0], s);
    for (std::size_t i = 1; i < sum->terms.size(); ++i) out = out + derivative(sum->terms[i], s);
    return out;
  }
  const auto& factors = std::get<typename Node::Product>(kind);
  return product(derivative(factors.factor, s), factors.map) + product(factors.factor, derivative(factors.map, s));
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K, class F>
auto linear_image(const TransfiniteMap<T, D, N, K>& map, const F& f) {
  using Node = TransfiniteNode<T, D, N, K>;
  constexpr std::size_t M = decltype(f(std::declval<const Vec<T, N>&>()))::size();
  using Image = TransfiniteMap<T, D, M, K>;
  const auto& kind = map.node().kind;
  if (const auto* constant = std::get_if<typename Node::Constant>(&kind)) return Image(f(constant->point));
  if (const auto* blend = std::get_if<typename Node::Blend>(&kind)) {
    std::vector<Image> controls;
    for (const auto& control : blend->controls) controls.push_back(linear_image(control, f));
    return *Image::blend(blend->coordinate, blend->knots, std::move(controls));
  }
  if (const auto* sum = std::get_if<typename Node::Sum>(&kind)) {
    Image out = linear_image(sum->terms[0], f);
    for (std::size_t i = 1; i < sum->terms.size(); ++i) out = out + linear_image(sum->terms[i], f);
    return out;
  }
  const auto& factors = std::get<typename Node::Product>(kind);
  return product(factors.factor, linear_image(factors.map, f));
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
std::vector<K> breaks(const TransfiniteMap<T, D, N, K>& map, std::size_t s) {
  std::vector<K> out{map.domain_begin(s), map.domain_end(s)};
  detail::collect_breaks(map, s, out);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

template <ExactField T, std::size_t D, std::size_t N, ExactField K>
bool identical(const TransfiniteMap<T, D, N, K>& a, const TransfiniteMap<T, D, N, K>& b) {
  return detail::same_on_all_pieces(a, b, [](const auto& x, const auto& y) {
    for (std::size_t c = 0; c < N; ++c)
      if (!identical(x[c], y[c])) return false;
    return true;
  });
}

template <ExactField T, std::size_t D, std::size_t M, ExactField K>
bool identical_points(const TransfiniteMap<T, D, M, K>& a, const TransfiniteMap<T, D, M, K>& b) {
  return detail::same_on_all_pieces(a, b, [](const auto& x, const auto& y) {
    for (std::size_t c = 0; c + 1 < M; ++c)
      if (!identical(x[c] * y[M - 1], y[c] * x[M - 1])) return false;
    return true;
  });
}

}  // namespace patchproof
