// SPDX-License-Identifier: Apache-2.0
// The functions that the control data of a local curve or surface belong to: B-splines, or trigonometric functions.
//
//   splines         N_0(t) … N_{n−1}(t) on a knot vector
//   trigonometric   1, cos πt, sin πt, cos 2πt, sin 2πt, …, cos mπt, sin mπt;  period 2
//
// REQUIRES  live_functions: `inside` and the side name the piece that is meant (a limit at a knot); for splines `inside` lies
//           in the domain. t itself may be of any scalar and is not checked.
// ENSURES   (1) the functions and their derivatives of all orders are those above;  (2) trigonometric ones are enclosed where
//           the scalar encloses;  (3) covers(a, b): every parameter of [a, b] has a value.
// SCALARS   K: OrderedField. R: Ring that K embeds into; for trigonometric functions Transcendental.
// TEST      tests/spline/function_basis_test.cpp checks (1)–(3).
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/transcendental.h"
#include "patchproof/spline/bspline_basis.h"

namespace patchproof {

struct TrigonometricFunctions {
  int harmonics = 0;  // m
  friend bool operator==(const TrigonometricFunctions&, const TrigonometricFunctions&) = default;
};

template <OrderedField K>
class FunctionBasis {
 public:
  FunctionBasis(KnotVector<K> knots) : functions_(std::move(knots)) {}
  // REQUIRES harmonics ≥ 0.
  FunctionBasis(TrigonometricFunctions functions) : functions_(functions) {
    PATCHPROOF_REQUIRES(functions.harmonics >= 0, "FunctionBasis: the number of harmonics is negative");
  }

  // Of splines; null for trigonometric functions.
  const KnotVector<K>* knots() const { return std::get_if<KnotVector<K>>(&functions_); }
  bool is_trigonometric() const { return knots() == nullptr; }
  int count() const {
    return knots() ? knots()->control_count() : 2 * std::get<TrigonometricFunctions>(functions_).harmonics + 1;
  }
  bool covers(const K& begin, const K& end) const {
    return is_trigonometric() || (knots()->domain_begin() <= begin && end <= knots()->domain_end());
  }
  // The knots strictly between begin and end, in order.
  std::vector<K> breaks_between(const K& begin, const K& end) const {
    std::vector<K> out;
    if (!is_trigonometric())
      for (const K& t : knots()->breaks())
        if (begin < t && t < end) out.push_back(t);
    return out;
  }
  friend bool operator==(const FunctionBasis&, const FunctionBasis&) = default;

 private:
  std::variant<KnotVector<K>, TrigonometricFunctions> functions_;
};

// The functions that do not vanish on a piece: values[r][l] is the r-th derivative of function first + l.
template <Ring R>
struct LiveFunctions {
  int first;
  std::vector<std::vector<R>> values;
};

template <Ring R, OrderedField K>
LiveFunctions<R> live_functions(const FunctionBasis<K>& basis, const K& inside, Side side, const R& t, int order);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// The r-th derivatives of cos kπt and sin kπt are (kπ)^r times cos and sin of kπt + rπ/2.
template <Transcendental R>
std::vector<std::vector<R>> trigonometric_functions(int harmonics, const R& t, int order) {
  std::vector<std::vector<R>> out(order + 1, std::vector<R>(2 * harmonics + 1, R(0)));
  out[0][0] = R(1);
  for (int k = 1; k <= harmonics; ++k) {
    const auto [cosine, sine] = cos_sin_pi(R(R(k) * t));
    const R cycle[4] = {cosine, -sine, -cosine, sine};  // cos, cos′, cos″, cos‴; sin begins at the last
    R factor(1);
    for (int r = 0; r <= order; ++r) {
      out[r][2 * k - 1] = factor * cycle[r % 4];
      out[r][2 * k] = factor * cycle[(r + 3) % 4];
      factor = factor * R(k) * pi<R>();
    }
  }
  return out;
}

}  // namespace detail

template <Ring R, OrderedField K>
LiveFunctions<R> live_functions(const FunctionBasis<K>& basis, const K& inside, Side side, const R& t, int order) {
  if (const KnotVector<K>* knots = basis.knots()) {
    const int span = knots->find_span(inside, side);
    return {span - knots->degree(), basis_derivatives_in_span<R>(*knots, span, t, order)};
  }
  if constexpr (Transcendental<R>) {
    return {0, detail::trigonometric_functions((basis.count() - 1) / 2, t, order)};
  } else {
    PATCHPROOF_REQUIRES(false, "trigonometric functions have no exact values: ask for an enclosure");
    return {};
  }
}

}  // namespace patchproof
