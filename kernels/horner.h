// SPDX-License-Identifier: Apache-2.0
// The bodies of the evaluation kernels, written once for every kind of number.
//
// Value is what a coefficient is: a vector of lanes for each coordinate, four coordinates in one vector, a Vec<Rational, 4>,
// a Vec<Tracked, 4>, a Magnitude. Parameter is what multiplies it. Needed: fma(value, parameter, value) = value·parameter +
// value, found by the compiler next to the types; Value{} is zero.
// On Rational these bodies are the exact formula (tests compare them with bspline_patch.h), on Magnitude they give the
// error bounds (error_bounds.h), on lanes they are the production path.
// SOURCE   N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., alg. 5.2.
#pragma once

#if defined(__GNUC__)
#define PATCHPROOF_INLINE inline __attribute__((always_inline))
#define PATCHPROOF_INLINE_LAMBDA __attribute__((always_inline))
#else
#define PATCHPROOF_INLINE inline
#define PATCHPROOF_INLINE_LAMBDA
#endif

namespace patchproof::kernels {

// Horner's rule for a polynomial and its derivatives: after coefficients c_n, …, c_0 have been pushed (the k-th push with
// its number k), d[m] = (m-th derivative)/m! at x, for m ≤ Order.
template <int Order, class Value>
struct Horner {
  Value d[Order + 1];

  template <class Parameter>
  PATCHPROOF_INLINE void push(int k, const Value& c, const Parameter& x) {
    if (k == 0) {
      for (int m = 1; m <= Order; ++m) d[m] = Value{};
    } else {
      for (int m = Order; m >= 1; --m) {
        if (k == m) d[m] = d[m - 1];
        if (k > m) d[m] = fma(d[m], x, d[m - 1]);
      }
    }
    d[0] = k == 0 ? c : fma(d[0], x, c);
  }
};

// Sums over rows of a tensor-product polynomial Σ_j (Σ_i c_ij x^i) y^j. Rows are finished polynomials in x (Horner), pushed
// from j = q down. The results, up to factorials: value d0[0], ∂y d0[1], ∂yy/2 d0[2]; ∂x d1[0], ∂xy d1[1]; ∂xx/2 d2[0].
template <int Order, class Value>
struct HornerRows {
  Horner<Order, Value> value;
  Horner<(Order > 0 ? Order - 1 : 0), Value> dx;
  Horner<0, Value> dxx;

  template <class Parameter>
  PATCHPROOF_INLINE void push(int k, const Value (&row)[Order + 1], const Parameter& y) {
    value.push(k, row[0], y);
    if constexpr (Order >= 1) dx.push(k, row[1], y);
    if constexpr (Order >= 2) dxx.push(k, row[2], y);
  }
};

// S, S_x, S_y, S_xx, S_xy, S_yy, as far as Order asks.
template <int Order, class Value>
struct SurfaceJet {
  static constexpr int kCount = Order == 0 ? 1 : Order == 1 ? 3 : 6;
  Value d[kCount];
};

// Order 0: S; 1: S, S_x, S_y; 2: all six. factor_x, factor_y: dx/du, dy/dv, powers of two.
template <int Order, class Value, class Factor>
PATCHPROOF_INLINE SurfaceJet<Order, Value> surface_jet(const HornerRows<Order, Value>& rows, const Factor& factor_x,
                                                       const Factor& factor_y) {
  SurfaceJet<Order, Value> out;
  out.d[0] = rows.value.d[0];
  if constexpr (Order >= 1) {
    out.d[1] = scale(rows.dx.d[0], factor_x);
    out.d[2] = scale(rows.value.d[1], factor_y);
  }
  if constexpr (Order >= 2) {
    out.d[3] = scale(rows.dxx.d[0], (factor_x * factor_x) * Factor(2.0));
    out.d[4] = scale(rows.dx.d[1], factor_x * factor_y);
    out.d[5] = scale(rows.value.d[2], (factor_y * factor_y) * Factor(2.0));
  }
  return out;
}

// A/w and its derivatives from those of the homogeneous A = (w x, w y, w z, w): the quotient rule
//   S = A/w,  S_u = (A_u − w_u S)/w,  S_uv = (A_uv − w_uv S − w_v S_u − w_u S_v)/w.
// weight_of(value): the fourth coordinate; minus_product(a, s, w) = a − s·w. One reciprocal.
template <int Order, class Value>
PATCHPROOF_INLINE SurfaceJet<Order, Value> quotient(const SurfaceJet<Order, Value>& a) {
  SurfaceJet<Order, Value> out;
  const auto inverse = reciprocal(weight_of(a.d[0]));
  out.d[0] = scale(a.d[0], inverse);
  if constexpr (Order >= 1) {
    const auto wu = weight_of(a.d[1]), wv = weight_of(a.d[2]);
    out.d[1] = scale(minus_product(a.d[1], out.d[0], wu), inverse);
    out.d[2] = scale(minus_product(a.d[2], out.d[0], wv), inverse);
    if constexpr (Order >= 2) {
      const auto second = [&](const Value& h, const Value& s1, const auto& w1, const Value& s2, const auto& w2) {
        const Value rest = minus_product(h, out.d[0], weight_of(h));
        return scale(minus_product(minus_product(rest, s1, w2), s2, w1), inverse);
      };
      out.d[3] = second(a.d[3], out.d[1], wu, out.d[1], wu);
      out.d[4] = second(a.d[4], out.d[1], wu, out.d[2], wv);
      out.d[5] = second(a.d[5], out.d[2], wv, out.d[2], wv);
    }
  }
  return out;
}

// C, C', C'' of a curve, as for surfaces.
template <int Order, class Value>
struct CurveJet {
  Value d[Order + 1];
};

template <int Order, class Value, class Factor>
PATCHPROOF_INLINE CurveJet<Order, Value> curve_jet(const Horner<Order, Value>& h, const Factor& factor) {
  CurveJet<Order, Value> out;
  out.d[0] = h.d[0];
  if constexpr (Order >= 1) out.d[1] = scale(h.d[1], factor);
  if constexpr (Order >= 2) out.d[2] = scale(h.d[2], (factor * factor) * Factor(2.0));
  return out;
}

template <int Order, class Value>
PATCHPROOF_INLINE CurveJet<Order, Value> quotient(const CurveJet<Order, Value>& a) {
  CurveJet<Order, Value> out;
  const auto inverse = reciprocal(weight_of(a.d[0]));
  out.d[0] = scale(a.d[0], inverse);
  if constexpr (Order >= 1) {
    const auto w1 = weight_of(a.d[1]);
    out.d[1] = scale(minus_product(a.d[1], out.d[0], w1), inverse);
    if constexpr (Order >= 2) {
      const Value rest = minus_product(a.d[2], out.d[0], weight_of(a.d[2]));
      out.d[2] = scale(minus_product(minus_product(rest, out.d[1], w1), out.d[1], w1), inverse);
    }
  }
  return out;
}

}  // namespace patchproof::kernels
