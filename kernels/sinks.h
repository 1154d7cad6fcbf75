// SPDX-License-Identifier: Apache-2.0
// Writing vectors of results where the caller wants them: separate arrays, xyzxyz…, or fields of records.
#pragma once

#include "kernels/lanes.h"
#include "patchproof/spline/evaluate_batch.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

// x, y, z of kLanes parameters become xyzxyz…
PATCHPROOF_INLINE void interleave(V x, V y, V z, V& first, V& second, V& third) {
#if HWY_TARGET == HWY_AVX3
  // Two permutations a vector: places 0…7 choose from the first operand, 8…15 from the second.
  const __m512i xy0 = _mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), z0 = _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7);
  const __m512i xy1 = _mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), z1 = _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7);
  const __m512i xy2 = _mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), z2 = _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15);
  const auto two = [](V a, __m512i places, V b) { return V{_mm512_permutex2var_pd(a.raw, places, b.raw)}; };
  first = two(two(x, xy0, y), z0, z);
  second = two(two(x, xy1, y), z1, z);
  third = two(two(x, xy2, y), z2, z);
#else
  HWY_ALIGN double numbers[3 * kLanes];
  HWY_ALIGN double coordinates[3][kLanes];
  hn::Store(x, D(), coordinates[0]);
  hn::Store(y, D(), coordinates[1]);
  hn::Store(z, D(), coordinates[2]);
  for (int i = 0; i < kLanes; ++i)
    for (int k = 0; k < 3; ++k) numbers[3 * i + k] = coordinates[k][i];
  first = hn::Load(D(), numbers);
  second = hn::Load(D(), numbers + kLanes);
  third = hn::Load(D(), numbers + 2 * kLanes);
#endif
}

class Sink {
 public:
  enum class Kind { none, separate, interleaved, streamed, strided };

  // Non-temporal stores pay for large outputs only: what fits a cache is wanted there.
  static constexpr std::size_t kStreamBytes = std::size_t{1} << 22;

  Sink() = default;
  Sink(const VectorArray& a, std::size_t count, bool whole_vectors) : a_(a) {
    if (!a.wanted()) return;
    const bool xyz = a.stride == 3 && a.y == a.x + 1 && a.z == a.x + 2;
    kind_ = xyz ? Kind::interleaved : a.stride == 1 ? Kind::separate : Kind::strided;
    const bool aligned = reinterpret_cast<std::uintptr_t>(a.x) % (kLanes * sizeof(double)) == 0;
    if (xyz && aligned && whole_vectors && kLanes > 1 && count * 3 * sizeof(double) >= kStreamBytes)
      kind_ = Kind::streamed;
  }

  bool wanted() const { return kind_ != Kind::none; }

