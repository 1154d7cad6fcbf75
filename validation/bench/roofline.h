// SPDX-License-Identifier: Apache-2.0
// What the machine could do: the limits that kernels are compared with, measured in the same run.
//
//   multiply_add   chains of a·x + b that do not wait for each other: the peak of arithmetic.  (sse4, portable: multiply,
//                  then add)
//   divide, root   the same of divisions and square roots
//   traffic        reads `in` numbers and writes `out` numbers for each item, and computes next to nothing; with ordinary
//                  and with non-temporal stores, into `out` arrays or into one
//   bernstein      bicubic points from a Bernstein basis, one coefficient after the other: the plain way, for ratios
// One object file for each instruction set, as the kernels have.
#pragma once

#include <cstddef>
#include <vector>

#include "patchproof/instruction_set.h"

namespace patchproof::bench {

enum class Stores { separate, separate_streamed, sequential, sequential_streamed };
inline constexpr Stores kAllStores[] = {Stores::separate, Stores::separate_streamed, Stores::sequential,
                                        Stores::sequential_streamed};

// In each coordinate the control value b_ij of a bicubic patch at 4·i + j.
struct BicubicNet {
  double b[3][16];
};

struct RooflineTable {
  InstructionSet set;
  int lanes;  // doubles in a vector
  // `count` vector operations; the result depends on all of them.
  double (*multiply_add)(std::size_t count);
  double (*divide)(std::size_t count);
  double (*root)(std::size_t count);
  // REQUIRES items a multiple of 8, arrays aligned to 64 bytes, in ≤ 2, out ≤ 18.
  void (*traffic)(const double* u, const double* v, int in, double* to, int out, std::size_t items, Stores stores);
  // Separate coordinates at to, to + items, to + 2·items.
  void (*bernstein)(const BicubicNet& net, const double* u, const double* v, std::size_t items, double* to);
};

extern const RooflineTable kRooflinePortable;
#if defined(__x86_64__)
extern const RooflineTable kRooflineSse4, kRooflineAvx2, kRooflineAvx512;
#endif

// Those that this machine has, narrowest first.
std::vector<const RooflineTable*> roofline_tables();

}  // namespace patchproof::bench
