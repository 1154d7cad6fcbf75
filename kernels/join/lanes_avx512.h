// SPDX-License-Identifier: Apache-2.0
// Eight joins: lanes of AVX-512 (F, DQ, VL).
#pragma once

#include <immintrin.h>

namespace {

struct Lanes {
  using D = __m512d;
  using I = __m512i;
  static constexpr int kCount = 8;
  static constexpr unsigned kAll = 0xff;

  static D constant(double x) { return _mm512_set1_pd(x); }
  static D add(D x, D y) { return _mm512_add_pd(x, y); }
  static D subtract(D x, D y) { return _mm512_sub_pd(x, y); }
  static D multiply(D x, D y) { return _mm512_mul_pd(x, y); }
  static D fma(D x, D y, D z) { return _mm512_fmadd_pd(x, y, z); }
  static D fnma(D x, D y, D z) { return _mm512_fnmadd_pd(x, y, z); }
  static D abs(D x) { return _mm512_abs_pd(x); }
  static D max(D x, D y) { return _mm512_max_pd(x, y); }
  static D round(D x) { return _mm512_roundscale_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
  static D keep(D x, unsigned lanes) { return _mm512_maskz_mov_pd(static_cast<__mmask8>(lanes), x); }
  static unsigned equal(D x, D y) { return _mm512_cmp_pd_mask(x, y, _CMP_EQ_OQ); }
  static unsigned greater(D x, D y) { return _mm512_cmp_pd_mask(x, y, _CMP_GT_OQ); }
  static void store(double* to, D x) { _mm512_storeu_pd(to, x); }

  // Many comparisons, one mask: bits in which x and y ever differed. (0 and −0 differ.)
  static I no_bits() { return _mm512_setzero_si512(); }
  static I differences(I seen, D x, D y) {  // seen | (x ^ y)
    return _mm512_ternarylogic_epi64(seen, _mm512_castpd_si512(x), _mm512_castpd_si512(y), 0xf6);
  }
  static unsigned without(I seen) { return _mm512_testn_epi64_mask(seen, seen); }
  // The least size so far that is not zero, in `least`, which begins as infinity. As bits: those of 0 minus 1 are the
  // largest.
  static D least_size(D least, D x) {
    const I bits = _mm512_sub_epi64(_mm512_castpd_si512(abs(x)), _mm512_set1_epi64(1));
    return _mm512_castsi512_pd(_mm512_min_epu64(_mm512_castpd_si512(least), bits));
  }

  // up: the power of two with 2^52 ≤ top · up < 2^53, down: 1 / up. Anything when top is not in range.
  static void scale_to_whole(D top, D& up, D& down) {
    const I exponent = _mm512_and_si512(_mm512_castpd_si512(top), _mm512_set1_epi64(0x7ff0000000000000));
    up = _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_set1_epi64((2 * 1023LL + 52) << 52), exponent));
    down = _mm512_castsi512_pd(_mm512_sub_epi64(exponent, _mm512_set1_epi64(52LL << 52)));
  }

  static I collect_bits(I bits, D whole) { return _mm512_or_si512(bits, _mm512_cvtpd_epi64(whole)); }
  static I collect_small_bits(I bits, D whole) { return collect_bits(bits, whole); }
  static constexpr int kZerosSeen = 53;
  static int trailing_zeros(I bits, int most) {
    return __builtin_ctzll(static_cast<unsigned long long>(_mm512_reduce_or_epi64(bits)) | 1ULL << most);
  }

  // to[i] = entry i of each join. Four entries at a time: rows of joins j and j + 4 side by side, then 4 × 4
  // transposed.
  template <int Size>
  static void load(const double* const* from, D (&to)[Size]) {
    static_assert(Size % 4 == 0);
    const I first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
#pragma GCC unroll 9
    for (int i = 0; i < Size; i += 4) {
      D row[4];
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j)
        row[j] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(from[j] + i)),
                                    _mm256_loadu_pd(from[j + 4] + i), 1);
      const D even01 = _mm512_unpacklo_pd(row[0], row[1]), odd01 = _mm512_unpackhi_pd(row[0], row[1]);
      const D even23 = _mm512_unpacklo_pd(row[2], row[3]), odd23 = _mm512_unpackhi_pd(row[2], row[3]);
      to[i] = _mm512_permutex2var_pd(even01, first, even23);
      to[i + 1] = _mm512_permutex2var_pd(odd01, first, odd23);
      to[i + 2] = _mm512_permutex2var_pd(even01, second, even23);
      to[i + 3] = _mm512_permutex2var_pd(odd01, second, odd23);
    }
  }

  // For residues of 28 bits.
  static I constant_bits(unsigned long long x) { return _mm512_set1_epi64(static_cast<long long>(x)); }
  static I bits_of(D x) { return _mm512_castpd_si512(x); }
  static I multiply_low(I x, I y) { return _mm512_mul_epu32(x, y); }
  static I add_bits(I x, I y) { return _mm512_add_epi64(x, y); }
  static I subtract_bits(I x, I y) { return _mm512_sub_epi64(x, y); }
  static I high_half(I x) { return _mm512_srli_epi64(x, 32); }
  static unsigned low_half_above(I x, unsigned limit) {
    return _mm512_cmpgt_epu64_mask(_mm512_and_si512(x, constant_bits(0xffffffff)), constant_bits(limit));
  }
};

}  // namespace
