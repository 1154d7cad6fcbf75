// SPDX-License-Identifier: Apache-2.0
// Numbers of the kernels in SIMD registers, by google/highway, for the instruction set that the including file is
// compiled for. Everything stands in highway's namespace of that set, so that no two sets share a function.
//
//   Lanes    one double for each of several parameters
//   Points   N coordinates (3, or 4 with the weight), each Lanes, for B groups of parameters
//   Quad     the four numbers x, y, z, w of one parameter
//   Octet    the quads of two rows
#pragma once

#include <cstddef>
#include <cstdint>

#include "hwy/cache_control.h"
#include "hwy/highway.h"
#include "kernels/horner.h"

HWY_BEFORE_NAMESPACE();
namespace patchproof::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
// A vector that holds part or all of a quad, and of an octet.
using Q = hn::CappedTag<double, 4>;
using O = hn::CappedTag<double, 8>;
constexpr int kQuadLanes = static_cast<int>(hn::MaxLanes(Q())), kQuadParts = 4 / kQuadLanes;
constexpr int kOctetLanes = static_cast<int>(hn::MaxLanes(O())), kOctetParts = 8 / kOctetLanes;

struct Lanes {
  V v;
  Lanes() : v(hn::Zero(D())) {}
  Lanes(V x) : v(x) {}
  explicit Lanes(double x) : v(hn::Set(D(), x)) {}
};
PATCHPROOF_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
PATCHPROOF_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
PATCHPROOF_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
PATCHPROOF_INLINE Lanes fma(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
PATCHPROOF_INLINE Lanes reciprocal(Lanes a) { return hn::Div(hn::Set(D(), 1.0), a.v); }

// The first `count` numbers (fewer than kLanes), 0 in the other lanes. Nothing beyond them is read.
PATCHPROOF_INLINE V load_some(const double* from, std::size_t count) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  return hn::MaskedLoad(hn::FirstN(D(), count), D(), from);
#else
  HWY_ALIGN double numbers[kLanes] = {};
  for (std::size_t i = 0; i < count; ++i) numbers[i] = from[i];
  return hn::Load(D(), numbers);
#endif
}

template <int B>
struct Group {
  Lanes g[B];
  Group() = default;
  PATCHPROOF_INLINE explicit Group(double x) {
    for (int b = 0; b < B; ++b) g[b] = Lanes(x);
  }
};
template <int B>
PATCHPROOF_INLINE Group<B> operator*(const Group<B>& a, const Group<B>& b) {
  Group<B> out;
#pragma GCC unroll 4
  for (int i = 0; i < B; ++i) out.g[i] = a.g[i] * b.g[i];
  return out;
}
template <int B>
PATCHPROOF_INLINE Group<B> reciprocal(const Group<B>& a) {
  Group<B> out;
#pragma GCC unroll 4
  for (int i = 0; i < B; ++i) out.g[i] = reciprocal(a.g[i]);
  return out;
}

template <int N, int B>
struct Points {
  Lanes c[B][N];
  // The same coefficient for all parameters.
  static PATCHPROOF_INLINE Points all(const double* from) {
    Points out;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      const Lanes x(from[k]);
#pragma GCC unroll 4
      for (int b = 0; b < B; ++b) out.c[b][k] = x;
    }
    return out;
  }
};
template <int N, int B, class Op>
PATCHPROOF_INLINE Points<N, B> each(Op op) {
  Points<N, B> out;
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b)
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) out.c[b][k] = op(b, k);
  return out;
}
template <int N, int B>
PATCHPROOF_INLINE Points<N, B> fma(const Points<N, B>& a, const Group<B>& x, const Points<N, B>& c) {
  Points<N, B> out;
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b)
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) out.c[b][k] = fma(a.c[b][k], x.g[b], c.c[b][k]);
  return out;
}
template <int N, int B>
PATCHPROOF_INLINE Points<N, B> scale(const Points<N, B>& a, const Group<B>& x) {
  Points<N, B> out;
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b)
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) out.c[b][k] = a.c[b][k] * x.g[b];
  return out;
}
template <int N, int B>
PATCHPROOF_INLINE Points<N, B> minus_product(const Points<N, B>& a, const Points<N, B>& s, const Group<B>& w) {
  Points<N, B> out;
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b)
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) out.c[b][k] = hn::NegMulAdd(s.c[b][k].v, w.g[b].v, a.c[b][k].v);
  return out;
}
template <int B>
PATCHPROOF_INLINE Group<B> weight_of(const Points<4, B>& a) {
  Group<B> out;
#pragma GCC unroll 4
  for (int b = 0; b < B; ++b) out.g[b] = a.c[b][3];
  return out;
}

// A number that multiplies a whole quad or octet.
struct Scalar {
  double x;
  Scalar() = default;
  explicit Scalar(double value) : x(value) {}
  friend Scalar operator*(Scalar a, Scalar b) { return Scalar(a.x * b.x); }
};

