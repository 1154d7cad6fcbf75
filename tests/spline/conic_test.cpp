// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/conic.h"

#include <gtest/gtest.h>

#include "patchproof/spline/bezier_extraction.h"
#include "patchproof/spline/binary_form.h"
#include "patchproof/spline/curve_denominator.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/reparametrize.h"
#include "patchproof/spline/smoothness.h"
#include "support/lar_curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

using Arc = ConicArc<Rational, 3>;
using Homogeneous = Vec<Rational, 3>;
using Point = Vec<Rational, 2>;

Rational q(int p, int d = 1) { return Rational(p) / Rational(d); }
Homogeneous h(const Rational& x, const Rational& y, const Rational& w) { return {{x, y, w}}; }
Point at(const Rational& x, const Rational& y) { return {{x, y}}; }

const Arc quarter = {h(q(1), q(0), q(1)), h(q(1), q(1), q(1)), h(q(0), q(2), q(2))};
const Arc ellipse = {h(q(3), q(0), q(1)), h(q(3), q(2), q(1)), h(q(0), q(4), q(2))};
const Arc parabola = {h(q(-1), q(1), q(1)), h(q(0), q(-1), q(1)), h(q(1), q(1), q(1))};
const Arc hyperbola_xy = {h(q(2), q(1, 2), q(1)), h(q(1), q(1), q(5, 4)), h(q(1, 2), q(2), q(1))};
const Arc hyperbola_std = {h(q(1), q(0), q(1)), h(q(1), q(1, 2), q(1)), h(q(5, 4), q(1), q(3, 4))};
const Arc three_quarters = {h(q(1), q(0), q(1)), h(q(-1), q(-1), q(-1)), h(q(0), q(2), q(2))};
const Arc half = {h(q(1), q(0), q(1)), h(q(0), q(1), q(0)), h(q(-1), q(0), q(1))};
const Arc pole = {h(q(0), q(0), q(1)), h(q(-1), q(-1), q(-1)), h(q(2), q(0), q(1))};

struct Known {
  const char* name;
  Arc arc;
  ConicClass type;
  std::vector<int> form;  // xx, yy, ww, and twice: xy, xw, yw
};
const Known known[] = {
    {"quarter circle", quarter, ConicClass::ellipse, {1, 1, -1, 0, 0, 0}},
    {"ellipse", ellipse, ConicClass::ellipse, {4, 9, -36, 0, 0, 0}},
    {"parabola", parabola, ConicClass::parabola, {2, 0, 0, 0, 0, -1}},
    {"hyperbola xy = 1", hyperbola_xy, ConicClass::hyperbola, {0, 0, -2, 1, 0, 0}},
    {"hyperbola x² − y² = 1", hyperbola_std, ConicClass::hyperbola, {1, -1, -1, 0, 0, 0}},
    {"three quarters of a circle", three_quarters, ConicClass::ellipse, {1, 1, -1, 0, 0, 0}},
    {"half a circle", half, ConicClass::ellipse, {1, 1, -1, 0, 0, 0}},
};

// The components of a curve's pieces as polynomials.
template <ExactField T, std::size_t M>
BinaryForm<T> component(const std::vector<Vec<T, M>>& points, std::size_t c) {
  std::vector<T> b;
  for (const auto& p : points) b.push_back(p[c]);
  return BinaryForm<T>::from_bernstein(b);
}

// Q(X, Y, W) as a polynomial in the parameter, zero or not.
template <ExactField T>
bool lies_on(const QuadraticForm<T>& form, const std::vector<Vec<T, 3>>& points) {
  BinaryForm<T> sum;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum = sum + BinaryForm<T>::constant(form.rows[i][j]) * component(points, i) * component(points, j);
  return *is_zero(sum);
}
template <ExactField T>
bool lies_on(const QuadraticForm<T>& form, const ConicArc<T, 3>& arc) {
  return lies_on(form, std::vector<Vec<T, 3>>(arc.begin(), arc.end()));
}

template <ExactField T>
QuadraticForm<T> form_of(const std::vector<int>& a) {
  const auto n = [&](int i) { return T(a[i]); };
  return {{{{{n(0), n(3), n(4)}}, {{n(3), n(1), n(5)}}, {{n(4), n(5), n(2)}}}}};
}
template <ExactField T>
QuadraticForm<T> circle_form() {
  return form_of<T>({1, 1, -1, 0, 0, 0});
}

// One form is a multiple of the other, positive or not.
bool proportional(const QuadraticForm<Rational>& a, const QuadraticForm<Rational>& b) {
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      if (a.rows[i / 3][i % 3] * b.rows[j / 3][j % 3] != a.rows[j / 3][j % 3] * b.rows[i / 3][i % 3]) return false;
  return true;
}

