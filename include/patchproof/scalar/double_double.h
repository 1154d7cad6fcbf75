// SPDX-License-Identifier: Apache-2.0
// DoubleDouble: an unevaluated sum high + low of two doubles, with a running bound of its distance from the exact value.
//
// About 106 bits: what kernels are prepared in, so that a coefficient of theirs is the exact one rounded once, and the
// compensated kernels' coefficients. |low| ≤ ulp(high)/2, so high is the double nearest to the sum.
//
// ENSURES  (1) |high + low − exact| ≤ error, for inputs within their errors and as long as nothing overflows (then error
//          is +infinity; underflow is covered);  (2) +, −, × and ÷ add to the propagated errors at most 2⁻¹⁰⁴, 2⁻¹⁰⁴,
//          2⁻¹⁰³ and 2⁻¹⁰² of the result's size;  (3) sums and products of two doubles that need no more than 106 bits are
//          exact in value.
// REQUIRES rounding to nearest; -ffp-contract=off.
// SOURCE   algorithms and their bounds: M. Joldes, J.-M. Muller, V. Popescu, Tight and rigorous error bounds for basic
//          building blocks of double-word arithmetic, ACM TOMS 44 (2017): AccurateDWPlusDW 3u² + 13u³, DWTimesDW2 6u²,
//          DWDivDW3-like division checked by its residue (see operator/), u = 2⁻⁵³.
// TEST     tests/scalar/double_double_test.cpp checks (1)–(3) against Rational.
#pragma once

#include <cmath>
#include <limits>

#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

namespace detail {

// a + b = sum + error exactly (D. Knuth).
template <class T>
inline T two_sum(const T& a, const T& b, T& error) {
  const T sum = a + b, part = sum - a;
  error = (a - (sum - part)) + (b - part);
  return sum;
}

// The same for |a| ≥ |b| (T. Dekker).
inline double fast_two_sum(double a, double b, double& error) {
  const double sum = a + b;
  error = b - (sum - a);
  return sum;
}

}  // namespace detail

class DoubleDouble {
 public:
  DoubleDouble() = default;
  explicit DoubleDouble(int value) : high_(value) {}
  // REQUIRES |low| ≤ ulp(high)/2, error ≥ 0.
  explicit DoubleDouble(double high, double low = 0, double error = 0) : high_(high), low_(low), error_(error) {}
  // a · b
  static DoubleDouble product(double a, double b) { return DoubleDouble(a) * DoubleDouble(b); }

  double high() const { return high_; }
  double low() const { return low_; }
  double error() const { return error_; }

  DoubleDouble& operator+=(const DoubleDouble& o) { return *this = *this + o; }
  friend DoubleDouble operator-(const DoubleDouble& a) { return DoubleDouble(-a.high_, -a.low_, a.error_); }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    double s_error, t_error;
    const double s = detail::two_sum(a.high_, b.high_, s_error), t = detail::two_sum(a.low_, b.low_, t_error);
    const double v = detail::fast_two_sum(s, s_error + t, s_error);
    return renormalised(v, s_error + t_error, a.error_ + b.error_, 0x1p-104);
  }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    if (a.is_exact_zero() || b.is_exact_zero()) return DoubleDouble(a.high_ * b.high_);
    const double p = a.high_ * b.high_, p_error = std::fma(a.high_, b.high_, -p);
    const double cross = std::fma(a.high_, b.low_, a.low_ * b.high_);
    double propagated = 0;
    if (a.error_ != 0 || b.error_ != 0)
      propagated = std::fabs(a.high_) * b.error_ * kUp + a.error_ * (std::fabs(b.high_) * kUp + b.error_);
    // Below 2^-900 the errors of products may themselves be lost: seven products, each within 2^-1074.
    if (std::fabs(p) < 0x1p-900) propagated += 0x1p-1070;
    return renormalised(p, p_error + cross, propagated, 0x1p-103);
  }
  // The quotient q of the high parts, improved by the residue a − q·b: what is left of the residue bounds the error.
  // ENSURES error is +infinity when the divisor may be zero.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double smallest = std::fabs(b.high_) * (1 - 0x1p-50) - b.error_;  // ≤ |exact divisor|
    const double first = a.high_ / b.high_;
    if (!(smallest > 0) || !std::isfinite(first)) return DoubleDouble(first, 0, kInfinity);
    const DoubleDouble residue = a - DoubleDouble(first) * b;
    const double second = residue.high_ / b.high_;
    double low;
    const double high = detail::fast_two_sum(first, second, low);
    const DoubleDouble rest = residue - DoubleDouble(second) * b;  // = a − (first + second)·b within its error
    return DoubleDouble(high, low, (std::fabs(rest.high_) * kUp + rest.error_) / smallest * kUp + 0x1p-1070);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kUp = 1 + 0x1p-49;  // more than the roundings of the bounds themselves lose
  bool is_exact_zero() const { return high_ == 0 && error_ == 0; }
  static DoubleDouble renormalised(double high, double low, double propagated, double unit) {
    double l;
    const double h = detail::fast_two_sum(high, low, l);
    if (!std::isfinite(h)) return DoubleDouble(h, 0, kInfinity);
    const double error = (propagated + unit * std::fabs(h)) * kUp;
    return DoubleDouble(h, l, propagated == 0 && h == 0 ? 0 : error + (error < 0x1p-960 ? 0x1p-1070 : 0));
  }

  double high_ = 0, low_ = 0, error_ = 0;
};

template <>
struct scalar_traits<DoubleDouble> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const DoubleDouble& x) {
    if (std::fabs(x.high()) * (1 - 0x1p-50) > x.error()) return x.high() > 0 ? Sign::positive : Sign::negative;
    if (x.high() == 0 && x.error() == 0) return Sign::zero;
    return std::nullopt;
  }
  using knot_scalar = double;
};

template <>
struct embedding<DoubleDouble, double> {
  static DoubleDouble apply(double x) { return DoubleDouble(x); }
};

}  // namespace patchproof
