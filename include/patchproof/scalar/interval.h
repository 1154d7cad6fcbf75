// SPDX-License-Identifier: Apache-2.0
// Interval: pairs of doubles that enclose the exact value. The scalar of filters and of certified bounds.
//
// ENSURES  (1) every operation's result contains the exact result for all values of its operands (under a RoundingGuard);
//          (2) enclose(x) contains x, and is a single point when x is a double;
//          (3) sign() answers only when the whole interval has one sign, or is the point 0;
//          (4) Interval() is the point 0; dividing by an interval that contains 0 gives the whole line.
// REQUIRES a RoundingGuard alive in the thread for + − × ÷ and sqrt (the FPU rounds upward while it lives); builds
//          without NDEBUG check it. One guard per job is the intended use. enclose() and the signs need none.
// SOURCE   CGAL::Interval_nt_advanced, in a class of ours because CGAL leaves Interval() undefined, lets NaN in, and
//          offers == and <, which an interval cannot answer.
#pragma once

#include <CGAL/Interval_nt.h>

#include <cmath>
#include <limits>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

using RoundingGuard = CGAL::Interval_nt_advanced::Protector;

class Interval {
 public:
  Interval() : x_(0.0) {}
  explicit Interval(int value) : x_(value) {}
  // REQUIRES value is finite.
  explicit Interval(double value) : x_(finite(value)) {}
  // [lower, upper]; the ends may be infinite. REQUIRES lower ≤ upper, a number between them.
  Interval(double lower, double upper) : x_(ordered(lower, upper)) {}

  double inf() const { return x_.inf(); }
  double sup() const { return x_.sup(); }
  bool is_point() const { return x_.is_point(); }

  Interval& operator+=(const Interval& o) { return *this = *this + o; }
  Interval& operator-=(const Interval& o) { return *this = *this - o; }
  Interval& operator*=(const Interval& o) { return *this = *this * o; }
  Interval& operator/=(const Interval& o) { return *this = *this / o; }
  friend Interval operator-(const Interval& a) { return Interval(-a.x_); }
  friend Interval operator+(const Interval& a, const Interval& b) { return guarded(), Interval(a.x_ + b.x_); }
  friend Interval operator-(const Interval& a, const Interval& b) { return guarded(), Interval(a.x_ - b.x_); }
  friend Interval operator*(const Interval& a, const Interval& b) { return guarded(), Interval(a.x_ * b.x_); }
  friend Interval operator/(const Interval& a, const Interval& b) { return guarded(), Interval(a.x_ / b.x_); }
  // Tighter than a * a: never negative.
  friend Interval square(const Interval& a) { return guarded(), Interval(CGAL::square(a.x_)); }
  // The negative part of the operand is cut off. REQUIRES sup ≥ 0.
  friend Interval sqrt(const Interval& a) {
    PATCHPROOF_REQUIRES(a.sup() >= 0, "sqrt of a negative Interval");
    return guarded(), Interval(CGAL::sqrt(a.x_));
  }

 private:
  using Bounds = CGAL::Interval_nt_advanced;
  explicit Interval(const Bounds& x) : x_(x) {}
  static double finite(double value) {
    PATCHPROOF_REQUIRES(std::isfinite(value), "Interval: NaN and infinity are not numbers");
    return value;
  }
  static Bounds ordered(double lower, double upper) {
    PATCHPROOF_REQUIRES(lower <= upper && lower <= kLargest && upper >= -kLargest, "Interval: lower ≤ upper, not NaN");
    return Bounds(lower, upper);
  }
  static void guarded() {
#ifndef NDEBUG
    PATCHPROOF_REQUIRES(CGAL::FPU_get_cw() == CGAL_FE_UPWARD, "Interval arithmetic without a RoundingGuard");
#endif
  }
  static constexpr double kLargest = std::numeric_limits<double>::max();

  Bounds x_;
};

template <>
struct scalar_traits<Interval> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const Interval& x) {
    if (x.inf() > 0) return Sign::positive;
    if (x.sup() < 0) return Sign::negative;
    if (x.inf() == 0 && x.sup() == 0) return Sign::zero;
    return std::nullopt;
  }
  using knot_scalar = Rational;
};

// Tightest interval of doubles around x, up to one unit in the last place.
Interval enclose(const Rational& x);
inline Interval enclose(double x) { return Interval(x); }

// mantissa · 2^exponent encloses the number; |mantissa| in [1/2, 1] or the point 0. Covers numbers outside the range of
// doubles, e.g. products of join polynomials with thousands of bits.
struct ScaledInterval {
  Interval mantissa{0.0};
  long exponent = 0;
};
ScaledInterval enclose_scaled(const Integer& x);
ScaledInterval enclose_scaled(const Rational& x);

// x · 2^exponent, rounded outward (saturating at the largest double and at the smallest subnormal).
Interval scale_by_power_of_two(const Interval& x, long exponent);

template <>
struct embedding<Interval, double> {
  static Interval apply(double x) { return Interval(x); }
};
template <>
struct embedding<Interval, Rational> {
  static Interval apply(const Rational& x) { return enclose(x); }
};
template <>
struct embedding<Interval, Integer> {
  static Interval apply(const Integer& x) { return enclose(Rational(x)); }
};

}  // namespace patchproof
