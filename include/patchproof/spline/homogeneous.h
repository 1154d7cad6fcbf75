// SPDX-License-Identifier: Apache-2.0
// Rational curves: affine points and derivatives from homogeneous ones. The homogeneous point (A, w) = (w·x, w·y, …, w)
// stands for the affine point A/w.
//
//   R = A/W,    R^(r) = (A^(r) − Σ_{j=1…r} C(r,j) W^(j) R^(r−j)) / W
//
// Control points are stored homogeneously, so weight 0 (a control vector) and negative weights are legal; only the value
// of W where the curve is evaluated must not vanish.
//
// REQUIRES  project, rational_derivatives: the weight is not certainly zero.
// ENSURES   (1) project(to_homogeneous(p, w)) = p;  (2) project(λ h) = project(h) for λ ≠ 0;
//           (3) rational_derivatives gives the derivatives of the quotient A/W, of every order;
//           (4) with all weights equal to 1 they are those of the polynomial curve;
//           (5) the rational basis sums to 1, and Σ p_i R_i is the affine point of the curve with points p_i.
// SCALARS   T: Field. An enclosure of W that contains 0 without being 0 gives the enclosure "anything", never a point.
// ERRORS    none here; readers certify the denominator first (patch/denominator.h).
// COST      order² combinations of points.
// SOURCE    L. Piegl, W. Tiller, The NURBS Book, 2nd ed., §4.3.
#pragma once

#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/bernstein.h"
#include "patchproof/spline/curve.h"
#include "patchproof/vec.h"

namespace patchproof {

// (w·p, w).
template <Ring T, std::size_t N>
Vec<T, N + 1> to_homogeneous(const Vec<T, N>& p, const T& weight) {
  Vec<T, N + 1> h;
  for (std::size_t i = 0; i < N; ++i) h[i] = weight * p[i];
  h[N] = weight;
  return h;
}

// The same for a row of control points. REQUIRES as many weights as points.
template <Ring T, std::size_t N>
std::vector<Vec<T, N + 1>> to_homogeneous(const std::vector<Vec<T, N>>& points, const std::vector<T>& weights) {
  PATCHPROOF_REQUIRES(points.size() == weights.size(), "to_homogeneous: one weight for each point");
  std::vector<Vec<T, N + 1>> out;
  for (std::size_t i = 0; i < points.size(); ++i) out.push_back(to_homogeneous(points[i], weights[i]));
  return out;
}

// The affine derivatives of orders 0…k from the homogeneous ones of orders 0…k, at one parameter. REQUIRES at least one.
template <Field T, std::size_t M>
requires(M >= 2) std::vector<Vec<T, M - 1>> rational_derivatives(const std::vector<Vec<T, M>>& homogeneous);

// The affine point A/w.
template <Field T, std::size_t M>
requires(M >= 2) Vec<T, M - 1> project(const Vec<T, M>& h) {
  return rational_derivatives(std::vector<Vec<T, M>>{h})[0];
}

// The affine point at t of a curve of homogeneous points, from `side`. REQUIRES t in the domain.
template <Field T, std::size_t M, OrderedField K>
Vec<T, M - 1> evaluate_rational(const BsplineCurve<T, M, K>& curve, const K& t, Side side = Side::right) {
  return project(evaluate(curve, t, side));
}

// Its affine derivatives of orders 0…order at t, from `side`. REQUIRES t in the domain, order ≥ 0.
template <Field T, std::size_t M, OrderedField K>
std::vector<Vec<T, M - 1>> rational_derivatives(const BsplineCurve<T, M, K>& curve, const K& t, int order,
                                                Side side = Side::right) {
  return rational_derivatives(derivatives(curve, t, order, side));
}

// R_i(t) = w_i N_i(t) / Σ_j w_j N_j(t) for all i, as limits from `side`. A weight 0 gives the function 0 (its control
// vector has no place in a sum of affine points). REQUIRES t in the domain, one weight for each function, Σ w_j N_j not
// certainly zero.
template <Field T, OrderedField K>
std::vector<T> rational_basis(const KnotVector<K>& knots, const std::vector<T>& weights, const K& t,
                              Side side = Side::right);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Ordered scalars can be asked; of the others sign() is believed. (A double answers no sign, but 0 is 0.)
template <Field T>
bool is_certainly_zero(const T& w) {
  if constexpr (OrderedField<T>)
    return w == T(0);
  else
    return scalar_traits<T>::sign(w) == Sign::zero;
}

}  // namespace detail

template <Field T, std::size_t M>
requires(M >= 2) std::vector<Vec<T, M - 1>> rational_derivatives(const std::vector<Vec<T, M>>& homogeneous) {
  PATCHPROOF_REQUIRES(!homogeneous.empty(), "rational_derivatives: the value at least");
  const T& weight = homogeneous[0][M - 1];
  PATCHPROOF_REQUIRES(!detail::is_certainly_zero(weight), "the homogeneous point lies at infinity: its weight is zero");
  std::vector<Vec<T, M - 1>> out;
  for (std::size_t r = 0; r < homogeneous.size(); ++r) {
    Vec<T, M - 1> a;
    for (std::size_t c = 0; c + 1 < M; ++c) a[c] = homogeneous[r][c];
    const std::vector<T> choose = binomial_row<T>(static_cast<int>(r));
    for (std::size_t j = 1; j <= r; ++j) a = a - (choose[j] * homogeneous[j][M - 1]) * out[r - j];
    for (std::size_t c = 0; c + 1 < M; ++c) a[c] = a[c] / weight;
    out.push_back(a);
  }
  return out;
}

template <Field T, OrderedField K>
std::vector<T> rational_basis(const KnotVector<K>& knots, const std::vector<T>& weights, const K& t, Side side) {
  PATCHPROOF_REQUIRES(static_cast<int>(weights.size()) == knots.control_count(),
                      "rational_basis: one weight for each function");
  const int span = knots.find_span(t, side), first = span - knots.degree();
  const std::vector<T> live = basis_in_span<T>(knots, span, t);
  std::vector<T> out(weights.size(), T(0));
  T denominator(0);
  for (std::size_t l = 0; l < live.size(); ++l) denominator += out[first + l] = weights[first + l] * live[l];
  PATCHPROOF_REQUIRES(!detail::is_certainly_zero(denominator), "rational_basis: the denominator is zero here");
  for (std::size_t l = 0; l < live.size(); ++l) out[first + l] = out[first + l] / denominator;
  return out;
}

}  // namespace patchproof
