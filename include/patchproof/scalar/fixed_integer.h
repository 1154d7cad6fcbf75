// SPDX-License-Identifier: Apache-2.0
// FixedInteger<Limbs>: whole numbers of 64·Limbs bits on the stack, for exact decisions whose size is known beforehand.
//
//     value = Σ limb_i 2^(64 i) − [top bit] 2^(64 Limbs)        two's complement
//
// No allocation: for numbers of a few words many times faster than Integer. The price is a proof: whoever uses it
// states a bound on every intermediate result and chooses Limbs by it (join/fixed_g1.h does).
//
// REQUIRES  the exact result of + − × fits; otherwise it is reduced modulo 2^(64 Limbs), as unsigned numbers are.
// ENSURES   (1) + − × and unary − are exact modulo 2^(64 Limbs), hence exact when the result fits;  (2) multiply_wide
//           never overflows: N + M limbs hold every product of N and M limbs;  (3) add_product(s, a, b) is s + a b and
//           subtract_product(s, a, b) is s − a b, modulo the width of s;  (4) widening keeps the value;  (5) x << k is
//           x 2^k modulo 2^(64 Limbs), shifted_down(k) the largest whole number not above x / 2^k;  (6) sign() is the
//           sign.
// SCALARS   a Ring, but no ExactRing: a template that relies on exactness without a bound must not receive it.
// COST      Limbs word additions; N · M word products.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>

#include "patchproof/contract.h"
#include "patchproof/scalar/integer.h"

namespace patchproof {
namespace detail {

using Word = std::uint64_t;

struct WordPair {
  Word low, high;
};

// a · b + c + d, which always fits two words: by halves where there is no 128-bit type.
constexpr WordPair multiply_words_by_halves(Word a, Word b, Word c = 0, Word d = 0) {
  constexpr Word mask = 0xffffffffu;
  const Word a0 = a & mask, a1 = a >> 32, b0 = b & mask, b1 = b >> 32;
  const Word low = a0 * b0, cross = a1 * b0 + (low >> 32), middle = a0 * b1 + (cross & mask);
  WordPair r{(middle << 32) | (low & mask), a1 * b1 + (cross >> 32) + (middle >> 32)};
  r.low += c;
  r.high += static_cast<Word>(r.low < c);
  r.low += d;
  r.high += static_cast<Word>(r.low < d);
  return r;
}

#ifdef __SIZEOF_INT128__
__extension__ using WideWord = unsigned __int128;
constexpr WordPair multiply_words(Word a, Word b, Word c = 0, Word d = 0) {
  const WideWord r = static_cast<WideWord>(a) * b + c + d;
  return {static_cast<Word>(r), static_cast<Word>(r >> 64)};
}
#else
constexpr WordPair multiply_words(Word a, Word b, Word c = 0, Word d = 0) {
  return multiply_words_by_halves(a, b, c, d);
}
#endif

// a + b + carry and a − b − borrow; the new carry (borrow), 0 or 1, is left in the last argument.
constexpr Word add_words(Word a, Word b, Word& carry) {
  const Word once = a + b, twice = once + carry;
  carry = static_cast<Word>(once < a) | static_cast<Word>(twice < once);
  return twice;
}
constexpr Word subtract_words(Word a, Word b, Word& borrow) {
  const Word once = a - b, twice = once - borrow;
  borrow = static_cast<Word>(a < b) | static_cast<Word>(once < borrow);
  return twice;
}

}  // namespace detail

template <int Limbs>
class FixedInteger {
  static_assert(Limbs >= 1);

 public:
  using Word = detail::Word;

  constexpr FixedInteger() = default;  // 0
  template <std::signed_integral I>
  explicit constexpr FixedInteger(I x) {
    limb_[0] = static_cast<Word>(static_cast<std::int64_t>(x));
    for (int i = 1; i < Limbs; ++i) limb_[i] = x < 0 ? ~Word{0} : 0;
  }
  template <int M>
  requires(M < Limbs) explicit constexpr FixedInteger(const FixedInteger<M>& x) {
    for (int i = 0; i < Limbs; ++i) limb_[i] = i < M ? x.limb(i) : x.sign_word();
  }

  constexpr Word limb(int i) const { return limb_[i]; }  // the i-th least significant
  constexpr Word& limb(int i) { return limb_[i]; }
  // All ones when the value is negative, otherwise 0.
  constexpr Word sign_word() const { return Word{0} - (limb_[Limbs - 1] >> 63); }
  constexpr Sign sign() const {
    if (sign_word() != 0) return Sign::negative;
    Word any = 0;
    for (const Word w : limb_) any |= w;
    return any != 0 ? Sign::positive : Sign::zero;
  }
  // The least k with −2^k ≤ value < 2^k.
  constexpr int magnitude_bits() const {
    for (int i = Limbs; i-- > 0;)
      if (const Word w = limb_[i] ^ sign_word(); w != 0) return 64 * i + static_cast<int>(std::bit_width(w));
    return 0;
  }

