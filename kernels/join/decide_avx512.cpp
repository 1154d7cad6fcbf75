// SPDX-License-Identifier: Apache-2.0
// AVX-512 (F, DQ, VL) without IFMA.
#include "kernels/join/decide_lanes.h"
#include "kernels/join/lanes_avx512.h"
#include "kernels/join/residues28.h"

namespace patchproof::kernels {

constexpr DecideTable kTable{Lanes::kCount, lanes::decide_polynomial<Lanes, Residues28<Lanes>>,
                             lanes::decide_rational<Lanes, Residues28<Lanes>>};
const DecideTable kDecideAvx512 = kTable;

}  // namespace patchproof::kernels
