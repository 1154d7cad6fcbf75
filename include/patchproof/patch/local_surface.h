// SPDX-License-Identifier: Apache-2.0
// A local surface of a GERBS surface: a tensor product of splines or trigonometric functions in either direction.
//
//   c(u,v) = A/W,   (A, W)(u,v) = Σ_i Σ_j P_ij F_i(u − s_u) G_j(v − s_v)        P_ij: homogeneous points; F, G: function_basis.h
//
// REQUIRES  weights without a zero where the surface is used.
// ENSURES   (1) partial_derivatives_at are those of the quotient, in every order;  (2) shifted(d, e)(u, v) = c(u − d, v − e);
//           (3) mapping the points by an affine map maps the surface;  (4) edge_curve: c on a line of constant parameter,
//           or its derivative across it, of weight 1.
// SCALARS   T: OrderedField, K: OrderedField; results in R: Field, Transcendental for trigonometric functions.
// ERRORS    make: wrong_count unless there is a point for each pair of functions.
// NEIGHBOURS spline/local_curve.h.
// TEST      tests/patch/local_surface_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/patch/boundary.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/spline/local_curve.h"
#include "patchproof/spline/product.h"

namespace patchproof {

template <OrderedField T, std::size_t M, OrderedField K = knot_scalar_t<T>>
class LocalSurface {
 public:
  using Point = Vec<T, M>;

  LocalSurface(const BsplinePatch<T, M, K>& patch)
      : LocalSurface(patch.knots(Direction::u), patch.knots(Direction::v), patch.net()) {}
  // The net with j, along v, running fastest.
  static Result<LocalSurface> make(FunctionBasis<K> u, FunctionBasis<K> v, std::vector<Point> net) {
    if (net.size() != static_cast<std::size_t>(u.count()) * v.count())
      return Error{
          ErrorCode::wrong_count, "",
          "the functions need " + std::to_string(u.count()) + " x " + std::to_string(v.count()) + " control points",
          std::to_string(net.size())};
    return LocalSurface(std::move(u), std::move(v), std::move(net));
  }

  const FunctionBasis<K>& basis(Direction d) const { return bases_[index(d)]; }
  const std::vector<Point>& net() const { return net_; }
  const K& shift(Direction d) const { return shifts_[index(d)]; }
  bool has_unit_weights() const { return unit_weights_; }
  bool is_trigonometric() const { return bases_[0].is_trigonometric() || bases_[1].is_trigonometric(); }
  LocalSurface shifted(const K& by_u, const K& by_v) const {
    LocalSurface out = *this;
    out.shifts_ = {shifts_[0] + by_u, shifts_[1] + by_v};
    return out;
  }
  template <class F>
  LocalSurface map_points(F f) const {
    LocalSurface out = *this;
    for (Point& p : out.net_) p = f(p);
    out.unit_weights_ = detail::has_unit_weights<K>({&out.bases_[0], &out.bases_[1]}, out.net_);
    return out;
  }
  bool covers(Direction d, const K& begin, const K& end) const {
    return basis(d).covers(begin - shift(d), end - shift(d));
  }
  std::vector<K> breaks_between(Direction d, const K& begin, const K& end) const {
    std::vector<K> out = basis(d).breaks_between(begin - shift(d), end - shift(d));
    for (K& t : out) t = t + shift(d);
    return out;
  }
  // Without its shift. REQUIRES splines in both directions.
  BsplinePatch<T, M, K> patch() const { return {*bases_[0].knots(), *bases_[1].knots(), net_}; }
  friend bool operator==(const LocalSurface&, const LocalSurface&) = default;

 private:
  LocalSurface(FunctionBasis<K> u, FunctionBasis<K> v, std::vector<Point> net)
      : bases_{std::move(u), std::move(v)},
        net_(std::move(net)),
        unit_weights_(detail::has_unit_weights<K>({&bases_[0], &bases_[1]}, net_)) {}
  static std::size_t index(Direction d) { return d == Direction::u ? 0 : 1; }

