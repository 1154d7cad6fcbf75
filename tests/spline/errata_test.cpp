// SPDX-License-Identifier: Apache-2.0
// Errata of "Curves, surfaces and splines with LAR" about curves. Each test holds the printed formula, shows the wrong value
// that it gives, and the right one from this library. docs/errata.md refers to the tests by name.
#include <gtest/gtest.h>

#include <algorithm>

#include "patchproof/scalar/integer.h"
#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/smoothness.h"
#include "patchproof/spline/spline_domain.h"
#include "support/lar_curves.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;
using Point = Vec<Rational, 2>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Point at(const Rational& x, const Rational& y) { return {{x, y}}; }

// The recursion of BSPLINE as printed: order h = degree + 1, "0/0 = 0", and the base case
//   (t >= T[i] and t < T[i+1]) or (t == tmax and t >= T[i] and t <= T[i+1]),   tmax = T[n+1]
template <class T>
T printed_weight(const std::vector<T>& knots, const T& t_max, int i, int h, const T& t, bool has_end_clause = true) {
  if (h == 1) {
    const bool in_span = t >= knots[i] && t < knots[i + 1];
    const bool at_end = has_end_clause && t == t_max && t >= knots[i] && t <= knots[i + 1];
    return T(in_span || at_end ? 1 : 0);
  }
  const auto divided = [](const T& a, const T& b) -> T { return b == T(0) ? T(0) : T(a / b); };
  const T left =
      divided(t - knots[i], knots[i + h - 1] - knots[i]) * printed_weight<T>(knots, t_max, i, h - 1, t, has_end_clause);
  const T right = divided(knots[i + h] - t, knots[i + h] - knots[i + 1]) *
                  printed_weight<T>(knots, t_max, i + 1, h - 1, t, has_end_clause);
  return left + right;
}

template <class T>
std::vector<T> printed_weights(int degree, const std::vector<T>& knots, const T& t, bool has_end_clause = true) {
  const int n = static_cast<int>(knots.size()) - degree - 1;
  std::vector<T> out;
  for (int i = 0; i < n; ++i) out.push_back(printed_weight<T>(knots, knots[n], i, degree + 1, t, has_end_clause));
  return out;
}

Numbers printed_weights(const KnotVector<Rational>& knots, const Rational& t) {
  return printed_weights<Rational>(knots.degree(), knots.knots(), t);
}

Point printed_point(const std::string& name, const Rational& t) {
  const auto curve = lar_curve(name);
  const Numbers weights = printed_weights(curve.knots(), t);
  Point sum;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * curve.points()[i];
  return sum;
}

template <class T>
T sum_of(const std::vector<T>& weights) {
  T sum(0);
  for (const T& w : weights) sum += w;
  return sum;
}

// larDom as printed: j/tics from 0 on, over a length of knots[-1] − knots[0].
Numbers printed_domain(const Numbers& knots, int tics) {
  Numbers out;
  for (int j = 0; q(j, tics) <= knots.back() - knots.front(); ++j) out.push_back(q(j, tics));
  return out;
}

// The printed recursion is right where it is meant to be: the tests below find errors, not a misprint of their own.
TEST(Errata, PrintedWeightsAreRightOnClampedKnots) {
  for (const char* name : {"test08a", "test08b", "test10c", "test12_b2", "test12_b3", "test12_b4", "over_clamped"}) {
    const auto knots = lar_curve(name).knots();
    for (const Rational& t : knots.breaks())
      EXPECT_EQ(printed_weights(knots, t), basis_derivative(knots, t, 0)) << name;
  }
}

