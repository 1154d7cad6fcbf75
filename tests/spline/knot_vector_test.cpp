// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/knot_vector.h"

#include <gtest/gtest.h>

#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Knots = KnotVector<Rational>;
using Numbers = std::vector<Rational>;

Numbers numbers(std::initializer_list<int> values) { return Numbers(values.begin(), values.end()); }
Knots knots(int degree, std::initializer_list<int> values) { return Knots::make(degree, numbers(values)).value(); }

ErrorCode code_of(const Result<Knots>& result) {
  EXPECT_FALSE(result.has_value());
  return result.error().code;
}

TEST(KnotVector, RefusesBadKnotsWithTheirCode) {
  EXPECT_EQ(code_of(Knots::make(-1, numbers({0, 1}))), ErrorCode::bad_degree);
  EXPECT_EQ(code_of(Knots::make(2, numbers({0, 0, 0, 1, 1}))), ErrorCode::wrong_count);
  EXPECT_EQ(code_of(Knots::make(0, {})), ErrorCode::wrong_count);
  EXPECT_EQ(code_of(Knots::make(1, numbers({0, 2, 1, 3}))), ErrorCode::decreasing_knots);
  EXPECT_EQ(code_of(Knots::make(1, numbers({0, 1, 1, 2}))), ErrorCode::empty_domain);
  EXPECT_EQ(code_of(Knots::make(1, numbers({0, 0, 0, 0}))), ErrorCode::empty_domain);
  EXPECT_NE(Knots::make(1, numbers({0, 2, 1, 3})).error().message.find("knot 2"), std::string::npos);
}

TEST(KnotVector, CountsAndDomain) {
  const Knots unclamped = knots(2, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(unclamped.control_count(), 6);
  EXPECT_EQ(unclamped.domain_begin(), 2);
  EXPECT_EQ(unclamped.domain_end(), 6);
  EXPECT_EQ(unclamped.breaks(), numbers({2, 3, 4, 5, 6}));
  EXPECT_FALSE(unclamped.is_clamped());
  EXPECT_TRUE(unclamped.in_domain(2));
  EXPECT_TRUE(unclamped.in_domain(6));
  EXPECT_FALSE(unclamped.in_domain(1));
  EXPECT_FALSE(unclamped.in_domain(7));

  const Knots over = knots(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2});
  EXPECT_EQ(over.multiplicity(1), 4);
  EXPECT_EQ(over.multiplicity(3), 0);
  EXPECT_EQ(over.breaks(), numbers({0, 1, 2}));
  EXPECT_TRUE(over.is_clamped());
  EXPECT_TRUE(knots(2, {0, 0, 0, 1, 1, 1, 1}).is_clamped());  // one knot more than needed at the end
  EXPECT_FALSE(knots(2, {-1, 0, 0, 0, 1, 1, 1}).is_clamped());

  EXPECT_EQ(Knots::bezier(3), knots(3, {0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(Knots::bezier(0, 4, 7), knots(0, {4, 7}));
  EXPECT_THROW(Knots::bezier(-1), contract_error);
  EXPECT_THROW(Knots::bezier(1, 2, 2), contract_error);
}

// The documented meaning of find_span, stated without its algorithm.
TEST(KnotVector, FindSpanIsTheNonEmptySpanOnTheWantedSide) {
  RandomRationals random;
  for (int round = 0; round < 200; ++round) {
    const int degree = random.integer(0, 4);
    const Knots k = Knots::make(degree, random.knots(degree, degree + 1 + random.integer(0, 6))).value();
    Numbers parameters = k.breaks();
    for (std::size_t i = 1; i < k.breaks().size(); ++i)
      parameters.push_back((k.breaks()[i - 1] + k.breaks()[i]) / Rational(2));
    for (const Rational& t : parameters)
      for (Side side : {Side::left, Side::right}) {
        const int span = k.find_span(t, side);
        ASSERT_LE(degree, span);
        ASSERT_LT(span, k.control_count());
        EXPECT_LT(k[span], k[span + 1]);
        const bool from_left = t == k.domain_begin() ? false : t == k.domain_end() || side == Side::left;
        if (from_left)
          EXPECT_TRUE(k[span] < t && t <= k[span + 1]);
        else
          EXPECT_TRUE(k[span] <= t && t < k[span + 1]);
      }
  }
}

TEST(KnotVector, FindSpanAtRepeatedKnotsAndEnds) {
  const Knots k = knots(2, {0, 0, 0, 1, 1, 1, 1, 2, 2, 2});
  EXPECT_EQ(k.find_span(0, Side::left), 2);
  EXPECT_EQ(k.find_span(0, Side::right), 2);
  EXPECT_EQ(k.find_span(1, Side::left), 2);
  EXPECT_EQ(k.find_span(1, Side::right), 6);
  EXPECT_EQ(k.find_span(2, Side::left), 6);
  EXPECT_EQ(k.find_span(2, Side::right), 6);
  EXPECT_THROW(k.find_span(-1), contract_error);
  EXPECT_THROW(k.find_span(3), contract_error);
  // A clamped end with more knots than the domain needs, and a repeated first knot of an unclamped domain.
  EXPECT_EQ(knots(2, {0, 0, 0, 1, 1, 1, 1}).find_span(1, Side::right), 2);
  EXPECT_EQ(knots(2, {0, 0, 1, 1, 2, 2, 3, 3}).find_span(1, Side::left), 3);
  EXPECT_EQ(knots(2, {0, 0, 1, 1, 2, 2, 3, 3}).find_span(2, Side::right), 3);
}

TEST(KnotVector, KnotsAreComparedExactly) {
  const Rational close = Rational(1) + Rational(1) / Rational("1000000000000000000000000000000");
  const Knots k = Knots::make(1, {Rational(0), Rational(0), Rational(1), close, Rational(2), Rational(2)}).value();
  EXPECT_EQ(k.multiplicity(1), 1);
  EXPECT_EQ(k.breaks().size(), 4u);
  EXPECT_EQ(k.find_span(1), 2);
  EXPECT_EQ(k.find_span(close), 3);
}

TEST(KnotVector, DoubleAndQuadraticKnots) {
  EXPECT_EQ(KnotVector<double>::make(1, {1.408, 1.408, 2.5, 3, 3}).value().find_span(2.5, Side::left), 1);
  EXPECT_EQ(KnotVector<double>::make(1, {1.408, 1.408, 2.5, 3, 3}).value().find_span(2.5, Side::right), 2);
  const Quadratic root(Rational(0), Rational(1), 2);
  const auto k = KnotVector<Quadratic>::make(0, {Quadratic(1), root, Quadratic(2)}).value();
  EXPECT_EQ(k.find_span(Quadratic(Rational(7) / Rational(5))), 0);
  EXPECT_EQ(k.find_span(Quadratic(Rational(3) / Rational(2))), 1);
}

}  // namespace
}  // namespace patchproof::test
