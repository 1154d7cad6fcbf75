// SPDX-License-Identifier: Apache-2.0
// The instruction sets that kernels are compiled for. One is chosen at run time; each can be asked for by name.
#pragma once

#include <vector>

namespace patchproof {

// portable: plain C++.  sse4: 2 doubles a vector, no fused multiply-add.  neon: 2.  avx2: 4.  avx512: 8 (F, BW, CD, DQ, VL).
enum class InstructionSet { fastest, portable, neon, sse4, avx2, avx512 };

const char* to_string(InstructionSet set);

// Compiled in, and this processor has it. `fastest` always is.
bool is_available(InstructionSet set);
// The available ones, slowest first, without `fastest`.
std::vector<InstructionSet> available_instruction_sets();
// `fastest` by its own name.
InstructionSet resolve(InstructionSet set);
// Does the set multiply and add with one rounding? Results on all sets that do are the same bits.
bool fuses_multiply_add(InstructionSet set);

}  // namespace patchproof
