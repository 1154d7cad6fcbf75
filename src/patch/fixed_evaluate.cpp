// SPDX-License-Identifier: Apache-2.0
// Widths are chosen by the bounds in the header.
#include "patchproof/patch/fixed_evaluate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace patchproof {
namespace {

using Word = std::uint64_t;

// x = mantissa · 2^exponent with an odd mantissa; 0 is 0 · 2^0.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};
Dyadic split(double x) {
  const Word bits = std::bit_cast<Word>(x), fraction = bits & ((Word{1} << 52) - 1);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  Word mantissa = biased == 0 ? fraction : fraction | (Word{1} << 52);
  if (mantissa == 0) return {};
  const int zeros = std::countr_zero(mantissa);
  mantissa >>= zeros;
  const auto whole = static_cast<std::int64_t>(mantissa);
  return {x < 0 ? -whole : whole, std::max(biased, 1) - 1075 + zeros};
}
int bit_length(std::int64_t x) { return static_cast<int>(std::bit_width(static_cast<Word>(x < 0 ? -x : x))); }

// Several doubles as multiples of 2^lowest: |x| < 2^(lowest + bits).
struct WholeNumbers {
  std::array<Dyadic, FixedPatch::kMostPoints> x;
  int lowest = 0, bits = 0;

  WholeNumbers(std::span<const double> from, std::size_t first, std::size_t stride) {
    int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
    for (std::size_t i = first, k = 0; i < from.size(); i += stride, ++k) {
      x[k] = split(from[i]);
      if (x[k].mantissa == 0) continue;
      low = std::min(low, x[k].exponent);
      high = std::max(high, x[k].exponent + bit_length(x[k].mantissa));
    }
    if (low > high) return;
    lowest = low;
    bits = high - low;
  }
  int shift(std::size_t k) const { return x[k].mantissa == 0 ? 0 : x[k].exponent - lowest; }
  FixedInteger<4> operator[](std::size_t k) const { return FixedInteger<4>(x[k].mantissa) << shift(k); }
};

// x y modulo 2^(64 W). REQUIRES x, y ≥ 0.
template <int W>
FixedInteger<W> times(const FixedInteger<W>& x, const FixedInteger<2>& y) {
  FixedInteger<W> out;
  for (int j = 0; j < (y.limb(1) != 0 ? 2 : 1); ++j) {
    Word carry = 0;
    for (int i = 0; i + j < W; ++i) {
      const detail::WordPair p = detail::multiply_words(x.limb(i), y.limb(j), out.limb(i + j), carry);
      out.limb(i + j) = p.low;
      carry = p.high;
    }
  }
  return out;
}
FixedInteger<2> size_of(const FixedInteger<2>& x) { return x.sign_word() != 0 ? -x : x; }

template <int W>
struct Factors {
  std::array<FixedInteger<W>, FixedPatch::kMostDegree + 1> size;
  std::array<bool, FixedPatch::kMostDegree + 1> negative;
};

// C(n,i) s^(n−i) t^i for all i. The widths are those of the whole products: C(n,i) |t|^i alone may be too long when s
// is 0, but then it is right modulo 2^(64 W), and so is the product, which fits.
template <int W>
Factors<W> bernstein_factors(int n, const FixedInteger<2>& s, const FixedInteger<2>& t) {
  const FixedInteger<2> positive_s = size_of(s), positive_t = size_of(t);
  const bool s_negative = s.sign_word() != 0, t_negative = t.sign_word() != 0;
  Factors<W> out;
  FixedInteger<W> power(1);
  std::int64_t binomial = 1;
  for (int i = 0; i <= n; ++i) {
    out.size[i] = binomial == 1 ? power : times(power, FixedInteger<2>(binomial));
    out.negative[i] = (s_negative && (n - i) % 2 != 0) != (t_negative && i % 2 != 0);
    if (i < n) power = times(power, positive_t);
    binomial = binomial * (n - i) / (i + 1);
  }
  power = FixedInteger<W>(1);
  for (int i = n - 1; i >= 0; --i) {
    power = times(power, positive_s);
    out.size[i] = i == 0 ? power : out.size[i] * power;
  }
  return out;
}

// sum += factor · x. REQUIRES factor ≥ 0, and that the widths hold every partial sum.
template <int S, int N, int M>
void add_multiple(FixedInteger<S>& sum, const FixedInteger<N>& factor, const FixedInteger<M>& x) {
  static_assert(S == N + M);
  for (int j = 0; j < M; ++j) {
    Word carry = 0;
    for (int i = 0; i < N; ++i) {
      const detail::WordPair p = detail::multiply_words(factor.limb(i), x.limb(j), sum.limb(i + j), carry);
      sum.limb(i + j) = p.low;
      carry = p.high;
    }
    for (int i = j + N; i < S; ++i) {
      sum.limb(i) += carry;
      carry = sum.limb(i) < carry ? 1 : 0;
    }
  }
  // Read without its sign a negative x is larger by 2^(64 M).
  const Word mask = x.sign_word();
  Word borrow = 0;
  for (int i = 0; i < N; ++i) sum.limb(M + i) = detail::subtract_words(sum.limb(M + i), factor.limb(i) & mask, borrow);
}

// |x| in the first `limbs` words; the sign.
template <int N>
bool store_magnitude(const FixedInteger<N>& x, int limbs, Word* out) {
  const bool negative = x.sign_word() != 0;
  const FixedInteger<N> size = negative ? -x : x;
  for (int i = 0; i < limbs; ++i) out[i] = i < N ? size.limb(i) : 0;
  return negative;
}

template <int W>
FixedInteger<W> power_of(const FixedInteger<2>& b, int n) {
  FixedInteger<W> out(1);
  if (b.limb(0) == 1 && b.limb(1) == 0) return out;
  for (int i = 0; i < n; ++i) out = times(out, b);
  return out;
}

int bit_length(const Word* x, int limbs) {
  for (int i = limbs; i-- > 0;)
    if (x[i] != 0) return 64 * i + static_cast<int>(std::bit_width(x[i]));
  return 0;
}
// 64 bits of x from bit `from` on, which may be negative: zeros stand below x.
Word bits_from(const Word* x, int limbs, int from) {
  const int word = from >= 0 ? from / 64 : -((63 - from) / 64), bit = from - 64 * word;
  const auto at = [&](int i) { return i >= 0 && i < limbs ? x[i] : Word{0}; };
  return bit == 0 ? at(word) : at(word) >> bit | at(word + 1) << (64 - bit);
}

// m · 2^e to the nearest double, the even one of two. REQUIRES m ≥ 2^54.
double round_to_double(Word m, int e) {
  const int length = static_cast<int>(std::bit_width(m)), top = length - 1 + e;  // 2^top ≤ m 2^e < 2^(top + 1)
  if (top > 1023) return std::numeric_limits<double>::infinity();
  const int precision = top >= -1022 ? 53 : 53 - (-1022 - top), dropped = length - precision;
  if (precision < 0) return 0;
  const Word kept = dropped == 64 ? 0 : m >> dropped, rest = dropped == 64 ? m : m & ((Word{1} << dropped) - 1),
             half = Word{1} << (dropped - 1);
  const Word rounded = kept + (rest > half || (rest == half && (kept & 1) != 0) ? 1 : 0);
  return std::ldexp(static_cast<double>(rounded), e + dropped);
}

}  // namespace

