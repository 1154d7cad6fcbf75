// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/homogeneous.h"

#include <gtest/gtest.h>

#include "support/polynomial.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Point = Vec<Rational, 2>;
using Homogeneous = Vec<Rational, 3>;
using Conic = BsplineCurve<Rational, 3>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Point at(const Rational& x, const Rational& y) { return {{x, y}}; }
Homogeneous h(int x, int y, int w) { return {{q(x), q(y), q(w)}}; }

const Conic quarter_circle = Conic::bezier({h(1, 0, 1), h(1, 1, 1), h(0, 2, 2)});
const Conic half_circle = Conic::bezier({h(1, 0, 1), h(0, 1, 0), h(-1, 0, 1)});       // a weight is 0
const Conic three_quarters = Conic::bezier({h(1, 0, 1), h(-1, -1, -1), h(0, 2, 2)});  // a weight is negative
const Conic pole = Conic::bezier({h(0, 0, 1), h(-1, -1, -1), h(2, 0, 1)});            // W = (1 − 2t)²
const Conic full_circle(
    KnotVector<Rational>::make(2, {q(0), q(0), q(0), q(1), q(1), q(2), q(2), q(3), q(3), q(4), q(4), q(4)}).value(),
    {h(1, 0, 1), h(1, 1, 1), h(0, 2, 2), h(-1, 1, 1), h(-1, 0, 1), h(-1, -1, 1), h(0, -2, 2), h(1, -1, 1), h(1, 0, 1)});

template <class T>
class HomogeneousLaws : public ScalarTest<T> {};
TYPED_TEST_SUITE(HomogeneousLaws, AllScalars, ScalarNames);

TYPED_TEST(HomogeneousLaws, Law1_ProjectUndoesToHomogeneous) {
  RandomRationals random;
  for (const Rational& w : {q(1), q(-3, 4), q(1, 1024)}) {
    const Point p = random.point<2>();
    check<TypeParam>(p, [&]<class S>() { return project(to_homogeneous(make_point<S>(p), make<S>(w))); });
  }
}

// Figures worked out independently of this library, for positive, zero and negative weights.
TYPED_TEST(HomogeneousLaws, Law3_KnownConics) {
  const auto expect = [](const Conic& c, const Rational& t, const std::vector<Point>& exact) {
    check<TypeParam>(exact, [&]<class S>() { return rational_derivatives(make_curve<S>(c), make_knot<S>(t), 2); });
    check<TypeParam>(exact[0], [&]<class S>() { return evaluate_rational(make_curve<S>(c), make_knot<S>(t)); });
  };
  expect(quarter_circle, q(1, 4),
         {at(q(15, 17), q(8, 17)), at(q(-256, 289), q(480, 289)), at(q(-13312, 4913), q(-12032, 4913))});
  expect(half_circle, q(1, 2), {at(q(0), q(1)), at(q(-4), q(0)), at(q(0), q(-16))});
  expect(half_circle, q(1, 4), {at(q(4, 5), q(3, 5)), at(q(-48, 25), q(64, 25)), at(q(-1408, 125), q(-256, 125))});
  expect(three_quarters, q(1, 2), {at(q(-1), q(0)), at(q(0), q(8)), at(q(64), q(-32))});
  expect(pole, q(1, 4), {at(q(-1), q(-3, 2)), at(q(-8), q(-16)), at(q(-64), q(-192))});
  expect(full_circle, q(5, 2), {at(q(-3, 5), q(-4, 5)), at(q(32, 25), q(-24, 25)), at(q(64, 125), q(352, 125))});
}

TYPED_TEST(HomogeneousLaws, Law4_UnitWeightsGiveThePolynomialCurve) {
  RandomRationals random;
  const auto points = random.points<2>(4);
  const Conic c = Conic::bezier(to_homogeneous(points, Numbers(4, q(1))));
  const auto exact = derivatives(BsplineCurve<Rational, 2>::bezier(points), q(3, 8), 5);
  check<TypeParam>(exact, [&]<class S>() { return rational_derivatives(make_curve<S>(c), make_knot<S>(q(3, 8)), 5); });
}

