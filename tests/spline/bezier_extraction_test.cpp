// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/bezier_extraction.h"

#include "support/curves.h"
#include "support/scalars.h"

namespace patchproof::test {
namespace {

template <class T>
class BezierExtraction : public ScalarTest<T> {};
TYPED_TEST_SUITE(BezierExtraction, AllScalars, ScalarNames);

// The points of all pieces one after the other.
template <class T, std::size_t N, class K>
std::vector<Vec<T, N>> all_points(const std::vector<BezierPiece<T, N, K>>& pieces) {
  std::vector<Vec<T, N>> out;
  for (const auto& piece : pieces) out.insert(out.end(), piece.points.begin(), piece.points.end());
  return out;
}

TEST(BezierExtraction, Law1_pieces_are_the_curve_on_their_spans) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const auto pieces = extract_bezier(curve);
    const std::vector<Rational> breaks = curve.knots().breaks();
    ASSERT_EQ(pieces.size() + 1, breaks.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto& piece = pieces[i];
      EXPECT_EQ(piece.begin, breaks[i]);
      EXPECT_EQ(piece.end, breaks[i + 1]);
      ASSERT_EQ(piece.degree(), curve.degree());
      const int span = span_over(curve.knots(), piece.begin, piece.end);
      for (const Rational& t : enough_parameters(piece.begin, piece.end, curve.degree()))
        EXPECT_EQ(de_casteljau(piece.points, knot_ratio<Rational>(t, piece.begin, piece.end)),
                  evaluate_in_span<Rational>(curve, span, t));
    }
  }
}

TYPED_TEST(BezierExtraction, Law1_in_every_scalar) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    check<TypeParam>(all_points(extract_bezier(curve)),
                     [&]<class S>() { return all_points(extract_bezier(make_curve<S>(curve))); });
  }
}

TEST(BezierExtraction, Law2_joined_pieces_are_the_curve) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const auto pieces = extract_bezier(curve);
    const PlaneCurve same_knots = join_pieces(pieces, curve.knots()), free_knots = join_pieces(pieces);
    EXPECT_EQ(same_knots.knots(), curve.knots());
    expect_same_curve(same_knots, curve);
    expect_same_curve(free_knots, curve);
    for (const Rational& t : curve.knots().breaks()) EXPECT_EQ(free_knots.knots().multiplicity(t), curve.degree() + 1);
    // Points that act on the domain come back; in an unclamped curve all of these do.
    for (int i = 0; i < curve.knots().control_count(); ++i) {
      const int p = curve.degree();
      const bool acts = curve.knots()[i] < curve.knots().domain_end() &&
                        curve.knots().domain_begin() < curve.knots()[i + p + 1] &&
                        curve.knots()[i] < curve.knots()[i + p + 1];
      if (acts) {
        EXPECT_EQ(same_knots.points()[i], curve.points()[i]) << "point " << i;
      }
    }
    if (is_clean(curve)) {
      EXPECT_EQ(remove_redundant_knots(free_knots).points(), curve.points());
    }
  }
}

TYPED_TEST(BezierExtraction, Law2_in_every_scalar) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    check<TypeParam>(join_pieces(extract_bezier(curve), curve.knots()).points(), [&]<class S>() {
      const auto c = make_curve<S>(curve);
      return join_pieces(extract_bezier(c), c.knots()).points();
    });
  }
}

TEST(BezierExtraction, Law2_pieces_of_one_polynomial_may_share_a_span) {
  const PlaneCurve parabola = PlaneCurve::bezier({{{0, 0}}, {{1, 0}}, {{2, 4}}});
  const auto pieces = extract_bezier(insert_knot(parabola, Rational(Rational(1) / Rational(3))));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(join_pieces(pieces, parabola.knots()).points(), parabola.points());
}

TEST(BezierExtraction, Law3_restriction_and_splitting) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const std::vector<Rational> where = places(curve.knots());
    for (const Rational& a : where)
      for (const Rational& b : where) {
        if (!(a < b)) continue;
        const PlaneCurve part = restrict(curve, a, b);
        EXPECT_TRUE(part.knots().is_clamped());
        EXPECT_EQ(part.knots().multiplicity(a), curve.degree() + 1);
        EXPECT_EQ(part.knots().multiplicity(b), curve.degree() + 1);
        EXPECT_EQ(part.points().front(), evaluate(curve, a, Side::right));
        EXPECT_EQ(part.points().back(), evaluate(curve, b, Side::left));
        // On each span of the part, the polynomial of the curve there.
        const std::vector<Rational> breaks = part.knots().breaks();
        EXPECT_EQ(breaks.front(), a);
        EXPECT_EQ(breaks.back(), b);
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
          for (const Rational& t : enough_parameters(breaks[i], breaks[i + 1], curve.degree()))
            EXPECT_EQ(evaluate_in_span<Rational>(part, span_over(part.knots(), breaks[i], breaks[i + 1]), t),
                      evaluate_in_span<Rational>(curve, span_over(curve.knots(), breaks[i], breaks[i + 1]), t));
      }
    for (const Rational& t : where) {
      if (t == curve.knots().domain_begin() || t == curve.knots().domain_end()) continue;
      const auto [left, right] = split(curve, t);
      EXPECT_EQ(left.points(), restrict(curve, curve.knots().domain_begin(), t).points());
      EXPECT_EQ(right.points(), restrict(curve, t, curve.knots().domain_end()).points());
      // Extraction of the halves is extraction of the whole, cut at t.
      auto pieces = extract_bezier(left);
      for (auto& piece : extract_bezier(right)) pieces.push_back(piece);
      expect_same_curve(join_pieces(pieces), curve);
    }
  }
}

