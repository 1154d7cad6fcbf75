// SPDX-License-Identifier: Apache-2.0
// Joins decided by every instruction set of this machine.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "patchproof/join/decide_batch.h"
#include "support/g1_joins.h"
#include "support/g1_truth.h"

namespace patchproof::test {

using kernels::InstructionSet;

inline std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> out;
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512, InstructionSet::avx512_ifma})
    if (kernels::is_available(set)) out.push_back(set);
  return out;
}

inline std::vector<JoinDecision> decisions(const std::vector<BicubicJoinRows>& rows, InstructionSet set,
                                           const std::vector<BicubicEdge>& edges = {}) {
  std::vector<JoinDecision> out(rows.size());
  kernels::decide_batch(rows, edges, out, set);
  return out;
}

inline bool same_answer(const JoinDecision& a, const JoinDecision& b) {
  return a.c0 == b.c0 && a.c1 == b.c1 && a.g1 == b.g1;
}

// All sets answer as decide_join does. How many joins each rung of the vectors decided; empty without vectors.
inline std::map<DecidedBy, int> expect_all_alike(const std::vector<BicubicJoinRows>& rows) {
  std::map<DecidedBy, int> rungs;
  const std::vector<JoinDecision> reference = decisions(rows, InstructionSet::portable);
  for (const InstructionSet set : sets()) {
    const std::vector<JoinDecision> answers = decisions(rows, set);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_TRUE(same_answer(answers[i], reference[i])) << kernels::name_of(set) << ", join " << i;
      if (set == InstructionSet::portable) continue;
      if (set == InstructionSet::avx2) ++rungs[answers[i].rung];
      if (answers[i].rung == DecidedBy::modular && i % 8 == 0) {
        const ExactAnswer truth = exact_answer(rows[i]);
        EXPECT_EQ(answers[i].g1 == FixedG1::refuted, !truth.coplanar);
        EXPECT_TRUE(truth.smooth || answers[i].g1 != FixedG1::proven_smooth);
        EXPECT_EQ(answers[i].c1, truth.c1);
      }
    }
  }
  return rungs;
}
inline bool have_vectors() { return kernels::is_available(InstructionSet::avx2); }

}  // namespace patchproof::test