Arc random_arc(RandomRationals& random) { return {random.point<3>(), random.point<3>(), random.point<3>()}; }

TEST(Conic, Law1_ImplicitFormsOfKnownConics) {
  for (const Known& k : known) {
    SCOPED_TRACE(k.name);
    const auto form = implicit_form(k.arc);
    EXPECT_TRUE(proportional(form, form_of<Rational>(k.form)));
    EXPECT_TRUE(lies_on(form, k.arc));
    EXPECT_TRUE(lies_on(form_of<Rational>(k.form), k.arc));
    EXPECT_GT(form(k.arc[1]), 0);
    EXPECT_EQ(form(k.arc[0]), 0);
    // Negative control: another curve is not on it.
    EXPECT_FALSE(lies_on(form, pole));
  }
}

TEST(Conic, Law1_ImplicitFormOfAnyArcVanishesIdentically) {
  RandomRationals random;
  for (int round = 0; round < 60; ++round) {
    const Arc arc = random_arc(random);
    const auto form = implicit_form(arc);
    EXPECT_TRUE(lies_on(form, arc));
    const Rational det = dot(arc[0], cross(arc[1], arc[2]));
    EXPECT_EQ(form(arc[1]), det * det);
    EXPECT_EQ(conic_class(arc) == ConicClass::degenerate, det == 0);
  }
}

