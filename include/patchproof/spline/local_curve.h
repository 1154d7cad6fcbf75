// SPDX-License-Identifier: Apache-2.0
// A local curve of a GERBS curve: a spline, a rational spline or a trigonometric curve, in the parameter of the whole.
//
//   c(t) = A(t − s)/W(t − s),    (A, W) = Σ_l P_l F_l       P_l: homogeneous points, F_l: functions (function_basis.h), s: a shift
//
// A sub-curve of a model is the model itself, mapped (apply); a Bézier curve on [0, 1] is laid over a range by map_domain
// (reparametrize.h); a Taylor curve is a Bézier curve. Trigonometric ones carry the weight on their constant, so an affine map acts
// on all homogeneous points alike.
//
// REQUIRES  weights without a zero on the range where the curve is used.
// ENSURES   (1) derivatives_at are those of the quotient, in every order;  (2) shifted(d)(t) = c(t − d);
//           (3) mapping the points by an affine map maps the curve.
// SCALARS   T: OrderedField, K: OrderedField; results in R: Field, Transcendental for trigonometric curves.
// ERRORS    trigonometric: wrong_count unless there is an odd number of points.
// TEST      tests/spline/local_curve_test.cpp checks (1)–(3).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/function_basis.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {

namespace detail {

// Whether W is 1: of splines all weights, of trigonometric functions that of the constant, in one direction or two.
template <OrderedField K, Ring T, std::size_t M>
bool has_unit_weights(const std::vector<const FunctionBasis<K>*>& bases, const std::vector<Vec<T, M>>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    bool constant = true;
    std::size_t rest = k;
    for (std::size_t d = bases.size(); d-- > 0;) {
      const std::size_t index = rest % bases[d]->count();
      rest /= bases[d]->count();
      constant = constant && (!bases[d]->is_trigonometric() || index == 0);
    }
    if (!(points[k][M - 1] == T(constant ? 1 : 0))) return false;
  }
  return true;
}

}  // namespace detail

template <OrderedField T, std::size_t M, OrderedField K = knot_scalar_t<T>>
class LocalCurve {
 public:
  using Point = Vec<T, M>;

  LocalCurve(const BsplineCurve<T, M, K>& curve) : LocalCurve(curve.knots(), curve.points()) {}
  // Σ over 1, cos πt, sin πt, cos 2πt, …, in this order.
  static Result<LocalCurve> trigonometric(std::vector<Point> points) {
    if (points.size() % 2 == 0)
      return Error{ErrorCode::wrong_count, "", "a trigonometric curve has 1, 3, 5, … coefficients",
                   std::to_string(points.size())};
    const int harmonics = static_cast<int>(points.size() / 2);
    return LocalCurve(TrigonometricFunctions{harmonics}, std::move(points));
  }

  const FunctionBasis<K>& basis() const { return basis_; }
  const std::vector<Point>& points() const { return points_; }
  const K& shift() const { return shift_; }
  bool has_unit_weights() const { return unit_weights_; }  // W = 1
  LocalCurve shifted(const K& by) const {
    LocalCurve out = *this;
    out.shift_ = shift_ + by;
    return out;
  }
  // f(P_l) for each point.
  template <class F>
  LocalCurve map_points(F f) const {
    LocalCurve out = *this;
    for (Point& p : out.points_) p = f(p);
    out.unit_weights_ = detail::has_unit_weights<K>({&out.basis_}, out.points_);
    return out;
  }
  bool covers(const K& begin, const K& end) const { return basis_.covers(begin - shift_, end - shift_); }
  std::vector<K> breaks_between(const K& begin, const K& end) const {
    std::vector<K> out = basis_.breaks_between(begin - shift_, end - shift_);
    for (K& t : out) t = t + shift_;
    return out;
  }
  // REQUIRES a spline.
  BsplineCurve<T, M, K> spline() const {
    const BsplineCurve<T, M, K> unshifted(*basis_.knots(), points_);
    return shift_ == K(0) ? unshifted : moved(unshifted);
  }
  friend bool operator==(const LocalCurve&, const LocalCurve&) = default;

 private:
  LocalCurve(FunctionBasis<K> basis, std::vector<Point> points)
      : basis_(std::move(basis)),
        points_(std::move(points)),
        unit_weights_(detail::has_unit_weights<K>({&basis_}, points_)) {}
  BsplineCurve<T, M, K> moved(const BsplineCurve<T, M, K>& curve) const {
    std::vector<K> knots = curve.knots().knots();
    for (K& t : knots) t = t + shift_;
    return {KnotVector<K>::make_unchecked(curve.degree(), std::move(knots)), curve.points()};
  }

  FunctionBasis<K> basis_;
  std::vector<Point> points_;
  K shift_{0};
  bool unit_weights_;
};

// c(t), c′(t), …, of the piece that is the limit at `inside` from `side`; t of any scalar. REQUIRES `inside` where c is defined.
template <Field R, OrderedField T, std::size_t M, OrderedField K>
std::vector<Vec<R, M - 1>> derivatives_at(const LocalCurve<T, M, K>& curve, const K& inside, Side side, const R& t,
                                          int order);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// t − s in R; nothing is rounded where there is no shift.
template <Ring R, OrderedField K>
R unshifted(const R& t, const K& shift) {
  return shift == K(0) ? t : R(t - embed<R>(shift));
}

// (A, W) → A/W and its derivatives; W = 1 costs nothing.
template <Field R, std::size_t M>
std::vector<Vec<R, M - 1>> projected(const std::vector<Vec<R, M>>& homogeneous, bool unit_weights) {
  if (!unit_weights) return rational_derivatives(homogeneous);
  std::vector<Vec<R, M - 1>> out(homogeneous.size());
  for (std::size_t r = 0; r < out.size(); ++r)
    for (std::size_t c = 0; c + 1 < M; ++c) out[r][c] = homogeneous[r][c];
  return out;
}

}  // namespace detail

template <Field R, OrderedField T, std::size_t M, OrderedField K>
std::vector<Vec<R, M - 1>> derivatives_at(const LocalCurve<T, M, K>& curve, const K& inside, Side side, const R& t,
                                          int order) {
  const LiveFunctions<R> live =
      live_functions<R>(curve.basis(), K(inside - curve.shift()), side, detail::unshifted(t, curve.shift()), order);
  std::vector<Vec<R, M>> sums(order + 1);
  for (std::size_t l = 0; l < live.values[0].size(); ++l) {
    Vec<R, M> point;
    for (std::size_t c = 0; c < M; ++c) point[c] = embed<R>(curve.points()[live.first + l][c]);
    for (int r = 0; r <= order; ++r) sums[r] += live.values[r][l] * point;
  }
  return detail::projected(sums, curve.has_unit_weights());
}

}  // namespace patchproof
