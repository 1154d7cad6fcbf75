// SPDX-License-Identifier: Apache-2.0
#include "kernels/kernel_table.h"
#include "patchproof/contract.h"

namespace patchproof {
namespace {

bool processor_has(InstructionSet set) {
  switch (set) {
    case InstructionSet::fastest:
    case InstructionSet::portable: return true;
#if defined(PATCHPROOF_KERNELS_X86)
    case InstructionSet::sse4:
      return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
    // All that the flags in CMakeLists.txt let the compiler use.
    case InstructionSet::avx2:
      return processor_has(InstructionSet::sse4) && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("f16c") &&
             __builtin_cpu_supports("lzcnt") && __builtin_cpu_supports("movbe") && __builtin_cpu_supports("popcnt");
    case InstructionSet::avx512:
      return processor_has(InstructionSet::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#elif defined(PATCHPROOF_KERNELS_NEON)
    case InstructionSet::neon: return true;
#endif
    default: return false;
  }
}

}  // namespace

const char* to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::fastest: return "fastest";
    case InstructionSet::portable: return "portable";
    case InstructionSet::neon: return "neon";
    case InstructionSet::sse4: return "sse4";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "unknown";
}

bool is_available(InstructionSet set) { return processor_has(set); }

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::neon, InstructionSet::sse4,
                                   InstructionSet::avx2, InstructionSet::avx512})
    if (is_available(set)) out.push_back(set);
  return out;
}

InstructionSet resolve(InstructionSet set) {
  static const InstructionSet fastest = available_instruction_sets().back();
  return set == InstructionSet::fastest ? fastest : set;
}

bool fuses_multiply_add(InstructionSet set) {
  const InstructionSet own = resolve(set);
  return own == InstructionSet::avx2 || own == InstructionSet::avx512 || own == InstructionSet::neon;
}

namespace kernels {

const KernelTable& kernel_table(InstructionSet set) {
  const InstructionSet own = resolve(set);
  PATCHPROOF_REQUIRES(is_available(own), "the instruction set is not available here");
  switch (own) {
#if defined(PATCHPROOF_KERNELS_X86)
    case InstructionSet::sse4: return kSse4;
    case InstructionSet::avx2: return kAvx2;
    case InstructionSet::avx512: return kAvx512;
#elif defined(PATCHPROOF_KERNELS_NEON)
    case InstructionSet::neon: return kNeon;
#endif
    default: return kPortable;
  }
}

}  // namespace kernels
}  // namespace patchproof
