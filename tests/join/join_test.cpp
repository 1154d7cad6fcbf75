// SPDX-License-Identifier: Apache-2.0
#include "patchproof/join/join.h"

#include <gtest/gtest.h>

#include "patchproof/scalar/rational.h"

namespace patchproof::test {
namespace {

TEST(Join, Names) {
  EXPECT_STREQ(to_string(JoinKind::isoparametric), "isoparametric");
  EXPECT_STREQ(to_string(JoinKind::t_junction), "t-junction");
  EXPECT_STREQ(to_string(JoinKind::seam), "seam");
  EXPECT_STREQ(to_string(JoinKind::knot_line), "knot-line");
  EXPECT_STREQ(to_string(PairingKind::identity), "identity");
  EXPECT_STREQ(to_string(PairingKind::affine), "affine");
  EXPECT_STREQ(to_string(PairingKind::rational_linear), "rational-linear");
  EXPECT_STREQ(to_string(PairingKind::piecewise_linear), "piecewise-linear");
}

TEST(Join, AJoinIsReversedWhenLineBRunsBackwards) {
  const auto reversed = [](std::vector<Rational> b) {
    return Pairing<Rational>{PairingKind::affine, {Rational(0), Rational(1)}, std::move(b), Rational(1)}.reversed();
  };
  EXPECT_FALSE(reversed({Rational(-3), Rational(-2)}));
  EXPECT_TRUE(reversed({Rational(-2), Rational(-3)}));
  EXPECT_TRUE(reversed({Rational(1), Rational(1) / Rational(2), Rational(0)}));
}

}  // namespace
}  // namespace patchproof::test
