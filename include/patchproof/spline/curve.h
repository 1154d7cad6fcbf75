// SPDX-License-Identifier: Apache-2.0
// B-spline curves C(t) = Σ d_i N_{i,p}(t) with control points d_i in T^N. A rational curve in the plane or in space is a
// curve of homogeneous points (w·x, w·y, w·z, w): see homogeneous.h.
//
//   de Boor, on a span [t_i, t_{i+1}]: for r = 1…p  d_j ← (1 − α) d_{j−1} + α d_j,   α = (t − t_j)/(t_{j+p+1−r} − t_j)
//
// Every denominator contains the span, so knots of any multiplicity need no special case. At a knot the curve has a value
// from the left and one from the right; `side` chooses, and both exist at every knot inside the domain.
//
// ENSURES   (1) evaluate equals Σ d_i N_{i,p}(t) from the same side;  (2) derivative is the derivative of the polynomial
//           piece on that side, zero for orders above p;  (3) derivative_curve(C) has the value C' from either side
//           wherever C has one;  (4) the blossom of a span is symmetric, affine in each argument and the curve's piece on
//           the diagonal; d_j is the blossom at (t_{j+1}, …, t_{j+p});  (5) on Bézier knots of [0, 1] all this is
//           bernstein.h;  (6) a control point whose function has an empty support has no influence.
// SCALARS   T: Ring for the data, Field for evaluation. K: OrderedField. In …_in_span<R>, the result is in R, which T, K
//           and the parameter embed into: exact curves at Interval, Ball or Tracked parameters.
// COST      O(p²) combinations of points.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter X; L. Ramshaw, Blossoms are polar forms, CAGD 6 (1989).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

// T: scalar of the control points.  K: scalar of the knots.
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
class BsplineCurve {
 public:
  using Point = Vec<T, N>;

  // ERRORS wrong_count unless there are knots.control_count() points.
  static Result<BsplineCurve> make(KnotVector<K> knots, std::vector<Point> points) {
    if (static_cast<int>(points.size()) != knots.control_count())
      return Error{ErrorCode::wrong_count, "",
                   "the knots need " + std::to_string(knots.control_count()) + " control points",
                   std::to_string(points.size())};
    return BsplineCurve(std::move(knots), std::move(points));
  }
  // REQUIRES what make() checks.
  BsplineCurve(KnotVector<K> knots, std::vector<Point> points) : knots_(std::move(knots)), points_(std::move(points)) {
    PATCHPROOF_REQUIRES(static_cast<int>(points_.size()) == knots_.control_count(), "BsplineCurve: wrong point count");
  }
  // A Bézier curve on [0, 1]. REQUIRES at least one point.
  static BsplineCurve bezier(std::vector<Point> points) {
    const int degree = static_cast<int>(points.size()) - 1;
    return BsplineCurve(KnotVector<K>::bezier(degree), std::move(points));
  }

  int degree() const { return knots_.degree(); }
  const KnotVector<K>& knots() const { return knots_; }
  const std::vector<Point>& points() const { return points_; }

 private:
  KnotVector<K> knots_;
  std::vector<Point> points_;
};

// The order-th derivative at t of the curve's polynomial piece on `span`. REQUIRES order ≥ 0, degree ≤ span < n and
// t_span < t_{span+1}. t is not checked to lie in the span.
template <Ring R, Ring T, std::size_t N, OrderedField K, class U>
Vec<R, N> derivative_in_span(const BsplineCurve<T, N, K>& curve, int span, const U& t, int order);

// The value at t of the curve's polynomial piece on `span`. REQUIRES as above.
template <Ring R, Ring T, std::size_t N, OrderedField K, class U>
Vec<R, N> evaluate_in_span(const BsplineCurve<T, N, K>& curve, int span, const U& t) {
  return derivative_in_span<R>(curve, span, t, 0);
}

// C(t), from `side`. REQUIRES t in the domain.
template <Ring T, std::size_t N, OrderedField K>
Vec<T, N> evaluate(const BsplineCurve<T, N, K>& curve, const K& t, Side side = Side::right) {
  return evaluate_in_span<T>(curve, curve.knots().find_span(t, side), t);
}

// The order-th derivative of C at t, from `side`. REQUIRES t in the domain, order ≥ 0.
template <Ring T, std::size_t N, OrderedField K>
Vec<T, N> derivative(const BsplineCurve<T, N, K>& curve, const K& t, int order, Side side = Side::right) {
  return derivative_in_span<T>(curve, curve.knots().find_span(t, side), t, order);
}

