// SPDX-License-Identifier: Apache-2.0
// GERBS surfaces as ordinary patches, exactly.
//
// Over a box between breaks, with B = n/d in either direction and local surfaces of one common weight w,
//
//   F(u,v) = Σ_p Σ_q a_p(u) b_q(v) c_pq,    a = (d − n, n) in u,  b = (d − n, n) in v;    its weight is d(u) d(v) w
//
// REQUIRES  weights without a zero.
// ENSURES   (1) to_patch: the same surface, everywhere;  (2) degrees deg B + the largest degree of a local surface, in each
//           direction;  (3) inner knots stand as often as the homogeneous pieces need, not more.
// SCALARS   T: ExactField, K: OrderedField that is exact.
// ERRORS    unsupported: a transcendental B-function, trigonometric local surfaces, local surfaces of different weights (then
//           there is no common denominator of a useful degree).
// COST      O(p² q²) for each box.
// TEST      tests/patch/gerbs_expand_test.cpp checks (1)–(3).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "patchproof/patch/gerbs_surface.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/spline/gerbs_spline.h"

namespace patchproof {

template <ExactField T, std::size_t M, OrderedField K>
Result<BsplinePatch<T, M, K>> to_patch(const GerbsSurface<T, M, K>& surface);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// A Bézier net: rows along u, points along v.
template <Ring T, std::size_t M>
using BezierNet = std::vector<std::vector<Vec<T, M>>>;

template <Ring T, std::size_t M>
BezierNet<T, M> transposed(const BezierNet<T, M>& net) {
  BezierNet<T, M> out(net[0].size());
  for (const auto& row : net)
    for (std::size_t j = 0; j < row.size(); ++j) out[j].push_back(row[j]);
  return out;
}

// f(v) times the net, raised to `degree` in v.
template <Field T, std::size_t M>
BezierNet<T, M> times_along_rows(const std::vector<T>& f, BezierNet<T, M> net, int degree) {
  for (auto& row : net) {
    row = product(f, row);
    row = elevate_degree(std::move(row), degree - static_cast<int>(row.size()) + 1);
  }
  return net;
}

// d − n and n over a part of a span, as polynomials on [0, 1].
template <Field T, OrderedField K>
std::array<std::vector<T>, 2> blend_factors(const BFunction& b, const K& begin, const K& end, const K& from,
                                            const K& to) {
  auto [n, d] = b_function_pieces<T>(b, begin, end);
  const auto part_of = [&](const Piecewise<T, 1, K>& f) {
    const Piecewise<T, 1, K> part = window(f, from, to);
    std::vector<T> out;
    for (const Vec<T, 1>& p : part.front().points) out.push_back(p[0]);
    return out;
  };
  return {part_of(sum(d, scale(T(-1), n))), part_of(n)};
}

template <ExactField T, std::size_t M, OrderedField K>
BezierNet<T, M> local_net(const LocalSurface<T, M, K>& local, const ParameterBox<K>& box) {
  const K &u = local.shift(Direction::u), &v = local.shift(Direction::v);
  const BsplinePatch<T, M, K> part = restrict(
      local.patch(), ParameterBox<K>{K(box.u_begin - u), K(box.u_end - u), K(box.v_begin - v), K(box.v_end - v)});
  BezierNet<T, M> out(part.count(Direction::u));
  for (int i = 0; i < part.count(Direction::u); ++i)
    for (int j = 0; j < part.count(Direction::v); ++j) out[i].push_back(part.point(i, j));
  return out;
}

// One box, or nothing where the local surfaces have different weights.
template <ExactField T, std::size_t M, OrderedField K>
std::optional<BezierNet<T, M>> gerbs_box(const GerbsSurface<T, M, K>& surface, const ParameterBox<K>& box, int degree_u,
                                         int degree_v) {
  const KnotVector<K>&knots_u = surface.knots(Direction::u), &knots_v = surface.knots(Direction::v);
  const int j = knots_u.find_span(box.u_begin), i = knots_v.find_span(box.v_begin);
  const auto a = blend_factors<T>(surface.b_function(), knots_u[j], knots_u[j + 1], box.u_begin, box.u_end),
             b = blend_factors<T>(surface.b_function(), knots_v[i], knots_v[i + 1], box.v_begin, box.v_end);
  const int of_u = degree_u - static_cast<int>(a[0].size()) + 1, of_v = degree_v - static_cast<int>(b[0].size()) + 1;
  BezierNet<T, M> total(degree_u + 1, std::vector<Vec<T, M>>(degree_v + 1)), first;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) {
      // All four in the largest degrees, so that weights can be compared.
      BezierNet<T, M> net = times_along_rows({T(1)}, local_net(surface.local(j - 1 + p, i - 1 + q), box), of_v);
      net = transposed(times_along_rows({T(1)}, transposed(net), of_u));
      if (first.empty()) first = net;
      for (std::size_t row = 0; row < net.size(); ++row)
        for (std::size_t k = 0; k < net[row].size(); ++k)
          if (!(net[row][k][M - 1] == first[row][k][M - 1])) return std::nullopt;
      net = times_along_rows(b[q], std::move(net), degree_v);
      net = transposed(times_along_rows(a[p], transposed(net), degree_u));
      for (std::size_t row = 0; row < net.size(); ++row)
        for (std::size_t k = 0; k < net[row].size(); ++k) total[row][k] += net[row][k];
    }
  return total;
}

