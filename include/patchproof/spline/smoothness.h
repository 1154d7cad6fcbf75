// SPDX-License-Identifier: Apache-2.0
// How smoothly the pieces of a curve meet, decided exactly: at every break inside the domain, and where a closed curve ends
// and begins again.
//
// The knots promise C^(p−m) at a break of multiplicity m; the control points decide what is true. With the Taylor
// polynomials A/W from the left (1) and from the right (2), W = 1 for a polynomial curve,
//
//   A2/W2 − A1/W1 = D/(W1 W2),   D = A2 W1 − A1 W2 = D_k x^k + …     first jump: order k, value k! D_k/(W1 W2)(0),
//
// and D = 0 says that both sides are one and the same function. A homogeneous curve may be less smooth than the affine one:
// a full circle of nine points (conic.h) is C¹ and its homogeneous points are only C⁰.
// C¹ does not mean a continuous tangent: where the velocity is zero, the tangent is the direction of the first derivative
// that is not, and that one may turn.
//
// REQUIRES  …_rational: W is not zero at the breaks (and at the ends for closing), from either side.
// ENSURES   (1) one entry for each distinct knot inside the domain, in order; nominal = max(−1, p − multiplicity);
//           (2) the derivatives of orders 0…order agree from both sides, and those of order + 1 differ by `jump`, right minus
//               left; order is kOneFunction exactly when both pieces are one polynomial, or one rational function;
//           (3) order ≥ nominal; the affine curve is at least as smooth as the homogeneous one;
//           (4) inserted knots have order kOneFunction and change nothing elsewhere; reversal changes the sign of jumps of
//               even order; scaling all homogeneous points by one number changes no affine answer;
//           (5) has_tangent: the curve is continuous here and comes in and leaves in the same direction, each side's first
//               non-zero derivative taken; false when a side is constant;
//           (6) closing: the same between the end and the begin of the domain, jump = begin minus end.
// SCALARS   T: ExactField. K: OrderedField that T can hold.
// COST      O(p³) points for each break.
// SOURCE    C. de Boor, A Practical Guide to Splines, chapter IX; L. Piegl, W. Tiller, The NURBS Book, 2nd ed., §4.2.
// NEIGHBOURS spline_domain.h (components), homogeneous.h (derivatives of quotients), curve_denominator.h (is W ≠ 0?).
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/curve.h"

namespace patchproof {

// The order of smoothness of two pieces that are one function.
constexpr int kOneFunction = std::numeric_limits<int>::max();

// How two pieces meet at one parameter.
template <ExactField T, std::size_t N>
struct Smoothness {
  int order;            // −1: the value jumps;  k: C^k, not C^(k+1);  kOneFunction
  Vec<T, N> jump;       // of the derivative of that order + 1, right minus left; 0 for kOneFunction
  bool has_zero_speed;  // the first derivative from the left or from the right is 0
  bool has_tangent;     // continuous, with one direction of the tangent (G¹)

  bool is_one_function() const { return order == kOneFunction; }
};

template <ExactField T, std::size_t N, OrderedField K>
struct BreakSmoothness {
  K t;
  int multiplicity;
  int nominal;  // what the knots promise
  Smoothness<T, N> actual;
};

// Polynomial curves; also the homogeneous points of a rational one.
template <ExactField T, std::size_t N, OrderedField K>
std::vector<BreakSmoothness<T, N, K>> smoothness(const BsplineCurve<T, N, K>& curve);

// The affine curve of a curve of homogeneous points.
template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) std::vector<BreakSmoothness<T, M - 1, K>> smoothness_rational(const BsplineCurve<T, M, K>& curve);

// At one parameter, a break or not. REQUIRES domain_begin < t < domain_end.
template <ExactField T, std::size_t N, OrderedField K>
Smoothness<T, N> smoothness_at(const BsplineCurve<T, N, K>& curve, const K& t);
template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) Smoothness<T, M - 1> smoothness_at_rational(const BsplineCurve<T, M, K>& curve, const K& t);

// From the end of the domain to its begin. The curve is closed when the order is not −1.
template <ExactField T, std::size_t N, OrderedField K>
Smoothness<T, N> closing_smoothness(const BsplineCurve<T, N, K>& curve);

