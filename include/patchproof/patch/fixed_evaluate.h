// SPDX-License-Identifier: Apache-2.0
// The exact point of a Bézier patch of doubles at a rational parameter, in integers of a fixed width: no allocation.
//
//   S(u,v) = Σ_i Σ_j C(p,i) C(q,j) s^(p−i) t^i σ^(q−j) τ^j w_ij P_ij / the same sum of w_ij
//   for u = t/(s + t), v = τ/(σ + τ) with whole s, t, σ, τ; without weights the sum below is (s + t)^p (σ + τ)^q
//
// Coordinates are doubles, so one power of two for each of x, y, z makes whole numbers X_ij of them; another one does
// so for the weights, and whole numbers w X stand for the products. Then everything is one sum of whole numbers for
// each coordinate, and one for the denominator.
//
// WIDTHS  Parameters take k bits: |s| + |t| ≤ 2^k, and so for v; whole numbers take x bits: |X| < 2^x. Since
//   Σ_i C(p,i) |s|^(p−i) |t|^i = (|s| + |t|)^p ≤ 2^(pk), with W limbs for factors and L limbs for numbers:
//     C(p,i) s^(p−i) t^i           ≤ 2^(pk)             ≤ 2^(64 W − 2)               W limbs
//     Σ_j C(q,j) σ^(q−j) τ^j X_ij  < 2^(qk + x)         ≤ 2^(64 (W + L) − 3)         W + L limbs
//     the whole sum                < 2^(pk + qk' + x)   ≤ 2^(64 (2W + L) − 5)        2W + L limbs
//     (s + t)^p (σ + τ)^q          ≤ 2^(pk + qk')       ≤ 2^(128 W − 4)              2W limbs
//   whenever pk, qk' ≤ 64 W − 2 and x ≤ 64 L − 1. Partial sums obey the same bounds. W = 1, 3, 5, 6, 10 and L = 1, 2, 4
//   are compiled; the least that suffice are used. A double x is accepted as a parameter when it is a multiple of
//   2^-125 and |x| < 2^125 (all of [2^-73, 1] is); every ratio of 64-bit numbers is. So |s| + |t| < 2^127 and k ≤ 127.
//   Doubles in [1/1024, 1] take k ≤ 63.
//
// REQUIRES  all numbers are finite; (degree + 1)(degree + 1) points, as many weights or none.
// ENSURES   (1) coordinate(c) is the exact value;  (2) nearest(c) is the double nearest to it, the even one of two, ±∞
//           beyond the largest double, subnormals rounded correctly;  (3) make is empty exactly when a degree is not in
//           0, …, 5 or a whole number takes more than 255 bits; a parameter is empty when it is not accepted as above;
//           evaluate never is, except where the denominator vanishes;  (4) parameters outside [0, 1] are those of the
//           polynomial;  (5) scaling all coordinates by a power of two scales the point.
// COST      (p + 1)(q + 1) W L + (p + 1) W (W + L) word products for each coordinate, about 4 p W + p W² for the
//           factors. No heap, except in coordinate().
// NEIGHBOURS bezier_patch.h, rational_patch.h (evaluate() over Rational: the oracle of the tests), evaluate_batch.h.
// TEST      tests/patch/fixed_evaluate_test.cpp checks (1)–(5).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "patchproof/scalar/fixed_integer.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

// t/(s + t) in whole numbers.
class FixedParameter {
 public:
  // Empty when the whole numbers are too long, or x is not finite.
  static std::optional<FixedParameter> from_double(double x);
  // REQUIRES denominator != 0.
  static FixedParameter from_ratio(std::int64_t numerator, std::int64_t denominator);

  const FixedInteger<2>& s() const { return s_; }
  const FixedInteger<2>& t() const { return t_; }
  // s + t = odd_part · 2^shift, and odd_part is 1 when s + t is a power of two, otherwise s + t itself.
  const FixedInteger<2>& odd_part() const { return odd_part_; }
  int shift() const { return shift_; }
  int bits() const { return bits_; }  // the least k with |s| + |t| ≤ 2^k

 private:
  FixedParameter(const FixedInteger<2>& s, const FixedInteger<2>& t);
  FixedInteger<2> s_, t_, odd_part_;
  int shift_ = 0, bits_ = 0;
};

// Three fractions with one denominator: numerator_c · 2^exponent_c / denominator.
class FixedPoint {
 public:
  static constexpr int kMostLimbs = 24;
  class Uninitialized {  // only for FixedPatch
    friend class FixedPatch;
    Uninitialized() = default;
  };
  explicit FixedPoint(Uninitialized) {}

  Rational coordinate(int c) const;
  double nearest(int c) const;

 private:
  friend class FixedPatch;
  using Words = std::array<std::uint64_t, kMostLimbs>;

  // Magnitudes, the first `limbs_` words of each.
  int limbs_;
  std::array<Words, 3> numerator_;
  Words denominator_;
  std::array<bool, 3> negative_;  // of the fraction
  std::array<int, 3> exponent_;
};

class FixedPatch {
 public:
  static constexpr int kMostDegree = 5, kMostBits = 255, kMostPoints = (kMostDegree + 1) * (kMostDegree + 1);
  class Uninitialized {  // only for make
    friend class FixedPatch;
    Uninitialized() = default;
  };
  explicit FixedPatch(Uninitialized) {}

  // points: x y z each, j (along v) running fastest.
  static std::optional<FixedPatch> make(int degree_u, int degree_v, std::span<const double> points,
                                        std::span<const double> weights = {});
  // Empty when the denominator vanishes.
  std::optional<FixedPoint> evaluate(const FixedParameter& u, const FixedParameter& v) const;

 private:
  static constexpr int kMostNumberLimbs = 4;
  template <int W, int L>
  bool evaluate_in(const FixedParameter& u, const FixedParameter& v, FixedPoint& out) const;
  template <int W>
  bool evaluate_with(const FixedParameter& u, const FixedParameter& v, FixedPoint& out) const;

  int degree_u_, degree_v_, limbs_;
  bool rational_;
  std::array<int, 3> exponent_;
  // Whole numbers x, y, z and, for rational patches, w of all points: `limbs_` words each, least significant first.
  std::array<std::array<std::uint64_t, kMostPoints * kMostNumberLimbs>, 4> numbers_;
};

namespace detail {

// (high · 2^64 + low) / d rounded down. REQUIRES high < d.
constexpr Word divide_words_by_bits(Word high, Word low, Word d) {
  Word quotient = 0;
  for (int i = 64; i-- > 0;) {
    const Word carry = high >> 63;
    high = (high << 1) | (low >> 63);
    low <<= 1;
    quotient <<= 1;
    if (carry != 0 || high >= d) {
      high -= d;
      quotient |= 1;
    }
  }
  return quotient;
}
#ifdef __SIZEOF_INT128__
constexpr Word divide_words(Word high, Word low, Word d) {
  return static_cast<Word>(((static_cast<WideWord>(high) << 64) | low) / d);
}
#else
constexpr Word divide_words(Word high, Word low, Word d) { return divide_words_by_bits(high, low, d); }
#endif

}  // namespace detail
}  // namespace patchproof