TEST(Errata, Erratum_E_LAR_03_TheDomainIsNotTheRangeOfTheKnots) {
  const auto uniform = lar_curve("test11b");
  const Numbers printed = printed_domain(uniform.knots().knots(), 4);
  EXPECT_EQ(printed.front(), q(0));
  EXPECT_EQ(printed.back(), q(7));
  EXPECT_EQ(sum_of(printed_weights(uniform.knots(), q(1, 2))), q(1, 8));
  EXPECT_EQ(printed_point("test11b", q(1, 2)), at(q(0), q(1, 8)));
  EXPECT_THROW(evaluate(uniform, q(1, 2)), contract_error);
  // The domain of knots from 0 was taken for another curve, which ends at 4: a false edge back to the origin.
  EXPECT_EQ(printed_point("test12_b2", q(9, 2)), at(q(0), q(0)));
  EXPECT_THROW(evaluate(lar_curve("test12_b2"), q(9, 2)), contract_error);
  // Knots from 10 to 11 would be sampled on [0, 1].
  const Numbers shifted = printed_domain(lar_curve("shifted_domain").knots().knots(), 4);
  EXPECT_EQ(shifted.back(), q(1));
  for (const char* name : {"test11b", "test12_b2", "shifted_domain"}) {
    const auto curve = lar_curve(name);
    const auto lists = sample_domain(curve.knots(), q(4)).value();
    ASSERT_EQ(lists.size(), 1u);
    EXPECT_EQ(lists[0].front().t, curve.knots().domain_begin());
    EXPECT_EQ(lists[0].back().t, curve.knots().domain_end());
    for (const auto& s : lists[0]) EXPECT_EQ(sum_of(basis_derivative(curve.knots(), s.t, 0, s.side)), 1);
  }
}

TEST(Errata, Erratum_E_LAR_04_TheEndIsCountedTwice) {
  const auto uniform = lar_curve("test11b");
  EXPECT_EQ(printed_weights(uniform.knots(), q(5)), numbers_of("0 0 0 1 1"));
  EXPECT_EQ(printed_point("test11b", q(5)), at(q(1), q(2)));
  EXPECT_EQ(basis_derivative(uniform.knots(), q(5), 0), numbers_of("0 0 0 1/2 1/2"));
  EXPECT_EQ(evaluate(uniform, q(5)), at(q(1, 2), q(1)));
  const auto partly = lar_curve("partially_clamped");
  EXPECT_EQ(sum_of(printed_weights(partly.knots(), q(3))), 2);
  EXPECT_EQ(printed_point("partially_clamped", q(3)), q(2) * evaluate(partly, q(3)));
}

TEST(Errata, Erratum_E_LAR_05_OnePolylineDrawsAnEdgeThatDoesNotExist) {
  struct Jump {
    const char* name;
    Point before, after;
  };
  for (const Jump& j :
       {Jump{"test12_b3", at(q(1), q(4)), at(q(2), q(3))}, Jump{"test12_b4", at(q(1), q(4)), at(q(1), q(1))}}) {
    const auto curve = lar_curve(j.name);
    // Printed: all samples in one line; the sample at the jump is the right limit, next to samples of the left piece.
    const Numbers printed = printed_domain(curve.knots().knots(), 32);
    const auto jump = std::find(printed.begin(), printed.end(), q(1));
    ASSERT_NE(jump, printed.end());
    EXPECT_EQ(printed_point(j.name, *jump), j.after);
    EXPECT_EQ(printed_point(j.name, *(jump - 1)), evaluate(curve, q(31, 32)));
    EXPECT_TRUE(std::none_of(printed.begin(), printed.end(),
                             [&](const Rational& t) { return printed_point(j.name, t) == j.before; }));
    // Ours: two lines; the first one ends in the left limit.
    const auto lists = sample_domain(curve.knots(), q(32)).value();
    ASSERT_EQ(lists.size(), 2u);
    EXPECT_EQ(evaluate(curve, lists[0].back().t, lists[0].back().side), j.before);
    EXPECT_EQ(evaluate(curve, lists[1].front().t, lists[1].front().side), j.after);
  }
}

TEST(Errata, Erratum_E_LAR_06_OneRepeatedPointDoesNotCloseAPeriodicCurve) {
  const auto printed = lar_curve("test11b");
  EXPECT_EQ(evaluate(printed, q(2)), at(q(0), q(1, 2)));
  EXPECT_EQ(evaluate(printed, q(5)), at(q(1, 2), q(1)));
  EXPECT_EQ(closing_smoothness(printed).order, -1);
  const auto closed =
      make_periodic<Rational, 2, Rational>(2, numbers_of("2 3 4 5 6"), points_of("0 1  0 0  1 0  1 1")).value();
  EXPECT_EQ(closed.knots(), lar_curve("test11c_closed").knots());
  EXPECT_EQ(closed.points(), lar_curve("test11c_closed").points());
  EXPECT_EQ(closing_smoothness(closed).order, 1);
}