  // The vectors of parameters at…at + kLanes − 1. Streamed: REQUIRES at to be a multiple of kLanes.
  PATCHPROOF_INLINE void put(std::size_t at, V x, V y, V z) const {
    switch (kind_) {
      case Kind::none: return;
      case Kind::separate:
        hn::StoreU(x, D(), a_.x + at);
        hn::StoreU(y, D(), a_.y + at);
        hn::StoreU(z, D(), a_.z + at);
        return;
      case Kind::interleaved:
      case Kind::streamed: {
#if HWY_TARGET == HWY_AVX2
        double* to = a_.x + 3 * at;
        if (kind_ == Kind::interleaved) return hn::StoreInterleaved3(x, y, z, D(), to);
        HWY_ALIGN double numbers[3 * kLanes];
        hn::StoreInterleaved3(x, y, z, D(), numbers);
        for (int i = 0; i < 3; ++i) hn::Stream(hn::Load(D(), numbers + i * kLanes), D(), to + i * kLanes);
#else
        double* to = a_.x + 3 * at;
        V first, second, third;
        interleave(x, y, z, first, second, third);
        if (kind_ == Kind::interleaved) {
          hn::StoreU(first, D(), to);
          hn::StoreU(second, D(), to + kLanes);
          hn::StoreU(third, D(), to + 2 * kLanes);
        } else {
          hn::Stream(first, D(), to);
          hn::Stream(second, D(), to + kLanes);
          hn::Stream(third, D(), to + 2 * kLanes);
        }
#endif
        return;
      }
      case Kind::strided: put_some(at, x, y, z, kLanes); return;
    }
  }
  // Only the first `count` of them.
  HWY_NOINLINE void put_some(std::size_t at, V x, V y, V z, int count) const {
    if (kind_ == Kind::none) return;
#if HWY_TARGET == HWY_AVX3
    // Masked stores write nothing beyond.
    const auto put_first = [](V v, std::size_t n, double* to) {
      if (n > 0) hn::BlendedStore(v, hn::FirstN(D(), n < kLanes ? n : kLanes), D(), to);
    };
    const std::size_t n = static_cast<std::size_t>(count);
    if (kind_ == Kind::separate) {
      put_first(x, n, a_.x + at);
      put_first(y, n, a_.y + at);
      put_first(z, n, a_.z + at);
      return;
    }
    if (kind_ == Kind::interleaved) {
      V first, second, third;
      interleave(x, y, z, first, second, third);
      double* to = a_.x + 3 * at;
      put_first(first, 3 * n, to);
      put_first(second, 3 * n > kLanes ? 3 * n - kLanes : 0, to + kLanes);
      put_first(third, 3 * n > 2 * kLanes ? 3 * n - 2 * kLanes : 0, to + 2 * kLanes);
      return;
    }
#endif
    HWY_ALIGN double numbers[3][kLanes];
    hn::Store(x, D(), numbers[0]);
    hn::Store(y, D(), numbers[1]);
    hn::Store(z, D(), numbers[2]);
    for (int i = 0; i < count; ++i) {
      const std::ptrdiff_t place = (static_cast<std::ptrdiff_t>(at) + i) * a_.stride;
      a_.x[place] = numbers[0][i];
      a_.y[place] = numbers[1][i];
      a_.z[place] = numbers[2][i];
    }
  }
  // One point in a quad.
  PATCHPROOF_INLINE void put(std::size_t at, const Quad& point) const {
    if (kind_ == Kind::none) return;
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(at) * a_.stride;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
    const __m128d xy = _mm256_castpd256_pd128(point.part[0].raw), zw = _mm256_extractf128_pd(point.part[0].raw, 1);
    if (a_.y == a_.x + 1) {
      _mm_storeu_pd(a_.x + place, xy);
    } else {
      _mm_storel_pd(a_.x + place, xy);
      _mm_storeh_pd(a_.y + place, xy);
    }
    _mm_storel_pd(a_.z + place, zw);
#else
    double numbers[4];
    point.store(numbers);
    a_.x[place] = numbers[0];
    a_.y[place] = numbers[1];
    a_.z[place] = numbers[2];
#endif
  }

 private:
  VectorArray a_;
  Kind kind_ = Kind::none;
};

// (S_u × S_v)/|S_u × S_v| of kLanes parameters, 0 0 0 where that is not defined in double; `undefined` counts those.
// The factors, powers of two, keep squares from overflowing and underflowing.
struct NormalScale {
  Lanes u, v;
};
PATCHPROOF_INLINE void unit_normal(const Lanes (&du)[3], const Lanes (&dv)[3], const NormalScale& scale,
                                   Lanes (&n)[3]) {
  Lanes a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = du[k] * scale.u;
    b[k] = dv[k] * scale.v;
  }
  const auto minor = [&](int i, int j) { return Lanes(hn::MulSub(a[i].v, b[j].v, (a[j] * b[i]).v)); };
  n[0] = minor(1, 2);
  n[1] = minor(2, 0);
  n[2] = minor(0, 1);
  const Lanes square = fma(n[0], n[0], fma(n[1], n[1], n[2] * n[2]));
  // Below 2^-900 the square has lost digits, above 2^1000 a minor may have overflowed: no direction.
  const auto defined = hn::And(hn::Gt(square.v, hn::Set(D(), 0x1p-900)), hn::Lt(square.v, hn::Set(D(), 0x1p1000)));
  const V inverse = hn::Div(hn::Set(D(), 1.0), hn::Sqrt(square.v));
  for (int k = 0; k < 3; ++k) n[k] = hn::IfThenElseZero(defined, hn::Mul(n[k].v, inverse));
}
// The number of zero normals among the first `count`.
PATCHPROOF_INLINE std::size_t undefined_among(const Lanes (&n)[3], int count) {
  const V zero = hn::Zero(D());
  const auto none = hn::And(hn::And(hn::Eq(n[0].v, zero), hn::Eq(n[1].v, zero)),
                            hn::And(hn::Eq(n[2].v, zero), hn::FirstN(D(), static_cast<std::size_t>(count))));
  return hn::CountTrue(D(), none);
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
