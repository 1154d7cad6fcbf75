// SPDX-License-Identifier: Apache-2.0
// Integer: GMP's mpz. Exact like Rational but without divisions and reductions to lowest terms, hence several times
// faster: clear the denominators of a control net once (spline/cleared.h) and run the same formula.
#pragma once

#include <boost/multiprecision/gmp.hpp>

#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

// An exact Ring. Its `/` truncates, so it is no Field.
template <>
struct scalar_traits<Integer> {
  static constexpr bool is_exact = true;
  static constexpr bool is_field = false;
  static constexpr bool is_ordered = true;
  static std::optional<Sign> sign(const Integer& x) { return static_cast<Sign>(mpz_sgn(x.backend().data())); }
  using knot_scalar = Rational;
};

template <>
struct embedding<Rational, Integer> {
  static Rational apply(const Integer& x) { return Rational(x); }
};

}  // namespace patchproof
