// SPDX-License-Identifier: Apache-2.0
// The bodies of roofline.h for one instruction set. Each file that includes it defines
//   PATCHPROOF_ROOFLINE (the table's name), PATCHPROOF_ROOFLINE_SET, PATCHPROOF_ROOFLINE_LANES
// and is compiled with the flags of its set, and contraction on: a·x + b is one operation where there is one.
#pragma once

#include <cmath>
#include <cstring>

#include "validation/bench/roofline.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace patchproof::bench {
namespace {

constexpr int kLanes = PATCHPROOF_ROOFLINE_LANES;
#if PATCHPROOF_ROOFLINE_LANES > 1
typedef double V __attribute__((vector_size(PATCHPROOF_ROOFLINE_LANES * sizeof(double))));
#else
typedef double V;
#endif

inline V all(double x) { return x - V{}; }
inline V load(const double* from) {
  V x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
inline void store(double* to, V x) { std::memcpy(to, &x, sizeof x); }
inline void stream(double* to, V x) {
#if defined(__AVX512F__)
  _mm512_stream_pd(to, reinterpret_cast<__m512d>(x));
#elif defined(__AVX2__)
  _mm256_stream_pd(to, reinterpret_cast<__m256d>(x));
#elif defined(__SSE4_2__)
  _mm_stream_pd(to, reinterpret_cast<__m128d>(x));
#else
  store(to, x);
#endif
}
inline double sum(V x) {
#if PATCHPROOF_ROOFLINE_LANES > 1
  double s = 0;
  for (int i = 0; i < kLanes; ++i) s += x[i];
  return s;
#else
  return x;
#endif
}
inline V root_of(V x) {
#if defined(__AVX512F__)
  return reinterpret_cast<V>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(x)));
#elif defined(__AVX2__)
  return reinterpret_cast<V>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(x)));
#elif defined(__SSE4_2__)
  return reinterpret_cast<V>(_mm_sqrt_pd(reinterpret_cast<__m128d>(x)));
#else
  return std::sqrt(x);
#endif
}

// Twelve chains: more than latency times width of any processor so far.
constexpr int kChains = 12;

template <class Step>
inline double chains(std::size_t count, Step step) {
  V a[kChains];
#pragma GCC unroll 12  // a loop would keep the chains in memory
  for (int k = 0; k < kChains; ++k) a[k] = all(1.0 + 0.001 * k);
  for (std::size_t i = 0; i < count; i += kChains) {
#pragma GCC unroll 12
    for (int k = 0; k < kChains; ++k) {
      a[k] = step(a[k]);
      asm volatile("" : "+x"(a[k]));  // the compiler must not turn the chains into something else
    }
  }
  double s = 0;
#pragma GCC unroll 12
  for (int k = 0; k < kChains; ++k) s += sum(a[k]);
  return s;
}

double multiply_add(std::size_t count) {
  V x = all(0.999), b = all(0.001);
  asm volatile("" : "+x"(x), "+x"(b));
  return chains(count, [&](V a) { return a * x + b; });
}
double divide(std::size_t count) {
  V x = all(1.0001);
  asm volatile("" : "+x"(x));
  return chains(count, [&](V a) { return x / a; });
}
double root(std::size_t count) {
  return chains(count, [](V a) { return root_of(a); });
}

template <Stores kStores, int kOut>
void traffic_of(const double* u, const double* v, int in, double* to, std::size_t items) {
  constexpr bool kSequential = kStores == Stores::sequential || kStores == Stores::sequential_streamed;
  constexpr bool kStreamed = kStores == Stores::separate_streamed || kStores == Stores::sequential_streamed;
  for (std::size_t i = 0; i < items; i += kLanes) {
    V x = all(static_cast<double>(i));
    if (in >= 1) x += load(u + i);
    if (in >= 2) x += load(v + i);
#pragma GCC unroll 18
    for (int k = 0; k < kOut; ++k) {
      double* const at = kSequential ? to + i * kOut + static_cast<std::size_t>(k) * kLanes
                                     : to + static_cast<std::size_t>(k) * items + i;
      kStreamed ? stream(at, x) : store(at, x);
    }
  }
#if defined(__x86_64__)
  if (kStreamed) _mm_sfence();
#endif
}

template <int kOut>
void traffic_to(const double* u, const double* v, int in, double* to, std::size_t items, Stores stores) {
  switch (stores) {
    case Stores::separate: return traffic_of<Stores::separate, kOut>(u, v, in, to, items);
    case Stores::separate_streamed: return traffic_of<Stores::separate_streamed, kOut>(u, v, in, to, items);
    case Stores::sequential: return traffic_of<Stores::sequential, kOut>(u, v, in, to, items);
    case Stores::sequential_streamed: return traffic_of<Stores::sequential_streamed, kOut>(u, v, in, to, items);
  }
}

void traffic(const double* u, const double* v, int in, double* to, int out, std::size_t items, Stores stores) {
  switch (out) {
    case 3: return traffic_to<3>(u, v, in, to, items, stores);
    case 6: return traffic_to<6>(u, v, in, to, items, stores);
    case 9: return traffic_to<9>(u, v, in, to, items, stores);
    case 12: return traffic_to<12>(u, v, in, to, items, stores);
    case 18: return traffic_to<18>(u, v, in, to, items, stores);
  }
}

inline void cubic_basis(V t, V (&b)[4]) {
  const V s = all(1.0) - t, three = all(3.0);
  b[0] = s * s * s;
  b[1] = three * s * s * t;
  b[2] = three * s * t * t;
  b[3] = t * t * t;
}

void bernstein(const BicubicNet& net, const double* u, const double* v, std::size_t items, double* to) {
  for (std::size_t at = 0; at < items; at += kLanes) {
    V bu[4], bv[4];
    cubic_basis(load(u + at), bu);
    cubic_basis(load(v + at), bv);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      V point{};
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
        V row = bv[0] * all(net.b[c][4 * i]);
#pragma GCC unroll 3
        for (int j = 1; j < 4; ++j) row = bv[j] * all(net.b[c][4 * i + j]) + row;
        point = bu[i] * row + point;
      }
      store(to + static_cast<std::size_t>(c) * items + at, point);
    }
  }
}

}  // namespace

const RooflineTable PATCHPROOF_ROOFLINE{
    InstructionSet::PATCHPROOF_ROOFLINE_SET, kLanes, multiply_add, divide, root, traffic, bernstein};

}  // namespace patchproof::bench