FixedParameter::FixedParameter(const FixedInteger<2>& s, const FixedInteger<2>& t) : s_(s), t_(t) {
  FixedInteger<2> sum = s + t;
  if (sum.sign() == Sign::negative) {
    s_ = -s_;
    t_ = -t_;
    sum = -sum;
  }
  const int length = sum.magnitude_bits();
  const bool power = (FixedInteger<2>(1) << (length - 1)).limb(0) == sum.limb(0) &&
                     (FixedInteger<2>(1) << (length - 1)).limb(1) == sum.limb(1);
  shift_ = power ? length - 1 : 0;
  odd_part_ = power ? FixedInteger<2>(1) : sum;
  bits_ = (size_of(s_) + size_of(t_) - FixedInteger<2>(1)).magnitude_bits();
}

std::optional<FixedParameter> FixedParameter::from_double(double x) {
  if (!std::isfinite(x)) return std::nullopt;
  const Dyadic d = split(x);
  const int length = bit_length(d.mantissa), shift = std::max(0, -d.exponent);
  if (shift > 125 || length + std::max(0, d.exponent) > 125) return std::nullopt;
  const FixedInteger<2> t = FixedInteger<2>(d.mantissa) << std::max(0, d.exponent);
  return FixedParameter((FixedInteger<2>(1) << shift) - t, t);
}