// boxes[i][j] over [us_i, us_{i+1}] × [vs_j, vs_{j+1}], all of one pair of degrees.
template <ExactField T, std::size_t M, OrderedField K>
BsplinePatch<T, M, K> joined_smoothly(const std::vector<K>& us, const std::vector<K>& vs,
                                      const std::vector<std::vector<BezierNet<T, M>>>& boxes) {
  std::vector<Piecewise<T, M, K>> along_v;  // row after row, strip after strip
  for (const auto& strip : boxes)
    for (std::size_t row = 0; row < strip[0].size(); ++row) {
      along_v.emplace_back();
      for (std::size_t j = 0; j < strip.size(); ++j) along_v.back().push_back({vs[j], vs[j + 1], strip[j][row]});
    }
  const KnotVector<K> knots_v = smoothest_knots(along_v);
  const std::size_t rows = boxes[0][0].size(), columns = knots_v.control_count();
  std::vector<Piecewise<T, M, K>> along_u(columns);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (auto& line : along_u) line.push_back({us[i], us[i + 1], {}});
    for (std::size_t row = 0; row < rows; ++row) {
      const auto joined = join_pieces(along_v[i * rows + row], knots_v).points();
      for (std::size_t column = 0; column < columns; ++column) along_u[column].back().points.push_back(joined[column]);
    }
  }
  const KnotVector<K> knots_u = smoothest_knots(along_u);
  std::vector<Vec<T, M>> net(knots_u.control_count() * columns);
  for (std::size_t column = 0; column < columns; ++column) {
    const auto points = join_pieces(along_u[column], knots_u).points();
    for (std::size_t row = 0; row < points.size(); ++row) net[row * columns + column] = points[row];
  }
  return {knots_u, knots_v, std::move(net)};
}

}  // namespace detail

template <ExactField T, std::size_t M, OrderedField K>
Result<BsplinePatch<T, M, K>> to_patch(const GerbsSurface<T, M, K>& surface) {
  if (!surface.is_exact())
    return Error{ErrorCode::unsupported, "",
                 "this GERBS surface is no spline: its B-function or a local surface is transcendental",
                 surface.b_function().to_string()};
  const auto degree = [&](Direction d) {
    int most = 0;
    for (int p = 0; p < surface.knots(Direction::u).control_count(); ++p)
      for (int q = 0; q < surface.knots(Direction::v).control_count(); ++q)
        most = std::max(most, surface.local(p, q).basis(d).knots()->degree());
    return most +
           static_cast<int>(
               std::max(surface.b_function().numerator().size(), surface.b_function().denominator().size())) -
           1;
  };
  const int degree_u = degree(Direction::u), degree_v = degree(Direction::v);
  const std::vector<K> us = surface.breaks(Direction::u), vs = surface.breaks(Direction::v);
  std::vector<std::vector<detail::BezierNet<T, M>>> boxes;
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    boxes.emplace_back();
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      auto box = detail::gerbs_box(surface, {us[i], us[i + 1], vs[j], vs[j + 1]}, degree_u, degree_v);
      if (!box)
        return Error{
            ErrorCode::unsupported, "",
            "this GERBS surface is no single patch: its local surfaces have different weights over one span",
            "u " + to_text(us[i]) + " … " + to_text(us[i + 1]) + ", v " + to_text(vs[j]) + " … " + to_text(vs[j + 1])};
      boxes.back().push_back(std::move(*box));
    }
  }
  return detail::joined_smoothly(us, vs, boxes);
}

}  // namespace patchproof
