// SPDX-License-Identifier: Apache-2.0
// Rational: GMP's mpq, always in lowest terms. The scalar of proofs.
//
// ENSURES  (1) + − × ÷ are exact;  (2) from_double is exact;  (3) nearest_double is correctly rounded (ties to even).
// Expression templates are off, so every operation returns a Rational and `auto` is safe.
// SOURCE   Boost.Multiprecision number<gmp_rational, et_off>.
#pragma once

#include <boost/multiprecision/gmp.hpp>

#include "patchproof/scalar/concepts.h"

namespace patchproof {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

template <>
struct scalar_traits<Rational> {
  static constexpr bool is_exact = true;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = true;
  static std::optional<Sign> sign(const Rational& x) { return static_cast<Sign>(mpq_sgn(x.backend().data())); }
  using knot_scalar = Rational;
};

// The exact value of a double. REQUIRES x is finite.
Rational from_double(double x);

// The double nearest to x, ties to even; ±infinity beyond the largest double, subnormals rounded correctly.
double nearest_double(const Rational& x);

template <>
struct embedding<Rational, double> {
  static Rational apply(double x) { return from_double(x); }
};

template <>
struct embedding<double, Rational> {  // production values from exact data: the nearest double
  static double apply(const Rational& x) { return nearest_double(x); }
};

}  // namespace patchproof
