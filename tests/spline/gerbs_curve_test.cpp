// SPDX-License-Identifier: Apache-2.0
#include "patchproof/spline/gerbs_curve.h"

#include <gtest/gtest.h>

#include "patchproof/spline/knot_insertion.h"
#include "patchproof/spline/reparametrize.h"
#include "support/curves.h"
#include "support/gerbs.h"

namespace patchproof::test {
namespace {

using Gerbs = GerbsCurve<Rational, 3>;
using Local = LocalCurve<Rational, 3>;
using Spline = BsplineCurve<Rational, 3>;

const std::vector<Rational> kBreaks{0, 1, "5/4"_q, 3, "7/2"_q};
constexpr Weights kWeights[] = {Weights::one, Weights::common, Weights::different};

// ---- (1) the formula ------------------------------------------------------------------------------------------------

TEST(GerbsCurve, Law1_TheFormulaInExactNumbers) {
  RandomRationals random;
  for (const std::string& b : kExactB)
    for (const bool closed : {false, true})
      for (const Weights weights : kWeights) {
        SCOPED_TRACE(b);
        const Gerbs f = random_gerbs(random, b_function(b), kBreaks, closed, weights);
        EXPECT_TRUE(f.is_exact());
        EXPECT_EQ(f.locals().size(), 5u);
        for (const auto& [t, side] : sided_places(f))
          EXPECT_EQ((derivatives_at<Rational>(f, t, side, t, 4)), reference_derivatives<Rational>(f, t, side, t, 4))
              << t;
      }
}

template <class T>
class GerbsCurveScalars : public ScalarTest<T> {};
TYPED_TEST_SUITE(GerbsCurveScalars, AllScalars, ScalarNames);

TYPED_TEST(GerbsCurveScalars, Law1_TheFormulaInEveryScalar) {
  RandomRationals random;
  for (const char* b : {"polynomial(2)", "beta(2,1)", "rational(1)"})
    for (const bool closed : {false, true}) {
      const Gerbs f = random_gerbs(random, b_function(b), {0, 1, "3/2"_q, 4}, closed, Weights::different, 0);
      for (const auto& [t, side] : sided_places(f))
        check<TypeParam>(reference_derivatives<Rational>(f, t, side, t, 2), [&, at = t, from = side]<class S>() {
          return derivatives_at<S>(f, at, from, embed<S>(at), 2);
        });
    }
}

// Curves whose own numbers are doubles, or of Q(√2).
TEST(GerbsCurve, Law1_ControlPointsInOtherScalars) {
  const Quadratic root(Rational(0), Rational(1), 2);
  const auto in = [&]<class T>(const T& scale) {
    using K = knot_scalar_t<T>;
    std::vector<LocalCurve<T, 3>> locals;
    for (int i = 0; i < 3; ++i)
      locals.push_back(BsplineCurve<T, 3>(KnotVector<K>::bezier(1, K(i - 1), K(i + 1)),
                                          {{{T(i), scale, T(1)}}, {{scale * T(i + 1), T(2 - i), T(2)}}}));
    return GerbsCurve<T, 3>::make(b_function("polynomial(1)"),
                                  gerbs_knots(std::vector<K>{K(0), K(1), K(2)}, false).value(), std::move(locals))
        .value();
  };
  const Gerbs exact = in(Rational(3) / Rational(4));
  const auto rounded = in(0.75);
  const auto of_root = in(root);
  for (const Rational& t : {Rational(0), "1/4"_q, "11/8"_q, Rational(2)}) {
    const double x = nearest_double(t);
    with_bound(reference_derivatives<Rational>(exact, t, Side::left, t, 2),
               [&]<class S>() { return derivatives_at<S>(rounded, x, Side::left, embed<S>(x), 2); });
    // The points are linear in `scale`, and so is the curve.
    const auto zero = derivatives_at<Rational>(in(Rational(0)), t, Side::left, t, 2),
               one = derivatives_at<Rational>(in(Rational(1)), t, Side::left, t, 2);
    const auto of_two =
        derivatives_at<Quadratic>(of_root, embed<knot_scalar_t<Quadratic>>(t), Side::left, Quadratic(t), 2);
    for (int r = 0; r <= 2; ++r)
      for (const std::size_t c : {0u, 1u})
        EXPECT_TRUE(of_two[r][c] == Quadratic(zero[r][c]) + root * Quadratic(Rational(one[r][c] - zero[r][c])));
  }
}

TEST(GerbsCurve, Law1_TranscendentalFunctionsAreEnclosedByBalls) {
  RandomRationals random;
  for (const std::string& b : kTranscendentalB)
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(b);
      const Gerbs f = random_gerbs(random, b_function(b), kBreaks, closed, Weights::different);
      EXPECT_FALSE(f.is_exact());
      for (const auto& [t, side] : sided_places(f)) {
        const auto value = derivatives_at<Ball>(f, t, side, Ball(t), 3);
        expect_overlap(value, reference_derivatives<Ball>(f, t, side, t, 3));
        for (const auto& d : value)
          for (const std::size_t c : {0u, 1u}) EXPECT_LT(width(d[c]), 1e-18);
      }
    }
}

TEST(GerbsCurve, Law1_IntervalsAndModelsContainTheTranscendentalOnes) {
  const RoundingGuard guard;
  using Model = TaylorModel<4>;
  RandomRationals random;
  std::vector<std::string> all = kTranscendentalB;
  all.push_back("polynomial(2)");
  all.push_back("rational(1)");
  for (const std::string& b : all) {
    SCOPED_TRACE(b);
    const Gerbs f = random_gerbs(random, b_function(b), {0, 1, 3}, false, Weights::different, 0);
    // The second range begins at a knot, where the flat functions have an essential singularity.
    for (const auto& [centre, radius] : {std::pair("1/2"_q, "1/256"_q), std::pair("1/32"_q, "1/32"_q)}) {
      const auto models = derivatives_at<Model>(f, centre, Side::right,
                                                Model::variable(embed<Interval>(centre), embed<Interval>(radius)), 2);
      for (const Rational& s : {Rational(-1), "-1/3"_q, "1/2"_q, Rational(1)}) {
        const Rational t = centre + s * radius;
        const auto truth = reference_derivatives<Ball>(f, centre, Side::right, t, 2);
        const auto at_point = derivatives_at<Interval>(f, centre, Side::right, embed<Interval>(t), 2);
        for (int r = 0; r <= 2; ++r)
          for (const std::size_t c : {0u, 1u}) {
            const Interval exact = truth[r][c].to_interval(), model = models[r][c].value(embed<Interval>(s)),
                           point = at_point[r][c];
            EXPECT_TRUE(model.inf() <= exact.sup() && exact.inf() <= model.sup()) << r << " at " << t;
            EXPECT_TRUE(std::isfinite(model.inf()) && std::isfinite(model.sup()));
            if (centre == "1/2"_q) {
              EXPECT_LT(model.sup() - model.inf(), 0.01) << r;
            }
            EXPECT_TRUE(point.inf() <= exact.sup() && exact.inf() <= point.sup());
            EXPECT_LT(point.sup() - point.inf(), 1e-7);
          }
      }
    }
  }
}

// |rounded − exact| by the bound on B, and a few roundings of what is multiplied with it.
TEST(GerbsCurve, Law1_DoublesStayNearTheTranscendentalOnes) {
  RandomRationals random;
  for (const std::string& name : kTranscendentalB) {
    SCOPED_TRACE(name);
    const BFunction b = b_function(name);
    const Gerbs f = random_gerbs(random, b, {0, 1, 3}, false, Weights::one, 0);
    for (int i = 0; i <= 48; ++i) {
      const Rational t = Rational(i) / Rational(16);
      const Side side = i == 48 ? Side::left : Side::right;
      const int span = f.knots().find_span(t, side);
      const Rational h = f.knots()[span + 1] - f.knots()[span];
      const auto exact = reference_derivatives<Ball>(f, t, side, t, 2);
      const auto rounded = derivatives_at<double>(f, t, side, nearest_double(t), 2);
      const auto before = derivatives_at<Rational>(f.locals()[span - 1], t, side, t, 2),
                 after = derivatives_at<Rational>(f.locals()[span], t, side, t, 2);
      const auto of_b = derivatives(b, Ball(Rational((t - f.knots()[span]) / h)), 3);
      for (int r = 0; r <= 2; ++r)
        for (const std::size_t c : {0u, 1u}) {
          double bound = 0x1p-48 * (1 + std::fabs(nearest_double(before[r][c])));
          for (int j = 0; j <= r; ++j) {
            const auto size = [&](int k) {
              return std::max(std::fabs(of_b[k].to_interval().inf()), std::fabs(of_b[k].to_interval().sup()));
            };
            const double factor = std::fabs(nearest_double(Rational(after[r - j][c] - before[r - j][c]))) *
                                  (j == 1 && r == 2 ? 2 : 1) / std::pow(nearest_double(h), j);
            bound += factor * (double_error(b, j) + 0x1p-48 * (size(j) + size(j + 1)));
          }
          const Ball distance = exact[r][c] - Ball(rounded[r][c]);
          EXPECT_LE(std::fabs(distance.to_interval().sup()), bound) << r << " at " << t;
          EXPECT_LE(std::fabs(distance.to_interval().inf()), bound) << r << " at " << t;
          EXPECT_LT(bound, 1e-7);
        }
    }
  }
}

TEST(GerbsCurve, Law1_TrigonometricLocalCurves) {
  const auto turn = [](int i) {
    return Local::trigonometric({{{i, 1, 1}}, {{2, 0, "1/3"_q}}, {{0, 3 - i, "1/4"_q}}}).value();
  };
  for (const char* b : {"polynomial(2)", "trigonometric", "logistic"}) {
    const Gerbs f =
        Gerbs::make(b_function(b), gerbs_knots(kBreaks, false).value(), {turn(0), turn(1), turn(2), turn(1), turn(0)})
            .value();
    EXPECT_FALSE(f.is_exact());
    EXPECT_EQ(f.breaks(), kBreaks);
    for (const auto& [t, side] : sided_places(f))
      expect_overlap(derivatives_at<Ball>(f, t, side, Ball(t), 3), reference_derivatives<Ball>(f, t, side, t, 3));
  }
}

TEST(GerbsCurve, BreaksAreTheKnotsAndThoseOfLocalCurvesWhereTheyAreUsed) {
  RandomRationals random;
  const Spline wide = random_spline<3>(random, -4, 4, 3, 3, Weights::one);  // knots at −2, 0 and 2
  const Gerbs f = Gerbs::make(BFunction(), gerbs_knots<Rational>({-3, -1, 1, 3}, false).value(),
                              {wide, Local(random_spline<3>(random, -3, 1, 2, 1, Weights::one)),
                               Local(random_spline<3>(random, -1, 3, 2, 0, Weights::one)), wide})
                      .value();
  // wide is used up to −1 and from 1 on: its knot at 0 does not count; the second has one at −2 as well.
  EXPECT_EQ(f.breaks(), (std::vector<Rational>{-3, -2, -1, 1, 2, 3}));
  EXPECT_EQ(f.centre(0), -3);
  EXPECT_EQ(f.centre(2), 1);
}

// ---- (2) Hermite ----------------------------------------------------------------------------------------------------

// f^(r) = c_i^(r), and beyond the order of B the formula of the next derivative, from either side.
TEST(GerbsCurve, Law2_HermiteAndTheExactNextDerivative) {
  RandomRationals random;
  for (const std::string& name : kExactB)
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(name);
      const BFunction b = b_function(name);
      const Gerbs f = random_gerbs(random, b, kBreaks, closed, Weights::different, 0);
      for (int i = 0; i < f.knots().control_count(); ++i)
        for (const Side side : {Side::left, Side::right}) {
          if ((i == 0 && side == Side::left) || (i + 1 == f.knots().control_count() && side == Side::right)) continue;
          const Rational t = f.centre(i);
          const int n = side == Side::right ? *b.order_at_begin() : *b.order_at_end();
          const auto whole = derivatives_at<Rational>(f, t, side, t, n + 1),
                     local = derivatives_at<Rational>(f.locals()[i], t, side, t, n + 1);
          for (int r = 0; r <= n; ++r) EXPECT_EQ(whole[r], local[r]) << r << " at " << t;
          const int neighbour = side == Side::right ? i + 1 : i - 1;
          const auto other = derivatives_at<Rational>(f.locals()[neighbour], t, side, t, 0)[0];
          Rational factor = derivatives(b, Rational(side == Side::right ? 0 : 1), n + 1)[n + 1];
          for (int k = 0; k <= n; ++k) factor = factor / abs(Rational(f.centre(neighbour) - t));
          // right of the centre B (c_{i+1} − c_i) is added, left of it (1 − B)(c_{i−1} − c_i)
          if (side == Side::left) factor = -factor;
          EXPECT_EQ(whole[n + 1], local[n + 1] + factor * (other - local[0])) << "next at " << t;
          EXPECT_NE(factor, 0);
        }
    }
}

