// SPDX-License-Identifier: Apache-2.0
// π, and sine and cosine of multiples of it: what trigonometric blending functions, circles by angle and rotations need.
//
//   cos_sin_pi(x) = (cos πx, sin πx)
//
// The factor π inside makes the special places exact: at x = 0, 1/2, 1, … the answer is 0 or ±1, not a rounded neighbour.
//
// REQUIRES a RoundingGuard for Interval and TaylorModel (interval.h); double: x finite.
// ENSURES  (1) enclosing scalars (Interval, Ball, TaylorModel) contain the exact numbers;  (2) where x is the point k/2 both
//          results are exactly 0 or ±1, in every scalar;  (3) no result of Interval or Ball leaves [−1, 1] by more than its
//          rounding; double stays within [−1, 1], after an exact reduction of x, so large arguments lose nothing;
//          (4) the derivative of cos πx is −π sin πx, and of sin πx it is π cos πx: models (TaylorModel) have remainders of
//          their full order.
// SCALARS  R: double, Interval, Ball, TaylorModel<N>.
// COST     double: one sine and one cosine;  Interval: those of Ball at 128 bits.
// SOURCE   MPFI for Ball; the reduction to |x| ≤ 1/4 by quarter turns.
// NEIGHBOURS ball.h, taylor_model.h; spline/b_function.h uses it.
// TEST     tests/scalar/transcendental_test.cpp checks (1)–(4).
#pragma once

#include <array>

#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/taylor_model.h"

namespace patchproof {

namespace detail {

// (cos πx, sin πx) where π is a number of this type; the primary definition serves no type.
template <class R>
struct Circular;

template <>
struct Circular<double> {
  static double pi();
  static std::array<double, 2> cos_sin_pi(double x);
};
template <>
struct Circular<Interval> {
  static Interval pi();
  static std::array<Interval, 2> cos_sin_pi(const Interval& x);
};
template <>
struct Circular<Ball> {
  static Ball pi();
  static std::array<Ball, 2> cos_sin_pi(const Ball& x);
};
template <int N>
struct Circular<TaylorModel<N>> {
  using Model = TaylorModel<N>;
  static Model pi() { return Model(Circular<Interval>::pi()); }
  // Taylor coefficients about the constant term: π^k/k! times a quarter turn more each.
  static std::array<Model, 2> cos_sin_pi(const Model& x) {
    constexpr double kFar = 0x1p40;  // beyond it a model says no more than that both lie in [−1, 1]
    const Interval all = x.range();
    Model anywhere = Model::unknown(Interval(-1.0, 1.0));
    if (!(-kFar < all.inf() && all.sup() < kFar)) return {anywhere, anywhere};
    const std::array<Interval, 2> at = Circular<Interval>::cos_sin_pi(x.coefficient(0));
    const std::array<Interval, 2> on = Circular<Interval>::cos_sin_pi(x.argument_range());
    std::array<Model, 2> out;
    for (int which = 0; which < 2; ++which) {  // the derivatives of cosine go c, −s, −c, s; those of sine s, c, −s, −c
      const auto term = [which](const std::array<Interval, 2>& cs, int k) {
        const int turn = (which == 0 ? k : k + 3) % 4;  // sin x = cos(x − π/2), three quarters of a turn on
        const Interval& size = turn % 2 == 0 ? cs[0] : cs[1];
        return turn == 0 || turn == 3 ? size : -size;
      };
      std::array<Interval, N + 1> f;
      Interval factor(1);
      for (int k = 0; k <= N; ++k) {
        if (k > 0) factor = factor * Circular<Interval>::pi() / Interval(k);
        f[k] = term(at, k) * factor;
      }
      factor = factor * Circular<Interval>::pi() / Interval(N + 1);
      out[which] = x.composed(f, term(on, N + 1) * factor);
    }
    return out;
  }
};

}  // namespace detail

// A field with π and the circular functions.
template <class R>
concept Transcendental = Field<R> && requires(const R x) {
  { detail::Circular<R>::pi() } -> std::same_as<R>;
  { detail::Circular<R>::cos_sin_pi(x) } -> std::same_as<std::array<R, 2>>;
};

// (cos πx, sin πx).
template <Transcendental R>
std::array<R, 2> cos_sin_pi(const R& x) {
  return detail::Circular<R>::cos_sin_pi(x);
}

// π: the nearest double, or an enclosure.
template <Transcendental R>
R pi() {
  return detail::Circular<R>::pi();
}

}  // namespace patchproof
