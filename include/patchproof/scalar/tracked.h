// SPDX-License-Identifier: Apache-2.0
// Tracked: a double together with a running bound of its distance from the exact value.
//
// Run a formula on Tracked to obtain what the same formula on double returns (bit for bit) and a bound of its error:
// this is how the kernels' bounds are derived and checked.
//
// ENSURES  (1) value is the double that the same operations on double give;  (2) |value − exact| ≤ error, for
//          inputs without error and as long as nothing overflows (underflow is covered).
// REQUIRES rounding to nearest (no RoundingGuard alive).
// SOURCE   running error analysis: N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §3.3.
#pragma once

#include <cmath>
#include <limits>

#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

class Tracked {
 public:
  Tracked() = default;
  explicit Tracked(int value) : value_(value) {}
  explicit Tracked(double value, double error = 0) : value_(value), error_(error) {}

  double value() const { return value_; }
  double error() const { return error_; }

  Tracked& operator+=(const Tracked& o) { return *this = *this + o; }
  friend Tracked operator-(const Tracked& a) { return Tracked(-a.value_, a.error_); }
  friend Tracked operator+(const Tracked& a, const Tracked& b) {
    const double v = a.value_ + b.value_;
    return Tracked(v, up(a.error_ + b.error_ + rounding(v)));
  }
  friend Tracked operator-(const Tracked& a, const Tracked& b) {
    const double v = a.value_ - b.value_;
    return Tracked(v, up(a.error_ + b.error_ + rounding(v)));
  }
  friend Tracked operator*(const Tracked& a, const Tracked& b) {
    const double v = a.value_ * b.value_;
    return Tracked(v, up(std::fabs(a.value_) * b.error_ + a.error_ * (std::fabs(b.value_) + b.error_) + rounding(v) +
                         underflow(v)));
  }
  // ENSURES error is +infinity when the divisor may be zero.
  friend Tracked operator/(const Tracked& a, const Tracked& b) {
    const double v = a.value_ / b.value_;
    const double smallest = std::fabs(b.value_) * (1 - 4 * kUnit) - b.error_;  // ≤ |exact divisor|
    if (!(smallest > 0)) return Tracked(v, std::numeric_limits<double>::infinity());
    return Tracked(v, up((a.error_ + std::fabs(v) * b.error_) / smallest * (1 + 4 * kUnit) + rounding(v) + underflow(v)));
  }

 private:
  static constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;  // 2^-53, the unit roundoff
  // |fl(x) − x| ≤ u·|fl(x)| for the exact x of a rounded-to-nearest fl(x).
  static double rounding(double v) { return kUnit * std::fabs(v); }
  // Products and quotients may lose up to half the smallest subnormal; sums never do.
  static double underflow(double v) {
    return v != 0 && std::fabs(v) >= std::numeric_limits<double>::min() ? 0.0 : std::numeric_limits<double>::denorm_min();
  }
  // Each bound is a sum of at most five rounded non-negative terms, each with at most four rounded factors: relative
  // error below 9u, so 16u and one subnormal more make it an upper bound.
  static double up(double bound) {
    return bound == 0 ? 0 : bound * (1 + 16 * kUnit) + std::numeric_limits<double>::denorm_min();
  }

  double value_ = 0;
  double error_ = 0;
};

template <>
struct scalar_traits<Tracked> {
  static constexpr bool is_exact = false;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const Tracked& x) {
    if (x.value() > x.error()) return Sign::positive;
    if (-x.value() > x.error()) return Sign::negative;
    if (x.value() == 0 && x.error() == 0) return Sign::zero;
    return std::nullopt;
  }
  using knot_scalar = double;
};

template <>
struct embedding<Tracked, double> {
  static Tracked apply(double x) { return Tracked(x); }
};
template <>
struct embedding<Tracked, Rational> {
  static Tracked apply(const Rational& x) {
    const double v = nearest_double(x);
    const double error = std::fabs(v) * (std::numeric_limits<double>::epsilon() / 2);
    return Tracked(v, from_double(v) == x ? 0.0 : error + std::numeric_limits<double>::denorm_min());
  }
};

}  // namespace patchproof