  std::array<FunctionBasis<K>, 2> bases_;
  std::vector<Point> net_;
  std::array<K, 2> shifts_{K(0), K(0)};
  bool unit_weights_;
};

// All partial derivatives up to (order_u, order_v) of the piece that is the limit at `inside` from the sides.
template <Field R, OrderedField T, std::size_t M, OrderedField K>
PartialDerivatives<R, M - 1> partial_derivatives_at(const LocalSurface<T, M, K>& surface,
                                                    const std::array<K, 2>& inside, const std::array<Side, 2>& sides,
                                                    const R& u, const R& v, int order_u, int order_v);

// ---------------------------------------------------------------------------------------------------------------------

template <Field R, OrderedField T, std::size_t M, OrderedField K>
PartialDerivatives<R, M - 1> partial_derivatives_at(const LocalSurface<T, M, K>& surface,
                                                    const std::array<K, 2>& inside, const std::array<Side, 2>& sides,
                                                    const R& u, const R& v, int order_u, int order_v) {
  const auto live = [&](Direction d, const K& place, Side side, const R& x, int order) {
    return live_functions<R>(surface.basis(d), K(place - surface.shift(d)), side,
                             detail::unshifted(x, surface.shift(d)), order);
  };
  const LiveFunctions<R> f = live(Direction::u, inside[0], sides[0], u, order_u),
                         g = live(Direction::v, inside[1], sides[1], v, order_v);
  const int columns = surface.basis(Direction::v).count();
  std::vector<Vec<R, M>> values(static_cast<std::size_t>(order_u + 1) * (order_v + 1));
  for (std::size_t i = 0; i < f.values[0].size(); ++i) {
    std::vector<Vec<R, M>> along_v(order_v + 1);
    for (std::size_t j = 0; j < g.values[0].size(); ++j) {
      const Vec<T, M>& p = surface.net()[(f.first + i) * columns + g.first + j];
      Vec<R, M> point;
      for (std::size_t c = 0; c < M; ++c) point[c] = embed<R>(p[c]);
      for (int l = 0; l <= order_v; ++l) along_v[l] += g.values[l][j] * point;
    }
    for (int k = 0; k <= order_u; ++k)
      for (int l = 0; l <= order_v; ++l)
        values[static_cast<std::size_t>(k) * (order_v + 1) + l] += f.values[k][i] * along_v[l];
  }
  if (!surface.has_unit_weights())
    return rational_derivatives(PartialDerivatives<R, M>(order_u, order_v, std::move(values)));
  std::vector<Vec<R, M - 1>> points(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t c = 0; c + 1 < M; ++c) points[k][c] = values[k][c];
  return {order_u, order_v, std::move(points)};
}

// The curve v ↦ c(at, v), or u ↦ c(u, at) where `constant` is v; or the derivative of that order across it, as a curve of points.
// REQUIRES splines in the direction that is held constant; order ≤ 1 where there are weights, and then splines in both directions.
template <OrderedField T, std::size_t M, OrderedField K>
LocalCurve<T, M, K> edge_curve(const LocalSurface<T, M, K>& surface, Direction constant, const K& at, Side side,
                               int order = 0);

namespace detail {

// (A′W − AW′, W²): the derivative of A/W, of splines with the same knots.
template <OrderedField T, std::size_t M, OrderedField K>
BsplineCurve<T, M, K> quotient_derivative(const BsplineCurve<T, M, K>& value, const BsplineCurve<T, M, K>& derivative) {
  const auto weights = [](const BsplineCurve<T, M, K>& c) {
    std::vector<Vec<T, 1>> out;
    for (const Vec<T, M>& p : c.points()) out.push_back({{p[M - 1]}});
    return BsplineCurve<T, 1, K>(c.knots(), std::move(out));
  };
  const BsplineCurve<T, M, K> first = product(weights(value), derivative), second = product(weights(derivative), value),
                              squares = product(weights(value), value);
  std::vector<Vec<T, M>> points;
  for (std::size_t k = 0; k < first.points().size(); ++k) {
    points.push_back(first.points()[k] - second.points()[k]);
    points.back()[M - 1] = squares.points()[k][M - 1];
  }
  return {first.knots(), std::move(points)};
}

}  // namespace detail

template <OrderedField T, std::size_t M, OrderedField K>
LocalCurve<T, M, K> edge_curve(const LocalSurface<T, M, K>& surface, Direction constant, const K& at, Side side,
                               int order) {
  PATCHPROOF_REQUIRES(order <= 1 || surface.has_unit_weights(), "edge_curve: second derivatives of a rational surface");
  const Direction along = other(constant);
  const K place = at - surface.shift(constant);
  const LiveFunctions<T> live = live_functions<T>(surface.basis(constant), place, side, embed<T>(place), order);
  const int columns = surface.basis(Direction::v).count();
  const auto row = [&](int r) {
    std::vector<Vec<T, M>> points(surface.basis(along).count());
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t l = 0; l < live.values[r].size(); ++l) {
        const std::size_t i = constant == Direction::u ? live.first + l : k,
                          j = constant == Direction::u ? k : live.first + l;
        points[k] += live.values[r][l] * surface.net()[i * columns + j];
      }
    return points;
  };
  using Curve = BsplineCurve<T, M, K>;
  const KnotVector<K>* knots = surface.basis(along).knots();
  if (order == 1 && !surface.has_unit_weights())
    return LocalCurve<T, M, K>(detail::quotient_derivative(Curve(*knots, row(0)), Curve(*knots, row(1))))
        .shifted(surface.shift(along));
  std::vector<Vec<T, M>> points = row(order);
  if (order > 0)  // a derivative of points of weight 1, as a curve of points
    for (std::size_t k = 0; k < points.size(); ++k) points[k][M - 1] = T(k == 0 || knots ? 1 : 0);
  const LocalCurve<T, M, K> out = knots ? LocalCurve<T, M, K>(Curve(*knots, std::move(points)))
                                        : *LocalCurve<T, M, K>::trigonometric(std::move(points));
  return out.shifted(surface.shift(along));
}

}  // namespace patchproof