// C(t), C'(t), …, up to the derivative of the given order, from `side`. REQUIRES as above.
template <Ring T, std::size_t N, OrderedField K>
std::vector<Vec<T, N>> derivatives(const BsplineCurve<T, N, K>& curve, const K& t, int order, Side side = Side::right) {
  const int span = curve.knots().find_span(t, side);
  std::vector<Vec<T, N>> out;
  for (int k = 0; k <= order; ++k) out.push_back(derivative_in_span<T>(curve, span, t, k));
  return out;
}

// The polar form of the curve's polynomial piece on `span`. REQUIRES as many arguments as the degree, and a span as above.
template <Ring R, Ring T, std::size_t N, OrderedField K, class U>
Vec<R, N> blossom_in_span(const BsplineCurve<T, N, K>& curve, int span, const std::vector<U>& arguments);

template <Ring T, std::size_t N, OrderedField K>
Vec<T, N> blossom(const BsplineCurve<T, N, K>& curve, int span, const std::vector<K>& arguments) {
  return blossom_in_span<T>(curve, span, arguments);
}

// C' as a B-spline curve of degree p − 1 on the same knots without the first and the last one:
//   Q_i = p (d_{i+1} − d_i)/(t_{i+p+1} − t_{i+1}).
// Where that denominator is 0 the curve may jump; Q_i then has no influence and is 0. A curve of degree 0 gives the zero
// curve on its own knots.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> derivative_curve(const BsplineCurve<T, N, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The control points that live on `span`, in R.
template <Ring R, Ring T, std::size_t N, OrderedField K>
std::vector<Vec<R, N>> live_points(const BsplineCurve<T, N, K>& curve, int span) {
  require_span(curve.knots(), span);
  std::vector<Vec<R, N>> out(curve.degree() + 1);
  for (int l = 0; l <= curve.degree(); ++l)
    for (std::size_t c = 0; c < N; ++c) out[l][c] = embed<R>(curve.points()[span - curve.degree() + l][c]);
  return out;
}

// De Boor's triangle on the live points of a piece of degree d.size() − 1; round r is done at argument(r).
template <Ring R, std::size_t N, OrderedField K, class Argument>
Vec<R, N> de_boor(const KnotVector<K>& knots, int span, std::vector<Vec<R, N>> d, Argument argument) {
  const int q = static_cast<int>(d.size()) - 1;
  for (int r = 1; r <= q; ++r)
    for (int l = q; l >= r; --l) {
      const int j = span - q + l;
      const R alpha = knot_ratio<R>(argument(r), knots[j], knots[j + q + 1 - r]);
      d[l] = (R(1) - alpha) * d[l - 1] + alpha * d[l];
    }
  return d[q];
}

}  // namespace detail

template <Ring R, Ring T, std::size_t N, OrderedField K, class U>
Vec<R, N> derivative_in_span(const BsplineCurve<T, N, K>& curve, int span, const U& t, int order) {
  PATCHPROOF_REQUIRES(order >= 0, "derivative: the order is not negative");
  std::vector<Vec<R, N>> d = detail::live_points<R>(curve, span);
  if (order > curve.degree()) return {};
  for (int q = curve.degree(); q > curve.degree() - order; --q) {
    for (int l = 0; l < q; ++l) {
      const int j = span - q + 1 + l;
      d[l] = knot_rate<R>(q, curve.knots()[j], curve.knots()[j + q]) * (d[l + 1] - d[l]);
    }
    d.pop_back();
  }
  return detail::de_boor(curve.knots(), span, std::move(d), [&](int) -> const U& { return t; });
}

template <Ring R, Ring T, std::size_t N, OrderedField K, class U>
Vec<R, N> blossom_in_span(const BsplineCurve<T, N, K>& curve, int span, const std::vector<U>& arguments) {
  PATCHPROOF_REQUIRES(static_cast<int>(arguments.size()) == curve.degree(), "blossom: as many arguments as the degree");
  return detail::de_boor(curve.knots(), span, detail::live_points<R>(curve, span),
                         [&](int r) -> const U& { return arguments[r - 1]; });
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> derivative_curve(const BsplineCurve<T, N, K>& curve) {
  const KnotVector<K>& knots = curve.knots();
  const int p = knots.degree(), n = knots.control_count();
  if (p == 0) return BsplineCurve<T, N, K>(knots, std::vector<Vec<T, N>>(n));
  std::vector<Vec<T, N>> points(n - 1);
  for (int i = 0; i + 1 < n; ++i)
    if (knots[i + 1] < knots[i + p + 1])
      points[i] = knot_rate<T>(p, knots[i + 1], knots[i + p + 1]) * (curve.points()[i + 1] - curve.points()[i]);
  std::vector<K> inner(knots.knots().begin() + 1, knots.knots().end() - 1);
  return BsplineCurve<T, N, K>(KnotVector<K>::make_unchecked(p - 1, std::move(inner)), std::move(points));
}

}  // namespace patchproof
