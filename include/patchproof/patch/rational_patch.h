// SPDX-License-Identifier: Apache-2.0
// Rational patches: points, partial derivatives and normals of S = A/w from the homogeneous patch (A, w) = (w·x, w·y, w·z, w).
//
// The control points are homogeneous, so that weights may be negative or zero; only w itself must not vanish where the
// patch is evaluated (denominator.h proves that it vanishes nowhere). With S^{kl} = ∂^(k+l) S / ∂u^k ∂v^l, Leibniz' rule
// applied to A = w·S gives
//   S^{kl} = ( A^{kl} − Σ_{(a,b) ≠ (0,0)} C(k,a) C(l,b) w^{ab} S^{k−a, l−b} ) / w
// Normal: S_u × S_v, not normalised (its length is that of the area element; it is zero at a singular point). In terms of
// homogeneous points it is also  (w·A_u − w_u·A) × (w·A_v − w_v·A) / w⁴,  without divisions up to the factor w⁻⁴.
//
// REQUIRES parameters in the domain, and w there not certainly zero.
// ENSURES  (1) w·S == A at every parameter;  (2) the derivatives are those of the quotient, in either order the same;
//          (3) with all weights equal they are those of the polynomial patch;  (4) multiplying all homogeneous points by
//          one number ≠ 0 changes nothing;  (5) normal == S_u × S_v == scaled_normal / w⁴.
// SCALARS  T: Field (scaled_normal: Ring). Exact when T is.
// COST     O(k²l²) products for order (k, l).
// SOURCE   L. Piegl, W. Tiller, The NURBS Book, 2nd ed., §4.5.
// NEIGHBOURS spline/homogeneous.h (the same for curves), denominator.h.
// TEST     tests/patch/rational_patch_test.cpp checks (1)–(5).
#pragma once

#include <utility>
#include <vector>

#include "patchproof/patch/bspline_patch.h"
#include "patchproof/spline/homogeneous.h"

