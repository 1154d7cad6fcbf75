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

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

class Tracked {
 public:
  Tracked() = default;
  explicit Tracked(int value) : value_(value) {}
  // REQUIRES error ≥ 0 (infinite: nothing is known).
  explicit Tracked(double value, double error = 0) : value_(value), error_(error) {
    PATCHPROOF_REQUIRES(error >= 0, "Tracked: an error bound is not negative and not NaN");
  }

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
    if ((a.is_exact_zero() && b.error_ < kInfinity) || (b.is_exact_zero() && a.error_ < kInfinity)) return Tracked(v);
    return Tracked(v, up(std::fabs(a.value_) * b.error_ + a.error_ * (std::fabs(b.value_) + b.error_) + rounding(v) +
                         underflow(v)));
  }
  // ENSURES error is +infinity when the divisor may be zero.
  friend Tracked operator/(const Tracked& a, const Tracked& b) {
    const double v = a.value_ / b.value_;
    const double smallest = std::fabs(b.value_) * (1 - 4 * kUnit) - b.error_;  // ≤ |exact divisor|
    if (!(smallest > 0)) return Tracked(v, kInfinity);
    if (a.is_exact_zero()) return Tracked(v);
    // |a/b − A/B| ≤ (error a + |a/b|·error b) / |B|. The numerator is rounded up by itself because a small divisor would
    // magnify what it lost to underflow; |a/b| ≤ |v| + 2^-1074 up to rounding.
    double numerator = a.error_;
    if (b.error_ > 0) numerator += up((std::fabs(v) + kTiniest) * b.error_ + kTiniest);
    return Tracked(v, up(up(numerator) / smallest + rounding(v) + underflow(v)));
  }

 private:
  static constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;    // u = 2^-53, the unit roundoff
  static constexpr double kTiniest = std::numeric_limits<double>::denorm_min();  // 2^-1074
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bool is_exact_zero() const { return value_ == 0 && error_ == 0; }
  // |fl(x) − x| ≤ u·|fl(x)| for the exact x of a rounded-to-nearest fl(x) that does not underflow.
  static double rounding(double v) { return kUnit * std::fabs(v); }
  // Products and quotients, and the products inside their bounds, lose up to 2^-1075 each when they underflow, at most
  // four of them in one bound. When |v| ≥ 2^-960 the slack of up() on rounding(v) is larger than that. Sums never lose.
  static double underflow(double v) { return std::fabs(v) >= 0x1p-960 ? 0.0 : 4 * kTiniest; }
  // The exact bound whose rounded evaluation gave `bound`: at most five operations deep and each loses at most the
  // factor 1 − u, so 16u (of which the two operations here lose 2u) and one subnormal more suffice. A computed sum that
  // is 0 has exact summands 0, or is a sum of doubles below 2^-1022, which is exact.
  static double up(double bound) {
    if (bound == 0) return 0;
    return bound < kInfinity ? bound * (1 + 16 * kUnit) + kTiniest : kInfinity;  // NaN: nothing is known
  }

  double value_ = 0;
  double error_ = 0;
};

template <>
struct scalar_traits<Tracked> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
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
    if (!std::isfinite(v)) return Tracked(v, std::numeric_limits<double>::infinity());
    const double error = std::fabs(v) * (std::numeric_limits<double>::epsilon() / 2);
    return Tracked(v, from_double(v) == x ? 0.0 : error + std::numeric_limits<double>::denorm_min());
  }
};

}  // namespace patchproof
