// SPDX-License-Identifier: Apache-2.0
// The kernels of one instruction set. Each instruction set's file defines one table; dispatch.cpp chooses.
//
// All return how many leading parameters were good: less than the count where a parameter lies outside the domain or is
// NaN, or where the denominator vanishes (Stop says which; then `good` is the first of its tile). Nothing beyond the tile of
// a bad parameter is written.
#pragma once

#include <cstddef>

#include "kernels/pieces.h"
#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::kernels {

enum class Stop { none, outside_domain, vanishing_weight };

struct Progress {
  std::size_t good = 0;
  Stop stop = Stop::none;
  std::size_t undefined_normals = 0;
};

struct SurfaceCall {
  SurfaceOutput out;
  double* bound = nullptr;   // evaluate_bounded
  VectorArray lower, upper;  // evaluate_interval
  bool left_u = false, left_v = false;
};

struct KernelTable {
  Progress (*surface)(const SurfacePieces&, const SurfaceCall&, const double* u, const double* v, std::size_t count);
  // Item i · count_v + j at (u[i], v[j]). REQUIRES all parameters in the domain. Where the denominator vanishes, `good` is
  // the first item of a block of rows that holds the place.
  Progress (*grid)(const SurfacePieces&, const SurfaceCall&, const double* u, std::size_t count_u, const double* v,
                   std::size_t count_v);
  // Points with the bound of each (call.bound), or enclosures (call.lower, call.upper).
  Progress (*bounded)(const SurfacePieces&, const SurfaceCall&, const double* u, const double* v, std::size_t count);
  Progress (*curve)(const CurvePieces&, const CurveOutput&, bool left, const double* t, std::size_t count);
  // Points, and for each: may it differ from the double nearest to the exact one? See compensated_kernels.h.
  Progress (*compensated)(const SurfacePieces&, const SurfaceCall&, const double* u, const double* v, std::size_t count,
                          unsigned char* undecided);
};

const KernelTable& kernel_table(InstructionSet set);  // REQUIRES is_available(set)

extern const KernelTable kPortable;
#if defined(PATCHPROOF_KERNELS_X86)
extern const KernelTable kSse4, kAvx2, kAvx512;
#elif defined(PATCHPROOF_KERNELS_NEON)
extern const KernelTable kNeon;
#endif

}  // namespace patchproof::kernels
