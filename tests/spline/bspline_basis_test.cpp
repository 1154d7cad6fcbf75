// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/bspline_basis.h"

#include <gtest/gtest.h>

#include "patchproof/spline/bernstein.h"
#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Knots = KnotVector<Rational>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }

struct Case {
  const char* what;
  int degree;
  Numbers knots;
};

// Doubles hold all these knots.
const std::vector<Case> cases = {
    {"degree 0", 0, {q(0), q(1), q(1), q(3)}},
    {"clamped", 3, {q(0), q(0), q(0), q(0), q(1), q(2), q(2), q(2), q(2)}},
    {"multiplicity degree + 1", 2, {q(0), q(0), q(0), q(1), q(1), q(1), q(2), q(3), q(3), q(3)}},
    {"multiplicity degree + 2", 2, {q(0), q(0), q(0), q(1), q(1), q(1), q(1), q(2), q(2), q(2)}},
    {"unclamped, repeated begin", 2, {q(-1), q(1, 4), q(1, 4), q(1), q(3), q(7, 2)}},
    {"uniform, unclamped", 3, {q(0), q(1), q(2), q(3), q(4), q(5), q(6), q(7), q(8)}},
    {"end knots beyond degree + 1", 2, {q(0), q(0), q(0), q(1), q(1), q(1), q(1)}},
    {"not from 0, uneven", 1, {q(45, 32), q(45, 32), q(3, 2), q(13, 2), q(13, 2)}},
};

// The breaks of the domain and two parameters in each span.
Numbers parameters_of(const Knots& k) {
  Numbers out = k.breaks();
  const Numbers breaks = out;
  for (std::size_t i = 1; i < breaks.size(); ++i)
    for (const Rational& f : {q(1, 4), q(1, 2)}) out.push_back(breaks[i - 1] + f * (breaks[i] - breaks[i - 1]));
  return out;
}

template <class F>
void for_each_span(const Knots& k, F f) {
  for (int span = k.degree(); span < k.control_count(); ++span)
    if (k[span] < k[span + 1]) f(span);
}

template <class T>
class BsplineBasis : public ScalarTest<T> {};
TYPED_TEST_SUITE(BsplineBasis, AllScalars, ScalarNames);

// Both forms of a parameter: in the scalar itself, and as an exact knot.
TYPED_TEST(BsplineBasis, Law4_ValuesAndDerivativesAreThoseOfThePieces) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Knots k = Knots::make(c.degree, c.knots).value();
    for_each_span(k, [&](int span) {
      for (int order = 0; order <= c.degree + 1; ++order)
        for (const Rational& t : {k[span], Rational((k[span] + k[span + 1]) / q(2)), k[span + 1]}) {
          Numbers exact;
          for (int i = span - c.degree; i <= span; ++i)
            exact.push_back(bspline_piece(c.knots, i, c.degree, span).derivative(order)(t));
          check<TypeParam>(exact, [&]<class S>() {
            return basis_derivative_in_span<S>(make_knots<S>(c.degree, c.knots), span, make<S>(t), order);
          });
          check<TypeParam>(exact, [&]<class S>() {
            return basis_derivatives_in_span<S>(make_knots<S>(c.degree, c.knots), span, make_knot<S>(t), order).back();
          });
        }
    });
  }
}

TYPED_TEST(BsplineBasis, Law1_SumsToOneInEveryScalar) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Knots k = Knots::make(c.degree, c.knots).value();
    for (const Rational& t : parameters_of(k))
      check<TypeParam>(q(1), [&]<class S>() {
        S sum(0);
        for (const S& b : basis_in_span<S>(make_knots<S>(c.degree, c.knots), k.find_span(t), make<S>(t))) sum += b;
        return sum;
      });
  }
}

// The control scalar may be richer than the knots' or the other way round.
TEST(BsplineBasisScalars, ExactKnotsAtEnclosedAndBoundedParameters) {
  const Knots k = Knots::make(2, cases[1].knots).value();
  const Numbers exact = basis_in_span<Rational>(k, 4, q(7, 5));
  expect_agrees(basis_in_span<Ball>(k, 4, Ball(q(7, 5))), exact);
  expect_agrees(basis_in_span<Tracked>(k, 4, make<Tracked>(q(7, 5))), exact);
  const RoundingGuard guard;
  // The whole span as one interval: every value of the functions on it is enclosed.
  const std::vector<Interval> all = basis_in_span<Interval>(k, 4, Interval(1, 2));
  for (int i = 0; i <= 8; ++i) {
    const Numbers b = basis_in_span<Rational>(k, 4, Rational(1 + q(i, 8)));
    for (std::size_t j = 0; j < b.size(); ++j)
      EXPECT_TRUE(from_double(all[j].inf()) <= b[j] && b[j] <= from_double(all[j].sup()));
  }
}