TEST(GerbsCurve, Law2_FlatFunctionsGiveEveryDerivative) {
  RandomRationals random;
  for (const std::string& name : kFlatB) {
    SCOPED_TRACE(name);
    const Gerbs f = random_gerbs(random, b_function(name), kBreaks, true, Weights::different, 0);
    for (int i = 1; i + 1 < f.knots().control_count(); ++i)
      for (const Side side : {Side::left, Side::right}) {
        const Rational t = f.centre(i);
        const auto local = derivatives_at<Rational>(f.locals()[i], t, side, t, 7);
        // Exact numbers too: at a knot B and all its derivatives are 0 or 1.
        EXPECT_EQ((derivatives_at<Rational>(f, t, side, t, 7)), local);
        const auto ball = derivatives_at<Ball>(f, t, side, Ball(t), 7);
        for (int r = 0; r <= 7; ++r)
          for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(ball[r][c].contains(local[r][c]));
      }
  }
}

TEST(GerbsCurve, Law2_TheTrigonometricFunctionHasOrderOne) {
  RandomRationals random;
  const Gerbs f = random_gerbs(random, b_function("trigonometric"), {0, 1, 3}, false, Weights::one, 0);
  const auto local = derivatives_at<Rational>(f.locals()[1], Rational(1), Side::right, Rational(1), 2),
             next = derivatives_at<Rational>(f.locals()[2], Rational(1), Side::right, Rational(1), 2);
  const auto right = derivatives_at<Ball>(f, Rational(1), Side::right, Ball(1), 2);
  for (const std::size_t c : {0u, 1u}) {
    for (const int r : {0, 1}) EXPECT_TRUE(right[r][c].contains(local[r][c]));
    // B″(0) = π²/2, h = 2
    const Ball second =
        Ball(local[2][c]) + Ball::pi() * Ball::pi() / Ball(8) * Ball(Rational(next[0][c] - local[0][c]));
    expect_overlap(right[2][c], second);
    EXPECT_FALSE(right[2][c].contains(local[2][c]));
  }
}

