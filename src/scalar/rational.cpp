// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/rational.h"

#include <mpfr.h>

#include <cmath>

#include "patchproof/contract.h"

namespace patchproof {

Rational from_double(double x) {
  PATCHPROOF_REQUIRES(std::isfinite(x), "from_double: NaN and infinity are not numbers of any model");
  Rational r;
  mpq_set_d(r.backend().data(), x);
  return r;
}

double nearest_double(const Rational& x) {
  // mpfr_get_d rounds correctly in the whole double range (subnormals too) when the MPFR value is exact, so a value
  // rounded once to 53 bits would be rounded twice in the subnormal range: emulate binary64's exponents instead.
  const mpfr_exp_t emin = mpfr_get_emin(), emax = mpfr_get_emax();
  mpfr_set_emin(-1073);
  mpfr_set_emax(1024);
  mpfr_t f;
  mpfr_init2(f, 53);
  const int ternary = mpfr_set_q(f, x.backend().data(), MPFR_RNDN);
  mpfr_subnormalize(f, ternary, MPFR_RNDN);
  const double d = mpfr_get_d(f, MPFR_RNDN);
  mpfr_clear(f);
  mpfr_set_emin(emin);
  mpfr_set_emax(emax);
  return d;
}

}  // namespace patchproof