TEST(HomogeneousExact, Law2_AFactorChangesNothing) {
  RandomRationals random;
  for (const Rational& factor : {q(-1), q(7, 3)}) {
    const Homogeneous p = {{random(), random(), q(2, 5)}};
    EXPECT_EQ(project(factor * p), project(p));
    std::vector<Homogeneous> scaled;
    for (const Homogeneous& d : full_circle.points()) scaled.push_back(factor * d);
    const Conic c(full_circle.knots(), scaled);
    EXPECT_EQ(rational_derivatives(c, q(1, 3), 3), rational_derivatives(full_circle, q(1, 3), 3));
  }
}

// A random rational quintic up to order 7, against the quotient rule applied to whole polynomials.
TEST(HomogeneousExact, Law3_DerivativesOfTheQuotient) {
  RandomRationals random;
  const auto points = random.points<3>(6);
  Numbers x, w;
  for (const Homogeneous& p : points) {
    x.push_back(p[0]);
    w.push_back(p[2]);
  }
  const Polynomial a = from_bernstein(x), weight = from_bernstein(w);
  const Rational t = q(2, 7);
  ASSERT_NE(weight(t), 0);
  const auto r = rational_derivatives(Conic::bezier(points), t, 7);
  EXPECT_EQ(r[0][0], a(t) / weight(t));
  // n_k / w^(k+1) is the k-th derivative:  n_{k+1} = n_k' w − (k+1) n_k w'.
  Polynomial numerator = a;
  Rational denominator = weight(t);
  for (int k = 0; k <= 7; ++k) {
    EXPECT_EQ(r[k][0], numerator(t) / denominator) << "order " << k;
    numerator = numerator.derivative() * weight + Polynomial({Rational(-(k + 1))}) * numerator * weight.derivative();
    denominator = denominator * weight(t);
  }
}

TEST(HomogeneousExact, Law3_FullCircleStaysOnTheCircleInBothForms) {
  const Quadratic half_root(Rational(0), q(1, 2), 2), one(1), zero(0);  // √2/2
  const auto octant =
      BsplineCurve<Quadratic, 3>::bezier({{{one, zero, one}}, {{half_root, half_root, half_root}}, {{zero, one, one}}});
  for (int i = 0; i <= 8; ++i) {
    const Point p = evaluate_rational(full_circle, q(i, 2));
    EXPECT_EQ(p[0] * p[0] + p[1] * p[1], 1);
    const auto r = evaluate_rational(octant, Quadratic(q(i, 8)));
    EXPECT_TRUE(r[0] * r[0] + r[1] * r[1] == one);
  }
  const auto middle = rational_derivatives(octant, Quadratic(q(1, 2)), 1);
  EXPECT_TRUE(middle[0][0] == half_root);
  EXPECT_TRUE(middle[1][0] == Quadratic(q(-4), q(2), 2));
}

