// SPDX-License-Identifier: Apache-2.0
// What a batch call on a surface writes, in arrays of xyz.
#pragma once

#include <vector>

#include "patchproof/patch/evaluate_batch.h"

namespace patchproof::test {

constexpr int kVectors = 7;  // S, S_u, S_v, S_uu, S_uv, S_vv, normal

// Numbers that are not written stay −1. wanted: bit m for vector m.
struct Results {
  std::vector<double> numbers[kVectors];
  SurfaceOutput out;
  explicit Results(std::size_t count, unsigned wanted = 0x7f) {
    VectorArray* arrays[kVectors] = {&out.point, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal};
    for (int m = 0; m < kVectors; ++m) {
      numbers[m].assign(3 * count, -1);
      if (wanted >> m & 1) *arrays[m] = VectorArray::interleaved(numbers[m].data());
    }
  }
};

}  // namespace patchproof::test