TEST(Errata, Erratum_E_LAR_07_TheCircleNeedsItsNinthPoint) {
  const auto circle = lar_circle();
  std::vector<Vec<Quadratic, 3>> printed(circle.points().begin(), circle.points().end() - 1);
  const auto refused = BsplineCurve<Quadratic, 3>::make(circle.knots(), printed);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::wrong_count);
  EXPECT_EQ(closing_smoothness_rational(circle).order, 1);
}

TEST(Errata, Erratum_E_LAR_08_SumsOfRoundedStepsMissTheKnots) {
  // Printed: twenty steps of 1/20, added up; and j (1/n) times the size.
  volatile double step = 1.0 / 20, sum = 0;
  for (int j = 0; j < 20; ++j) sum = sum + step;
  EXPECT_GT(sum, 1.0);
  const std::vector<double> knots{0, 0, 0, 1, 1, 1};
  EXPECT_EQ(printed_weights<double>(2, knots, double(sum)), (std::vector<double>{0, 0, 0}));
  volatile double part = 1.0 / 160, other = 1.0 / 224;
  EXPECT_NE(96 * part * 5, 3.0);
  EXPECT_NE(160 * other * 7, 5.0);
  // Ours: the knots are in the samples, in doubles and exactly.
  const auto unit = sample_domain(KnotVector<double>::make(2, knots).value(), 20.0).value();
  EXPECT_EQ(unit[0].size(), 21u);
  EXPECT_EQ(unit[0].back().t, 1.0);
  const std::vector<double> longer{0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 7, 7};
  const auto samples = sample_domain(KnotVector<double>::make(2, longer).value(), 32.0).value();
  for (const double knot : longer)
    EXPECT_EQ(std::count_if(samples[0].begin(), samples[0].end(), [&](const auto& s) { return s.t == knot; }), 1);
  const auto exact = sample_domain(KnotVector<Rational>::make(1, numbers_of("0 0 1/3 1 1")).value(), q(20)).value();
  EXPECT_EQ(std::count_if(exact[0].begin(), exact[0].end(), [](const auto& s) { return s.t == q(1, 3); }), 1);
}

TEST(Errata, Erratum_E_LAR_09_HomogeneousPointsAreNotThePolygon) {
  const Vec<Quadratic, 3> printed = lar_circle().points()[1];
  EXPECT_TRUE(printed[0] == in_root_two("0", "-1/2"));
  EXPECT_TRUE((project(printed) == Vec<Quadratic, 2>{{Quadratic(-1), Quadratic(1)}}));
}

TEST(Errata, Erratum_E_LAR_12_SegmentsAreTheNonEmptySpans) {
  const auto circle = lar_circle();
  const int m = static_cast<int>(circle.points().size()) - 1, k = circle.degree();
  EXPECT_EQ(m - k + 1, 7);                            // printed
  EXPECT_EQ(circle.knots().breaks().size() - 1, 4u);  // arcs
  EXPECT_EQ(extract_bezier(circle).size(), 4u);
  // "A knot span of length zero is a point of the curve": not at multiplicity degree + 1 and beyond.
  EXPECT_EQ(dead_control_points(lar_curve("test12_b4").knots()), std::vector<int>{3});
  const auto curve = lar_curve("test12_b4");
  for (const Side side : {Side::left, Side::right}) EXPECT_NE(evaluate(curve, q(1), side), curve.points()[3]);
  // "Degree 0 shows the control points": all of them only without empty spans.
  EXPECT_TRUE(dead_control_points(lar_curve("deg0").knots()).empty());
  EXPECT_EQ(dead_control_points(KnotVector<Rational>::make(0, numbers_of("0 1 1 2")).value()), std::vector<int>{1});
  // The half-open domain loses the end.
  const auto knots = lar_curve("test08a").knots();
  EXPECT_EQ(sum_of(printed_weights<Rational>(3, knots.knots(), q(7), false)), 0);
  EXPECT_EQ(evaluate(lar_curve("test08a"), q(7)), at(q(5), q(0)));
}

