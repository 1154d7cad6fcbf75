// SPDX-License-Identifier: Apache-2.0
// Tensor-product B-spline patches S(u,v) = Σ_i Σ_j d_ij N_{i,p}(u) N_{j,q}(v) with control points d_ij in T^N.
//
// The net is stored with j (along v) running fastest: d_ij = net[i · count_v + j]. A Bézier patch is one with Bézier knots.
// Rational patches are patches of homogeneous points: rational_patch.h.
//
// REQUIRES  parameters in the domain; at a knot the sides say which limit is meant.
// ENSURES  (1) evaluate is the double sum above, along v first or along u first;  (2) partial derivatives of any order are
//          those of the polynomial piece; beyond the degree they are zero;  (3) swap_directions: S'(u,v) == S(v,u), and
//          S'_uv == S_uv;  (4) at a knot of multiplicity above the degree the two sides may differ, elsewhere they agree;
//          both ends of the domain have a value;  (5) evaluation in a span takes a parameter of any scalar U and encloses
//          what U encloses;  (6) corner twists are S_uv at the corners.
// SCALARS  T: Ring that knots embed into, K: OrderedField; parameters K, or any Ring U that T and K embed into. Exact when T
//          and K are.
// COST     O((p + 1)(q + 1)) point operations after the basis functions.
// SOURCE   L. Piegl, W. Tiller, The NURBS Book, 2nd ed., §3.4–3.5.
// NEIGHBOURS bezier_patch.h (polynomial pieces), patch_knots.h (knots, degrees, parts), boundary.h (edges).
// TEST     tests/patch/bspline_patch_test.cpp checks (1)–(6).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "patchproof/deadline.h"
#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

// The two parameter directions of a patch.
enum class Direction { u, v };

// [u_begin, u_end] × [v_begin, v_end]
template <OrderedField K>
struct ParameterBox {
  K u_begin, u_end, v_begin, v_end;
  friend bool operator==(const ParameterBox&, const ParameterBox&) = default;
};

template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
class BsplinePatch {
 public:
  using Point = Vec<T, N>;

  // ERRORS wrong_count unless the net has u.control_count() · v.control_count() points.
  static Result<BsplinePatch> make(KnotVector<K> u, KnotVector<K> v, std::vector<Point> net) {
    const std::size_t count = static_cast<std::size_t>(u.control_count()) * v.control_count();
    if (net.size() != count)
      return Error{ErrorCode::wrong_count, "",
                   "the knots need " + std::to_string(u.control_count()) + " x " + std::to_string(v.control_count()) +
                       " control points",
                   std::to_string(net.size())};
    return BsplinePatch(std::move(u), std::move(v), std::move(net));
  }
  // REQUIRES what make() checks.
  BsplinePatch(KnotVector<K> u, KnotVector<K> v, std::vector<Point> net)
      : u_(std::move(u)), v_(std::move(v)), net_(std::move(net)) {
    PATCHPROOF_REQUIRES(net_.size() == static_cast<std::size_t>(u_.control_count()) * v_.control_count(),
                        "BsplinePatch: wrong point count");
  }

  const KnotVector<K>& knots(Direction d) const { return d == Direction::u ? u_ : v_; }
  int degree(Direction d) const { return knots(d).degree(); }
  int count(Direction d) const { return knots(d).control_count(); }
  const Point& point(int i, int j) const { return net_[static_cast<std::size_t>(i) * v_.control_count() + j]; }
  const std::vector<Point>& net() const { return net_; }
  ParameterBox<K> domain() const { return {u_.domain_begin(), u_.domain_end(), v_.domain_begin(), v_.domain_end()}; }

 private:
  KnotVector<K> u_, v_;
  std::vector<Point> net_;
};

// All ∂^(k+l) S / ∂u^k ∂v^l for k ≤ order_u, l ≤ order_v at one place.
template <Ring T, std::size_t N>
class PartialDerivatives {
 public:
  PartialDerivatives(int order_u, int order_v, std::vector<Vec<T, N>> values)
      : order_u_(order_u), order_v_(order_v), values_(std::move(values)) {}
  int order_u() const { return order_u_; }
  int order_v() const { return order_v_; }
  // REQUIRES 0 ≤ k ≤ order_u, 0 ≤ l ≤ order_v.
  const Vec<T, N>& at(int k, int l) const { return values_[static_cast<std::size_t>(k) * (order_v_ + 1) + l]; }

