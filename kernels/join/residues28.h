// SPDX-License-Identifier: Apache-2.0
// Residues modulo primes below 2^28 by products 32 × 32 → 64, R = 2^32: any instruction set. Ranges: decide_lanes.h.
#pragma once

#include "kernels/join/primes.h"

namespace {

template <class L>
class Residues28 {
 public:
  static constexpr int kBits = 28;
  using D = typename L::D;
  using Number = typename L::I;
  using Sum = typename L::I;

  static constexpr int kPrimes = 16;

  // Prime q; whole numbers are high · 2^split + low.
  Residues28(int q, int split) {
    const unsigned p = (1u << 28) - patchproof::kernels::kBelow28[q];
    unsigned inverse = p;  // modulo 2^3: p² = 1; each step doubles the bits
    for (int i = 0; i < 4; ++i) inverse *= 2 - p * inverse;
    p_ = L::constant_bits(p);
    twice_p_ = L::constant_bits(2 * p);
    inverse_ = L::constant_bits(inverse);
    minus_inverse_ = L::constant_bits(0u - inverse);
    one_ = L::constant_bits(1);
    power_ = L::constant_bits((1ULL << split) % p);
    modulus_ = L::constant(p);
    reciprocal_ = L::constant(1.0 / p);
    offset_ = L::constant(0x1p52 + 2.0 * p);
  }

  // x − p round(x / p), |x| ≤ 2^53: the quotient is below 2^26, and its error before rounding below 2^-26.
  D remainder(D x) const {
    const D to_whole = L::constant(0x3p51);
    const D quotient = L::subtract(L::fma(x, reciprocal_, to_whole), to_whole);
    return L::fnma(quotient, modulus_, x);
  }
  // factor · remainder + 2 p in the low bits of the mantissa: products read 32 bits.
  Number number(D remainder, double factor) const {
    return L::bits_of(L::fma(remainder, L::constant(factor), offset_));
  }
  Number one() const { return one_; }
  // factor · (high · 2^split + low) / R, of the remainders of high and low.
  Number joined(D high, D low, double factor) const {
    return close(add_product(add_product(zero(), number(high, factor), power_), number(low, factor), one_));
  }

  static Sum zero() { return L::no_bits(); }
  static Sum add_product(Sum sum, Number x, Number y) { return L::add_bits(sum, L::multiply_low(x, y)); }
  Number close(Sum sum) const {
    const Number m = L::multiply_low(sum, minus_inverse_);
    return L::high_half(L::add_bits(sum, L::multiply_low(m, p_)));
  }
  Number minus(Number x) const { return L::subtract_bits(twice_p_, x); }
  static Number twice(Number x) { return L::add_bits(x, x); }
  static Number thrice(Number x) { return L::add_bits(L::add_bits(x, x), x); }
  // Lanes where x is no multiple of p: ⌊(2^32 − 1) / p⌋ = 16, as p < 2^28.
  unsigned nonzero(Number x) const { return L::low_half_above(L::multiply_low(x, inverse_), 16); }

 private:
  Number p_, twice_p_, inverse_, minus_inverse_, one_, power_;
  D modulus_, reciprocal_, offset_;
};

}  // namespace
