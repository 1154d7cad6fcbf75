// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/knot_ratio.h"

#include <gtest/gtest.h>

#include "support/scalars.h"

namespace patchproof::test {
namespace {

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

template <class T>
class KnotRatio : public ScalarTest<T> {};
TYPED_TEST_SUITE(KnotRatio, AllScalars, ScalarNames);

// The knots are doubles, their ratio 1/3 is not: the bounds must show it.
TYPED_TEST(KnotRatio, Law1And2_ExactOrBoundedFromKnotsAndFromParameters) {
  const Rational a = q(45, 32), b = q(129, 32), t = q(73, 32);
  check<TypeParam>(q(1, 3),
                   [&]<class S>() { return knot_ratio<S>(make_knot<S>(t), make_knot<S>(a), make_knot<S>(b)); });
  check<TypeParam>(q(1, 3), [&]<class S>() { return knot_ratio<S>(make<S>(t), make_knot<S>(a), make_knot<S>(b)); });
  check<TypeParam>(q(40, 21), [&]<class S>() { return knot_rate<S>(5, make_knot<S>(a), make_knot<S>(b)); });
  check<TypeParam>(q(-1, 3), [&]<class S>() {  // not clamped: the formula is a polynomial in t
    return knot_ratio<S>(make<S>(q(17, 32)), make_knot<S>(a), make_knot<S>(b));
  });
}

TYPED_TEST(KnotRatio, Law3_ZeroAndOneAtTheKnots) {
  const Rational a = q(-7, 4), b = q(3, 8);
  check<TypeParam>(q(0), [&]<class S>() { return knot_ratio<S>(make_knot<S>(a), make_knot<S>(a), make_knot<S>(b)); });
  check<TypeParam>(q(1), [&]<class S>() { return knot_ratio<S>(make_knot<S>(b), make_knot<S>(a), make_knot<S>(b)); });
}

TEST(KnotRatioExact, Law2_RoundedKnotsDoNotHideTheirDivision) {
  EXPECT_GT(knot_ratio<Tracked>(1.0, 0.0, 3.0).error(), 0);
  EXPECT_GT(knot_rate<Tracked>(1, 0.0, 3.0).error(), 0);
}

TEST(KnotRatioExact, ContractsAreChecked) {
  EXPECT_THROW(knot_ratio<Rational>(q(1), q(2), q(2)), contract_error);
  EXPECT_THROW(knot_rate<Rational>(1, q(2), q(2)), contract_error);
  EXPECT_THROW(knot_ratio<double>(1.0, 2.0, 2.0), contract_error);
}

}  // namespace
}  // namespace patchproof::test
