// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/gerbs_spline.h"

#include <gtest/gtest.h>

#include "support/curves.h"
#include "support/gerbs.h"

namespace patchproof::test {
namespace {

using Gerbs = GerbsCurve<Rational, 3>;
using Local = LocalCurve<Rational, 3>;
using Spline = BsplineCurve<Rational, 3>;

const std::vector<Rational> kBreaks{0, 1, "5/4"_q, 3};
constexpr Weights kWeights[] = {Weights::one, Weights::common, Weights::different};

// Whether two rational pieces are one: A1 W2 = A2 W1, decided in as many places as the degrees ask for.
void expect_same_pieces(const Gerbs& f, const Spline& s) {
  EXPECT_EQ(s.knots().domain_begin(), f.knots().domain_begin());
  EXPECT_EQ(s.knots().domain_end(), f.knots().domain_end());
  const std::vector<Rational> at = f.breaks();
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    for (const Rational& t : enough_parameters(at[i], at[i + 1], 2 * s.degree()))
      for (const Side side : {Side::left, Side::right}) {
        if (t == (side == Side::left ? at[i] : at[i + 1])) continue;
        EXPECT_EQ((derivatives_at<Rational>(Local(s), t, side, t, 0)),
                  (reference_derivatives<Rational>(f, t, side, t, 0)))
            << t;
      }
}

int degree_of(const BFunction& b) {
  return static_cast<int>(std::max(b.numerator().size(), b.denominator().size())) - 1;
}

// ---- (1) ----------------------------------------------------------------------------------------------------------------

TEST(GerbsSpline, Law1_TheSameCurve) {
  RandomRationals random;
  for (const std::string& name : kExactB)
    for (const bool closed : {false, true})
      for (const Weights weights : kWeights) {
        SCOPED_TRACE(name);
        const Gerbs f = random_gerbs(random, b_function(name), kBreaks, closed, weights);
        const Spline s = to_spline(f).value();
        expect_same_pieces(f, s);
        const int local = weights == Weights::one ? 3 : 2;
        EXPECT_EQ(s.degree(), degree_of(f.b_function()) + (weights == Weights::different ? 2 * local : local));
      }
}

// A common weight that is no constant: the local curves are images of one model.
TEST(GerbsSpline, Law1_CommonWeightsKeepTheDegreeLow) {
  RandomRationals random;
  const Local model(random_spline<3>(random, 0, 3, 3, 2, Weights::different));
  std::vector<Local> locals;
  for (int i = 0; i < 4; ++i)
    locals.push_back(model.map_points([i](Vec<Rational, 3> p) {
      p[i % 2] += Rational(i * i) * p[2];
      return p;
    }));
  for (const char* name : {"polynomial(1)", "rational(2)"}) {
    const Gerbs f = Gerbs::make(b_function(name), gerbs_knots(kBreaks, false).value(), locals).value();
    const Spline s = to_spline(f).value();
    expect_same_pieces(f, s);
    EXPECT_EQ(s.degree(), 3 + degree_of(f.b_function()));
  }
}

TEST(GerbsSpline, Law1_KnotsAreAsFewAsThePiecesNeed) {
  RandomRationals random;
  for (const char* name : {"polynomial(0)", "polynomial(2)", "beta(2,1)"}) {
    const Gerbs f = random_gerbs(random, b_function(name), kBreaks, false, Weights::one, 1);
    const Spline s = to_spline(f).value();
    int inner = 0;
    for (const Rational& t : s.knots().breaks()) {
      if (t == 0 || t == 3) continue;
      ++inner;
      EXPECT_EQ(s.knots().multiplicity(t), s.degree() - smoothness_at(s, t).order) << t;
    }
    EXPECT_EQ(inner, static_cast<int>(f.breaks().size()) - 2);
    EXPECT_EQ(s.knots().multiplicity(0), s.degree() + 1);
  }
  // One model: no inner knot is left, whatever was blended.
  const Spline g = random_spline<3>(random, 0, 3, 3, 0, Weights::one);
  const Gerbs same = Gerbs::make(BFunction(), gerbs_knots(kBreaks, false).value(), std::vector<Local>(4, g)).value();
  expect_same_curve(to_spline(same).value(), g);
  EXPECT_EQ(to_spline(same).value().knots(), g.knots());
}

// Hermite as an identity of the converted spline: its derivatives at a centre are those of the local curve.
TEST(GerbsSpline, Law1_HermiteOfTheConvertedSpline) {
  RandomRationals random;
  for (const std::string& name : kExactB)
    for (const Weights weights : kWeights) {
      const Gerbs f = random_gerbs(random, b_function(name), kBreaks, true, weights, 0);
      const Local s(to_spline(f).value());
      const int n = *f.b_function().order();
      for (int i = 0; i < 4; ++i)
        for (const Side side : {Side::left, Side::right}) {
          if ((i == 0 && side == Side::left) || (i == 3 && side == Side::right)) continue;
          const Rational t = f.centre(i);
          EXPECT_EQ((derivatives_at<Rational>(s, t, side, t, n)),
                    (derivatives_at<Rational>(f.locals()[i], t, side, t, n)));
        }
    }
}

TEST(GerbsSpline, Law1_JumpsAndTinySpans) {
  RandomRationals random;
  const Rational tiny = Rational(1) / Rational(1LL << 40), far(1000000);
  const auto knots =
      KnotVector<Rational>::make(1, {far, far, far + tiny, far + tiny, far + Rational(1), far + Rational(1)}).value();
  std::vector<Local> locals;
  for (int i = 0; i < 4; ++i)
    locals.push_back(random_spline<3>(random, far, far + Rational(1), 2, 1, Weights::different));
  const Gerbs f = Gerbs::make(b_function("rational(1)"), knots, locals).value();
  const Spline s = to_spline(f).value();
  expect_same_pieces(f, s);
  EXPECT_EQ(s.knots().multiplicity(far + tiny), s.degree() + 1) << "the curve jumps";
}

TEST(GerbsSpline, TranscendentalCurvesAreNoSplines) {
  RandomRationals random;
  for (const std::string& name : kTranscendentalB) {
    const auto made = to_spline(random_gerbs(random, b_function(name), kBreaks, false));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::unsupported);
    EXPECT_EQ(made.error().values, b_function(name).to_string());
  }
  const Local turn = Local::trigonometric({{{1, 2, 1}}, {{1, 0, 0}}, {{0, 1, 0}}}).value();
  const auto made =
      to_spline(Gerbs::make(BFunction(), gerbs_knots(kBreaks, false).value(), std::vector<Local>(4, turn)).value());
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::unsupported);
}