TEST(BsplineBasisExact, Law1And2_NonNegativePartitionWithLocalSupport) {
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    const int p = random.integer(0, 4);
    const Numbers t = random.knots(p, p + 1 + random.integer(0, 6));
    const Knots k = Knots::make(p, t).value();
    for (const Rational& x : parameters_of(k))
      for (Side side : {Side::left, Side::right}) {
        Rational sum(0);
        const Numbers values = basis(k, x, side);
        ASSERT_EQ(static_cast<int>(values.size()), k.control_count());
        for (int i = 0; i < k.control_count(); ++i) {
          sum += values[i];
          EXPECT_GE(values[i], 0);
          if (x < t[i] || t[i + p + 1] < x || t[i] == t[i + p + 1]) {
            EXPECT_EQ(values[i], 0);
          }
        }
        EXPECT_EQ(sum, 1);
        for (int order = 1; order <= p + 1; ++order) {
          Rational total(0);
          for (const Rational& d : basis_derivative(k, x, order, side)) total += d;
          EXPECT_EQ(total, 0);
        }
      }
  }
}

TEST(BsplineBasisExact, Law1_RightEndIsOneNotZero) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Knots k = Knots::make(c.degree, c.knots).value();
    for (Side side : {Side::left, Side::right}) {
      Rational sum(0);
      for (const Rational& b : basis(k, k.domain_end(), side)) sum += b;
      EXPECT_EQ(sum, 1);
    }
  }
  const Knots clamped = Knots::make(3, cases[1].knots).value();
  EXPECT_EQ(basis(clamped, q(2)).back(), 1);
  EXPECT_EQ(basis(clamped, q(0)).front(), 1);
}

TEST(BsplineBasisExact, Law2_DeadFunctions) {
  const Knots k = Knots::make(2, cases[3].knots).value();
  for (const Rational& t : parameters_of(k))
    for (Side side : {Side::left, Side::right})
      for (int order = 0; order <= 2; ++order) EXPECT_EQ(basis_derivative(k, t, order, side)[3], 0);
}

// Multiplicity m at 1 between 0 and 2, for every m from 1 to degree + 3.
TEST(BsplineBasisExact, Law3_SidesAtKnotsOfEveryMultiplicity) {
  for (int p = 0; p <= 4; ++p)
    for (int m = 1; m <= p + 3; ++m) {
      SCOPED_TRACE("degree " + std::to_string(p) + ", multiplicity " + std::to_string(m));
      Numbers t(p + 1, q(0));
      t.insert(t.end(), m, q(1));
      t.insert(t.end(), p + 1, q(2));
      const Knots k = Knots::make(p, t).value();
      for (int order = 0; order <= p - m; ++order)
        EXPECT_EQ(basis_derivative(k, q(1), order, Side::left), basis_derivative(k, q(1), order, Side::right));
      // One order more, and some function does jump: with smoothness p − m, not better.
      EXPECT_NE(basis_derivative(k, q(1), std::max(0, p - m + 1), Side::left),
                basis_derivative(k, q(1), std::max(0, p - m + 1), Side::right));
      if (m >= p + 1) {
        EXPECT_EQ(basis(k, q(1), Side::left)[p], 1);
        EXPECT_EQ(basis(k, q(1), Side::right)[m], 1);
      }
    }
}

TEST(BsplineBasisExact, Law5_BezierKnotsGiveBernsteinPolynomials) {
  for (int p = 0; p <= 6; ++p)
    for (const Rational& t : {q(0), q(2, 7), q(1)})
      for (int order = 0; order <= p + 1; ++order)
        EXPECT_EQ(basis_derivative(Knots::bezier(p), t, order), bernstein_basis_derivative(p, order, t));
}

TEST(BsplineBasisExact, ContractsAreChecked) {
  const Knots k = Knots::make(2, cases[3].knots).value();
  EXPECT_THROW(basis_in_span<Rational>(k, 1, q(0)), contract_error);  // before the domain
  EXPECT_THROW(basis_in_span<Rational>(k, 4, q(1)), contract_error);  // an empty span
  EXPECT_THROW(basis_in_span<Rational>(k, 7, q(2)), contract_error);  // behind the domain
  EXPECT_THROW(basis_derivative(k, q(1), -1), contract_error);
  EXPECT_THROW(basis(k, q(5, 2)), contract_error);
}

}  // namespace
}  // namespace patchproof::test
