// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/reparametrize.h"

#include "patchproof/spline/bezier_extraction.h"
#include "support/curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class Reparametrize : public ScalarTest<T> {};
TYPED_TEST_SUITE(Reparametrize, AllScalars, ScalarNames);

TEST(Reparametrize, Law1_reverse_runs_backwards) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const PlaneCurve back = reverse(curve);
    const Rational a = curve.knots().domain_begin(), b = curve.knots().domain_end();
    EXPECT_EQ(back.knots().domain_begin(), a);
    EXPECT_EQ(back.knots().domain_end(), b);
    const auto pieces = extract_bezier(curve);
    const auto mirrored = extract_bezier(back);
    ASSERT_EQ(mirrored.size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto &piece = pieces[pieces.size() - 1 - i], &image = mirrored[i];
      EXPECT_EQ(image.begin, a + b - piece.end);
      EXPECT_EQ(image.end, a + b - piece.begin);
      EXPECT_EQ(image.points, reverse(piece.points));
    }
    EXPECT_EQ(reverse(back).knots(), curve.knots());
    EXPECT_EQ(reverse(back).points(), curve.points());
  }
}

TEST(Reparametrize, Law2_map_domain_keeps_points_and_ratios) {
  RandomRationals random;
  const std::vector<std::pair<Rational, Rational>> domains = {
      {0, 1}, {-3, 7}, {Rational(1) / Rational(3), Rational(1) / Rational(2)}, {1000000, 1000001}};
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const Rational a = curve.knots().domain_begin(), b = curve.knots().domain_end();
    for (const auto& [c, d] : domains) {
      const PlaneCurve moved = map_domain(curve, c, d);
      EXPECT_EQ(moved.knots().domain_begin(), c);
      EXPECT_EQ(moved.knots().domain_end(), d);
      EXPECT_EQ(moved.points(), curve.points());
      for (const Rational& t : places(curve.knots())) {
        const Rational s = c + (d - c) * (t - a) / (b - a);
        for (const Side side : {Side::left, Side::right}) EXPECT_EQ(evaluate(moved, s, side), evaluate(curve, t, side));
      }
      EXPECT_EQ(map_domain(moved, a, b).knots(), curve.knots());
    }
    EXPECT_EQ(to_unit_domain(curve).knots(), map_domain(curve.knots(), Rational(0), Rational(1)));
  }
}

// w(s)^p C(φ(s)) of the piece on each span, at p + 1 parameters: an identity of polynomials of degree p.
void expect_moebius(const PlaneCurve& image, const PlaneCurve& curve, const Rational& r) {
  const Rational a = curve.knots().domain_begin(), b = curve.knots().domain_end();
  const auto w = [&](const Rational& s) { return Rational(1 - s + r * s); };
  const auto phi = [&](const Rational& s) { return Rational(r * s / w(s)); };
  const auto unit = [&](const Rational& t) { return Rational((t - a) / (b - a)); };
  const std::vector<Rational> breaks = image.knots().breaks(), old = curve.knots().breaks();
  ASSERT_EQ(breaks.size(), old.size());
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    EXPECT_EQ(phi(unit(breaks[i])), unit(old[i]));
    EXPECT_EQ(image.knots().multiplicity(breaks[i]), curve.knots().multiplicity(old[i]));
  }
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (const Rational& t : enough_parameters(breaks[i], breaks[i + 1], curve.degree())) {
      const Rational s = unit(t);
      Rational power(1);
      for (int k = 0; k < curve.degree(); ++k) power = power * w(s);
      const Rational there = a + (b - a) * phi(s);
      EXPECT_EQ(evaluate_in_span<Rational>(image, span_over(image.knots(), breaks[i], breaks[i + 1]), t),
                power * evaluate_in_span<Rational>(curve, span_over(curve.knots(), old[i], old[i + 1]), there));
    }
}

// No outer knot is thrown beyond the pole.
bool within_reach(const PlaneCurve& curve, const Rational& r) {
  const KnotVector<Rational> unit = map_domain(curve.knots(), Rational(0), Rational(1));
  return std::all_of(unit.knots().begin(), unit.knots().end(), [&](const Rational& t) { return r + (1 - r) * t > 0; });
}