FixedParameter FixedParameter::from_ratio(std::int64_t numerator, std::int64_t denominator) {
  PATCHPROOF_REQUIRES(denominator != 0, "FixedParameter: the denominator is 0");
  const FixedInteger<2> t(numerator);
  return FixedParameter(FixedInteger<2>(denominator) - t, t);
}

std::optional<FixedPatch> FixedPatch::make(int degree_u, int degree_v, std::span<const double> points,
                                           std::span<const double> weights) {
  if (degree_u < 0 || degree_v < 0 || degree_u > kMostDegree || degree_v > kMostDegree) return std::nullopt;
  const std::size_t count = (degree_u + std::size_t(1)) * (degree_v + std::size_t(1));
  PATCHPROOF_REQUIRES(points.size() == 3 * count && (weights.empty() || weights.size() == count),
                      "FixedPatch: the degrees do not fit the points and weights");
  const WholeNumbers w(weights, 0, 1);
  const std::array<WholeNumbers, 3> x{WholeNumbers(points, 0, 3), WholeNumbers(points, 1, 3),
                                      WholeNumbers(points, 2, 3)};
  const int bits = std::max({w.bits, x[0].bits + w.bits, x[1].bits + w.bits, x[2].bits + w.bits});
  if (bits > kMostBits) return std::nullopt;

  std::optional<FixedPatch> out(std::in_place, Uninitialized());
  out->degree_u_ = degree_u;
  out->degree_v_ = degree_v;
  out->rational_ = !weights.empty();
  const int limbs = out->limbs_ = bits <= 63 ? 1 : bits <= 127 ? 2 : 4;
  const auto put = [&](std::size_t c, std::size_t i, const FixedInteger<4>& number) {
    for (int k = 0; k < limbs; ++k) out->numbers_[c][i * limbs + k] = number.limb(k);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    out->exponent_[c] = x[c].lowest;
    for (std::size_t i = 0; i < count; ++i)
      if (out->rational_)
        put(c, i, w[i] * x[c][i]);
      else if (limbs == 1)
        out->numbers_[c][i] = static_cast<Word>(x[c].x[i].mantissa) << x[c].shift(i);
      else
        put(c, i, x[c][i]);
  }
  if (out->rational_)
    for (std::size_t i = 0; i < count; ++i) put(3, i, w[i]);
  return out;
}

template <int W, int L>
bool FixedPatch::evaluate_in(const FixedParameter& u, const FixedParameter& v, FixedPoint& out) const {
  const auto a = bernstein_factors<W>(degree_u_, u.s(), u.t()), b = bernstein_factors<W>(degree_v_, v.s(), v.t());
  const auto sum_of = [&](std::size_t c) {
    const Word* word = numbers_[c].data();
    FixedInteger<2 * W + L> sum;
    for (int i = 0; i <= degree_u_; ++i) {
      FixedInteger<W + L> row;
      for (int j = 0; j <= degree_v_; ++j, word += L) {
        FixedInteger<L> x;
        for (int k = 0; k < L; ++k) x.limb(k) = word[k];
        add_multiple(row, b.size[j], b.negative[j] ? -x : x);
      }
      add_multiple(sum, a.size[i], a.negative[i] ? -row : row);
    }
    return sum;
  };
  out.limbs_ = 2 * W + L;
  bool negative_denominator = false;
  int shift = 0;
  if (rational_) {
    const auto denominator = sum_of(3);
    if (denominator.sign() == Sign::zero) return false;
    negative_denominator = store_magnitude(denominator, out.limbs_, out.denominator_.data());
  } else {
    shift = degree_u_ * u.shift() + degree_v_ * v.shift();
    store_magnitude(multiply_wide(power_of<W>(u.odd_part(), degree_u_), power_of<W>(v.odd_part(), degree_v_)),
                    out.limbs_, out.denominator_.data());
  }
  for (std::size_t c = 0; c < 3; ++c) {
    out.negative_[c] = store_magnitude(sum_of(c), out.limbs_, out.numerator_[c].data()) != negative_denominator;
    out.exponent_[c] = exponent_[c] - shift;
  }
  return true;
}

template <int W>
bool FixedPatch::evaluate_with(const FixedParameter& u, const FixedParameter& v, FixedPoint& out) const {
  switch (limbs_) {
    case 1: return evaluate_in<W, 1>(u, v, out);
    case 2: return evaluate_in<W, 2>(u, v, out);
    default: return evaluate_in<W, 4>(u, v, out);
  }
}