 private:
  int order_u_, order_v_;
  std::vector<Vec<T, N>> values_;
};

// S(u,v)
template <Ring T, std::size_t N, OrderedField K>
Vec<T, N> evaluate(const BsplinePatch<T, N, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                   Side side_v = Side::right);

template <Ring T, std::size_t N, OrderedField K>
PartialDerivatives<T, N> partial_derivatives(const BsplinePatch<T, N, K>& patch, const K& u, const K& v, int order_u,
                                             int order_v, Side side_u = Side::right, Side side_v = Side::right);

// The polynomial piece of the given spans (KnotVector::find_span) and its derivatives, at parameters of another scalar,
// also outside the spans.
template <Ring U, Ring T, std::size_t N, OrderedField K>
Vec<U, N> evaluate_in_span(const BsplinePatch<T, N, K>& patch, int span_u, int span_v, const U& u, const U& v);
template <Ring U, Ring T, std::size_t N, OrderedField K>
PartialDerivatives<U, N> partial_derivatives_in_span(const BsplinePatch<T, N, K>& patch, int span_u, int span_v,
                                                     const U& u, const U& v, int order_u, int order_v);

// S_uv at (u_begin, v_begin), (u_end, v_begin), (u_begin, v_end), (u_end, v_end) of the domain.
template <Ring T, std::size_t N, OrderedField K>
std::array<Vec<T, N>, 4> corner_twists(const BsplinePatch<T, N, K>& patch);

// u and v exchanged: S'(u,v) = S(v,u).
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> swap_directions(const BsplinePatch<T, N, K>& patch);

// The patch whose control points are f(d_ij); f may change their dimension and scalar.
template <Ring T, std::size_t N, OrderedField K, class F>
auto map_points(const BsplinePatch<T, N, K>& patch, F f);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// A net with i along u and j, along v, running fastest.
template <class Point>
struct Net {
  int count_u, count_v;
  std::vector<Point> points;
};

// `op` (points of a line → points of its image) applied to each line of the net that runs along d, in order.
template <class Point, class Op>
Net<Point> map_lines(const std::vector<Point>& net, int count_u, int count_v, Direction d, Op op) {
  const int lines = d == Direction::u ? count_v : count_u, length = d == Direction::u ? count_u : count_v;
  Net<Point> out{count_u, count_v, {}};
  for (int line = 0; line < lines; ++line) {
    std::vector<Point> points;
    points.reserve(length);
    for (int k = 0; k < length; ++k)
      points.push_back(net[d == Direction::u ? static_cast<std::size_t>(k) * count_v + line
                                             : static_cast<std::size_t>(line) * count_v + k]);
    std::vector<Point> image = op(std::move(points));
    if (line == 0) {
      (d == Direction::u ? out.count_u : out.count_v) = static_cast<int>(image.size());
      out.points.resize(image.size() * lines);
    }
    for (std::size_t k = 0; k < image.size(); ++k)
      out.points[d == Direction::u ? k * lines + line : line * image.size() + k] = std::move(image[k]);
  }
  return out;
}

template <class Point>
std::vector<Point> transposed(const std::vector<Point>& net, int count_u, int count_v) {
  std::vector<Point> out;
  out.reserve(net.size());
  for (int j = 0; j < count_v; ++j)
    for (int i = 0; i < count_u; ++i) out.push_back(net[static_cast<std::size_t>(i) * count_v + j]);
  return out;
}

