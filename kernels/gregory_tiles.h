// SPDX-License-Identifier: Apache-2.0
// The C surface of a Gregory patch at a tile of places, for the instruction set asked for. Nothing is contracted to fused
// multiply-adds here, so that every set gives the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "kernels/gregory_kernel.h"
#include "patchproof/instruction_set.h"

namespace patchproof::kernels {

constexpr std::size_t kGregoryTile = 256, kGregoryLanes = 8;

// 8 doubles; every operation is one on each of them.
struct Pack {
  typedef double Lanes __attribute__((vector_size(64)));
  Lanes x;
  PATCHPROOF_INLINE Pack() {}
  PATCHPROOF_INLINE explicit Pack(double a) : x{a, a, a, a, a, a, a, a} {}
  PATCHPROOF_INLINE explicit Pack(const Lanes& a) : x(a) {}
  PATCHPROOF_INLINE friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.x + b.x); }
  PATCHPROOF_INLINE friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.x - b.x); }
  PATCHPROOF_INLINE friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.x * b.x); }
  PATCHPROOF_INLINE friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.x / b.x); }
};

// The distances from u = 0, u = 1, v = 0, v = 1, and what is computed: [vector][component].
struct GregoryTile {
  double x[2][kGregoryTile], y[2][kGregoryTile];
  double c[6][4][kGregoryTile];
};

template <int Order, bool Inner>
PATCHPROOF_INLINE void run_tile(const GregoryNets& nets, GregoryTile& tile, std::size_t count) {
  constexpr int kComponents = Inner ? 3 : 4, kWanted = Order == 0 ? 1 : Order == 1 ? 3 : 6;
  for (std::size_t i = 0; i < count; i += kGregoryLanes) {
    std::array<Pack, 2> x, y;
    for (int e = 0; e < 2; ++e) {
      std::memcpy(&x[e].x, tile.x[e] + i, sizeof(Pack));
      std::memcpy(&y[e].x, tile.y[e] + i, sizeof(Pack));
    }
    CSurfaceValues<Pack> out;
    c_surface<Pack, Order, Inner>(nets, x, y, out);
    for (int v = 0; v < kWanted; ++v)
      for (int c = 0; c < kComponents; ++c) std::memcpy(tile.c[v][c] + i, &out[v][c].x, sizeof(Pack));
  }
}

#if defined(__x86_64__) && defined(__GNUC__)
#define PATCHPROOF_TILE(name, attributes)                                               \
  template <int Order, bool Inner>                                                      \
  attributes void name(const GregoryNets& nets, GregoryTile& tile, std::size_t count) { \
    run_tile<Order, Inner>(nets, tile, count);                                          \
  }
PATCHPROOF_TILE(tile_avx512, [[gnu::target("avx512f")]])
PATCHPROOF_TILE(tile_avx2, [[gnu::target("avx2")]])
#undef PATCHPROOF_TILE
#endif

template <int Order, bool Inner>
void c_tile(InstructionSet set, const GregoryNets& nets, GregoryTile& tile, std::size_t count) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (set == InstructionSet::avx512) return tile_avx512<Order, Inner>(nets, tile, count);
  if (set == InstructionSet::avx2) return tile_avx2<Order, Inner>(nets, tile, count);
#endif
  (void)set;
  run_tile<Order, Inner>(nets, tile, count);
}

template <bool Inner>
void c_tile(InstructionSet set, int order, const GregoryNets& nets, GregoryTile& tile, std::size_t count) {
  if (order == 0) return c_tile<0, Inner>(set, nets, tile, count);
  if (order == 1) return c_tile<1, Inner>(set, nets, tile, count);
  c_tile<2, Inner>(set, nets, tile, count);
}

}  // namespace patchproof::kernels
