// SPDX-License-Identifier: Apache-2.0
// Interval: pairs of doubles that enclose the exact value. The scalar of filters and of certified bounds.
//
// ENSURES  (1) every operation's result contains the exact result for all values of its operands (under a RoundingGuard);
//          (2) enclose(x) contains x, and is a single point when x is a double;
//          (3) sign() answers only when the whole interval has one sign, or is the point 0.
// REQUIRES a RoundingGuard alive in the thread for + − × ÷ and sqrt (the FPU rounds upward while it lives). One guard per
//          job is the intended use. enclose() needs none.
// SOURCE   CGAL::Interval_nt_advanced.
#pragma once

#include <CGAL/Interval_nt.h>

#include <vector>

#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

using Interval = CGAL::Interval_nt_advanced;
using RoundingGuard = Interval::Protector;

template <>
struct scalar_traits<Interval> {
  static constexpr bool is_exact = false;
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