struct Quad {
  hn::Vec<Q> part[kQuadParts];
  PATCHPROOF_INLINE Quad() {
    for (int i = 0; i < kQuadParts; ++i) part[i] = hn::Zero(Q());
  }
  static PATCHPROOF_INLINE Quad load(const double* from) {
    Quad out;
#pragma GCC unroll 4
    for (int i = 0; i < kQuadParts; ++i) out.part[i] = hn::LoadU(Q(), from + i * kQuadLanes);
    return out;
  }
  PATCHPROOF_INLINE void store(double* to) const {
#pragma GCC unroll 4
    for (int i = 0; i < kQuadParts; ++i) hn::StoreU(part[i], Q(), to + i * kQuadLanes);
  }
};
PATCHPROOF_INLINE Quad fma(const Quad& a, Scalar x, const Quad& c) {
  Quad out;
  const auto xs = hn::Set(Q(), x.x);
#pragma GCC unroll 4
  for (int i = 0; i < kQuadParts; ++i) out.part[i] = hn::MulAdd(a.part[i], xs, c.part[i]);
  return out;
}
PATCHPROOF_INLINE Quad scale(const Quad& a, Scalar x) {
  Quad out;
  const auto xs = hn::Set(Q(), x.x);
#pragma GCC unroll 4
  for (int i = 0; i < kQuadParts; ++i) out.part[i] = hn::Mul(a.part[i], xs);
  return out;
}

// A number that multiplies x, y, z, while its modulus multiplies the fourth: the term of a bound.
struct SignedScalar {
  double x;
};
constexpr std::uint64_t kSigns[8] = {~0ULL, ~0ULL, ~0ULL, ~0ULL >> 1, ~0ULL, ~0ULL, ~0ULL, ~0ULL >> 1};
template <class Tag>
PATCHPROOF_INLINE hn::Vec<Tag> with_modulus(Tag tag, double x, int first) {
  return hn::And(hn::Set(tag, x), hn::BitCast(tag, hn::LoadU(hn::RebindToUnsigned<Tag>(), kSigns + first % 4)));
}
PATCHPROOF_INLINE Quad fma(const Quad& a, SignedScalar x, const Quad& c) {
  Quad out;
#pragma GCC unroll 4
  for (int i = 0; i < kQuadParts; ++i)
    out.part[i] = hn::MulAdd(a.part[i], with_modulus(Q(), x.x, i * kQuadLanes), c.part[i]);
  return out;
}

// The fourth number of a quad, in all lanes of a quad's vectors.
struct Weight {
  hn::Vec<Q> v;
};
PATCHPROOF_INLINE Weight weight_of(const Quad& a) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  return {hn::Vec256<double>{_mm256_permute4x64_pd(a.part[0].raw, 0xff)}};
#else
  alignas(64) double numbers[4];
  a.store(numbers);
  return {hn::Set(Q(), numbers[3])};
#endif
}
PATCHPROOF_INLINE Weight reciprocal(const Weight& w) { return {hn::Div(hn::Set(Q(), 1.0), w.v)}; }
PATCHPROOF_INLINE Quad scale(const Quad& a, const Weight& w) {
  Quad out;
#pragma GCC unroll 4
  for (int i = 0; i < kQuadParts; ++i) out.part[i] = hn::Mul(a.part[i], w.v);
  return out;
}
PATCHPROOF_INLINE Quad minus_product(const Quad& a, const Quad& s, const Weight& w) {
  Quad out;
#pragma GCC unroll 4
  for (int i = 0; i < kQuadParts; ++i) out.part[i] = hn::NegMulAdd(s.part[i], w.v, a.part[i]);
  return out;
}

struct Octet {
  hn::Vec<O> part[kOctetParts];
  PATCHPROOF_INLINE Octet() {
    for (int i = 0; i < kOctetParts; ++i) part[i] = hn::Zero(O());
  }
  static PATCHPROOF_INLINE Octet load(const double* from) {
    Octet out;
#pragma GCC unroll 8
    for (int i = 0; i < kOctetParts; ++i) out.part[i] = hn::LoadU(O(), from + i * kOctetLanes);
    return out;
  }
  PATCHPROOF_INLINE void store(double* to) const {
#pragma GCC unroll 8
    for (int i = 0; i < kOctetParts; ++i) hn::StoreU(part[i], O(), to + i * kOctetLanes);
  }
  // Half 0 or 1.
  template <int Half>
  PATCHPROOF_INLINE Quad half() const {
    Quad out;
#if HWY_TARGET == HWY_AVX3
    out.part[0] = Half == 0 ? hn::LowerHalf(Q(), part[0]) : hn::UpperHalf(Q(), part[0]);
#else
#pragma GCC unroll 4
    for (int i = 0; i < kQuadParts; ++i) out.part[i] = part[Half * kQuadParts + i];
#endif
    return out;
  }
};
PATCHPROOF_INLINE Octet fma(const Octet& a, Scalar x, const Octet& c) {
  Octet out;
  const auto xs = hn::Set(O(), x.x);
#pragma GCC unroll 8
  for (int i = 0; i < kOctetParts; ++i) out.part[i] = hn::MulAdd(a.part[i], xs, c.part[i]);
  return out;
}

PATCHPROOF_INLINE Octet fma(const Octet& a, SignedScalar x, const Octet& c) {
  Octet out;
#pragma GCC unroll 8
  for (int i = 0; i < kOctetParts; ++i)
    out.part[i] = hn::MulAdd(a.part[i], with_modulus(O(), x.x, i * kOctetLanes), c.part[i]);
  return out;
}

}  // namespace patchproof::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