// ---- (3) reproduction, (4) affine maps --------------------------------------------------------------------------------

TEST(GerbsCurve, Law3_OneModelIsReproduced) {
  RandomRationals random;
  for (const Weights weights : kWeights) {
    const Spline g = random_spline<3>(random, 0, "7/2"_q, 3, 3, weights);
    // The same curve with more knots is another object: it goes through the blend.
    const Spline again = insert_knot(insert_knot(g, Rational("1/3"_q)), Rational(2), 2);
    for (const auto& locals : {std::vector<Local>(5, g), std::vector<Local>{g, again, g, again, g}})
      for (const std::string& b : kExactB) {
        SCOPED_TRACE(b);
        const Gerbs f = Gerbs::make(b_function(b), gerbs_knots(kBreaks, false).value(), locals).value();
        for (const auto& [t, side] : sided_places(f))
          EXPECT_EQ((derivatives_at<Rational>(f, t, side, t, 3)), (derivatives_at<Rational>(Local(g), t, side, t, 3)));
      }
    for (const std::string& b : kTranscendentalB) {
      const Gerbs f = Gerbs::make(b_function(b), gerbs_knots(kBreaks, false).value(), {g, again, g, again, g}).value();
      for (const auto& [t, side] : sided_places(f)) {
        const auto value = derivatives_at<Ball>(f, t, side, Ball(t), 3);
        const auto model = derivatives_at<Rational>(Local(g), t, side, t, 3);
        for (int r = 0; r <= 3; ++r)
          for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(value[r][c].contains(model[r][c]));
      }
    }
  }
}

