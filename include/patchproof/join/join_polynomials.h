// SPDX-License-Identifier: Apache-2.0
// The polynomials whose vanishing and size decide how two patches join, formed by symbolic cancellation before anything
// is bounded. All are binary forms (spline/binary_form.h) over one piece of the join's pairing.
//
// Let X(s,t) and Y(s,t) be the homogeneous patches A and B near the line, s the parameter distance into the own patch,
// t the common parameter, x = X/w_X and y = Y/w_Y the points. On s = 0:
//     point_difference   N = X w_Y − Y w_X                       y = x  iff  N = 0;   |x − y| = |N| / (w_X w_Y)
//     cross terms        P = X_s w_Y − Y w_Xs,  Q = Y_s w_X − X w_Ys
//                        given y = x:  y_s = −λ x_s  iff  Q = −λ P  (C1 as given: λ = 1)
//     second_difference  (X w_Y)-terms of order 2 of X(−s,t) w_Y(s,t) − Y(s,t) w_X(−s,t):  C2 iff C1 and it vanishes
//     normal             n_X = w X_t × X_s + w_s X × X_t − w_t X × X_s  =  w³ x_t × x_s
//     coplanarity        det[X, X_t, X_s, Y_s] (rows w, x, y, z), zero iff (given y = x and n_X ≠ 0) Y_s lies in A's tangent plane
// Normals of both sides use the same column order with both s pointing inward, so a smooth join has n_X and n_Y opposed.
//
// ENSURES  (1) each form equals the expression above, for every R;  (2) a polynomial side has a weight form of degree 0, so
//          polynomial joins cost no rational arithmetic;  (3) shifting the origin changes none of N, P, Q, n, det.
// SCALARS  R: Ring (Integer on cleared rows, Quadratic, Interval).
// SOURCE   K. Konno, H. Chiyokura's joins in homogeneous form; docs/mathematics.md has the proofs.
#pragma once

#include <array>
#include <vector>

#include "patchproof/spline/binary_form.h"

namespace patchproof {

template <Ring R>
using FormVector = std::array<BinaryForm<R>, 3>;

// One side of one piece: position[k] and weight[k] are the k-th derivatives into the patch of X and w_X, k = 0, 1, 2.
template <Ring R>
struct SideForms {
  std::array<FormVector<R>, 3> position;
  std::array<BinaryForm<R>, 3> weight;
};

template <Ring R>
struct JoinForms {
  SideForms<R> a, b;
};

template <Ring R>
FormVector<R> operator+(const FormVector<R>& f, const FormVector<R>& g) {
  return {f[0] + g[0], f[1] + g[1], f[2] + g[2]};
}
template <Ring R>
FormVector<R> operator-(const FormVector<R>& f, const FormVector<R>& g) {
  return {f[0] - g[0], f[1] - g[1], f[2] - g[2]};
}
template <Ring R>
FormVector<R> operator*(const BinaryForm<R>& s, const FormVector<R>& f) {
  return {s * f[0], s * f[1], s * f[2]};
}
template <Ring R>
FormVector<R> cross(const FormVector<R>& f, const FormVector<R>& g) {
  return {f[1] * g[2] - f[2] * g[1], f[2] * g[0] - f[0] * g[2], f[0] * g[1] - f[1] * g[0]};
}
template <Ring R>
BinaryForm<R> dot(const FormVector<R>& f, const FormVector<R>& g) {
  return f[0] * g[0] + f[1] * g[1] + f[2] * g[2];
}
template <Ring R>
FormVector<R> derivative(const FormVector<R>& f) {
  return {f[0].derivative(), f[1].derivative(), f[2].derivative()};
}

template <Ring R>
FormVector<R> point_difference(const SideForms<R>& a, const SideForms<R>& b) {
  return b.weight[0] * a.position[0] - a.weight[0] * b.position[0];
}

// P for (a, b); Q is cross_term(b, a).
template <Ring R>
FormVector<R> cross_term(const SideForms<R>& a, const SideForms<R>& b) {
  return b.weight[0] * a.position[1] - a.weight[1] * b.position[0];
}

template <Ring R>
FormVector<R> second_difference(const SideForms<R>& a, const SideForms<R>& b) {
  const BinaryForm<R> two = BinaryForm<R>::constant(R(2));
  return b.weight[0] * a.position[2] - two * (b.weight[1] * a.position[1]) + b.weight[2] * a.position[0] -
         (a.weight[0] * b.position[2] - two * (a.weight[1] * b.position[1]) + a.weight[2] * b.position[0]);
}

// The cross-boundary order at which a normal is taken: first is x_t × x_s; second is its s-derivative, the direction of
// the limit normal where x_t × x_s vanishes along the whole line (collapsed edges, vanishing cross derivatives).
enum class NormalOrder { first, second };

template <Ring R>
FormVector<R> normal(const SideForms<R>& side, NormalOrder order = NormalOrder::first);

template <Ring R>
BinaryForm<R> coplanarity(const SideForms<R>& a, const SideForms<R>& b);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring R>
FormVector<R> normal(const SideForms<R>& side, NormalOrder order) {
  const auto& X = side.position;
  const auto& w = side.weight;
  const auto term = [](const BinaryForm<R>& weight, const FormVector<R>& f, const FormVector<R>& g) {
    return weight.is_empty() ? FormVector<R>{} : weight * cross(f, g);
  };
  if (order == NormalOrder::first)
    return term(w[0], derivative(X[0]), X[1]) + term(w[1], X[0], derivative(X[0])) -
           term(w[0].derivative(), X[0], X[1]);
  // Product rule in s; w_s X_t × X_s and w_s X_s × X_t cancel.
  return term(w[0], derivative(X[1]), X[1]) + term(w[0], derivative(X[0]), X[2]) + term(w[2], X[0], derivative(X[0])) +
         term(w[1], X[0], derivative(X[1])) - term(w[1].derivative(), X[0], X[1]) - term(w[0].derivative(), X[0], X[2]);
}

template <Ring R>
BinaryForm<R> coplanarity(const SideForms<R>& a, const SideForms<R>& b) {
  const FormVector<R>&x = a.position[0], &xs = a.position[1], &ys = b.position[1], xt = derivative(a.position[0]);
  const BinaryForm<R> wt = a.weight[0].derivative();
  // Expansion along the row of weights: det[X, X_t, X_s, Y_s] with columns (x, y, z, w).
  const FormVector<R> xs_ys = cross(xs, ys);
  BinaryForm<R> det = a.weight[0] * dot(xt, xs_ys);
  if (!wt.is_empty()) det = det - wt * dot(x, xs_ys);
  if (!a.weight[1].is_empty() || !b.weight[1].is_empty()) {
    const FormVector<R> x_xt = cross(x, xt);
    det = det + a.weight[1] * dot(x_xt, ys) - b.weight[1] * dot(x_xt, xs);
  }
  return det;
}

}  // namespace patchproof
