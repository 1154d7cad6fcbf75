// SPDX-License-Identifier: Apache-2.0
// Closed GERBS curves, blends of two curves, knots at their limits, and what is refused.
#include <gtest/gtest.h>

#include "patchproof/spline/gerbs_curve.h"
#include "patchproof/spline/reparametrize.h"
#include "support/curves.h"
#include "support/gerbs.h"

namespace patchproof::test {
namespace {

using Gerbs = GerbsCurve<Rational, 3>;
using Local = LocalCurve<Rational, 3>;
using Spline = BsplineCurve<Rational, 3>;

// ---- (5) closed curves ------------------------------------------------------------------------------------------------

TEST(GerbsCurveClosed, Law5_TheEndContinuesAtTheBegin) {
  RandomRationals random;
  for (const std::vector<Rational>& breaks :
       {std::vector<Rational>{0, 1, "5/4"_q, 3, "7/2"_q}, std::vector<Rational>{-1, 2}, std::vector<Rational>{5, 6, 9}})
    for (const std::string& name : kExactB) {
      SCOPED_TRACE(name);
      const BFunction b = b_function(name);
      const Gerbs f = random_gerbs(random, b, breaks, true, Weights::different);
      EXPECT_TRUE(f.is_closed());
      const int n = *b.order();
      const Rational begin = breaks.front(), end = breaks.back();
      const auto first = derivatives_at<Rational>(f, begin, Side::right, begin, n + 1);
      auto last = derivatives_at<Rational>(f, end, Side::left, end, n + 1);
      for (int r = 0; r <= n; ++r) EXPECT_EQ(first[r], last[r]) << r;
      if (b.order_at_begin() == b.order_at_end() && breaks.size() > 2) {
        EXPECT_NE(first[n + 1], last[n + 1]) << "no more than the order of B";
      }
      // The last local curve is the first, a period later.
      EXPECT_EQ(f.locals().back(), f.locals().front().shifted(end - begin));
      EXPECT_EQ(f.locals().size(), breaks.size());
      EXPECT_EQ(f.knots().knots().front(), begin - (breaks[breaks.size() - 1] - breaks[breaks.size() - 2]));
      EXPECT_EQ(f.knots().knots().back(), end + (breaks[1] - breaks[0]));
    }
}

TEST(GerbsCurveClosed, Law5_FlatFunctionsCloseWithAllDerivatives) {
  RandomRationals random;
  for (const std::string& name : kFlatB) {
    const Gerbs f = random_gerbs(random, b_function(name), {0, 1, 3}, true, Weights::different, 0);
    EXPECT_EQ((derivatives_at<Rational>(f, Rational(0), Side::right, Rational(0), 6)),
              (derivatives_at<Rational>(f, Rational(3), Side::left, Rational(3), 6)));
  }
}

TEST(GerbsCurveClosed, Law5_ARotatedBeginIsTheSameCurve) {
  RandomRationals random;
  const Gerbs f = random_gerbs(random, b_function("polynomial(2)"), {0, 1, 3, 4}, true, Weights::different, 0);
  const Gerbs g = Gerbs::make(f.b_function(), gerbs_knots<Rational>({1, 3, 4, 5}, true).value(),
                              {f.locals()[1], f.locals()[2], f.locals()[3]}, true)
                      .value();
  for (const Rational& t : {"5/4"_q, Rational(2), "7/2"_q, Rational(4)})
    EXPECT_EQ((derivatives_at<Rational>(f, t, Side::left, t, 3)), (derivatives_at<Rational>(g, t, Side::left, t, 3)));
  const Rational t = "1/3"_q, later = t + Rational(4);
  EXPECT_EQ((derivatives_at<Rational>(f, t, Side::left, t, 3)),
            (derivatives_at<Rational>(g, later, Side::left, later, 3)));
}

// ---- (6) blends -------------------------------------------------------------------------------------------------------

TEST(GerbsCurveBlend, Law6_TheFirstTheWindowAndTheSecond) {
  RandomRationals random;
  for (const std::string& name : kExactB)
    for (const auto& [first_end, second_begin, overlap] :
         {std::tuple(Rational(3), Rational(7), "1/2"_q), std::tuple(Rational(3), Rational(-2), Rational(2)),
          std::tuple("5/2"_q, Rational(1), "3/2"_q), std::tuple(Rational(3), Rational(1), Rational(2))}) {
      SCOPED_TRACE(name);
      const BFunction b = b_function(name);
      const Spline first = random_spline<3>(random, 1, first_end, 3, 2, Weights::different),
                   second = random_spline<3>(random, second_begin, second_begin + Rational(2), 2, 1, Weights::one);
      const Gerbs f = Gerbs::blend(b, first, second, overlap).value();
      const Rational from = first_end - overlap, delay = from - second_begin;
      EXPECT_EQ(f.knots().domain_begin(), 1);
      EXPECT_EQ(f.knots().domain_end(), from + Rational(2));
      for (const auto& [t, side] : sided_places(f)) {
        const Rational later = t - delay;
        const auto value = derivatives_at<Rational>(f, t, side, t, 3);
        EXPECT_EQ(value, reference_derivatives<Rational>(f, t, side, t, 3));
        if (t < from || (t == from && side == Side::left)) {
          EXPECT_EQ(value, (derivatives_at<Rational>(Local(first), t, side, t, 3)));
        } else if (t > first_end || (t == first_end && side == Side::right)) {
          EXPECT_EQ(value, (derivatives_at<Rational>(Local(second), later, side, later, 3)));
        } else {
          const auto a = derivatives_at<Rational>(Local(first), t, side, t, 0)[0],
                     z = derivatives_at<Rational>(Local(second), later, side, later, 0)[0];
          const Rational w = derivatives(b, Rational((t - from) / overlap), 0)[0];
          EXPECT_EQ(value[0], (Rational(1) - w) * a + w * z);
        }
      }
    }
}

// Equations (8) and (9) of the source, for curves on [0, 1] and a ratio x.
TEST(GerbsCurveBlend, Law6_JumpsOfTheNextDerivative) {
  RandomRationals random;
  for (int n = 0; n <= 3; ++n)
    for (const Rational& x : {Rational(0), "1/5"_q, "1/2"_q, "4/5"_q}) {
      const Spline first = random_spline<3>(random, 0, 1, 3, 0, Weights::one),
                   second = random_spline<3>(random, 0, 1, 2, 0, Weights::one);
      const Rational overlap = Rational(1) - x;
      const Gerbs f = Gerbs::blend(BFunction::polynomial(n).value(), first, second, overlap).value();
      Rational size = factorial(2 * n + 1) / factorial(n);
      for (int k = 0; k <= n; ++k) size = size / overlap;
      const auto jump = [&](const Rational& t) {
        return derivatives_at<Rational>(f, t, Side::right, t, n + 1)[n + 1] -
               derivatives_at<Rational>(f, t, Side::left, t, n + 1)[n + 1];
      };
      const auto at = [](const Spline& c, const Rational& t) {
        return derivatives_at<Rational>(Local(c), t, Side::left, t, 0)[0];
      };
      if (x == 0) continue;  // there is nothing outside the window
      EXPECT_EQ(jump(x), size * (at(second, 0) - at(first, x)));
      EXPECT_EQ(jump(1), (n % 2 == 0 ? Rational(-size) : size) * (at(second, overlap) - at(first, 1)));
    }
}

TEST(GerbsCurveBlend, Law6_AnOverlapOfTheWholeCurve) {
  RandomRationals random;
  const Spline first = random_spline<3>(random, 0, 1, 2, 0, Weights::one),
               second = random_spline<3>(random, 4, 5, 3, 1, Weights::different);
  const Gerbs f = Gerbs::blend(b_function("rational(2)"), first, second, Rational(1)).value();
  EXPECT_EQ(f.knots().knots(), (std::vector<Rational>{0, 0, 1, 1}));
  EXPECT_EQ(f.locals().size(), 2u);
  // The first may be inside the second: it begins at once and ends before it.
  const Gerbs g =
      Gerbs::blend(b_function("polynomial(1)"), first, random_spline<3>(random, 0, 3, 2, 0, Weights::one), Rational(1))
          .value();
  EXPECT_EQ(g.knots().knots(), (std::vector<Rational>{0, 0, 1, 3, 3}));
}

TEST(GerbsCurveBlend, Law6_WindowsThatDoNotFit) {
  RandomRationals random;
  const Spline first = random_spline<3>(random, 0, 2, 2, 0, Weights::one),
               second = random_spline<3>(random, 0, 1, 2, 0, Weights::one);
  for (const Rational& overlap : {Rational(0), "-1/2"_q, "1000001/1000000"_q, Rational(2)}) {
    const auto made = Gerbs::blend(BFunction(), first, second, overlap);
    ASSERT_FALSE(made) << overlap;
    EXPECT_EQ(made.error().code, ErrorCode::bad_window);
    EXPECT_EQ(made.error().values, to_text(overlap) + " of 2 and 1");
  }
  EXPECT_FALSE(Gerbs::blend(BFunction(), second, first, Rational(2)));
  const auto of_doubles = [](double overlap) {
    const BsplineCurve<double, 3> c = BsplineCurve<double, 3>::bezier({{{0, 0, 1}}, {{1, 1, 1}}});
    return GerbsCurve<double, 3>::blend(BFunction(), c, c, overlap).has_value();
  };
  EXPECT_TRUE(of_doubles(0.5));
  EXPECT_FALSE(of_doubles(std::numeric_limits<double>::quiet_NaN()));
}

// ---- limits -----------------------------------------------------------------------------------------------------------

TEST(GerbsCurveEdges, ADoubleKnotInsideIsAJump) {
  RandomRationals random;
  for (const std::string& name : kExactB) {
    const auto knots = KnotVector<Rational>::make(1, {0, 0, 1, 1, 3, 3}).value();
    std::vector<Local> locals;
    for (int i = 0; i < 4; ++i) locals.push_back(random_spline<3>(random, 0, 3, 3, 0, Weights::different));
    const Gerbs f = Gerbs::make(b_function(name), knots, locals).value();
    EXPECT_EQ(f.breaks(), (std::vector<Rational>{0, 1, 3}));
    const int order = *f.b_function().order();
    const auto left = derivatives_at<Rational>(f, Rational(1), Side::left, Rational(1), order),
               right = derivatives_at<Rational>(f, Rational(1), Side::right, Rational(1), order);
    EXPECT_EQ(left, (derivatives_at<Rational>(locals[1], Rational(1), Side::left, Rational(1), order)));
    EXPECT_EQ(right, (derivatives_at<Rational>(locals[2], Rational(1), Side::right, Rational(1), order)));
    EXPECT_NE(left[0], right[0]);
  }
  // A local curve between three knots at one place is never seen.
  const auto knots = KnotVector<Rational>::make(1, {0, 0, 1, 1, 1, 3, 3});
  if (knots) {
    const Spline g = random_spline<3>(random, 0, 3, 1, 0, Weights::one),
                 unseen = random_spline<3>(random, 1, 3, 1, 0, Weights::one);
    const auto f = Gerbs::make(BFunction(), *knots, {g, g, unseen, g, g});
    ASSERT_TRUE(f);
    for (const auto& [t, side] : sided_places(*f))
      EXPECT_EQ((derivatives_at<Rational>(*f, t, side, t, 1)), (derivatives_at<Rational>(Local(g), t, side, t, 1)));
  } else {
    EXPECT_EQ(knots.error().code, ErrorCode::bad_multiplicity);
  }
}

// The whole curve far out, and squeezed: the same values, to the last bit of the exact numbers.
TEST(GerbsCurveEdges, FarOffsetsAndTinySpans) {
  RandomRationals random;
  const Rational tiny = Rational(1) / Rational(1LL << 40);
  for (const std::string& name : kExactB) {
    const Gerbs near = random_gerbs(random, b_function(name), {0, 1, 3, 4}, false, Weights::different);
    for (const auto& [offset, scale] : {std::pair(Rational(1000000), Rational(1)), std::pair(Rational(0), tiny),
                                        std::pair(Rational(1000000), tiny), std::pair("-1000000/3"_q, "1/7"_q)}) {
      std::vector<Local> locals;
      for (const Local& c : near.locals()) {
        const Spline s = c.spline();
        const auto at = [&](const Rational& t) { return Rational(offset + scale * t); };
        locals.push_back(map_domain(s, at(s.knots().domain_begin()), at(s.knots().domain_end())));
      }
      std::vector<Rational> breaks;
      for (const int t : {0, 1, 3, 4}) breaks.push_back(offset + scale * Rational(t));
      const Gerbs far = Gerbs::make(near.b_function(), gerbs_knots(breaks, false).value(), locals).value();
      for (const auto& [t, side] : sided_places(near)) {
        const Rational at = offset + scale * t;
        const auto a = derivatives_at<Rational>(near, t, side, t, 2),
                   z = derivatives_at<Rational>(far, at, side, at, 2);
        EXPECT_EQ(a[0], z[0]);
        EXPECT_EQ(a[1], scale * z[1]);
        EXPECT_EQ(a[2], scale * scale * z[2]);
      }
    }
  }
}

// Doubles at 10^6 with a span of 2^-20: all numbers are finite, and the bound of Tracked holds.
TEST(GerbsCurveEdges, DoublesFarOut) {
  std::vector<LocalCurve<double, 3>> locals;
  const double begin = 1e6, step = 0x1p-20;
  for (int i = 0; i < 3; ++i)
    locals.push_back(BsplineCurve<double, 3>(KnotVector<double>::bezier(1, begin, begin + 2 * step),
                                             {{{1.0 + i, 2, 1}}, {{3, 4.0 - i, 2}}}));
  const auto f =
      GerbsCurve<double, 3>::make(b_function("polynomial(2)"),
                                  gerbs_knots<double>({begin, begin + step, begin + 2 * step}, false).value(), locals)
          .value();
  for (int k = 0; k <= 8; ++k) {
    const double t = begin + k * step / 4;
    const auto tracked = derivatives_at<Tracked>(f, t, Side::left, embed<Tracked>(t), 2);
    expect_same_bits(derivatives_at<double>(f, t, Side::left, t, 2), tracked);
    for (const auto& d : tracked)
      for (const std::size_t c : {0u, 1u}) EXPECT_TRUE(std::isfinite(d[c].value()) && std::isfinite(d[c].error()));
  }
}

// ---- what is refused ----------------------------------------------------------------------------------------------------

TEST(GerbsCurveErrors, KnotsThatCannotBe) {
  const auto code = [](std::vector<Rational> breaks, bool closed) {
    return gerbs_knots(std::move(breaks), closed).error();
  };
  EXPECT_EQ(code({}, false).code, ErrorCode::wrong_count);
  EXPECT_EQ(code({}, true).code, ErrorCode::wrong_count);
  EXPECT_EQ(code({1}, false).code, ErrorCode::wrong_count);
  EXPECT_EQ(code({1}, true).values, "1");
  EXPECT_EQ(code({0, 2, 1}, false).code, ErrorCode::decreasing_knots);
  EXPECT_EQ(code({0, 2, 1, 5}, true).code, ErrorCode::decreasing_knots);
  EXPECT_EQ(code({3, 3}, false).code, ErrorCode::empty_domain);
  EXPECT_EQ(code({0, 0, 1, 2}, true).code, ErrorCode::not_closed);
  EXPECT_EQ(code({0, 1, 2, 2}, true).code, ErrorCode::not_closed);
  EXPECT_EQ(gerbs_knots<Rational>({0, 1, 1, 2}, true).value().knots(), (std::vector<Rational>{-1, 0, 1, 1, 2, 3}));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const bool closed : {false, true}) {
      EXPECT_EQ(gerbs_knots<double>({0, bad, 1}, closed).error().code, ErrorCode::bad_number);
      EXPECT_EQ(gerbs_knots<double>({0, 1, bad}, closed).error().values, "number 2");
      EXPECT_FALSE(gerbs_knots<double>({bad, 1}, closed));
    }
}

TEST(GerbsCurveErrors, LocalCurvesThatDoNotFit) {
  RandomRationals random;
  const Local g = random_spline<3>(random, 0, 3, 2, 0, Weights::one);
  const auto knots = gerbs_knots<Rational>({0, 1, 3}, false).value(),
             ring = gerbs_knots<Rational>({0, 1, 3}, true).value();
  const auto error = [](const auto& made) { return made.error(); };
  const Error few = error(Gerbs::make(BFunction(), knots, {g, g}));
  EXPECT_EQ(few.code, ErrorCode::wrong_count);
  EXPECT_EQ(few.values, "2");
  EXPECT_EQ(few.message, "3 knots need 3 local curves");
  const Error many = error(Gerbs::make(BFunction(), ring, {g, g, g}, true));
  EXPECT_EQ(many.code, ErrorCode::wrong_count);
  EXPECT_EQ(many.message, "3 closed knots need 2 local curves");
  EXPECT_EQ(error(Gerbs::make(BFunction(), knots, {})).code, ErrorCode::wrong_count);

  const Error degree =
      error(Gerbs::make(BFunction(), KnotVector<Rational>::make(2, {0, 0, 0, 1, 1, 1}).value(), {g, g, g}));
  EXPECT_EQ(degree.code, ErrorCode::bad_degree);
  EXPECT_EQ(degree.values, "2");

  // A curve that ends in its support; the outer halves of the supports of an open curve do not count.
  const Error outside =
      error(Gerbs::make(BFunction(), knots, {g, Local(random_spline<3>(random, 0, 2, 2, 0, Weights::one)), g}));
  EXPECT_EQ(outside.code, ErrorCode::outside_domain);
  EXPECT_EQ(outside.values, "0 … 3");
  EXPECT_EQ(outside.message, "local curve 1 is not defined everywhere it is used");
  EXPECT_TRUE(Gerbs::make(BFunction(), knots,
                          {Local(random_spline<3>(random, 0, 1, 2, 0, Weights::one)), g,
                           Local(random_spline<3>(random, 1, 3, 2, 0, Weights::one))}));
  // Of a closed one they do: the first is used before the begin, as the last.
  const Error seam = error(Gerbs::make(BFunction(), ring, {g, g}, true));
  EXPECT_EQ(seam.code, ErrorCode::outside_domain);
  EXPECT_EQ(seam.values, "1 … 3");
  EXPECT_TRUE(Gerbs::make(BFunction(), ring, {Local(random_spline<3>(random, -2, 1, 2, 0, Weights::one)), g}, true));

  const Error open_knots = error(Gerbs::make(BFunction(), knots, {g, g}, true));
  EXPECT_EQ(open_knots.code, ErrorCode::not_closed);
  EXPECT_EQ(open_knots.values, "0 … 3 instead of -2 … 4");
}

TEST(GerbsCurveErrors, ExactValuesOfTranscendentalCurvesAreRefused) {
  RandomRationals random;
  const Gerbs f = random_gerbs(random, b_function("logistic"), {0, 1, 3}, false, Weights::one, 0);
  EXPECT_THROW((void)derivatives_at<Rational>(f, Rational("1/2"_q), Side::right, Rational("1/2"_q), 0), contract_error);
  EXPECT_NO_THROW((void)derivatives_at<Rational>(f, Rational(1), Side::right, Rational(1), 0));
  EXPECT_THROW((void)derivatives_at<Ball>(f, Rational(4), Side::right, Ball(4), 0), contract_error);
}

}  // namespace
}  // namespace patchproof::test