  constexpr FixedInteger& operator+=(const FixedInteger& y) {
    Word carry = 0;
    for (int i = 0; i < Limbs; ++i) limb_[i] = detail::add_words(limb_[i], y.limb_[i], carry);
    return *this;
  }
  constexpr FixedInteger& operator-=(const FixedInteger& y) {
    Word borrow = 0;
    for (int i = 0; i < Limbs; ++i) limb_[i] = detail::subtract_words(limb_[i], y.limb_[i], borrow);
    return *this;
  }
  friend constexpr FixedInteger operator+(FixedInteger x, const FixedInteger& y) { return x += y; }
  friend constexpr FixedInteger operator-(FixedInteger x, const FixedInteger& y) { return x -= y; }
  friend constexpr FixedInteger operator-(const FixedInteger& x) { return FixedInteger() - x; }
  friend constexpr FixedInteger operator*(const FixedInteger& x, const FixedInteger& y) {
    FixedInteger r;
    for (int i = 0; i < Limbs; ++i) {
      Word carry = 0;
      for (int j = 0; i + j < Limbs; ++j) {
        const detail::WordPair p = detail::multiply_words(x.limb_[i], y.limb_[j], r.limb_[i + j], carry);
        r.limb_[i + j] = p.low;
        carry = p.high;
      }
    }
    return r;
  }
  // REQUIRES 0 ≤ k < 64 Limbs.
  friend constexpr FixedInteger operator<<(const FixedInteger& x, int k) {
    FixedInteger r;
    const int words = k / 64, bits = k % 64;
    for (int i = words; i < Limbs; ++i) {
      r.limb_[i] = x.limb_[i - words] << bits;
      if (bits != 0 && i > words) r.limb_[i] |= x.limb_[i - words - 1] >> (64 - bits);
    }
    return r;
  }
  // REQUIRES 0 ≤ k < 64 Limbs.
  constexpr FixedInteger shifted_down(int k) const {
    FixedInteger r;
    const int words = k / 64, bits = k % 64;
    const auto at = [&](int i) { return i < Limbs ? limb_[i] : sign_word(); };
    for (int i = 0; i < Limbs; ++i) {
      r.limb_[i] = at(i + words) >> bits;
      if (bits != 0) r.limb_[i] |= at(i + words + 1) << (64 - bits);
    }
    return r;
  }

 private:
  std::array<Word, Limbs> limb_{};
};

// a · b, always exact.
template <int N, int M>
constexpr FixedInteger<N + M> multiply_wide(const FixedInteger<N>& a, const FixedInteger<M>& b) {
  using detail::Word;
  FixedInteger<N + M> r;
  for (int i = 0; i < N; ++i) {
    Word carry = 0;
    for (int j = 0; j < M; ++j) {
      const detail::WordPair p = detail::multiply_words(a.limb(i), b.limb(j), r.limb(i + j), carry);
      r.limb(i + j) = p.low;
      carry = p.high;
    }
    r.limb(i + M) = carry;
  }
  // The limbs read as unsigned numbers are a + 2^(64 N) [a < 0] and b + 2^(64 M) [b < 0].
  Word borrow = 0;
  for (int j = 0; j < M; ++j) r.limb(N + j) = detail::subtract_words(r.limb(N + j), b.limb(j) & a.sign_word(), borrow);
  borrow = 0;
  for (int i = 0; i < N; ++i) r.limb(M + i) = detail::subtract_words(r.limb(M + i), a.limb(i) & b.sign_word(), borrow);
  return r;
}

// sum ± a · b in place.
template <int S, int N, int M>
requires(S >= N + M) constexpr void add_product(FixedInteger<S>& sum, const FixedInteger<N>& a,
                                                const FixedInteger<M>& b) {
  if constexpr (S == N + M)
    sum += multiply_wide(a, b);
  else
    sum += FixedInteger<S>(multiply_wide(a, b));
}
template <int S, int N, int M>
requires(S >= N + M) constexpr void subtract_product(FixedInteger<S>& sum, const FixedInteger<N>& a,
                                                     const FixedInteger<M>& b) {
  if constexpr (S == N + M)
    sum -= multiply_wide(a, b);
  else
    sum -= FixedInteger<S>(multiply_wide(a, b));
}

template <int Limbs>
struct scalar_traits<FixedInteger<Limbs>> {
  static constexpr bool is_exact = false;  // only under a bound
  static constexpr bool is_field = false;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const FixedInteger<Limbs>& x) { return x.sign(); }
  using knot_scalar = Rational;
};

// The same number, of any size.
template <int Limbs>
struct embedding<Integer, FixedInteger<Limbs>> {
  static Integer apply(const FixedInteger<Limbs>& x) {
    Integer r(static_cast<std::int64_t>(x.limb(Limbs - 1)));
    for (int i = Limbs - 1; i-- > 0;) r = r * (Integer(1) << 64) + Integer(x.limb(i));
    return r;
  }
};

}  // namespace patchproof
