// SPDX-License-Identifier: Apache-2.0
// Transfinite curves, surfaces and solids as meshes of doubles.
//
//   The spans of coordinate s are those between the knots of all blends in s; where one of them has multiplicity ≥ p + 1
//   the map may jump, and a new component begins. A coordinate without a blend has the one span [0, 1].
//
// ENSURES   (1) sample_map: the breaks of the map are among the samples, cells_per_span cells between two of them; a
//               component ends, with Side::left, exactly where a blend may jump or the domain ends;
//           (2) tessellate: vertex k lies at A/w for its parameters and sides, within rounding of the exact point; the
//               faces of a solid are those of its map with one coordinate held.
// ERRORS    those of tessellate.h.
// REQUIRES  at least one cell in each span; a denominator without a zero on the domain.
// SCALARS   T: Field with embedding<double, T>, K: OrderedField with embedding<double, K>.
// NEIGHBOURS tessellate.h, patch/transfinite.h.
// TEST      tests/mesh/tessellate_transfinite_test.cpp checks (1)–(2).
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "patchproof/mesh/tessellate.h"
#include "patchproof/patch/transfinite.h"
#include "patchproof/patch/transfinite_calculus.h"

namespace patchproof {

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
std::array<SampledDomain<K>, D> sample_map(const TransfiniteMap<T, D, N, K>& map, int cells_per_span);

// A map to homogeneous points.
template <Field T, std::size_t D, OrderedField K>
Result<std::vector<Tessellation<D>>> tessellate(const TransfiniteMap<T, D, 4, K>& map, int cells_per_span);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The inner knots of x_s at which some blend may jump.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
void collect_jumps(const TransfiniteMap<T, D, N, K>& map, std::size_t s, std::vector<K>& out) {
  using Node = TransfiniteNode<T, D, N, K>;
  if (const auto* blend = std::get_if<typename Node::Blend>(&map.node().kind)) {
    if (blend->coordinate == s)
      for (const DomainComponent<K>& c : components(blend->knots)) out.push_back(c.begin);
    for (const auto& control : blend->controls) collect_jumps(control, s, out);
  } else if (const auto* sum = std::get_if<typename Node::Sum>(&map.node().kind)) {
    for (const auto& term : sum->terms) collect_jumps(term, s, out);
  } else if (const auto* product = std::get_if<typename Node::Product>(&map.node().kind)) {
    collect_jumps(product->factor, s, out);
    collect_jumps(product->map, s, out);
  }
}

}  // namespace detail

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
std::array<SampledDomain<K>, D> sample_map(const TransfiniteMap<T, D, N, K>& map, int cells_per_span) {
  std::array<SampledDomain<K>, D> out;
  for (std::size_t s = 0; s < D; ++s) {
    const std::vector<K> all = breaks(map, s);
    std::vector<K> jumps;
    detail::collect_jumps(map, s, jumps);
    // As a polygon's knots: a break where the map may jump is double, so that it ends a component.
    std::vector<K> knots{all.front()};
    for (const K& t : all) {
      knots.push_back(t);
      if (all.front() < t && t < all.back() && std::find(jumps.begin(), jumps.end(), t) != jumps.end())
        knots.push_back(t);
    }
    knots.push_back(all.back());
    out[s] = sample_spans(KnotVector<K>::make_unchecked(1, std::move(knots)), cells_per_span);
  }
  return out;
}

template <Field T, std::size_t D, OrderedField K>
Result<std::vector<Tessellation<D>>> tessellate(const TransfiniteMap<T, D, 4, K>& map, int cells_per_span) {
  PATCHPROOF_REQUIRES(cells_per_span >= 1, "tessellate: at least one cell in each span");
  std::array<std::size_t, D> along{};
  for (std::size_t s = 0; s < D; ++s)
    along[s] = (breaks(map, s).size() - 1) * static_cast<std::size_t>(cells_per_span) + 1;
  if (auto error = detail::too_many_vertices(along)) return *error;
  std::optional<std::array<double, D>> no_weight;  // where
  auto out =
      tessellate_map(sample_map(map, cells_per_span), [&](const std::array<K, D>& x, const std::array<Side, D>& sides) {
        std::array<double, D> rounded;
        for (std::size_t s = 0; s < D; ++s) rounded[s] = embed<double>(x[s]);
        const auto h = evaluate_at<double>(map, ParameterPlace<K, D>(x, sides), rounded);
        if (h[3] != 0) return project(h);
        no_weight = rounded;
        return Vec<double, 3>{{std::numeric_limits<double>::quiet_NaN(), 0, 0}};
      });
  if (no_weight) return detail::not_a_double(*no_weight, true);
  return out;
}

}  // namespace patchproof
