// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/curve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "patchproof/scalar/integer.h"
#include "patchproof/spline/bernstein.h"
#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Point = Vec<Rational, 2>;
using Curve = BsplineCurve<Rational, 2>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Point at(const Rational& x, const Rational& y) { return {{x, y}}; }

Curve curve_of(int degree, const Numbers& knots, std::vector<Point> points) {
  return Curve::make(KnotVector<Rational>::make(degree, knots).value(), std::move(points)).value();
}

Curve random_curve(RandomRationals& random) {
  const int degree = random.integer(0, 4), count = degree + 1 + random.integer(0, 5);
  return curve_of(degree, random.knots(degree, count), random.points<2>(count));
}

// The curve's polynomial on a span, component by component, from the recursion of Cox and de Boor.
Polynomial piece(const Curve& c, int span, int component) {
  Polynomial sum;
  for (int i = span - c.degree(); i <= span; ++i)
    sum = sum + Polynomial({c.points()[i][component]}) * bspline_piece(c.knots().knots(), i, c.degree(), span);
  return sum;
}
Point piece_at(const Curve& c, int span, const Rational& t, int order = 0) {
  return at(piece(c, span, 0).derivative(order)(t), piece(c, span, 1).derivative(order)(t));
}

template <class F>
void for_each_span(const KnotVector<Rational>& k, F f) {
  for (int span = k.degree(); span < k.control_count(); ++span)
    if (k[span] < k[span + 1]) f(span);
}

// Seven points used with several knot vectors of degree 2.
const std::vector<Point> seven = {at(q(0), q(0)), at(q(-1), q(2)), at(q(1), q(4)),   at(q(2), q(3)),
                                  at(q(1), q(1)), at(q(1), q(2)),  at(q(5, 2), q(1))};
const Numbers twofold = {q(0), q(0), q(0), q(1), q(1), q(2), q(3), q(4), q(4), q(4)};
const Numbers threefold = {q(0), q(0), q(0), q(1), q(1), q(1), q(2), q(3), q(3), q(3)};
const Numbers fourfold = {q(0), q(0), q(0), q(1), q(1), q(1), q(1), q(2), q(2), q(2)};
const Numbers off_zero = {q(45, 32), q(45, 32), q(3, 2), q(2), q(9, 4), q(5), q(11, 2), q(11, 2), q(6), q(7)};

template <class T>
class CurveLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(CurveLaws, AllScalars, ScalarNames);

TYPED_TEST(CurveLaws, Law1And2_ValuesAndDerivativesFromBothSides) {
  for (const Numbers& knots : {twofold, threefold, fourfold, off_zero}) {
    const Curve c = curve_of(2, knots, seven);
    Numbers parameters = c.knots().breaks();
    parameters.push_back((parameters[0] + q(3) * parameters[1]) / q(4));
    for (const Rational& t : parameters)
      for (Side side : {Side::left, Side::right}) {
        const int span = c.knots().find_span(t, side);
        check<TypeParam>(piece_at(c, span, t),
                         [&]<class S>() { return evaluate(make_curve<S>(c), make_knot<S>(t), side); });
        std::vector<Point> exact;
        for (int order = 0; order <= 3; ++order) exact.push_back(piece_at(c, span, t, order));
        check<TypeParam>(exact, [&]<class S>() { return derivatives(make_curve<S>(c), make_knot<S>(t), 3, side); });
        check<TypeParam>(exact[1],
                         [&]<class S>() { return derivative_in_span<S>(make_curve<S>(c), span, make<S>(t), 1); });
      }
  }
}

TYPED_TEST(CurveLaws, Law3_DerivativeCurve) {
  for (const Numbers& knots : {twofold, threefold, fourfold, off_zero}) {
    const Curve c = curve_of(2, knots, seven);
    const Curve exact = derivative_curve(c);
    check<TypeParam>(exact.points(), [&]<class S>() { return derivative_curve(make_curve<S>(c)).points(); });
  }
}

TYPED_TEST(CurveLaws, Law4_BlossomOfASpan) {
  const Curve c = curve_of(2, off_zero, seven);
  const Numbers arguments = {q(1, 2), q(7)};
  check<TypeParam>(blossom(c, 3, arguments),
                   [&]<class S>() { return blossom_in_span<S>(make_curve<S>(c), 3, make_numbers<S>(arguments)); });
}

// Data in one scalar, parameter and result in another.
TEST(CurveScalars, ExactCurvesAtParametersOfOtherScalars) {
  const Curve c = curve_of(2, off_zero, seven);
  const Rational t = q(8, 5);
  const Point exact = piece_at(c, 3, t);
  EXPECT_EQ(evaluate_in_span<Rational>(c, 3, t), exact);
  expect_agrees(evaluate_in_span<Ball>(c, 3, Ball(t)), exact);
  expect_agrees(evaluate_in_span<Tracked>(c, 3, make<Tracked>(t)), exact);
  expect_agrees(evaluate_in_span<Quadratic>(c, 3, t), exact);
  const BsplineCurve<Integer, 1> net(KnotVector<Rational>::make(1, {q(0), q(0), q(1), q(3), q(3)}).value(),
                                     {{{Integer(1)}}, {{Integer(4)}}, {{Integer(-2)}}});
  EXPECT_EQ(evaluate_in_span<Rational>(net, 2, q(2))[0], 1);
  const RoundingGuard guard;
  const auto enclosure = evaluate_in_span<Interval>(c, 3, Interval(1.5, 1.75));
  for (const Rational& x : {q(3, 2), t, q(7, 4)})
    for (int i : {0, 1}) {
      EXPECT_LE(from_double(enclosure[i].inf()), piece_at(c, 3, x)[i]);
      EXPECT_GE(from_double(enclosure[i].sup()), piece_at(c, 3, x)[i]);
    }
}