namespace patchproof {

// The affine derivatives from the homogeneous ones at the same place; a table of the same orders.
template <Field T, std::size_t M>
requires(M >= 2) PartialDerivatives<T, M - 1> rational_derivatives(const PartialDerivatives<T, M>& homogeneous);

// The affine point S(u,v).
template <Field T, std::size_t M, OrderedField K>
Vec<T, M - 1> evaluate_rational(const BsplinePatch<T, M, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                                Side side_v = Side::right);

// All affine partial derivatives up to (order_u, order_v).
template <Field T, std::size_t M, OrderedField K>
PartialDerivatives<T, M - 1> rational_derivatives(const BsplinePatch<T, M, K>& patch, const K& u, const K& v,
                                                  int order_u, int order_v, Side side_u = Side::right,
                                                  Side side_v = Side::right);

// S_u × S_v.
template <Field T, OrderedField K>
Vec<T, 3> normal(const BsplinePatch<T, 4, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                 Side side_v = Side::right);
// The same for a patch of points, without weights.
template <Ring T, OrderedField K>
Vec<T, 3> normal(const BsplinePatch<T, 3, K>& patch, const K& u, const K& v, Side side_u = Side::right,
                 Side side_v = Side::right);

// w⁴ · S_u × S_v from the homogeneous point and its derivatives, free of divisions and w⁻¹.
template <Ring T>
Vec<T, 3> scaled_normal(const Vec<T, 4>& point, const Vec<T, 4>& du, const Vec<T, 4>& dv);

// The homogeneous patch of points and their weights, both in the order of the net.
// ERRORS wrong_count unless there is one weight for each control point.
template <Ring T, OrderedField K>
Result<BsplinePatch<T, 4, K>> with_weights(const BsplinePatch<T, 3, K>& patch, const std::vector<T>& weights);
// All weights 1.
template <Ring T, OrderedField K>
BsplinePatch<T, 4, K> to_homogeneous(const BsplinePatch<T, 3, K>& patch);

// ---------------------------------------------------------------------------------------------------------------------

template <Field T, std::size_t M>
requires(M >= 2) PartialDerivatives<T, M - 1> rational_derivatives(const PartialDerivatives<T, M>& homogeneous) {
  const T& weight = homogeneous.at(0, 0)[M - 1];
  PATCHPROOF_REQUIRES(!detail::is_certainly_zero(weight), "the homogeneous point lies at infinity: its weight is zero");
  const int order_u = homogeneous.order_u(), order_v = homogeneous.order_v();
  std::vector<Vec<T, M - 1>> out;
  for (int k = 0; k <= order_u; ++k) {
    const std::vector<T> choose_u = binomial_row<T>(k);
    for (int l = 0; l <= order_v; ++l) {
      const std::vector<T> choose_v = binomial_row<T>(l);
      Vec<T, M - 1> sum;
      for (std::size_t c = 0; c + 1 < M; ++c) sum[c] = homogeneous.at(k, l)[c];
      for (int a = 0; a <= k; ++a)
        for (int b = a == 0 ? 1 : 0; b <= l; ++b)
          sum = sum - (choose_u[a] * choose_v[b] * homogeneous.at(a, b)[M - 1]) * out[(k - a) * (order_v + 1) + l - b];
      for (std::size_t c = 0; c + 1 < M; ++c) sum[c] = sum[c] / weight;
      out.push_back(sum);
    }
  }
  return {order_u, order_v, std::move(out)};
}

template <Field T, std::size_t M, OrderedField K>
Vec<T, M - 1> evaluate_rational(const BsplinePatch<T, M, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  return project(evaluate(patch, u, v, side_u, side_v));
}

template <Field T, std::size_t M, OrderedField K>
PartialDerivatives<T, M - 1> rational_derivatives(const BsplinePatch<T, M, K>& patch, const K& u, const K& v,
                                                  int order_u, int order_v, Side side_u, Side side_v) {
  return rational_derivatives(partial_derivatives(patch, u, v, order_u, order_v, side_u, side_v));
}

template <Field T, OrderedField K>
Vec<T, 3> normal(const BsplinePatch<T, 4, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  const PartialDerivatives<T, 3> s = rational_derivatives(patch, u, v, 1, 1, side_u, side_v);
  return cross(s.at(1, 0), s.at(0, 1));
}

template <Ring T, OrderedField K>
Vec<T, 3> normal(const BsplinePatch<T, 3, K>& patch, const K& u, const K& v, Side side_u, Side side_v) {
  const PartialDerivatives<T, 3> s = partial_derivatives(patch, u, v, 1, 1, side_u, side_v);
  return cross(s.at(1, 0), s.at(0, 1));
}

template <Ring T>
Vec<T, 3> scaled_normal(const Vec<T, 4>& point, const Vec<T, 4>& du, const Vec<T, 4>& dv) {
  // w² S_u = w A_u − w_u A
  const auto scaled = [&](const Vec<T, 4>& d) {
    Vec<T, 3> out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = point[3] * d[c] - d[3] * point[c];
    return out;
  };
  return cross(scaled(du), scaled(dv));
}

template <Ring T, OrderedField K>
Result<BsplinePatch<T, 4, K>> with_weights(const BsplinePatch<T, 3, K>& patch, const std::vector<T>& weights) {
  if (weights.size() != patch.net().size())
    return Error{ErrorCode::wrong_count, "",
                 "the net has " + std::to_string(patch.net().size()) + " control points, each needs a weight",
                 std::to_string(weights.size())};
  std::size_t next = 0;
  return map_points(patch, [&](const Vec<T, 3>& p) { return to_homogeneous(p, weights[next++]); });
}

template <Ring T, OrderedField K>
BsplinePatch<T, 4, K> to_homogeneous(const BsplinePatch<T, 3, K>& patch) {
  return map_points(patch, [](const Vec<T, 3>& p) { return to_homogeneous(p, T(1)); });
}

}  // namespace patchproof
