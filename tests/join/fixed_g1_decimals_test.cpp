// SPDX-License-Identifier: Apache-2.0
// Law 6 of fixed_g1.h for decimals and other fractions. The other laws: fixed_g1_test.cpp.
#include <gtest/gtest.h>

#include "patchproof/join/fixed_g1.h"
#include "support/g1_joins.h"
#include "support/g1_truth.h"

namespace patchproof::test {
namespace {

// The same join times 1/1000, weights times 1/30, and its cross derivatives in the ratio 7/3.
TEST(FixedG1Decimals, Law6_DenominatorsAreCleared) {
  for (const G1Family& family : {G1Family{10}, G1Family{8, true, 10}}) {
    int i = 0, proven = 0, refuted = 0;
    for (BicubicJoinRows rows : make_g1_joins(family, 60)) {
      if (i++ % 3 == 1) spoil(rows, 1);
      JoinPiece<Rational> piece = exact_piece(rows);
      for (auto* side : {&piece.a, &piece.b})
        for (auto& row : *side)
          for (auto& p : row) {
            for (int k = 0; k < 3; ++k) p[k] = p[k] / Rational(1000);
            if (family.weight_bits > 0) p[3] = p[3] / Rational(30);
          }
      for (auto& p : piece.b[1]) p = Rational(7) / Rational(3) * p;
      const std::optional<BicubicJoinRows> back = bicubic_join_rows(piece);
      ASSERT_TRUE(back);
      const ExactAnswer truth = exact_answer(piece);
      const std::optional<FixedG1> answer = decide_fixed_g1(*back);
      ASSERT_TRUE(answer);
      ASSERT_EQ(*answer == FixedG1::refuted, !truth.coplanar);
      ASSERT_TRUE(truth.smooth || *answer != FixedG1::proven_smooth);
      proven += *answer == FixedG1::proven_smooth;
      refuted += *answer == FixedG1::refuted;
    }
    EXPECT_EQ(proven, 40);
    EXPECT_EQ(refuted, 20);
  }
}

}  // namespace
}  // namespace patchproof::test