template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) Smoothness<T, M - 1> closing_smoothness_rational(const BsplineCurve<T, M, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The first Taylor coefficients of A and W at one parameter, from one side; both lists have the same length.
template <Ring T, std::size_t N>
struct TaylorQuotient {
  std::vector<Vec<T, N>> a;
  std::vector<T> w;
};

template <ExactField T, std::size_t N, OrderedField K>
std::vector<Vec<T, N>> taylor(const BsplineCurve<T, N, K>& curve, const K& t, Side side, int order) {
  std::vector<Vec<T, N>> out = derivatives(curve, t, order, side);
  T inverse_factorial(1);
  for (int k = 2; k <= order; ++k) {
    inverse_factorial = inverse_factorial / T(k);
    out[k] = inverse_factorial * out[k];
  }
  return out;
}

template <ExactField T, std::size_t N>
TaylorQuotient<T, N> as_polynomial(std::vector<Vec<T, N>> taylor) {
  std::vector<T> w(taylor.size(), T(0));
  w[0] = T(1);
  return {std::move(taylor), std::move(w)};
}

template <ExactField T, std::size_t M>
TaylorQuotient<T, M - 1> as_quotient(const std::vector<Vec<T, M>>& taylor) {
  TaylorQuotient<T, M - 1> out;
  for (const Vec<T, M>& h : taylor) {
    out.a.emplace_back();
    for (std::size_t c = 0; c + 1 < M; ++c) out.a.back()[c] = h[c];
    out.w.push_back(h[M - 1]);
  }
  PATCHPROOF_REQUIRES(!is_zero_point(out.w[0]), "smoothness: the denominator vanishes at a break");
  return out;
}

// The coefficient of x^k in A2 W1 − A1 W2.
template <ExactField T, std::size_t N>
Vec<T, N> cross_coefficient(const TaylorQuotient<T, N>& f1, const TaylorQuotient<T, N>& f2, int k) {
  Vec<T, N> sum;
  const int p = static_cast<int>(f1.w.size()) - 1;
  for (int i = std::max(0, k - p); i <= std::min(k, p); ++i) sum += f1.w[k - i] * f2.a[i] - f2.w[k - i] * f1.a[i];
  return sum;
}

// The first k with a non-zero k-th derivative, k ≥ 1, and a positive multiple of that derivative; k = 0: constant.
// With R = A/W:  R − R(0) = (W(0) A − A(0) W)/(W(0) W).
template <ExactField T, std::size_t N>
std::pair<int, Vec<T, N>> first_derivative_not_zero(const TaylorQuotient<T, N>& f) {
  for (std::size_t k = 1; k < f.w.size(); ++k) {
    const Vec<T, N> b = f.w[0] * f.a[k] - f.w[k] * f.a[0];
    if (!is_zero_point(b)) return {static_cast<int>(k), b};
  }
  return {0, {}};
}

template <ExactField T, std::size_t N>
bool same_direction(const Vec<T, N>& a, const Vec<T, N>& b) {
  T along(0);
  for (std::size_t i = 0; i < N; ++i) {
    along += a[i] * b[i];
    for (std::size_t j = i + 1; j < N; ++j)
      if (!is_zero_point(T(a[i] * b[j] - a[j] * b[i]))) return false;
  }
  return *scalar_traits<T>::sign(along) == Sign::positive;
}

// What the coefficients up to some order say; nothing when more of them are needed.
template <ExactField T, std::size_t N>
std::optional<Smoothness<T, N>> meet(const TaylorQuotient<T, N>& left, const TaylorQuotient<T, N>& right,
                                     bool complete) {
  Smoothness<T, N> out{kOneFunction, {}, false, false};
  const int order = static_cast<int>(left.w.size()) - 1;
  T factorial(1);
  for (int k = 0; k <= (complete ? 2 * order : order); ++k) {
    if (k > 0) factorial = T(k) * factorial;
    const Vec<T, N> d = cross_coefficient(left, right, k);
    if (is_zero_point(d)) continue;
    out.order = k - 1;
    out.jump = factorial / (left.w[0] * right.w[0]) * d;
    break;
  }
  const auto [left_order, left_derivative] = first_derivative_not_zero(left);
  const auto [right_order, right_derivative] = first_derivative_not_zero(right);
  if (!complete && (out.order == kOneFunction || left_order == 0 || right_order == 0)) return std::nullopt;
  out.has_zero_speed = left_order != 1 || right_order != 1;
  // Before the break x is negative: the k-th derivative points backwards for even k.
  out.has_tangent = out.order >= 0 && left_order > 0 && right_order > 0 &&
                    same_direction(left_order % 2 == 1 ? left_derivative : -left_derivative, right_derivative);
  return out;
}

// Low orders decide nearly always, and are cheap where numbers are long: meet_up_to(order, complete) is asked for more and
// more until it answers.
template <class MeetUpTo>
auto meet_lazily(int degree, MeetUpTo meet_up_to) {
  for (int order = std::min(degree, 3);; order = std::min(degree, 2 * order))
    if (auto out = meet_up_to(order, order == degree)) return *out;
}

// Runs at(t) for each inner break.
template <ExactField T, std::size_t N, OrderedField K, class At>
std::vector<BreakSmoothness<T, N, K>> smoothness_at_breaks(const KnotVector<K>& knots, At at) {
  std::vector<BreakSmoothness<T, N, K>> out;
  const std::vector<K> breaks = knots.breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const int multiplicity = knots.multiplicity(breaks[i]);
    out.push_back({breaks[i], multiplicity, std::max(-1, knots.degree() - multiplicity), at(breaks[i])});
  }
  return out;
}

