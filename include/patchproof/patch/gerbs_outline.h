// SPDX-License-Identifier: Apache-2.0
// Splines that are near a GERBS curve or surface, for looking at them and for finding out which edges meet: cubic, C¹, over the same
// domain, with the values and first derivatives (and S_uv) of the original at every node. Found in double, without a bound:
// nothing may be concluded from them. Where the original is a spline, to_spline and to_patch give it exactly.
//
// ENSURES  (1) at the nodes, eight for each part between breaks, values and first derivatives are those of the original, within
//          rounding;  (2) an edge depends on nothing but the values and derivatives on that edge, within rounding.
// TEST     tests/patch/gerbs_outline_test.cpp checks (1) and (2).
#pragma once

#include <array>
#include <vector>

#include "patchproof/patch/gerbs_surface.h"

namespace patchproof {

template <ExactField T>
BsplinePatch<T, 4> outline(const GerbsSurface<T, 4>& surface);
template <ExactField T>
BsplineCurve<T, 4> outline(const GerbsCurve<T, 4>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Where a control point comes from: S + step · S′ at a node, from one side.
template <ExactField T>
struct OutlineNode {
  T at;
  Side side;
  double step;
};

template <ExactField T>
struct OutlineNodes {
  KnotVector<T> knots;
  std::vector<OutlineNode<T>> nodes;
};

template <ExactField T>
OutlineNodes<T> outline_nodes(const std::vector<T>& breaks) {
  constexpr int kCells = 8;
  std::vector<T> at;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < kCells; ++k) at.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * T(k) / T(kCells));
  at.push_back(breaks.back());
  std::vector<OutlineNode<T>> nodes{{at.front(), Side::right, 0}};
  std::vector<T> knots(4, at.front());
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0) nodes.push_back({at[i], Side::left, -embed<double>(T(at[i] - at[i - 1])) / 3});
    if (i + 1 < at.size()) nodes.push_back({at[i], Side::right, embed<double>(T(at[i + 1] - at[i])) / 3});
    if (i > 0 && i + 1 < at.size()) knots.insert(knots.end(), 2, at[i]);
  }
  nodes.push_back({at.back(), Side::left, 0});
  knots.insert(knots.end(), 4, at.back());
  return {KnotVector<T>::make_unchecked(3, std::move(knots)), std::move(nodes)};
}

template <ExactField T>
Vec<T, 4> outline_point(const Vec<double, 3>& p) {
  Vec<T, 4> out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = embed<T>(from_double(p[c]));
  out[3] = T(1);
  return out;
}

}  // namespace detail

template <ExactField T>
BsplinePatch<T, 4> outline(const GerbsSurface<T, 4>& surface) {
  const auto u = detail::outline_nodes(surface.breaks(Direction::u)),
             v = detail::outline_nodes(surface.breaks(Direction::v));
  std::vector<Vec<T, 4>> net;
  for (const auto& i : u.nodes)
    for (const auto& j : v.nodes) {
      const auto s = partial_derivatives_at<double>(surface, {i.at, j.at}, {i.side, j.side}, embed<double>(i.at),
                                                    embed<double>(j.at), 1, 1);
      net.push_back(detail::outline_point<T>(s.at(0, 0) + i.step * s.at(1, 0) + j.step * s.at(0, 1) +
                                             (i.step * j.step) * s.at(1, 1)));
    }
  return {u.knots, v.knots, std::move(net)};
}

template <ExactField T>
BsplineCurve<T, 4> outline(const GerbsCurve<T, 4>& curve) {
  const auto t = detail::outline_nodes(curve.breaks());
  std::vector<Vec<T, 4>> points;
  for (const auto& node : t.nodes) {
    const auto c = derivatives_at<double>(curve, node.at, node.side, embed<double>(node.at), 1);
    points.push_back(detail::outline_point<T>(c[0] + node.step * c[1]));
  }
  return {t.knots, std::move(points)};
}

}  // namespace patchproof
