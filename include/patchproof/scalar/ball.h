// SPDX-License-Identifier: Apache-2.0
// Ball: an enclosure [lower, upper] by MPFR numbers of a chosen precision, with sqrt, exp, trigonometry and π.
//
// Used where a square root or an angle leaves the rationals (reports in degrees, signs over Q(√d)), and for enclosures
// that doubles are too coarse for.
// ENSURES  (1) every result contains the exact result for all values of the operands;
//          (2) results have the precision of the BallPrecision alive in the thread (128 bits when there is none).
// SOURCE   MPFI.
#pragma once

#include <mpfi.h>

#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

// Sets the precision in bits of the Balls that this thread makes, for the lifetime of the object.
class BallPrecision {
 public:
  explicit BallPrecision(int bits);
  ~BallPrecision();
  BallPrecision(const BallPrecision&) = delete;
  BallPrecision& operator=(const BallPrecision&) = delete;
  static int current();

 private:
  int previous_;
};

class Ball {
 public:
  Ball() : Ball(0) {}
  explicit Ball(int value);
  explicit Ball(double value);
  explicit Ball(const Rational& value);
  explicit Ball(const Interval& value);
  Ball(const Ball& o);
  Ball(Ball&& o) noexcept;
  Ball& operator=(const Ball& o);
  Ball& operator=(Ball&& o) noexcept;
  ~Ball();

  Ball& operator+=(const Ball& o) { return *this = *this + o; }
  friend Ball operator+(const Ball& a, const Ball& b);
  friend Ball operator-(const Ball& a, const Ball& b);
  friend Ball operator*(const Ball& a, const Ball& b);
  friend Ball operator/(const Ball& a, const Ball& b);  // the whole line when b contains 0
  friend Ball operator-(const Ball& a);

  friend Ball sqrt(const Ball& a);  // REQUIRES a ≥ 0 somewhere; the negative part is cut off
  friend Ball atan(const Ball& a);
  friend Ball exp(const Ball& a);
  friend Ball sin(const Ball& a);
  friend Ball cos(const Ball& a);
  static Ball pi();

  // The enclosure, rounded outward to doubles.
  Interval to_interval() const;
  // mantissa · 2^exponent around the enclosure (for numbers beyond the range of doubles).
  ScaledInterval to_scaled_interval() const;
  bool contains(const Rational& x) const;
  // upper − lower ≤ 2^-bits · max(|lower|, |upper|)
  bool is_tight(int bits) const;
  std::optional<Sign> sign() const;

 private:
  mpfi_t x_;
};

template <>
struct scalar_traits<Ball> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const Ball& x) { return x.sign(); }
  using knot_scalar = Rational;
};

template <>
struct embedding<Ball, Rational> {
  static Ball apply(const Rational& x) { return Ball(x); }
};
template <>
struct embedding<Ball, double> {
  static Ball apply(double x) { return Ball(x); }
};
template <>
struct embedding<Ball, Interval> {
  static Ball apply(const Interval& x) { return Ball(x); }
};

}  // namespace patchproof