template <OrderedField K>
void require_inside(const KnotVector<K>& knots, const K& t) {
  PATCHPROOF_REQUIRES(knots.domain_begin() < t && t < knots.domain_end(),
                      "smoothness_at: the parameter lies inside the domain");
}

// The curve coming in at `from` and leaving at `to`.
template <ExactField T, std::size_t N, OrderedField K>
Smoothness<T, N> meet_polynomial(const BsplineCurve<T, N, K>& curve, const K& from, const K& to) {
  return meet_lazily(curve.degree(), [&](int order, bool complete) {
    return meet(as_polynomial(taylor(curve, from, Side::left, order)),
                as_polynomial(taylor(curve, to, Side::right, order)), complete);
  });
}
template <ExactField T, std::size_t M, OrderedField K>
Smoothness<T, M - 1> meet_rational(const BsplineCurve<T, M, K>& curve, const K& from, const K& to) {
  return meet_lazily(curve.degree(), [&](int order, bool complete) {
    return meet(as_quotient(taylor(curve, from, Side::left, order)), as_quotient(taylor(curve, to, Side::right, order)),
                complete);
  });
}

}  // namespace detail

template <ExactField T, std::size_t N, OrderedField K>
Smoothness<T, N> smoothness_at(const BsplineCurve<T, N, K>& curve, const K& t) {
  detail::require_inside(curve.knots(), t);
  return detail::meet_polynomial(curve, t, t);
}

template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) Smoothness<T, M - 1> smoothness_at_rational(const BsplineCurve<T, M, K>& curve, const K& t) {
  detail::require_inside(curve.knots(), t);
  return detail::meet_rational(curve, t, t);
}

template <ExactField T, std::size_t N, OrderedField K>
std::vector<BreakSmoothness<T, N, K>> smoothness(const BsplineCurve<T, N, K>& curve) {
  return detail::smoothness_at_breaks<T, N, K>(curve.knots(), [&](const K& t) { return smoothness_at(curve, t); });
}

template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) std::vector<BreakSmoothness<T, M - 1, K>> smoothness_rational(const BsplineCurve<T, M, K>& curve) {
  return detail::smoothness_at_breaks<T, M - 1, K>(curve.knots(),
                                                   [&](const K& t) { return smoothness_at_rational(curve, t); });
}

template <ExactField T, std::size_t N, OrderedField K>
Smoothness<T, N> closing_smoothness(const BsplineCurve<T, N, K>& curve) {
  return detail::meet_polynomial(curve, curve.knots().domain_end(), curve.knots().domain_begin());
}

template <ExactField T, std::size_t M, OrderedField K>
requires(M >= 2) Smoothness<T, M - 1> closing_smoothness_rational(const BsplineCurve<T, M, K>& curve) {
  return detail::meet_rational(curve, curve.knots().domain_end(), curve.knots().domain_begin());
}

}  // namespace patchproof