TEST(GerbsCurve, Law4_OneAffineMapOfAllLocalCurves) {
  RandomRationals random;
  const auto map = [](const Vec<Rational, 3>& p) {
    return Vec<Rational, 3>{
        {"3/5"_q * p[0] - "4/5"_q * p[1] + p[2], "4/5"_q * p[0] + "8/5"_q * p[1] - "2/3"_q * p[2], p[2]}};
  };
  const auto mapped_value = []<class R>(const Vec<R, 2>& p, int order) {
    const R w(order == 0 ? 1 : 0);
    return Vec<R, 2>{{embed<R>("3/5"_q) * p[0] - embed<R>("4/5"_q) * p[1] + w,
                      embed<R>("4/5"_q) * p[0] + embed<R>("8/5"_q) * p[1] - embed<R>("2/3"_q) * w}};
  };
  std::vector<std::string> all = kExactB;
  all.insert(all.end(), kTranscendentalB.begin(), kTranscendentalB.end());
  for (const std::string& b : all)
    for (const bool closed : {false, true}) {
      SCOPED_TRACE(b);
      const Gerbs f = random_gerbs(random, b_function(b), kBreaks, closed, Weights::different, 0);
      std::vector<Local> locals;
      for (std::size_t i = 0; i < f.locals().size() - (closed ? 1 : 0); ++i)
        locals.push_back(f.locals()[i].map_points(map));
      const Gerbs g = Gerbs::make(f.b_function(), f.knots(), locals, closed).value();
      for (const auto& [t, side] : sided_places(f)) {
        if (f.is_exact()) {
          const auto before = derivatives_at<Rational>(f, t, side, t, 2),
                     after = derivatives_at<Rational>(g, t, side, t, 2);
          for (int r = 0; r <= 2; ++r) EXPECT_EQ(after[r], mapped_value(before[r], r));
        } else {
          const auto before = derivatives_at<Ball>(f, t, side, Ball(t), 2),
                     after = derivatives_at<Ball>(g, t, side, Ball(t), 2);
          for (int r = 0; r <= 2; ++r) expect_overlap(std::vector{after[r]}, std::vector{mapped_value(before[r], r)});
        }
      }
    }
}

}  // namespace
}  // namespace patchproof::test
