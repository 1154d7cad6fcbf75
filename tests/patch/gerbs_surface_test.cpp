// SPDX-License-Identifier: Apache-2.0
#include "patchproof/patch/gerbs_surface.h"

#include <gtest/gtest.h>

#include "patchproof/patch/patch_knots.h"
#include "support/gerbs_surfaces.h"

namespace patchproof::test {
namespace {

using Numbers = std::vector<Rational>;

const Numbers kU{0, 1, 3}, kV{-1, 0, "1/2"_q};
const char* const kSomeB[] = {"polynomial(0)", "polynomial(2)", "beta(2,1)", "rational(1)"};
constexpr Weights kWeights[] = {Weights::one, Weights::common, Weights::different};

Place later(Place at, const Rational& u, const Rational& v) { return {at.u + u, at.v + v, at.side_u, at.side_v}; }

// ---- (1) ----------------------------------------------------------------------------------------------------------------

TEST(GerbsSurface, Law1_TheFormulaInExactNumbers) {
  RandomRationals random;
  for (const char* b : kSomeB)
    for (const int closed : {0, 1, 2, 3}) {
      SCOPED_TRACE(b);
      const Surface s = random_surface(random, b_function(b), kU, closed & 1, kV, closed & 2, kWeights[closed % 3]);
      EXPECT_TRUE(s.is_exact());
      EXPECT_EQ(s.axis(Direction::u).distinct(), closed & 1 ? 2 : 3);
      for (const Place& at : sided_places(s))
        EXPECT_EQ(partials<Rational>(s, at, 2, 2), reference_derivatives<Rational>(s, at, 2, 2));
    }
}

template <class T>
class GerbsSurfaceScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(GerbsSurfaceScalars, AllScalars, ScalarNames);

TYPED_TEST(GerbsSurfaceScalars, Law1_TheFormulaInEveryScalar) {
  RandomRationals random;
  for (const char* b : {"polynomial(1)", "rational(1)"}) {
    const Surface s = random_surface(random, b_function(b), {0, 1, 3}, true, {-1, 0, 1}, false, Weights::different);
    for (const Place& at : {Place{"3/4"_q, "-1/4"_q, Side::right, Side::right}, Place{3, 0, Side::left, Side::left},
                            Place{1, "1/2"_q, Side::right, Side::left}})
      check<TypeParam>(reference_derivatives<Rational>(s, at, 1, 2),
                       [&]<class S>() { return partials<S>(s, at, 1, 2); });
  }
}

TEST(GerbsSurface, Law1_TranscendentalOnesAreEnclosed) {
  const RoundingGuard guard;
  using Model = TaylorModel<3>;
  RandomRationals random;
  for (const std::string& b : kTranscendentalB) {
    SCOPED_TRACE(b);
    const Surface s = random_surface(random, b_function(b), kU, true, kV, false, Weights::different);
    EXPECT_FALSE(s.is_exact());
    for (const Place& at : sided_places(s))
      expect_overlap(partials<Ball>(s, at, 1, 1), reference_derivatives<Ball>(s, at, 1, 1));
    const Place at{"1/2"_q, "-1/3"_q, Side::right, Side::right};
    const Rational radius = "1/256"_q;
    // Along the diagonal of a small square.
    const auto models = partial_derivatives_at<Model>(
        s, std::array<Rational, 2>{at.u, at.v}, std::array<Side, 2>{Side::right, Side::right},
        Model::variable(embed<Interval>(at.u), embed<Interval>(radius)),
        Model::variable(embed<Interval>(at.v), embed<Interval>(radius)), 1, 1);
    for (const Rational& x : {Rational(-1), "1/3"_q, Rational(1)}) {
      const auto truth = reference_derivatives<Ball>(s, later(at, x * radius, x * radius), 1, 1);
      for (const int k : {0, 1})
        for (const int l : {0, 1})
          for (const std::size_t c : {0u, 1u, 2u}) {
            const Interval exact = truth[2 * k + l][c].to_interval(),
                           model = models.at(k, l)[c].value(embed<Interval>(x));
            EXPECT_TRUE(model.inf() <= exact.sup() && exact.inf() <= model.sup());
            EXPECT_LT(model.sup() - model.inf(), 0.05);
          }
    }
    const auto rounded = partials<double>(s, at, 0, 0)[0];
    const auto exact = partials<Ball>(s, at, 0, 0)[0];
    for (const std::size_t c : {0u, 1u, 2u})
      EXPECT_LT(std::fabs(Ball(exact[c] - Ball(rounded[c])).to_interval().sup()), 1e-12);
  }
}

// ---- (2) ----------------------------------------------------------------------------------------------------------------

TEST(GerbsSurface, Law2_HermiteFromAllFourSides) {
  RandomRationals random;
  for (const char* name : kSomeB)
    for (const bool closed : {false, true}) {
      const Surface s = random_surface(random, b_function(name), kU, closed, kV, closed, Weights::different);
      const int n = *s.b_function().order();
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          for (const Side side_u : {Side::left, Side::right})
            for (const Side side_v : {Side::left, Side::right}) {
              const Place at{kU[p], kV[q], side_u, side_v};
              EXPECT_EQ(partials<Rational>(s, at, n, n), partials<Rational>(s.local(p, q), at, n, n));
            }
      // Across a knot line, n derivatives and no more.
      const auto left = partials<Rational>(s, {1, "-1/3"_q, Side::left, Side::left}, n + 1, 0),
                 right = partials<Rational>(s, {1, "-1/3"_q, Side::right, Side::left}, n + 1, 0);
      for (int k = 0; k <= n; ++k) EXPECT_EQ(left[k], right[k]);
      EXPECT_NE(left[n + 1], right[n + 1]);
    }
}

TEST(GerbsSurface, Law2_FlatFunctionsGiveEveryDerivative) {
  RandomRationals random;
  for (const std::string& name : kFlatB) {
    const Surface s = random_surface(random, b_function(name), kU, false, kV, true, Weights::different);
    const Place at{1, 0, Side::left, Side::right};
    EXPECT_EQ(partials<Rational>(s, at, 3, 3), partials<Rational>(s.local(1, 1), at, 3, 3));
  }
}

// ---- (3), (4) -----------------------------------------------------------------------------------------------------------

TEST(GerbsSurface, Law3_OneSurfaceIsReproduced) {
  RandomRationals random;
  for (const Weights weights : kWeights) {
    const auto patch = random_patch(random, {0, 3, -1, "1/2"_q}, true, weights);
    const SurfaceLocal g(patch), again(insert_knot(patch, Direction::u, Rational("2/3"_q)));
    ASSERT_NE(g, again);
    for (const char* b : kSomeB) {
      const Surface::Axis u{gerbs_knots(kU, false).value()}, v{gerbs_knots(kV, false).value()};
      for (const auto& locals :
           {std::vector<SurfaceLocal>(9, g), std::vector<SurfaceLocal>{g, again, g, again, g, again, g, g, again}}) {
        const Surface s = Surface::make(b_function(b), u, v, locals).value();
        for (const Place& at : sided_places(s))
          EXPECT_EQ(partials<Rational>(s, at, 2, 2), partials<Rational>(g, at, 2, 2));
      }
    }
  }
}

TEST(GerbsSurface, Law4_ClosedSurfacesEndAsTheyBegin) {
  RandomRationals random;
  for (const char* name : kSomeB) {
    const Surface s = random_surface(random, b_function(name), kU, true, kV, true, Weights::different);
    const int n = *s.b_function().order();
    for (const Rational& t : {"-3/4"_q, Rational(0), "1/3"_q})
      for (const Side side : {Side::left, Side::right})
        EXPECT_EQ(partials<Rational>(s, {0, t, Side::right, side}, n, n),
                  partials<Rational>(s, {3, t, Side::left, side}, n, n));
    for (const Rational& t : {"1/2"_q, Rational(1), Rational(2)})
      EXPECT_EQ(partials<Rational>(s, {t, -1, Side::left, Side::right}, n, n),
                partials<Rational>(s, {t, "1/2"_q, Side::left, Side::left}, n, n));
    EXPECT_EQ(s.local(2, 2), s.local(0, 0).shifted(3, "3/2"_q));
    EXPECT_EQ(s.local(1, 2), s.local(1, 0).shifted(0, "3/2"_q));
  }
  for (const std::string& name : kFlatB) {
    const Surface s = random_surface(random, b_function(name), kU, true, kV, false);
    EXPECT_EQ(partials<Rational>(s, {0, 0, Side::right, Side::left}, 3, 3),
              partials<Rational>(s, {3, 0, Side::left, Side::left}, 3, 3));
  }
}

// ---- (5) ----------------------------------------------------------------------------------------------------------------

TEST(GerbsSurface, Law5_EdgesAreGerbsCurves) {
  RandomRationals random;
  for (const char* b : {"polynomial(1)", "rational(2)"})
    for (const bool closed : {false, true})
      for (const Weights weights : {Weights::one, Weights::different}) {
        const Surface s = random_surface(random, b_function(b), kU, closed, kV, false, weights, true);
        const auto box = s.domain();
        EXPECT_EQ(box, (ParameterBox<Rational>{0, 3, -1, "1/2"_q}));
        for (const EdgeName name : {EdgeName::u_min, EdgeName::u_max, EdgeName::v_min, EdgeName::v_max}) {
          const bool of_u = name == EdgeName::u_min || name == EdgeName::u_max,
                     first = name == EdgeName::u_min || name == EdgeName::v_min;
          for (int order = 0; order <= (weights == Weights::one ? 1 : 0); ++order) {
            const auto curve = edge(s, name, order);
            EXPECT_EQ(curve.knots(), s.knots(of_u ? Direction::v : Direction::u));
            EXPECT_EQ(curve.is_closed(), !of_u && closed);
            for (const auto& [t, side] : std::vector<std::pair<Rational, Side>>{{curve.breaks()[0], Side::right},
                                                                                {curve.breaks()[1], Side::left},
                                                                                {"1/3"_q, Side::left},
                                                                                {"1/2"_q, Side::left}}) {
              const Side across = first ? Side::right : Side::left;
              const Place at = of_u ? Place{first ? box.u_begin : box.u_end, t, across, side}
                                    : Place{t, first ? box.v_begin : box.v_end, side, across};
              const auto expected = of_u ? partials<Rational>(s, at, order, 2) : partials<Rational>(s, at, 2, order);
              const auto found = derivatives_at<Rational>(curve, t, side, t, 2);
              for (int r = 0; r <= 2; ++r)
                EXPECT_EQ(found[r], expected[of_u ? order * 3 + r : r * (order + 1) + order]) << to_string(name);
            }
          }
        }
      }
}

// ---- what is refused, and limits ------------------------------------------------------------------------------------------

TEST(GerbsSurface, ErrorsNameTheDirection) {
  RandomRationals random;
  const SurfaceLocal g(random_patch(random, {0, 3, -1, "1/2"_q}, false, Weights::one)),
      narrow(random_patch(random, {0, 1, -1, "1/2"_q}, false, Weights::one));
  const Surface::Axis u{gerbs_knots(kU, false).value()}, v{gerbs_knots(kV, false).value()},
      ring{gerbs_knots(kV, true).value(), true};
  const auto error = [](const auto& made) { return made.error(); };
  const Error few = error(Surface::make(BFunction(), u, v, std::vector<SurfaceLocal>(8, g)));
  EXPECT_EQ(few.code, ErrorCode::wrong_count);
  EXPECT_EQ(few.message, "the knots need 3 x 3 local surfaces");
  EXPECT_EQ(few.values, "8");
  EXPECT_EQ(error(Surface::make(BFunction(), u, ring, std::vector<SurfaceLocal>(9, g))).message,
            "the knots need 3 x 2 local surfaces");

  std::vector<SurfaceLocal> one_short(9, g);
  one_short[5] = narrow;
  const Error outside = error(Surface::make(BFunction(), u, v, one_short));
  EXPECT_EQ(outside.code, ErrorCode::outside_domain);
  EXPECT_EQ(outside.message, "local surface (1, 2) is not defined everywhere it is used in u");
  EXPECT_EQ(outside.values, "0 … 3");
  const Error seam = error(Surface::make(BFunction(), u, ring, std::vector<SurfaceLocal>(6, g)));
  EXPECT_EQ(seam.code, ErrorCode::outside_domain);
  EXPECT_EQ(seam.message, "local surface (0, 2) is not defined everywhere it is used in v");

  const Error open_knots =
      error(Surface::make(BFunction(), u, {gerbs_knots(kV, false).value(), true}, std::vector<SurfaceLocal>(6, g)));
  EXPECT_EQ(open_knots.code, ErrorCode::not_closed);
  EXPECT_EQ(open_knots.message.substr(0, 6), "in v: ");
  const Error degree =
      error(Surface::make(BFunction(), {KnotVector<Rational>::bezier(2)}, v, std::vector<SurfaceLocal>(9, g)));
  EXPECT_EQ(degree.code, ErrorCode::bad_degree);
  EXPECT_EQ(degree.message.substr(0, 6), "in u: ");
  EXPECT_FALSE(Surface::make(BFunction(), u, v, {}));
}

TEST(GerbsSurface, FarOffsetsTinySpansAndDoubleKnots) {
  RandomRationals random;
  const Rational tiny = Rational(1) / Rational(1LL << 40), far(1000000);
  const Surface::Axis u{
      KnotVector<Rational>::make(1, {far, far, far + tiny, far + tiny, far + Rational(1), far + Rational(1)}).value()},
      v{gerbs_knots<Rational>({0, tiny}, false).value()};
  std::vector<SurfaceLocal> locals;
  for (int k = 0; k < 8; ++k)
    locals.push_back(random_patch(random, {far, far + Rational(1), 0, tiny}, false, Weights::different));
  for (const char* b : kSomeB) {
    const Surface s = Surface::make(b_function(b), u, v, locals).value();
    for (const Place& at : sided_places(s))
      EXPECT_EQ(partials<Rational>(s, at, 1, 1), reference_derivatives<Rational>(s, at, 1, 1));
    EXPECT_NE(partials<Rational>(s, {far + tiny, 0, Side::left, Side::right}, 0, 0),
              partials<Rational>(s, {far + tiny, 0, Side::right, Side::right}, 0, 0));
  }
}

TEST(GerbsSurface, MapLocalsMapsEachOne) {
  RandomRationals random;
  const Surface s = random_surface(random, b_function("polynomial(2)"), kU, true, kV, false, Weights::different);
  const Surface lifted = s.map_locals([](const SurfaceLocal& c) {
    return c.map_points([](Vec<Rational, 4> p) {
      p[2] += Rational(5) * p[3];
      return p;
    });
  });
  for (const Place& at : sided_places(s)) {
    auto expected = partials<Rational>(s, at, 1, 1);
    expected[0][2] += Rational(5);
    EXPECT_EQ(partials<Rational>(lifted, at, 1, 1), expected);
  }
}

}  // namespace
}  // namespace patchproof::test