std::optional<FixedPoint> FixedPatch::evaluate(const FixedParameter& u, const FixedParameter& v) const {
  const int bits = std::max(degree_u_ * u.bits(), degree_v_ * v.bits());
  std::optional<FixedPoint> out(std::in_place, FixedPoint::Uninitialized());
  const bool defined = bits <= 62    ? evaluate_with<1>(u, v, *out)
                       : bits <= 190 ? evaluate_with<3>(u, v, *out)
                       : bits <= 318 ? evaluate_with<5>(u, v, *out)
                       : bits <= 382 ? evaluate_with<6>(u, v, *out)
                                     : evaluate_with<10>(u, v, *out);
  if (!defined) out.reset();
  return out;
}

Rational FixedPoint::coordinate(int c) const {
  const auto whole = [&](const Words& words) {
    Integer x(0);
    for (int i = limbs_; i-- > 0;) x = x * (Integer(1) << 64) + Integer(words[i]);
    return x;
  };
  Integer top = whole(numerator_[c]), bottom = whole(denominator_);
  if (exponent_[c] >= 0)
    top = top * (Integer(1) << static_cast<unsigned>(exponent_[c]));
  else
    bottom = bottom * (Integer(1) << static_cast<unsigned>(-exponent_[c]));
  const Rational size = Rational(top) / Rational(bottom);
  return negative_[c] ? Rational(-size) : size;
}

// Q = floor(A 2^m / D) has 62 or 63 bits when A 2^m is 62 bits longer than D. Let h and n be D/2^k and A 2^m/2^k
// rounded down, h of 64 bits, so n < 2^126. Then n/(h + 1) ≤ A 2^m / D < (n + 1)/h, and these differ by less than
// n/h² + 1/h < 1 + 2^-62: the quotient n/(h + 1), rounded down, is Q, Q − 1 or Q − 2. The remainder decides.
double FixedPoint::nearest(int c) const {
  const Word *a = numerator_[c].data(), *d = denominator_.data();
  const int length_a = bit_length(a, limbs_), length_d = bit_length(d, limbs_);
  if (length_a == 0) return 0;
  const int m = 62 + length_d - length_a;
  Word q;
  bool rest;
  if (length_d == 1) {  // D = 1
    q = bits_from(a, limbs_, -m);
    rest = false;  // is any bit of A below bit −m?
    for (int i = 0; i < limbs_ && 64 * i < -m; ++i)
      rest = rest || (-m - 64 * i >= 64 ? a[i] : a[i] & ((Word{1} << (-m - 64 * i)) - 1)) != 0;
  } else {
    const int k = length_d - 64;
    const Word h = bits_from(d, limbs_, k);
    q = h == ~Word{0} ? bits_from(a, limbs_, k - m + 64)
                      : detail::divide_words(bits_from(a, limbs_, k - m + 64), bits_from(a, limbs_, k - m), h + 1);
    // A 2^m − q D, both doubled until they are whole: one word more than A has suffices for both.
    std::array<Word, kMostLimbs + 1> left;
    const int limbs = limbs_ + 1;
    Word carry = 0, borrow = 0;
    const int lift = std::max(0, -m);  // D 2^lift, A 2^(m + lift)
    for (int i = 0; i < limbs; ++i) {
      const detail::WordPair p = detail::multiply_words(bits_from(d, limbs_, 64 * i - lift), q, carry);
      carry = p.high;
      left[i] = detail::subtract_words(bits_from(a, limbs_, 64 * i - m - lift), p.low, borrow);
    }
    const auto at_least_d = [&] {
      for (int i = limbs; i-- > 0;)
        if (const Word w = bits_from(d, limbs_, 64 * i - lift); left[i] != w) return left[i] > w;
      return true;
    };
    while (at_least_d()) {
      borrow = 0;
      for (int i = 0; i < limbs; ++i)
        left[i] = detail::subtract_words(left[i], bits_from(d, limbs_, 64 * i - lift), borrow);
      ++q;
    }
    rest = std::any_of(left.begin(), left.begin() + limbs, [](Word w) { return w != 0; });
  }
  const double size = round_to_double(q << 1 | Word{rest}, exponent_[c] - m - 1);
  return negative_[c] ? -size : size;
}

}  // namespace patchproof