TEST(CurveExact, Law1_EvaluateIsTheSumOfBasisFunctions) {
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    const Curve c = random_curve(random);
    for (const Rational& t : c.knots().breaks())
      for (Side side : {Side::left, Side::right})
        for (int order = 0; order <= c.degree() + 1; ++order) {
          Point sum;
          const Numbers b = basis_derivative(c.knots(), t, order, side);
          for (std::size_t i = 0; i < b.size(); ++i) sum += b[i] * c.points()[i];
          EXPECT_EQ(derivative(c, t, order, side), sum);
        }
  }
}

TEST(CurveExact, Law2_DerivativesAreThoseOfThePieces) {
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Curve c = random_curve(random);
    for_each_span(c.knots(), [&](int span) {
      for (int order = 0; order <= c.degree() + 1; ++order)
        for (const Rational& t : {c.knots()[span], random()})  // a polynomial identity: outside the span too
          EXPECT_EQ(derivative_in_span<Rational>(c, span, t, order), piece_at(c, span, t, order));
    });
  }
}

TEST(CurveExact, Law3_DerivativeCurveIsTheDerivativeOnEverySpan) {
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    const Curve c = random_curve(random);
    const Curve d = derivative_curve(c);
    EXPECT_EQ(d.degree(), std::max(0, c.degree() - 1));
    EXPECT_EQ(d.knots().domain_begin(), c.knots().domain_begin());
    EXPECT_EQ(d.knots().domain_end(), c.knots().domain_end());
    const int shift = c.degree() == 0 ? 0 : 1;
    for_each_span(c.knots(), [&](int span) {
      for (int i : {0, 1}) EXPECT_EQ(piece(d, span - shift, i), piece(c, span, i).derivative());
    });
    for (const Rational& t : c.knots().breaks())
      for (Side side : {Side::left, Side::right}) EXPECT_EQ(evaluate(d, t, side), derivative(c, t, 1, side));
  }
  // At multiplicity degree + 1 the point over the jump is dead and zero.
  EXPECT_EQ(derivative_curve(curve_of(2, threefold, seven)).points()[2], Point());
}

TEST(CurveExact, Law4_BlossomIsSymmetricMultiaffineDiagonalAndGivesTheControlPoints) {
  RandomRationals random;
  for (int round = 0; round < 25; ++round) {
    const Curve c = random_curve(random);
    const int p = c.degree();
    for_each_span(c.knots(), [&](int span) {
      const Rational t = random();
      EXPECT_EQ(blossom(c, span, Numbers(p, t)), piece_at(c, span, t));
      for (int j = span - p; j <= span; ++j) {
        const Numbers& k = c.knots().knots();
        EXPECT_EQ(blossom(c, span, Numbers(k.begin() + j + 1, k.begin() + j + p + 1)), c.points()[j]);
      }
      if (p == 0) return;
      Numbers arguments = random.numbers(p);
      const Point value = blossom(c, span, arguments);
      std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
      EXPECT_EQ(blossom(c, span, arguments), value);
      std::swap(arguments.front(), arguments.back());
      EXPECT_EQ(blossom(c, span, arguments), value);
      const Rational u = random(), v = random(), s = random();
      const auto with_first = [&](const Rational& x) {
        Numbers changed = arguments;
        changed[0] = x;
        return blossom(c, span, changed);
      };
      EXPECT_EQ(with_first((1 - s) * u + s * v), (1 - s) * with_first(u) + s * with_first(v));
    });
  }
}

TEST(CurveExact, Law5_BezierKnotsGiveTheBezierCurve) {
  RandomRationals random;
  for (int n = 0; n <= 5; ++n) {
    const auto b = random.points<2>(n + 1);
    const Curve c = Curve::bezier(b);
    for (const Rational& t : {q(0), q(3, 7), q(1)})
      for (int order = 0; order <= n + 1; ++order) EXPECT_EQ(derivative(c, t, order), derivative(b, t, order));
    if (n > 0) {
      EXPECT_EQ(derivative_curve(c).points(), hodograph(b));
    }
  }
}

TEST(CurveExact, Law6_DeadPointsHaveNoInfluence) {
  std::vector<Point> moved = seven;
  moved[3] = at(q(1000), q(-1000));
  const Curve a = curve_of(2, fourfold, seven), b = curve_of(2, fourfold, moved);
  for (const Rational& t : {q(0), q(1, 3), q(1), q(3, 2), q(2)})
    for (Side side : {Side::left, Side::right})
      for (int order = 0; order <= 2; ++order) EXPECT_EQ(derivative(a, t, order, side), derivative(b, t, order, side));
}

