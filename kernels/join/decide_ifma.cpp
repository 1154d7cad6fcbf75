// SPDX-License-Identifier: Apache-2.0
// AVX-512 with IFMA: products 52 × 52 → 104 in two instructions, primes below 2^47, R = 2^52.
#include "kernels/join/decide_lanes.h"
#include "kernels/join/lanes_avx512.h"
#include "kernels/join/primes.h"

namespace {

// p < R / 32: all ranges of decide_lanes.h hold with room, since sums divide by R = 32 p instead of 16 p. A sum keeps
// the low and the high halves of its products apart; 4096 of them fit.
class Residues47 {
 public:
  static constexpr int kBits = 47;
  using D = __m512d;
  using Number = __m512i;
  struct Sum {
    __m512i low, high;
  };

  static constexpr int kPrimes = 10;

  // Prime q; whole numbers are high · 2^split + low.
  Residues47(int q, int split) {
    const unsigned long long p = (1ULL << 47) - patchproof::kernels::kBelow47[q], mask = (1ULL << 52) - 1;
    unsigned long long inverse = p;  // modulo 2^3: p² = 1; each step doubles the bits
    for (int i = 0; i < 5; ++i) inverse *= 2 - p * inverse;
    p_ = Lanes::constant_bits(p);
    twice_p_ = Lanes::constant_bits(2 * p);
    inverse_ = Lanes::constant_bits(inverse & mask);
    minus_inverse_ = Lanes::constant_bits((0 - inverse) & mask);
    one_ = Lanes::constant_bits(1);
    power_ = Lanes::constant_bits((1ULL << split) % p);
    const double modulus = static_cast<double>(p);
    modulus_ = Lanes::constant(modulus);
    reciprocal_ = Lanes::constant(1 / modulus);
    offset_ = Lanes::constant(0x1p52 + 2 * modulus);
  }

  // x − p round(x / p), |x| ≤ 2^53: the quotient is below 2^7, and its error before rounding below 2^-45.
  D remainder(D x) const {
    const D to_whole = Lanes::constant(0x3p51);
    const D quotient = Lanes::subtract(Lanes::fma(x, reciprocal_, to_whole), to_whole);
    return Lanes::fnma(quotient, modulus_, x);
  }
  // factor · remainder + 2 p in the mantissa: products read 52 bits.
  Number number(D remainder, double factor) const {
    return _mm512_castpd_si512(Lanes::fma(remainder, Lanes::constant(factor), offset_));
  }
  Number one() const { return one_; }
  // factor · (high · 2^split + low) / R, of the remainders of high and low.
  Number joined(D high, D low, double factor) const {
    return close(add_product(add_product(zero(), number(high, factor), power_), number(low, factor), one_));
  }

  static Sum zero() { return {_mm512_setzero_si512(), _mm512_setzero_si512()}; }
  static Sum add_product(Sum sum, Number x, Number y) {
    return {_mm512_madd52lo_epu64(sum.low, x, y), _mm512_madd52hi_epu64(sum.high, x, y)};
  }
  Number close(Sum sum) const {
    const Number m = _mm512_madd52lo_epu64(_mm512_setzero_si512(), sum.low, minus_inverse_);
    const Number low = _mm512_madd52lo_epu64(sum.low, m, p_);  // a multiple of 2^52
    return _mm512_madd52hi_epu64(_mm512_add_epi64(sum.high, _mm512_srli_epi64(low, 52)), m, p_);
  }
  Number minus(Number x) const { return _mm512_sub_epi64(twice_p_, x); }
  static Number twice(Number x) { return _mm512_add_epi64(x, x); }
  static Number thrice(Number x) { return _mm512_add_epi64(_mm512_add_epi64(x, x), x); }
  // Lanes where x is no multiple of p: ⌊(2^52 − 1) / p⌋ = 32, as p < 2^47.
  unsigned nonzero(Number x) const {
    const Number quotient = _mm512_madd52lo_epu64(_mm512_setzero_si512(), x, inverse_);
    return _mm512_cmpgt_epu64_mask(quotient, Lanes::constant_bits(32));
  }

 private:
  Number p_, twice_p_, inverse_, minus_inverse_, one_, power_;
  D modulus_, reciprocal_, offset_;
};

}  // namespace

namespace patchproof::kernels {

constexpr DecideTable kTable{Lanes::kCount, lanes::decide_polynomial<Lanes, Residues47>,
                             lanes::decide_rational<Lanes, Residues47>};
const DecideTable kDecideIfma = kTable;

}  // namespace patchproof::kernels
