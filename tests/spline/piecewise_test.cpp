// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/piecewise.h"

#include <gtest/gtest.h>

#include "support/curves.h"
#include "support/polynomial.h"
#include "support/rational_literal.h"

namespace patchproof::test {
namespace {

using Field1 = Piecewise<Rational, 1>;
using Curve2 = Piecewise<Rational, 2>;

// Pieces that need not even meet.
template <std::size_t N>
Piecewise<Rational, N> random_pieces(RandomRationals& random, int degree, const std::vector<Rational>& breaks) {
  Piecewise<Rational, N> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    out.push_back({breaks[i], breaks[i + 1], random.points<N>(degree + 1)});
  return out;
}

// Component c of the piece to that side of t, multiplied out in powers of t.
template <std::size_t N>
Polynomial polynomial_at(const Piecewise<Rational, N>& f, const Rational& t, Side side, std::size_t c) {
  const BezierPiece<Rational, N>* found = nullptr;
  for (const auto& piece : f)
    if (side == Side::right ? piece.begin <= t && t < piece.end : piece.begin < t && t <= piece.end) found = &piece;
  if (!found) found = t == f.front().begin ? &f.front() : &f.back();
  std::vector<Rational> b;
  for (const auto& p : found->points) b.push_back(p[c]);
  const Rational length = found->end - found->begin;
  return from_bernstein(b).compose(Polynomial({Rational(-found->begin / length), Rational(1 / length)}));
}

// The middles of the intervals of both: where a polynomial is to be compared with another.
std::vector<Rational> middles(const std::vector<Rational>& a, const std::vector<Rational>& b) {
  std::vector<Rational> all = a, out;
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
    if (all[i] != all[i + 1]) out.push_back((all[i] + all[i + 1]) / 2);
  return out;
}

template <std::size_t N>
void expect_same(const Piecewise<Rational, N>& f, const Piecewise<Rational, N>& g) {
  EXPECT_EQ(f.front().begin, g.front().begin);
  EXPECT_EQ(f.back().end, g.back().end);
  for (const Rational& t : middles(breaks(f), breaks(g)))
    for (std::size_t c = 0; c < N; ++c)
      EXPECT_EQ(polynomial_at(f, t, Side::right, c), polynomial_at(g, t, Side::right, c)) << "about " << t;
}

void expect_without_gaps(const auto& f) {
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_LT(f[i].begin, f[i].end);
    EXPECT_EQ(f[i].degree(), f[0].degree());
    if (i > 0) {
      EXPECT_EQ(f[i - 1].end, f[i].begin);
    }
  }
}

const std::vector<Rational> kBreaks{"-1/3"_q, 0, "1/7"_q, 2}, kOthers{"-1/3"_q, "-1/4"_q, "1/7"_q, 1, "3/2"_q, 2};

TEST(Piecewise, BreaksAndTheirUnion) {
  RandomRationals random;
  EXPECT_EQ(breaks(random_pieces<2>(random, 3, kBreaks)), kBreaks);
  EXPECT_EQ(patchproof::common_breaks(kBreaks, kOthers),
            (std::vector<Rational>{"-1/3"_q, "-1/4"_q, 0, "1/7"_q, 1, "3/2"_q, 2}));
  EXPECT_EQ(patchproof::common_breaks(kBreaks, std::vector<Rational>{}), kBreaks);
  EXPECT_THROW(breaks(Curve2{}), contract_error);
}

TEST(Piecewise, Law1_RefineElevateAndWindowKeepTheFunction) {
  RandomRationals random;
  for (int degree = 0; degree <= 5; ++degree) {
    const Curve2 f = random_pieces<2>(random, degree, kBreaks);
    // Two cuts in one piece, cuts at breaks, at the ends and outside the range.
    const std::vector<Rational> at{-5, "-1/3"_q, "-1/4"_q, "-1/5"_q, 0, 1, "3/2"_q, 2, 7};
    const Curve2 refined = refine(f, at);
    EXPECT_EQ(breaks(refined), (std::vector<Rational>{"-1/3"_q, "-1/4"_q, "-1/5"_q, 0, "1/7"_q, 1, "3/2"_q, 2}));
    expect_without_gaps(refined);
    expect_same(f, refined);
    EXPECT_EQ(breaks(refine(f, {})), kBreaks);
    expect_same(f, refine(refined, at));

    EXPECT_EQ(elevate(f, degree + 3).front().degree(), degree + 3);
    expect_same(f, elevate(f, degree + 3));
    EXPECT_EQ(elevate(f, 0).front().degree(), degree) << "never lowered";

    const std::vector<std::pair<Rational, Rational>> windows{{"-1/3"_q, 2}, {"-1/3"_q, 0},      {"1/7"_q, 2},
                                                             {"-1/4"_q, 1}, {"1/5"_q, "1/4"_q}, {0, "1/7"_q}};
    for (const auto& [begin, end] : windows) {
      const Curve2 inside = window(f, begin, end);
      EXPECT_EQ(inside.front().begin, begin);
      EXPECT_EQ(inside.back().end, end);
      expect_without_gaps(inside);
      for (const Rational& t : middles(breaks(inside), {}))
        for (const std::size_t c : {0u, 1u})
          EXPECT_EQ(polynomial_at(inside, t, Side::right, c), polynomial_at(f, t, Side::right, c));
    }
    EXPECT_THROW(window(f, Rational(0), Rational(0)), contract_error);
    EXPECT_THROW(window(f, Rational(1), Rational(0)), contract_error);
    EXPECT_THROW(window(f, Rational(-1), Rational(0)), contract_error);
    EXPECT_THROW(window(f, Rational(0), Rational(3)), contract_error);
  }
}

TEST(Piecewise, Law2_SumScaleAndProductAreThoseOfTheValues) {
  RandomRationals random;
  for (int degree = 0; degree <= 4; ++degree) {
    const Curve2 f = random_pieces<2>(random, degree, kBreaks), g = random_pieces<2>(random, 4 - degree, kOthers);
    const Field1 k = random_pieces<1>(random, degree, kOthers);
    const Curve2 s = sum(f, g), p = product(k, f), scaled = scale(Rational("-5/3"_q), f);
    EXPECT_EQ(breaks(s), patchproof::common_breaks(kBreaks, kOthers));
    EXPECT_EQ(s.front().degree(), std::max(degree, 4 - degree));
    EXPECT_EQ(p.front().degree(), 2 * degree);
    expect_without_gaps(s);
    expect_without_gaps(p);
    const Polynomial factor({"-5/3"_q});
    for (const Rational& t : middles(kBreaks, kOthers))
      for (const std::size_t c : {0u, 1u}) {
        const Polynomial of_f = polynomial_at(f, t, Side::right, c);
        EXPECT_EQ(polynomial_at(s, t, Side::right, c), of_f + polynomial_at(g, t, Side::right, c));
        EXPECT_EQ(polynomial_at(p, t, Side::right, c), of_f * polynomial_at(k, t, Side::right, 0));
        EXPECT_EQ(polynomial_at(scaled, t, Side::right, c), of_f * factor);
      }
    expect_same(sum(g, f), s);
  }
}

// Also where the numbers of pieces happen to be the same.
TEST(Piecewise, OperandsOverOtherRangesAreRefused) {
  RandomRationals random;
  const auto over = [&](std::vector<Rational> at) { return random_pieces<1>(random, 2, at); };
  const Field1 f = over({0, 1});
  for (const Field1& g :
       {over({0, 2}), over({1, 2}), over({2, 3}), over({"-1/2"_q, "1/2"_q}), over({"1/4"_q, "3/4"_q})}) {
    EXPECT_THROW((void)sum(f, g), contract_error);
    EXPECT_THROW((void)product(f, g), contract_error);
    EXPECT_THROW((void)sum(g, f), contract_error);
  }
  EXPECT_THROW((void)sum(f, Field1{}), contract_error);
  EXPECT_THROW((void)product(Field1{}, f), contract_error);
}

TEST(Piecewise, Law3_DerivativeOfTheValues) {
  RandomRationals random;
  for (int degree = 0; degree <= 5; ++degree) {
    const Curve2 f = random_pieces<2>(random, degree, kBreaks), d = derivative(f);
    EXPECT_EQ(breaks(d), kBreaks);
    for (const Rational& t : middles(kBreaks, {}))
      for (const std::size_t c : {0u, 1u})
        EXPECT_EQ(polynomial_at(d, t, Side::right, c), polynomial_at(f, t, Side::right, c).derivative());
  }
}

TEST(Piecewise, Law4_PartsForwardsAndBackwards) {
  RandomRationals random;
  const Curve2 f = random_pieces<2>(random, 4, kBreaks);
  const std::vector<std::pair<Rational, Rational>> ranges{
      {"-1/3"_q, 2}, {2, "-1/3"_q}, {"-1/4"_q, 1}, {1, "-1/4"_q}, {0, "1/7"_q}, {"1/7"_q, 0}, {"1/5"_q, "1/6"_q}};
  for (const auto& [from, to] : ranges) {
    const Curve2 g = part(f, from, to);
    EXPECT_EQ(g.front().begin, 0);
    EXPECT_EQ(g.back().end, 1);
    expect_without_gaps(g);
    const Rational step = to - from;
    for (const Rational& t : middles(breaks(g), {}))
      for (const std::size_t c : {0u, 1u})
        EXPECT_EQ(polynomial_at(g, t, Side::right, c),
                  polynomial_at(f, from + step * t, Side::right, c).compose(Polynomial({from, step})))
            << from << " to " << to;
  }
  EXPECT_THROW((void)part(f, Rational(1), Rational(1)), contract_error);
  EXPECT_THROW((void)part(f, Rational(3), Rational(1)), contract_error);
}

TEST(Piecewise, Law5_ValuesAndDerivativesFromEitherSide) {
  RandomRationals random;
  for (int degree = 0; degree <= 4; ++degree) {
    const Curve2 f = random_pieces<2>(random, degree, kBreaks);
    std::vector<Rational> at = kBreaks;
    at.insert(at.end(), {"-1/5"_q, "1/9"_q, "13/7"_q});
    for (const Rational& t : at)
      for (const Side side : {Side::left, Side::right})
        for (int order = 0; order <= degree + 1; ++order)
          for (const std::size_t c : {0u, 1u})
            EXPECT_EQ(value(f, t, order, side)[c], polynomial_at(f, t, side, c).derivative(order)(t))
                << "order " << order << " at " << t;
    EXPECT_THROW((void)value(f, Rational(-1)), contract_error);
    EXPECT_THROW((void)value(f, Rational("2000001/1000000"_q)), contract_error);
  }
}

TEST(Piecewise, Law6_C1ExactlyWhenValuesAndDerivativesAgree) {
  RandomRationals random;
  const std::vector<Rational> knots{"-1/3"_q, "-1/3"_q, "-1/3"_q, "-1/3"_q, 0, 0, "1/7"_q, 2, 2, 2, 2};
  const auto k = KnotVector<Rational>::make(3, knots).value();
  const Curve2 smooth = extract_bezier(BsplineCurve<Rational, 2>(k, random.points<2>(k.control_count())));
  EXPECT_TRUE(is_c1(smooth));
  EXPECT_TRUE(is_c1(random_pieces<2>(random, 3, {0, 1})));
  const Rational tiny = Rational(1) / power(Polynomial({Rational(2)}), 300)(Rational(0));
  for (std::size_t i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      for (const std::size_t c : {0u, 1u}) {
        Curve2 bent = smooth;
        bent[i].points[j][c] += tiny;
        // The two points next to an inner break decide, and they do all in the middle piece.
        const bool counts = (i > 0 && j < 2) || (i < 2 && j > 1);
        EXPECT_EQ(is_c1(bent), !counts) << "piece " << i << ", point " << j;
      }
  // Continuous derivatives of two functions that do not meet.
  EXPECT_FALSE(is_c1(Field1{{0, 1, {{{0}}, {{1}}}}, {1, 2, {{{2}}, {{3}}}}}));
  EXPECT_FALSE(is_c1(Field1{{0, 1, {{{0}}, {{1}}}}, {1, 2, {{{1}}, {{3}}}}}));
}

TEST(Piecewise, Law7_JoinedIsTheSplineWithThesePieces) {
  RandomRationals random;
  for (int degree = 1; degree <= 5; ++degree)
    for (int multiplicity = 1; multiplicity <= degree + 1; ++multiplicity) {
      std::vector<Rational> knots(degree + 1, kBreaks.front());
      for (const Rational& t : {kBreaks[1], kBreaks[2]}) knots.insert(knots.end(), multiplicity, t);
      knots.insert(knots.end(), degree + 1, kBreaks.back());
      const PlaneCurve source = curve_on(random, degree, knots);
      const PlaneCurve again = joined(extract_bezier(source), multiplicity);
      EXPECT_EQ(again.knots().knots(), knots);
      expect_same_curve(source, again);
    }
  const Curve2 torn = random_pieces<2>(random, 3, kBreaks);
  const PlaneCurve kept = joined(torn, 4);
  for (const Rational& t : middles(kBreaks, {}))
    for (const Rational& x : {t, Rational(t + "1/100"_q)}) EXPECT_EQ(evaluate(kept, x), value(torn, x));
  EXPECT_THROW((void)joined(torn, 0), contract_error);
  EXPECT_THROW((void)joined(torn, 5), contract_error);
}

// Pieces whose first derivatives up to order[i] agree at break i + 1, and not the next.
Curve2 pieces_of_order(RandomRationals& random, int degree, const std::vector<Rational>& at,
                       const std::vector<int>& orders) {
  Curve2 out = random_pieces<2>(random, degree, at);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const Rational begin = at[i + 1], length = at[i + 2] - at[i + 1];
    // The left polynomial continued, plus a multiple of (t − begin)^(order + 1).
    std::vector<Vec<Rational, 2>> points = out[i].points;
    const Rational left = at[i + 1] - at[i];
    for (const std::size_t c : {0u, 1u}) {
      std::vector<Rational> b;
      for (const auto& p : out[i].points) b.push_back(p[c]);
      Polynomial next = from_bernstein(b).compose(Polynomial({Rational(1), Rational(length / left)}));
      if (orders[i] < degree) {
        std::vector<Rational> term(orders[i] + 2, Rational(0));
        term.back() = c == 0 ? Rational(2) : Rational(0);  // one coordinate is enough to tear them
        next = next + Polynomial(term);
      }
      next.c.resize(degree + 1, Rational(0));
      // b_l = Σ_j C(l,j)/C(degree,j) a_j
      for (int l = 0; l <= degree; ++l) {
        Rational sum(0), ratio(1);
        for (int j = 0; j <= l; ++j) {
          sum += ratio * next.c[j];
          ratio = ratio * Rational(l - j) / Rational(degree - j == 0 ? 1 : degree - j);
        }
        points[l][c] = sum;
      }
    }
    out[i + 1].points = points;
  }
  return out;
}

TEST(Piecewise, Law8_JoinedSmoothlyHasTheKnotsThatAreNeeded) {
  RandomRationals random;
  for (int degree = 0; degree <= 5; ++degree)
    for (int first = -1; first <= degree; ++first)
      for (int second = -1; second <= degree; ++second) {
        const Curve2 f = pieces_of_order(random, degree, kBreaks, {first, second});
        EXPECT_EQ(agreement(f, 0), first) << degree;
        EXPECT_EQ(agreement(f, 1), second) << degree;
        const PlaneCurve s = joined_smoothly(f);
        EXPECT_EQ(s.degree(), degree);
        EXPECT_EQ(s.knots().multiplicity(kBreaks[1]), degree - first);
        EXPECT_EQ(s.knots().multiplicity(kBreaks[2]), degree - second);
        EXPECT_EQ(s.knots().multiplicity(kBreaks[0]), degree + 1);
        expect_same(refine(f, kBreaks), refine(Curve2(extract_bezier(s)), kBreaks));
      }
}

TEST(Piecewise, Law8_SeveralFunctionsOnCommonKnots) {
  RandomRationals random;
  const std::vector<Curve2> all{pieces_of_order(random, 4, kBreaks, {2, 4}),
                                pieces_of_order(random, 4, kBreaks, {3, 3}),
                                pieces_of_order(random, 4, kBreaks, {4, 4})};
  const KnotVector<Rational> knots = smoothest_knots(all);
  EXPECT_EQ(knots.multiplicity(kBreaks[1]), 2);
  EXPECT_EQ(knots.multiplicity(kBreaks[2]), 1);
  for (const Curve2& f : all) expect_same(f, refine(Curve2(extract_bezier(join_pieces(f, knots))), kBreaks));
  EXPECT_EQ(smoothest_knots(std::vector<Curve2>{all[2]}).knots(),
            KnotVector<Rational>::bezier(4, kBreaks.front(), kBreaks.back()).knots());
}

template <class T>
class PiecewiseScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(PiecewiseScalars, AllScalars, ScalarNames);

template <class S, std::size_t N>
Piecewise<S, N> in(const Piecewise<Rational, N>& f) {
  Piecewise<S, N> out;
  for (const auto& piece : f)
    out.push_back({make_knot<S>(piece.begin), make_knot<S>(piece.end), make_points<S>(piece.points)});
  return out;
}

TYPED_TEST(PiecewiseScalars, Law1To5_InEveryScalar) {
  RandomRationals random;
  const Curve2 f = random_pieces<2>(random, 3, {0, "1/4"_q, 1}), g = random_pieces<2>(random, 2, {0, "5/8"_q, 1});
  const Field1 k = random_pieces<1>(random, 1, {0, "1/2"_q, 1});
  const auto formula = [&]<class S>(int order, Side side) {
    using K = knot_scalar_t<S>;
    const auto h = part(derivative(sum(product(in<S>(k), in<S>(f)), scale(make<S>(3), in<S>(g)))),
                        make_knot<S>("3/4"_q), make_knot<S>("1/8"_q));
    return value(h, K(make_knot<S>("3/16"_q)), order, side);
  };
  for (const int order : {0, 1, 2})
    for (const Side side : {Side::left, Side::right}) {
      const Vec<Rational, 2> exact = formula.template operator()<Rational>(order, side);
      // By the values: h(t) = (k f + 3 g)′(3/4 − 5 t/8)
      const Rational x = "3/4"_q - "5/8"_q * "3/16"_q;
      Rational inner(1);
      for (int i = 0; i < order; ++i) inner *= "-5/8"_q;
      for (const std::size_t c : {0u, 1u}) {
        const Polynomial sum = polynomial_at(k, x, Side::right, 0) * polynomial_at(f, x, Side::right, c) +
                               Polynomial({Rational(3)}) * polynomial_at(g, x, Side::right, c);
        EXPECT_EQ(exact[c], inner * sum.derivative(order + 1)(x));
      }
      check<TypeParam>(exact, [&]<class S>() { return formula.template operator()<S>(order, side); });
    }
}

}  // namespace
}  // namespace patchproof::test