TEST(Errata, Erratum_E_LAR_13_APointAtInfinityIsNoPoint) {
  const auto pole =
      BsplineCurve<Rational, 3>::bezier({{{q(0), q(0), q(1)}}, {{q(-1), q(-1), q(-1)}}, {{q(2), q(0), q(1)}}});
  const Vec<Rational, 3> h = evaluate(pole, q(1, 2));
  EXPECT_EQ(h, (Vec<Rational, 3>{{q(0), q(-1, 2), q(0)}}));  // printed: returned undivided, as (0, −1/2)
  EXPECT_THROW(project(h), contract_error);
}

TEST(Errata, Erratum_E_LAR_16_IntegersAreNotDivided) {
  const std::vector<int> knots{0, 0, 0, 2, 2, 2};
  EXPECT_EQ(printed_weights<int>(2, knots, 1), (std::vector<int>{0, 0, 0}));
  static_assert(!Field<int> && !Field<Integer>, "numbers whose / cuts off do not enter the formulas");
  const auto ours = KnotVector<Rational>::make(2, Numbers(knots.begin(), knots.end())).value();
  EXPECT_EQ(basis_derivative(ours, q(1), 0), numbers_of("1/4 1/2 1/4"));
}

// A derivative with respect to arc length would have norm 1. The velocity of the nine-point circle has norm √2 at its knots
// and another between them.
TEST(Errata, Erratum_E_LAR_11_TheParameterIsNotArcLength) {
  const auto circle = lar_circle();
  const auto speed_squared = [&](const Quadratic& t) {
    const auto d = rational_derivatives(circle, t, 1);
    return d[1][0] * d[1][0] + d[1][1] * d[1][1];
  };
  EXPECT_TRUE(speed_squared(Quadratic(1)) == Quadratic(2));
  EXPECT_TRUE(speed_squared(Quadratic(q(1, 2))) == in_root_two("48", "-32"));
  EXPECT_FALSE(speed_squared(Quadratic(1)) == Quadratic(1));
}

// One parameter gives a curve, in whatever space: the vector of all nine basis functions runs through the hyperplane
// Σ x_i = 1 of R⁹, and its derivative along the only parameter is not zero.
TEST(Errata, Erratum_E_LAR_15_TheBasisIsACurveInAHyperplane) {
  const auto knots = KnotVector<Rational>::make(2, circle_knots()).value();
  for (const Rational& t : {q(0), q(1, 3), q(1), q(5, 2), q(4)}) {
    Rational sum(0), rate(0);
    bool moves = false;
    for (const Rational& x : basis(knots, t)) sum += x;
    for (const Rational& x : basis_derivative(knots, t, 1)) {
      rate += x;
      moves = moves || x != 0;
    }
    EXPECT_EQ(basis(knots, t).size(), 9u);
    EXPECT_EQ(sum, 1);
    EXPECT_EQ(rate, 0);
    EXPECT_TRUE(moves);
  }
}

// If B_{i,h} were one polynomial, its pieces on two spans would agree. At t = 1/2 the first piece of a quadratic function
// on knots 0 … 3 is 1/8; the polynomial of its second piece is 1/2 + t' − t'² there (t' = t − 1 = −1/2), that is −1/4.
TEST(Errata, Erratum_E_LAR_17_FunctionsArePiecewisePolynomials) {
  const auto knots = KnotVector<Rational>::make(2, {q(-2), q(-1), q(0), q(1), q(2), q(3), q(4), q(5)}).value();
  // N_2 lives on [0, 3]: it is the last function of the span [0, 1] and the middle one of [1, 2].
  const Rational first = basis_in_span<Rational>(knots, 2, q(1, 2))[2],
                 second = basis_in_span<Rational>(knots, 3, q(1, 2))[1];
  EXPECT_EQ(first, q(1, 8));
  EXPECT_EQ(second, q(-1, 4));
}

}  // namespace
}  // namespace patchproof::test