// With barycentric coordinates τ of R(t) with respect to the affine control points: w0 w2 τ1² = 4 w1² τ0 τ2.
TEST(Conic, Law1_BarycentricEquation) {
  for (const Arc& arc : {quarter, ellipse, parabola, hyperbola_xy, hyperbola_std, three_quarters}) {
    const Point p[] = {project(arc[0]), project(arc[1]), project(arc[2])};
    const auto area = [](const Point& a, const Point& b, const Point& c) -> Rational {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    for (const Rational& t : {q(0), q(1, 3), q(1, 2), q(5, 7), q(1)}) {
      const Point x = evaluate_rational(to_curve(arc), t);
      const Rational whole = area(p[0], p[1], p[2]), a = area(x, p[1], p[2]) / whole, b = area(p[0], x, p[2]) / whole,
                     c = area(p[0], p[1], x) / whole;
      EXPECT_EQ(a + b + c, 1);
      EXPECT_EQ(arc[0][2] * arc[2][2] * b * b, 4 * arc[1][2] * arc[1][2] * a * c);
    }
  }
}

TEST(Conic, Law2_ClassesOfKnownConics) {
  for (const Known& k : known) EXPECT_EQ(conic_class(k.arc), k.type) << k.name;
  EXPECT_EQ(conic_class(pole), ConicClass::parabola);
  EXPECT_EQ(conic_class(Arc{h(q(0), q(0), q(1)), h(q(1), q(1), q(1)), h(q(3), q(3), q(1))}), ConicClass::degenerate);
  EXPECT_EQ(conic_class(Arc{h(q(1), q(0), q(0)), h(q(0), q(1), q(0)), h(q(1), q(1), q(0))}), ConicClass::degenerate);
  EXPECT_EQ(conic_class(Arc{quarter[0], quarter[0], quarter[0]}), ConicClass::degenerate);
}

TEST(Conic, Law2_TheClassBelongsToTheConic) {
  RandomRationals random;
  int seen[4] = {};
  for (int round = 0; round < 80; ++round) {
    const Arc arc = random_arc(random);
    const ConicClass type = conic_class(arc);
    ++seen[static_cast<int>(type)];
    if (type == ConicClass::degenerate) continue;
    const auto form = implicit_form(arc);
    const Rational minor = form.rows[0][0] * form.rows[1][1] - form.rows[0][1] * form.rows[1][0];
    EXPECT_EQ(type, minor > 0 ? ConicClass::ellipse : minor < 0 ? ConicClass::hyperbola : ConicClass::parabola);
    EXPECT_EQ(conic_class(complementary_arc(arc)), type);
    const auto part = restrict(std::vector<Homogeneous>(arc.begin(), arc.end()), random(), q(100));
    EXPECT_EQ(conic_class(Arc{part[0], part[1], part[2]}), type);
    const auto pace = moebius(part, q(7, 3));
    EXPECT_EQ(conic_class(Arc{pace[0], pace[1], pace[2]}), type);
    const Vec<Rational, 3> a{{q(1), q(2), q(3)}}, b{{q(0), q(1), q(-1)}};
    EXPECT_EQ(conic_class(place(arc, random.point<3>(), a, b)), type);
    EXPECT_EQ(conic_class(place(arc, random.point<3>(), a, q(2) * a)), ConicClass::degenerate);  // flattened
  }
  EXPECT_GT(seen[static_cast<int>(ConicClass::ellipse)], 5);
  EXPECT_GT(seen[static_cast<int>(ConicClass::hyperbola)], 5);
}

TEST(Conic, Law3_ComplementaryArcs) {
  EXPECT_EQ(complementary_arc(quarter), three_quarters);
  const auto big = to_curve(three_quarters), small = to_curve(quarter);
  EXPECT_EQ(certify_denominator(big).sign, CurveDenominatorSign::positive);  // 1 − 4t + 5t²
  for (const Rational& t : {q(0), q(1)}) EXPECT_EQ(evaluate_rational(big, t), evaluate_rational(small, t));
  // The quarter has x + y ≥ 1, the rest x + y ≤ 1.
  for (const Rational& t : {q(1, 10), q(1, 2), q(9, 10)}) {
    const Point on_small = evaluate_rational(small, t), on_big = evaluate_rational(big, t);
    EXPECT_GT(on_small[0] + on_small[1], 1);
    EXPECT_LT(on_big[0] + on_big[1], 1);
  }
  EXPECT_TRUE(lies_on(circle_form<Rational>(), three_quarters));
}

TEST(Conic, Law4_ArcsFromSquares) {
  const auto v = [](int r, int s) { return at(q(r), q(s)); };
  EXPECT_EQ(unit_circle_arc(v(1, 0), v(1, 1)), quarter);
  EXPECT_EQ(unit_circle_arc(v(1, 0), v(-1, -1)), three_quarters);
  EXPECT_EQ(unit_circle_arc(v(1, 0), v(0, 1)), half);
  EXPECT_EQ(unit_hyperbola_arc(v(2, 0), v(2, 1))[2], h(q(5), q(4), q(3)));
  const auto hyperbola = unit_hyperbola_arc(v(1, 0), at(q(1), q(1, 2)));
  EXPECT_EQ(hyperbola, hyperbola_std);
  EXPECT_EQ(parabola_arc(q(-1), q(1)), parabola);
  const std::array<Point, 3> affine = {at(q(2), q(1, 2)), at(q(4, 5), q(4, 5)), at(q(1, 2), q(2))};
  EXPECT_EQ(conic_arc(affine, q(5, 4)), hyperbola_xy);
  const auto scaled = unit_circle_arc(v(2, 1), v(1, 2));
  EXPECT_EQ(scaled, (Arc{h(q(3), q(4), q(5)), h(q(0), q(5), q(4)), h(q(-3), q(4), q(5))}));
  RandomRationals random;
  for (int round = 0; round < 30; ++round) {
    const auto y = random.point<2>(), z = random.point<2>();
    EXPECT_TRUE(lies_on(circle_form<Rational>(), unit_circle_arc(y, z)));
    EXPECT_TRUE(lies_on(form_of<Rational>({1, -1, -1, 0, 0, 0}), unit_hyperbola_arc(y, z)));
    EXPECT_TRUE(lies_on(form_of<Rational>({2, 0, 0, 0, 0, -1}), parabola_arc(y[0], z[0])));
    EXPECT_EQ(complementary_arc(unit_circle_arc(y, z))[1], unit_circle_arc(y, -z)[1]);
  }
}

TEST(Conic, Law5_CircleInRationalNumbers) {
  const auto circle = unit_circle<Rational>();
  EXPECT_EQ(circle.knots(), rational_circle().knots());
  EXPECT_EQ(circle.points(), rational_circle().points());
  EXPECT_EQ(certify_denominator(circle).sign, CurveDenominatorSign::positive);
  for (const auto& piece : extract_bezier(circle)) EXPECT_TRUE(lies_on(circle_form<Rational>(), piece.points));
}

TEST(Conic, Law5_SymmetricCircleIsTheNinePointCircle) {
  const Quadratic root = in_root_two("0", "1/2"), o(0), e(1);
  const auto circle = unit_circle<Quadratic>(root);
  // Seen from behind and from the other end it is test13.
  const Vec<Quadratic, 2> origin{{o, o}}, left{{-e, o}}, up{{o, e}};
  const auto placed = place(circle, origin, left, up);
  EXPECT_TRUE(placed.points() == lar_circle().points());
  EXPECT_TRUE(placed.knots() == lar_circle().knots());
  for (const auto& piece : extract_bezier(lar_circle())) {
    EXPECT_TRUE(lies_on(circle_form<Quadratic>(), piece.points));
    EXPECT_FALSE(lies_on(form_of<Quadratic>({1, 1, -2, 0, 0, 0}), piece.points));
  }
  EXPECT_EQ(certify_denominator(lar_circle()).sign, CurveDenominatorSign::positive);
  EXPECT_THROW(unit_circle<Quadratic>(in_root_two("0", "1/3")), contract_error);
  // With double weights nothing can be proved, and the points are still those.
  EXPECT_EQ(unit_circle<double>(0.70710678118654757).points()[2], (Vec<double, 3>{{0, 1, 1}}));
}

// Speed² 2 at the knots, 48 − 32√2 in the middle of the spans; R·R' = 0 and R'·R' + R·R'' = 0 everywhere.
TEST(Conic, Law5_DerivativesOnTheSymmetricCircle) {
  const auto circle = lar_circle();
  const auto product = [](const Vec<Quadratic, 2>& a, const Vec<Quadratic, 2>& b) -> Quadratic {
    return a[0] * b[0] + a[1] * b[1];
  };
  for (int sixth = 0; sixth <= 24; ++sixth)
    for (const Side side : {Side::left, Side::right}) {
      const auto d = rational_derivatives(circle, Quadratic(q(sixth, 6)), 2, side);
      EXPECT_TRUE(product(d[0], d[0]) == Quadratic(1));
      EXPECT_TRUE(product(d[0], d[1]) == Quadratic(0));
      EXPECT_TRUE(product(d[1], d[1]) + product(d[0], d[2]) == Quadratic(0));
      if (sixth % 6 == 0) {
        EXPECT_TRUE(product(d[1], d[1]) == Quadratic(2));
      }
      if (sixth % 6 == 3) {
        EXPECT_TRUE(product(d[1], d[1]) == in_root_two("48", "-32"));
      }
    }
}

TEST(Conic, Law6_EllipsesFromConjugateHalfDiameters) {
  const Point origin = at(q(0), q(0)), a = at(q(3), q(0)), b = at(q(0), q(2));
  EXPECT_EQ(place(quarter, origin, a, b), ellipse);
  // A skew pair about another centre: |coordinates in (a, b)| = 1.
  const Point center = at(q(5), q(-1)), u = at(q(2), q(1)), v = at(q(-1), q(3));
  const auto curve = place(unit_circle<Rational>(), center, u, v);
  const Rational det = u[0] * v[1] - u[1] * v[0];
  for (int tenth = 0; tenth <= 40; ++tenth) {
    const Point d = evaluate_rational(curve, q(tenth, 10)) - center;
    const Rational x = (d[0] * v[1] - d[1] * v[0]) / det, y = (u[0] * d[1] - u[1] * d[0]) / det;
    EXPECT_EQ(x * x + y * y, 1);
  }
  EXPECT_EQ(evaluate_rational(curve, q(0)), center + u);
  EXPECT_EQ(evaluate_rational(curve, q(1)), center + v);
  EXPECT_GE(closing_smoothness_rational(curve).order, 1);
  // In space.
  const Vec<Rational, 3> c3{{q(1), q(2), q(3)}}, a3{{q(0), q(0), q(2)}}, b3{{q(0), q(2), q(0)}};
  const auto ring = place(unit_circle<Rational>(), c3, a3, b3);
  const auto at_half = evaluate_rational(ring, q(1, 2));
  EXPECT_EQ(at_half, (Vec<Rational, 3>{{q(1), q(18, 5), q(21, 5)}}));
}

// The parabola with weights 1, −1, 1 goes through infinity in its middle.
TEST(Conic, PoleIsReported) {
  const auto verdict = certify_denominator(to_curve(pole));
  EXPECT_EQ(verdict.sign, CurveDenominatorSign::vanishes);
  ASSERT_EQ(verdict.zeros.size(), 1u);
  EXPECT_EQ(verdict.zeros[0].begin, q(1, 2));
  EXPECT_TRUE(verdict.zeros[0].is_exact());
  // An arc of a hyperbola from one branch to the other meets infinity; within a branch it does not.
  EXPECT_FALSE(certify_denominator(to_curve(unit_hyperbola_arc(at(q(1), q(0)), at(q(0), q(1))))).is_nonzero());
  EXPECT_TRUE(certify_denominator(to_curve(unit_hyperbola_arc(at(q(2), q(-1)), at(q(2), q(1))))).is_nonzero());
}

TEST(Conic, Contracts) {
  EXPECT_THROW(unit_circle_spline<Rational>({at(q(1), q(0))}), contract_error);
  EXPECT_THROW(unit_circle_arc(at(q(1), q(0)), at(q(0), q(0))), contract_error);
  const auto arc = unit_circle_spline<Rational>({at(q(1), q(0)), at(q(2), q(1)), at(q(1), q(2))});
  EXPECT_EQ(arc.points().size(), 5u);
  EXPECT_EQ(evaluate_rational(arc, q(2)), at(q(-3, 5), q(4, 5)));
  EXPECT_EQ(evaluate_rational(arc, q(1)), at(q(3, 5), q(4, 5)));
}

}  // namespace
}  // namespace patchproof::test