TEST(HomogeneousExact, PointsAtInfinityAreRefusedInEveryScalar) {
  EXPECT_EQ(evaluate(pole, q(1, 2)), (Homogeneous{{q(0), q(-1, 2), q(0)}}));
  EXPECT_EQ(rational_derivatives(pole, q(1, 4), 2),
            (std::vector<Point>{{{q(-1), q(-3, 2)}}, {{q(-8), q(-16)}}, {{q(-64), q(-192)}}}));
  EXPECT_EQ(rational_derivatives(pole, q(0), 2),
            (std::vector<Point>{{{q(0), q(0)}}, {{q(-2), q(-2)}}, {{q(-8), q(-12)}}}));
  EXPECT_EQ(rational_derivatives(pole, q(1), 2),
            (std::vector<Point>{{{q(2), q(0)}}, {{q(-2), q(2)}}, {{q(8), q(-12)}}}));
  EXPECT_THROW(evaluate_rational(pole, q(1, 2)), contract_error);
  EXPECT_THROW(evaluate_rational(make_curve<Quadratic>(pole), Quadratic(q(1, 2))), contract_error);
  EXPECT_THROW(evaluate_rational(make_curve<Ball>(pole), q(1, 2)), contract_error);
  EXPECT_THROW(evaluate_rational(make_curve<double>(pole), 0.5), contract_error);
  EXPECT_THROW(project(Vec<Tracked, 2>{{Tracked(1), Tracked(0)}}), contract_error);
  EXPECT_THROW(to_homogeneous(std::vector<Point>(2), Numbers(1, q(1))), contract_error);
  EXPECT_THROW(rational_derivatives(std::vector<Homogeneous>()), contract_error);
  // A weight that may be zero: no point is claimed.
  EXPECT_TRUE(std::isinf(project(Vec<Tracked, 2>{{Tracked(1), Tracked(0.5, 1.0)}})[0].error()));
  const RoundingGuard guard;
  const Interval x = project(Vec<Interval, 2>{{Interval(1), Interval(-1, 1)}})[0];
  EXPECT_TRUE(std::isinf(x.inf()) && std::isinf(x.sup()));
  EXPECT_THROW(evaluate_rational(make_curve<Interval>(pole), q(1, 2)), contract_error);
}

// R_4, R_5, R_6 of the nine-point circle at 9/4: 45/41 − 27√2/82, −9/41 + 15√2/41, 5/41 − 3√2/82.
TEST(HomogeneousExact, Law5_TheRationalBasisOfTheNinePointCircle) {
  std::vector<Quadratic> knots, weights;
  for (const int k : {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}) knots.push_back(Quadratic(k));
  for (int i = 0; i < 9; ++i) weights.push_back(i % 2 == 0 ? Quadratic(1) : Quadratic(q(0), q(1, 2), 2));
  const auto circle = KnotVector<Quadratic>::make(2, knots).value();
  const auto r = rational_basis(circle, weights, Quadratic(q(9, 4)));
  EXPECT_TRUE(r[4] == Quadratic(q(45, 41), q(-27, 82), 2));
  EXPECT_TRUE(r[5] == Quadratic(q(-9, 41), q(15, 41), 2));
  EXPECT_TRUE(r[6] == Quadratic(q(5, 41), q(-3, 82), 2));
  for (const int i : {0, 1, 2, 3, 7, 8}) EXPECT_TRUE(r[i] == Quadratic(0));
}

TEST(HomogeneousExact, Law5_TheRationalBasisGivesTheCurve) {
  RandomRationals random;
  for (int round = 0; round < 20; ++round) {
    const int degree = random.integer(0, 3), n = degree + 1 + random.integer(0, 4);
    const auto knots = KnotVector<Rational>::make(degree, random.knots(degree, n)).value();
    const auto points = random.points<2>(n);
    Numbers weights = random.numbers(n);
    for (Rational& w : weights) w = 1 + w * w;
    const Rational t = knots.domain_begin() + (knots.domain_end() - knots.domain_begin()) * random.unit();
    for (const Side side : {Side::left, Side::right}) {
      const Numbers r = rational_basis(knots, weights, t, side);
      Rational sum(0);
      Point point{};
      for (int i = 0; i < n; ++i) {
        sum += r[i];
        point += r[i] * points[i];
      }
      EXPECT_EQ(sum, 1);
      EXPECT_EQ(point, evaluate_rational(Conic(knots, to_homogeneous(points, weights)), t, side));
    }
  }
  const auto line = KnotVector<Rational>::bezier(1);
  EXPECT_THROW(rational_basis(line, Numbers{q(1), q(-1)}, q(1, 2)), contract_error);  // a pole
  EXPECT_THROW(rational_basis(line, Numbers{q(1)}, q(1, 2)), contract_error);
}

}  // namespace
}  // namespace patchproof::test
