// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/interval.h"

#include <mpfr.h>

#include <cmath>
#include <limits>

namespace patchproof {
namespace {

// [d, d] when the conversion that gave d lost nothing, else the neighbours on the side away from zero:
// GMP's conversions truncate towards zero.
Interval outward_of_truncated(double d, bool exact) {
  if (exact) return Interval(d);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  return d > 0 ? Interval(d, std::nextafter(d, kInf)) : Interval(std::nextafter(d, -kInf), d);
}

bool fits_53_bits(const mpz_t z) { return mpz_sizeinbase(z, 2) - mpz_scan1(z, 0) <= 53; }

// Both ends by MPFR's directed rounding, for numbers near or beyond the ends of the range of doubles.
Interval enclose_by_mpfr(const mpq_t q) {
  mpfr_t f;
  mpfr_init2(f, 64);
  mpfr_set_q(f, q, MPFR_RNDD);
  const double lower = mpfr_get_d(f, MPFR_RNDD);
  mpfr_set_q(f, q, MPFR_RNDU);
  const double upper = mpfr_get_d(f, MPFR_RNDU);
  mpfr_clear(f);
  return Interval(lower, upper);
}

}  // namespace

Interval enclose(const Rational& x) {
  const mpq_t& q = x.backend().data();
  if (mpq_sgn(q) == 0) return Interval(0.0);
  const long size =
      static_cast<long>(mpz_sizeinbase(mpq_numref(q), 2)) - static_cast<long>(mpz_sizeinbase(mpq_denref(q), 2));
  if (size > 1000 || size < -1000) return enclose_by_mpfr(q);
  const bool dyadic = mpz_scan1(mpq_denref(q), 0) + 1 == mpz_sizeinbase(mpq_denref(q), 2);
  return outward_of_truncated(mpq_get_d(q), dyadic && fits_53_bits(mpq_numref(q)));
}

ScaledInterval enclose_scaled(const Integer& x) {
  const mpz_t& z = x.backend().data();
  if (mpz_sgn(z) == 0) return {};
  long exponent = 0;
  const double d = mpz_get_d_2exp(&exponent, z);
  return {outward_of_truncated(d, fits_53_bits(z)), exponent};
}

ScaledInterval enclose_scaled(const Rational& x) {
  const mpq_t& q = x.backend().data();
  if (mpq_sgn(q) == 0) return {};
  if (mpq_sgn(q) < 0) {
    const ScaledInterval opposite = enclose_scaled(Rational(-x));
    return {-opposite.mantissa, opposite.exponent};
  }
  mpfr_t lower, upper;
  mpfr_init2(lower, 53);
  mpfr_init2(upper, 53);
  mpfr_set_q(lower, q, MPFR_RNDD);
  mpfr_set_q(upper, q, MPFR_RNDU);
  long exponent = 0, exponent_upper = 0;
  const double a = mpfr_get_d_2exp(&exponent, lower, MPFR_RNDN);
  double b = mpfr_get_d_2exp(&exponent_upper, upper, MPFR_RNDN);
  b = std::ldexp(b, static_cast<int>(exponent_upper - exponent));  // 1 when the upper end begins the next binade
  mpfr_clear(lower);
  mpfr_clear(upper);
  return {Interval(a, b), exponent};
}

Interval scale_by_power_of_two(const Interval& x, long exponent) {
  const int e = exponent > 5000 ? 5000 : exponent < -5000 ? -5000 : static_cast<int>(exponent);
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  double lower = std::ldexp(x.inf(), e), upper = std::ldexp(x.sup(), e);
  // ldexp is exact unless it leaves the normal range; there, move one step outward.
  const auto inexact = [e](double from, double to) { return std::isinf(to) || std::ldexp(to, -e) != from; };
  if (inexact(x.inf(), lower)) lower = lower > kMax ? kMax : std::nextafter(lower, -kInf);
  if (inexact(x.sup(), upper)) upper = upper < -kMax ? -kMax : std::nextafter(upper, kInf);
  return Interval(lower, upper);
}

}  // namespace patchproof