// Figures worked out independently of this library.
TEST(CurveExact, Law2_KnownValuesAtMultipleKnots) {
  const auto expect = [](const Curve& c, const Rational& t, Side side, const std::vector<Point>& exact) {
    EXPECT_EQ(derivatives(c, t, 2, side), exact);
  };
  const Curve two = curve_of(2, twofold, seven);
  expect(two, q(1, 3), Side::right, {at(q(-1, 3), q(4, 3)), at(q(0), q(4)), at(q(6), q(0))});
  expect(two, q(1), Side::left, {at(q(1), q(4)), at(q(4), q(4)), at(q(6), q(0))});
  expect(two, q(1), Side::right, {at(q(1), q(4)), at(q(2), q(-2)), at(q(-3), q(0))});
  const Curve three = curve_of(2, threefold, seven);
  expect(three, q(1), Side::left, {at(q(1), q(4)), at(q(4), q(4)), at(q(6), q(0))});
  expect(three, q(1), Side::right, {at(q(2), q(3)), at(q(-2), q(-4)), at(q(2), q(5))});
  const Curve over = curve_of(2, {q(0), q(0), q(0), q(1), q(1), q(1), q(1)},
                              {at(q(0), q(0)), at(q(1), q(2)), at(q(3), q(2)), at(q(9), q(9))});
  expect(over, q(1, 2), Side::right, {at(q(5, 4), q(3, 2)), at(q(3), q(2)), at(q(2), q(-4))});
  expect(over, q(1), Side::right, {at(q(3), q(2)), at(q(4), q(0)), at(q(2), q(-4))});
  const Curve closed =
      curve_of(2, {q(0), q(1), q(2), q(3), q(4), q(5), q(6), q(7), q(8)},
               {at(q(0), q(1)), at(q(0), q(0)), at(q(1), q(0)), at(q(1), q(1)), at(q(0), q(1)), at(q(0), q(0))});
  expect(closed, q(2), Side::left, {at(q(0), q(1, 2)), at(q(0), q(-1)), at(q(1), q(1))});
  expect(closed, q(3), Side::right, {at(q(1, 2), q(0)), at(q(1), q(0)), at(q(-1), q(1))});
}

TEST(CurveExact, Law2_PeriodicCubicClosesSmoothly) {
  const Numbers knots = {q(-7), q(-3), q(-2), q(0), q(2), q(3), q(7), q(8), q(10), q(12), q(13), q(17)};
  std::vector<Vec<Rational, 1>> points;
  for (int x : {0, 3, 1, 4, 2, 0, 3, 1}) points.push_back({{q(x)}});
  const BsplineCurve<Rational, 1> c(KnotVector<Rational>::make(3, knots).value(), points);
  EXPECT_EQ(derivatives(c, q(0), 2), derivatives(c, q(10), 2));
  EXPECT_EQ(derivatives(c, q(1), 2), (std::vector<Vec<Rational, 1>>{{{q(1523, 840)}}, {{q(-23, 56)}}, {{q(11, 140)}}}));
}

// Where the domain lies and how long it is does not matter: here [1.408, …] and knots around 10^6, tiny and huge spans.
TEST(CurveExact, Law1_AffineChangesOfTheKnotsLeaveTheValues) {
  RandomRationals random;
  for (const auto& [begin, scale] :
       {std::pair{q(1408, 1000), q(3, 7)}, {q(1000000), q(1, 1 << 30)}, {q(-5), q(1 << 30)}}) {
    const Curve c = random_curve(random);
    const auto moved = [&](const Rational& t) { return Rational(begin + scale * t); };
    Numbers knots;
    for (const Rational& t : c.knots().knots()) knots.push_back(moved(t));
    const Curve other = curve_of(c.degree(), knots, c.points());
    for (const Rational& t : c.knots().breaks())
      for (Side side : {Side::left, Side::right}) {
        EXPECT_EQ(evaluate(other, moved(t), side), evaluate(c, t, side));
        EXPECT_EQ(scale * derivative(other, moved(t), 1, side), derivative(c, t, 1, side));
      }
  }
}

TEST(CurveExact, MakeAndContracts) {
  const auto knots = KnotVector<Rational>::make(2, twofold).value();
  const auto bad = Curve::make(knots, {at(q(0), q(0))});
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, ErrorCode::wrong_count);
  EXPECT_THROW(Curve(knots, {}), contract_error);
  EXPECT_THROW(Curve::bezier({}), contract_error);
  const Curve c(knots, seven);
  EXPECT_THROW(evaluate(c, q(5)), contract_error);
  EXPECT_THROW(derivative(c, q(1), -1), contract_error);
  EXPECT_THROW(evaluate_in_span<Rational>(c, 3, q(1)), contract_error);  // an empty span
  EXPECT_THROW(derivative_in_span<Rational>(c, 3, q(1), 9), contract_error);
  EXPECT_THROW(blossom(c, 2, Numbers{q(1)}), contract_error);
}

}  // namespace
}  // namespace patchproof::test
