// SPDX-License-Identifier: Apache-2.0
// The one door between text and numbers, both ways.
//
// Texts read:  "42" "-0.1" "+.5" "1." "1e-3" "2.5E+4"      decimal
//              "1/7" "-3/4" "0.5/3"                         quotient of two decimals, the second without sign
//              "0x1.8p-1"                                    hexadecimal floating point
//              "1/2*sqrt(2)" "1-sqrt(2)" "sqrt(2)/2" "1/2+1/2*sqrt(2)"   Q(√d), parse_scalar<Quadratic> only
// Nothing else: no blanks inside, no nan, no inf, no second number run into the first. Independent of the locale.
//
// ENSURES  (1) parse_scalar(to_text(x)) == x for Rational, Integer, Quadratic and (with nearest_double) double, as long
//              as the text is no longer than kMaxDigits;
//          (2) Decimals::exact reads "0.1" as 1/10; Decimals::binary64 reads every number as the double nearest to it;
//          (3) the result is in lowest terms.
// ERRORS   bad_number: not a number; a zero denominator; more than kMaxDigits characters; an exponent beyond
//          ±kMaxExponent; with Decimals::binary64, a value beyond the largest double. The caller adds the place.
// COST     quadratic in the digits at worst, and they are limited.
#pragma once

#include <string>
#include <string_view>

#include "patchproof/error.h"
#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

enum class Decimals { exact, binary64 };

inline constexpr int kMaxDigits = 4096;    // characters of one number
inline constexpr int kMaxExponent = 4096;  // |exponent| after e, E or p

// T: Rational or Quadratic.
template <ExactField T>
Result<T> parse_scalar(std::string_view text, Decimals decimals = Decimals::exact);

// Does the text contain a root, i.e. does it need Quadratic?
bool mentions_root(std::string_view text);

// "3", "-1/7".
std::string to_text(const Rational& x);
std::string to_text(const Integer& x);
// "1/2+3*sqrt(2)", "-sqrt(5)"; a rational one prints as a Rational.
std::string to_text(const Quadratic& x);
// The shortest decimal that reads back as the same double; "inf" and "-inf" (which no reader accepts).
// REQUIRES x is not NaN.
std::string to_text(double x);
// "[0.1, 0.2]"
std::string to_text(const Interval& x);

}  // namespace patchproof
