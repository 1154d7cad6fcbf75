// SPDX-License-Identifier: Apache-2.0
// Four joins: lanes of AVX2 and FMA.
#pragma once

#include <immintrin.h>

namespace {

struct Lanes {
  using D = __m256d;
  using I = __m256i;
  static constexpr int kCount = 4;
  static constexpr unsigned kAll = 0xf;

  static D constant(double x) { return _mm256_set1_pd(x); }
  static D add(D x, D y) { return _mm256_add_pd(x, y); }
  static D subtract(D x, D y) { return _mm256_sub_pd(x, y); }
  static D multiply(D x, D y) { return _mm256_mul_pd(x, y); }
  static D fma(D x, D y, D z) { return _mm256_fmadd_pd(x, y, z); }
  static D fnma(D x, D y, D z) { return _mm256_fnmadd_pd(x, y, z); }
  static D abs(D x) { return _mm256_andnot_pd(constant(-0.0), x); }
  static D max(D x, D y) { return _mm256_max_pd(x, y); }
  static D round(D x) { return _mm256_round_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
  static D keep(D x, unsigned lanes) {
    const I bit = _mm256_setr_epi64x(1, 2, 4, 8);
    const I on = _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(lanes), bit), bit);
    return _mm256_and_pd(x, _mm256_castsi256_pd(on));
  }
  static unsigned equal(D x, D y) { return mask(_mm256_cmp_pd(x, y, _CMP_EQ_OQ)); }
  static unsigned greater(D x, D y) { return mask(_mm256_cmp_pd(x, y, _CMP_GT_OQ)); }
  static void store(double* to, D x) { _mm256_storeu_pd(to, x); }

  // Many comparisons, one mask: bits in which x and y ever differed. (0 and −0 differ.)
  static I no_bits() { return _mm256_setzero_si256(); }
  static I differences(I seen, D x, D y) { return _mm256_or_si256(seen, _mm256_castpd_si256(_mm256_xor_pd(x, y))); }
  static unsigned without(I seen) { return mask(_mm256_castsi256_pd(_mm256_cmpeq_epi64(seen, no_bits()))); }
  // The least size so far that is not zero, in `least`, which begins as infinity.
  static D least_size(D least, D x) {
    const D zero = _mm256_cmp_pd(x, constant(0), _CMP_EQ_OQ);
    return _mm256_min_pd(least, _mm256_blendv_pd(abs(x), least, zero));
  }

  // up: the power of two with 2^52 ≤ top · up < 2^53, down: 1 / up. Anything when top is not in range.
  static void scale_to_whole(D top, D& up, D& down) {
    const I exponent = _mm256_and_si256(_mm256_castpd_si256(top), _mm256_set1_epi64x(0x7ff0000000000000));
    up = _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_set1_epi64x((2 * 1023LL + 52) << 52), exponent));
    down = _mm256_castsi256_pd(_mm256_sub_epi64(exponent, _mm256_set1_epi64x(52LL << 52)));
  }

  // Whole numbers up to 2^51 in size stand in the mantissa of 3 · 2^51 + x. Of longer ones the lowest 27 bits are
  // enough: what rounding to a multiple of 2^27 takes off.
  static I collect_small_bits(I bits, D whole) {
    return _mm256_or_si256(bits, _mm256_castpd_si256(add(whole, constant(0x3p51))));
  }
  static I collect_bits(I bits, D whole) {
    const D high = round(multiply(whole, constant(0x1p-27)));
    return collect_small_bits(bits, fnma(high, constant(0x1p27), whole));
  }
  static constexpr int kZerosSeen = 27;
  static int trailing_zeros(I bits, int most) {
    unsigned long long all[4];
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(all), bits);
    return __builtin_ctzll(all[0] | all[1] | all[2] | all[3] | 1ULL << most);
  }

  // to[i] = entry i of each join, by 4 × 4 transposed.
  template <int Size>
  static void load(const double* const* from, D (&to)[Size]) {
    static_assert(Size % 4 == 0);
#pragma GCC unroll 9
    for (int i = 0; i < Size; i += 4) {
      const D r0 = _mm256_loadu_pd(from[0] + i), r1 = _mm256_loadu_pd(from[1] + i), r2 = _mm256_loadu_pd(from[2] + i),
              r3 = _mm256_loadu_pd(from[3] + i);
      const D even01 = _mm256_unpacklo_pd(r0, r1), odd01 = _mm256_unpackhi_pd(r0, r1);
      const D even23 = _mm256_unpacklo_pd(r2, r3), odd23 = _mm256_unpackhi_pd(r2, r3);
      to[i] = _mm256_permute2f128_pd(even01, even23, 0x20);
      to[i + 1] = _mm256_permute2f128_pd(odd01, odd23, 0x20);
      to[i + 2] = _mm256_permute2f128_pd(even01, even23, 0x31);
      to[i + 3] = _mm256_permute2f128_pd(odd01, odd23, 0x31);
    }
  }

  // For residues of 28 bits.
  static I constant_bits(unsigned long long x) { return _mm256_set1_epi64x(static_cast<long long>(x)); }
  static I bits_of(D x) { return _mm256_castpd_si256(x); }
  static I multiply_low(I x, I y) { return _mm256_mul_epu32(x, y); }
  static I add_bits(I x, I y) { return _mm256_add_epi64(x, y); }
  static I subtract_bits(I x, I y) { return _mm256_sub_epi64(x, y); }
  static I high_half(I x) { return _mm256_srli_epi64(x, 32); }
  static unsigned low_half_above(I x, unsigned limit) {
    const I low = _mm256_and_si256(x, constant_bits(0xffffffff));
    return mask(_mm256_castsi256_pd(_mm256_cmpgt_epi64(low, constant_bits(limit))));
  }

 private:
  static unsigned mask(D x) { return static_cast<unsigned>(_mm256_movemask_pd(x)); }
};

}  // namespace
