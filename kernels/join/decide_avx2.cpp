// SPDX-License-Identifier: Apache-2.0
// AVX2 with FMA.
#include "kernels/join/decide_lanes.h"
#include "kernels/join/lanes_avx2.h"
#include "kernels/join/residues28.h"

namespace patchproof::kernels {

constexpr DecideTable kTable{Lanes::kCount, lanes::decide_polynomial<Lanes, Residues28<Lanes>>,
                             lanes::decide_rational<Lanes, Residues28<Lanes>>};
const DecideTable kDecideAvx2 = kTable;

}  // namespace patchproof::kernels