// ---- (2) ----------------------------------------------------------------------------------------------------------------

bool contains(const Interval& x, const Rational& exact) {
  return from_double(x.inf()) <= exact && exact <= from_double(x.sup());
}

TEST(GerbsSpline, Law2_ExactSmoothnessAndItsJump) {
  const RoundingGuard guard;
  RandomRationals random;
  for (const std::string& name : kExactB)
    for (const Weights weights : kWeights) {
      SCOPED_TRACE(name);
      const Gerbs f = random_gerbs(random, b_function(name), kBreaks, false, weights, 1);
      const auto found = smoothness(f);
      const std::vector<Rational> breaks = f.breaks();
      ASSERT_EQ(found.size() + 2, breaks.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        const auto& here = found[k];
        EXPECT_EQ(here.t, breaks[k + 1]);
        EXPECT_TRUE(here.exact);
        if (here.order == kOneFunction) continue;
        const auto left = reference_derivatives<Rational>(f, here.t, Side::left, here.t, here.order + 1),
                   right = reference_derivatives<Rational>(f, here.t, Side::right, here.t, here.order + 1);
        for (int r = 0; r <= here.order; ++r) EXPECT_EQ(left[r], right[r]);
        const Vec<Rational, 2> jump = right.back() - left.back();
        EXPECT_NE(jump, (Vec<Rational, 2>{}));
        for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(contains((*here.jump)[c], jump[c]));
        // At a knot, where local curves have none, it is the order of B.
        if (f.knots().multiplicity(here.t) == 1 && here.t != breaks[0]) {
          const int i = f.knots().find_span(here.t);
          if (f.locals()[i - 1].basis().knots()->multiplicity(here.t) == 0) {
            EXPECT_GE(here.order, *f.b_function().order());
          }
        }
      }
    }
}

