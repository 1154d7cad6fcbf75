// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/integer.h"

#include <gtest/gtest.h>

#include "support/wild_numbers.h"

namespace patchproof::test {
namespace {

TEST(Integer, RingOperationsAgreeWithRational) {
  WildNumbers random;
  for (int i = 0; i < 300; ++i) {
    const Integer a = random.integer(200), b = random.integer(200);
    const Rational p = embed<Rational>(a), q = embed<Rational>(b);
    EXPECT_EQ(embed<Rational>(Integer(a + b)), p + q);
    EXPECT_EQ(embed<Rational>(Integer(a - b)), p - q);
    EXPECT_EQ(embed<Rational>(Integer(a * b)), p * q);
    EXPECT_EQ(embed<Rational>(Integer(-a)), -p);
    EXPECT_EQ(scalar_traits<Integer>::sign(a), scalar_traits<Rational>::sign(p));
  }
}

TEST(Integer, SignAlwaysAnswers) {
  const Integer huge = Integer(1) << 10000;
  EXPECT_EQ(scalar_traits<Integer>::sign(huge), Sign::positive);
  EXPECT_EQ(scalar_traits<Integer>::sign(Integer(1 - huge)), Sign::negative);
  EXPECT_EQ(scalar_traits<Integer>::sign(Integer(huge - huge)), Sign::zero);
}

}  // namespace
}  // namespace patchproof::test