// basis_u[k][i]: k-th derivative of the i-th basis function that is not zero on span_u; likewise basis_v.
template <Ring U, Ring T, std::size_t N, OrderedField K>
PartialDerivatives<U, N> contract(const BsplinePatch<T, N, K>& patch, int span_u, int span_v,
                                  const std::vector<std::vector<U>>& basis_u,
                                  const std::vector<std::vector<U>>& basis_v) {
  const int p = patch.degree(Direction::u), q = patch.degree(Direction::v);
  const std::size_t orders_v = basis_v.size();
  std::vector<Vec<U, N>> values(basis_u.size() * orders_v);
  for (int i = 0; i <= p; ++i) {
    if constexpr (ExactRing<U>) check_deadline();
    std::vector<Vec<U, N>> along_v(orders_v);
    for (int j = 0; j <= q; ++j) {
      Vec<U, N> point;
      for (std::size_t c = 0; c < N; ++c) point[c] = embed<U>(patch.point(span_u - p + i, span_v - q + j)[c]);
      for (std::size_t l = 0; l < orders_v; ++l) along_v[l] += basis_v[l][j] * point;
    }
    for (std::size_t k = 0; k < basis_u.size(); ++k)
      for (std::size_t l = 0; l < orders_v; ++l) values[k * orders_v + l] += basis_u[k][i] * along_v[l];
  }
  return {static_cast<int>(basis_u.size()) - 1, static_cast<int>(orders_v) - 1, std::move(values)};
}

}  // namespace detail

template <Ring T, std::size_t N, OrderedField K>
PartialDerivatives<T, N> partial_derivatives(const BsplinePatch<T, N, K>& patch, const K& u, const K& v, int order_u,
                                             int order_v, Side side_u, Side side_v) {
  const KnotVector<K>&knots_u = patch.knots(Direction::u), &knots_v = patch.knots(Direction::v);
  const int span_u = knots_u.find_span(u, side_u), span_v = knots_v.find_span(v, side_v);
  return detail::contract<T>(patch, span_u, span_v, basis_derivatives_in_span<T>(knots_u, span_u, u, order_u),
                             basis_derivatives_in_span<T>(knots_v, span_v, v, order_v));
}

template <Ring T, std::size_t N, OrderedField K>
Vec<T, N> evaluate(const BsplinePatch<T, N, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  return partial_derivatives(patch, u, v, 0, 0, side_u, side_v).at(0, 0);
}

template <Ring U, Ring T, std::size_t N, OrderedField K>
PartialDerivatives<U, N> partial_derivatives_in_span(const BsplinePatch<T, N, K>& patch, int span_u, int span_v,
                                                     const U& u, const U& v, int order_u, int order_v) {
  return detail::contract<U>(patch, span_u, span_v,
                             basis_derivatives_in_span<U>(patch.knots(Direction::u), span_u, u, order_u),
                             basis_derivatives_in_span<U>(patch.knots(Direction::v), span_v, v, order_v));
}

template <Ring U, Ring T, std::size_t N, OrderedField K>
Vec<U, N> evaluate_in_span(const BsplinePatch<T, N, K>& patch, int span_u, int span_v, const U& u, const U& v) {
  return partial_derivatives_in_span(patch, span_u, span_v, u, v, 0, 0).at(0, 0);
}

template <Ring T, std::size_t N, OrderedField K>
std::array<Vec<T, N>, 4> corner_twists(const BsplinePatch<T, N, K>& patch) {
  const ParameterBox<K> d = patch.domain();
  const auto twist = [&](const K& u, const K& v) { return partial_derivatives(patch, u, v, 1, 1).at(1, 1); };
  return {twist(d.u_begin, d.v_begin), twist(d.u_end, d.v_begin), twist(d.u_begin, d.v_end), twist(d.u_end, d.v_end)};
}

template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> swap_directions(const BsplinePatch<T, N, K>& patch) {
  return {patch.knots(Direction::v), patch.knots(Direction::u),
          detail::transposed(patch.net(), patch.count(Direction::u), patch.count(Direction::v))};
}

template <Ring T, std::size_t N, OrderedField K, class F>
auto map_points(const BsplinePatch<T, N, K>& patch, F f) {
  using Image = decltype(f(patch.point(0, 0)));
  std::vector<Image> net;
  net.reserve(patch.net().size());
  for (const Vec<T, N>& p : patch.net()) net.push_back(f(p));
  using Scalar = typename std::remove_cvref_t<decltype(std::declval<Image>().c)>::value_type;
  return BsplinePatch<Scalar, Image::size(), K>(patch.knots(Direction::u), patch.knots(Direction::v), std::move(net));
}

}  // namespace patchproof