TEST(GerbsSpline, Law2_TheOrderOfBAndNotMore) {
  const RoundingGuard guard;
  RandomRationals random;
  for (int n = 0; n <= 3; ++n)
    for (const std::string family : {"polynomial", "rational"}) {
      const Gerbs f = random_gerbs(random, b_function(family + "(" + std::to_string(n) + ")"), kBreaks, true,
                                   Weights::different, 0);
      for (const auto& here : smoothness(f)) EXPECT_EQ(here.order, n);
    }
  // The same local curves everywhere are one function.
  const Spline g = random_spline<3>(random, 0, 3, 3, 0, Weights::different);
  const Gerbs one = Gerbs::make(BFunction(), gerbs_knots(kBreaks, false).value(), std::vector<Local>(4, g)).value();
  for (const auto& here : smoothness(one)) {
    EXPECT_EQ(here.order, kOneFunction);
    EXPECT_FALSE(here.jump);
  }
}

TEST(GerbsSpline, Law2_TranscendentalFunctions) {
  const RoundingGuard guard;
  RandomRationals random;
  const Gerbs round = random_gerbs(random, b_function("trigonometric"), kBreaks, false, Weights::one, 0);
  for (const auto& here : smoothness(round)) {
    EXPECT_EQ(here.order, 1);
    EXPECT_TRUE(here.exact) << "the second derivative jumps by a number that is not 0";
    const auto left = reference_derivatives<Ball>(round, here.t, Side::left, here.t, 2)[2],
               right = reference_derivatives<Ball>(round, here.t, Side::right, here.t, 2)[2];
    for (const std::size_t c : {0u, 1u}) {
      const Interval truth = Ball(right[c] - left[c]).to_interval(), jump = (*here.jump)[c];
      EXPECT_TRUE(jump.inf() <= truth.sup() && truth.inf() <= jump.sup());
      EXPECT_LT(jump.sup() - jump.inf(), 1e-10);
    }
  }
  for (const std::string& name : kFlatB) {
    const Gerbs flat = random_gerbs(random, b_function(name), kBreaks, false, Weights::different, 0);
    for (const auto& here : smoothness(flat)) {
      EXPECT_EQ(here.order, kOneFunction) << "all derivatives agree";
      EXPECT_TRUE(here.exact);
      EXPECT_FALSE(here.jump);
    }
    // A knot of a local curve decides where it has one.
    const Gerbs knotted = random_gerbs(random, b_function(name), kBreaks, false, Weights::one, 1);
    for (const auto& here : smoothness(knotted))
      if (knotted.knots().multiplicity(here.t) == 0) {
        EXPECT_LE(here.order, 2);
        EXPECT_TRUE(here.jump.has_value());
      }
  }
}

TEST(GerbsSpline, Law2_ADoubleKnotIsAJump) {
  const RoundingGuard guard;
  RandomRationals random;
  for (const char* name : {"polynomial(1)", "logistic"}) {
    std::vector<Local> locals;
    for (int i = 0; i < 4; ++i) locals.push_back(random_spline<3>(random, 0, 3, 2, 0, Weights::one));
    const Gerbs f =
        Gerbs::make(b_function(name), KnotVector<Rational>::make(1, {0, 0, 1, 1, 3, 3}).value(), locals).value();
    const auto found = smoothness(f);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].order, -1);
    EXPECT_TRUE(found[0].exact);
    const auto jump = derivatives_at<Rational>(locals[2], Rational(1), Side::right, Rational(1), 0)[0] -
                      derivatives_at<Rational>(locals[1], Rational(1), Side::right, Rational(1), 0)[0];
    for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(contains((*found[0].jump)[c], jump[c]));
  }
}

// Where the next derivative does not jump, "at least" is all that is said.
TEST(GerbsSpline, Law2_AtLeastIsSaidWhereTheJumpIsNotSeen) {
  const RoundingGuard guard;
  // Two lines that meet at 1 in their value: sin²(πt/2) makes them meet in second order too, by chance.
  const auto line = [](int slope) {
    return Local(Spline(KnotVector<Rational>::bezier(1, 0, 3), {{{0, -slope, 1}}, {{3, 2 * slope, 1}}}));
  };
  const Gerbs f = Gerbs::make(b_function("trigonometric"), gerbs_knots<Rational>({0, 1, 3}, false).value(),
                              {line(1), line(2), line(-1)})
                      .value();
  const auto found = smoothness(f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].order, 1);
  EXPECT_FALSE(found[0].exact);
  ASSERT_TRUE(found[0].jump.has_value());
  for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(contains((*found[0].jump)[c], 0));
}

}  // namespace
}  // namespace patchproof::test