TEST(Reparametrize, Law3_moebius_keeps_the_shape) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random))
    for (const Rational& r :
         {Rational(Rational(2) / Rational(3)), Rational(1), Rational(Rational(5) / Rational(4)), Rational(3)}) {
      SCOPED_TRACE(name);
      // Clamped first where an outer knot would be thrown beyond the pole.
      const bool in_reach = within_reach(curve, r);
      const PlaneCurve start = in_reach ? curve : clamp(curve);
      if (!in_reach) {
        EXPECT_THROW(moebius(curve, r), contract_error);
      }
      const PlaneCurve image = moebius(start, r);
      expect_moebius(image, start, r);

      const PlaneCurve back = moebius(image, Rational(1 / r));
      Rational factor(1);
      for (int i = 0; i < curve.degree(); ++i) factor = factor * r;
      EXPECT_EQ(back.knots(), start.knots());
      EXPECT_EQ(back.points(), start.points());
      if (r == 1) {
        EXPECT_EQ(image.points(), curve.points());
        EXPECT_EQ(image.knots(), curve.knots());
      }
      if (is_clean(curve)) {
        EXPECT_EQ(image.points().front(), curve.points().front());
        EXPECT_EQ(image.points().back(), factor * curve.points().back());
      }
    }
}

TEST(Reparametrize, Law3_moebius_of_bezier_points) {
  RandomRationals random;
  for (int degree = 0; degree <= 5; ++degree) {
    const auto points = random.points<2>(degree + 1);
    const Rational r = Rational(7) / Rational(3);
    const auto image = moebius(points, r);
    EXPECT_EQ(image, moebius(PlaneCurve::bezier(points), r).points());
    expect_moebius(PlaneCurve::bezier(image), PlaneCurve::bezier(points), r);
  }
}

// The quarter circle (1 − t², 2t, 1 + t²) at another pace is on the circle still.
TEST(Reparametrize, Law3_a_circle_stays_a_circle) {
  const std::vector<Vec<Rational, 3>> quarter = {{{1, 0, 1}}, {{1, 1, 1}}, {{0, 2, 2}}};
  const auto image = moebius(quarter, Rational(Rational(1) / Rational(5)));
  for (int i = 0; i <= 8; ++i) {
    const Vec<Rational, 3> p = de_casteljau(image, Rational(Rational(i) / Rational(8)));
    EXPECT_EQ(p[0] * p[0] + p[1] * p[1], p[2] * p[2]);
  }
}

TYPED_TEST(Reparametrize, Laws_in_every_scalar) {
  RandomRationals random;
  const Rational r = Rational(5) / Rational(4);
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    check<TypeParam>(reverse(curve).points(), [&]<class S>() { return reverse(make_curve<S>(curve)).points(); });
    check<TypeParam>(to_unit_domain(curve).points(),
                     [&]<class S>() { return to_unit_domain(make_curve<S>(curve)).points(); });
    if (within_reach(curve, r))
      check<TypeParam>(moebius(curve, r).points(),
                       [&]<class S>() { return moebius(make_curve<S>(curve), make_knot<S>(r)).points(); });
    check<TypeParam>(moebius(curve.points(), r),
                     [&]<class S>() { return moebius(make_points<S>(curve.points()), make<S>(r)); });
  }
}

TEST(Reparametrize, Contracts) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 1, 1});
  EXPECT_THROW(map_domain(curve, Rational(1), Rational(1)), contract_error);
  EXPECT_THROW(moebius(curve, Rational(0)), contract_error);
  EXPECT_THROW(moebius(curve, Rational(-1)), contract_error);
  // Rounding would change the order of these neighbours: refused, neither sorted nor merged.
  const double knot = 0x1.859af11d6a24ap-1, next = 0x1.859af11d6a24bp-1;
  const auto close = KnotVector<double>::make(1, {0, 0, knot, next, 1, 1}).value();
  EXPECT_THROW(map_domain(close, 694.0, 695.0), contract_error);
}

}  // namespace
}  // namespace patchproof::test