TEST(BezierExtraction, Law4_clamping) {
  RandomRationals random;
  for (const auto& [name, curve] : awkward_curves(random)) {
    SCOPED_TRACE(name);
    const PlaneCurve clamped = clamp(curve);
    EXPECT_TRUE(clamped.knots().is_clamped());
    EXPECT_EQ(clamped.knots().multiplicity(curve.knots().domain_begin()), curve.degree() + 1);
    EXPECT_EQ(clamped.knots().multiplicity(curve.knots().domain_end()), curve.degree() + 1);
    expect_same_curve(clamped, curve);
    EXPECT_EQ(clamp(clamped).points(), clamped.points());
    if (is_clean(curve)) {
      EXPECT_EQ(clamped.points(), curve.points());
    }
    // Knots inside the domain stay as they are.
    for (const Rational& t : curve.knots().breaks()) {
      if (t != curve.knots().domain_begin() && t != curve.knots().domain_end()) {
        EXPECT_EQ(clamped.knots().multiplicity(t), curve.knots().multiplicity(t));
      }
    }
  }
}

TEST(BezierExtraction, Law5_periodic_curves_close_smoothly) {
  RandomRationals random;
  const std::vector<std::vector<Rational>> periods = {
      {0, 1, 2, 3, 4, 5}, {2, 3, 3, 5, 6, 7}, {0, 0, 1, 2, 4}, {-1, 0, 2, 2}, {0, 1}, {1, 4, 5}};
  for (const auto& period : periods)
    for (int degree = 0; degree <= 4; ++degree) {
      SCOPED_TRACE("degree " + std::to_string(degree) + ", " + std::to_string(period.size()) + " knots");
      const int m = static_cast<int>(period.size()) - 1;
      const auto points = random.points<2>(m);
      const PlaneCurve curve = make_periodic<Rational, 2, Rational>(degree, period, points).value();
      EXPECT_EQ(curve.knots().domain_begin(), period.front());
      EXPECT_EQ(curve.knots().domain_end(), period.back());
      const int seam = static_cast<int>(std::count(period.begin(), period.end() - 1, period.front()) +
                                        std::count(period.begin() + 1, period.end() - 1, period.back()));
      for (int order = 0; order <= degree - seam; ++order)
        EXPECT_EQ(derivative(curve, period.front(), order), derivative(curve, period.back(), order)) << order;
      expect_same_curve(clamp(curve), curve);

      // Begin one knot later: the pieces are the same, turned round.
      std::vector<Rational> turned(period.begin() + 1, period.end());
      turned.push_back(period[1] + (period.back() - period.front()));
      if (turned.front() == turned.back()) continue;
      std::vector<Vec<Rational, 2>> turned_points(points);
      std::rotate(turned_points.begin(), turned_points.begin() + 1, turned_points.end());
      const PlaneCurve other = make_periodic<Rational, 2, Rational>(degree, turned, turned_points).value();
      auto expected = extract_bezier(curve);
      const int whole = period[0] < period[1] ? 1 : 0;  // a piece moved to the end, unless the span is empty
      std::rotate(expected.begin(), expected.begin() + whole, expected.end());
      EXPECT_EQ(all_points(extract_bezier(other)), all_points(expected));
    }
}

TEST(BezierExtraction, Law5_periodic_knots_that_cannot_be) {
  const auto code = [](int degree, std::vector<Rational> knots) {
    return periodic_knots<Rational>(degree, knots).error().code;
  };
  EXPECT_EQ(code(2, {1}), ErrorCode::wrong_count);
  EXPECT_EQ(code(-1, {0, 1}), ErrorCode::bad_degree);
  EXPECT_EQ(code(2, {0, 2, 1, 3}), ErrorCode::decreasing_knots);
  EXPECT_EQ(code(2, {1, 1, 1}), ErrorCode::empty_domain);
  const auto wrong = make_periodic<Rational, 2, Rational>(2, {0, 1, 2}, {{{0, 0}}});
  EXPECT_EQ(wrong.error().code, ErrorCode::wrong_count);
}

TYPED_TEST(BezierExtraction, Law5_in_every_scalar) {
  RandomRationals random;
  const std::vector<Rational> period = {0, 1, 1, 3, 4};
  const auto points = random.points<2>(4);
  check<TypeParam>(clamp(make_periodic<Rational, 2, Rational>(3, period, points).value()).points(), [&]<class S>() {
    std::vector<knot_scalar_t<S>> knots;
    for (const Rational& t : period) knots.push_back(make_knot<S>(t));
    return clamp(make_periodic<S, 2, knot_scalar_t<S>>(3, knots, make_points<S>(points)).value()).points();
  });
}

TEST(BezierExtraction, Contracts) {
  RandomRationals random;
  const PlaneCurve curve = curve_on(random, 2, {0, 0, 0, 1, 2, 2, 2});
  const auto pieces = extract_bezier(curve);
  EXPECT_THROW(restrict(curve, Rational(1), Rational(1)), contract_error);
  EXPECT_THROW(restrict(curve, Rational(1), Rational(3)), contract_error);
  EXPECT_THROW(split(curve, Rational(0)), contract_error);
  EXPECT_THROW(join_pieces(pieces, KnotVector<Rational>::bezier(2)), contract_error);
  EXPECT_THROW(join_pieces(pieces, KnotVector<Rational>::make(2, {0, 0, 0, 1, 2, 3, 3, 3}).value()), contract_error);
  EXPECT_THROW(join_pieces(pieces, KnotVector<Rational>::make(3, {0, 0, 0, 0, 1, 2, 2, 2, 2}).value()), contract_error);
}

}  // namespace
}  // namespace patchproof::test
