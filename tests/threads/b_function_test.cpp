// SPDX-License-Identifier: Apache-2.0
// Law 10 of b_function.h, and GERBS of functions whose tables all threads ask for at a time.
#include "patchproof/spline/b_function.h"

#include "patchproof/spline/gerbs_spline.h"
#include "spline/smooth_b_function.h"
#include "support/gerbs.h"
#include "support/gerbs_surfaces.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

using detail::SmoothBFunction;

// Values, derivatives and bounds, to the bit: what depends on the tables of doubles and on the panels of 128 and 160 bits.
std::string all_of(const SmoothBFunction& b) {
  Said out;
  for (int i = 1; i < 24; ++i) {
    const double t = i / 24.0;
    out.add(detail::smooth_derivatives(b, t, 1));
    if (i % 4 != 1) continue;
    out.add(detail::smooth_coefficients(b, Interval(t, t + 0x1p-10), 2));
    const BallPrecision precision(128);
    out.add(detail::smooth_coefficients(b, Ball(t), 2));
  }
  for (int k = 0; k < 4; ++k) out.add(b.table().error(k));
  return out.text();
}

std::vector<std::shared_ptr<const SmoothBFunction>> fresh_functions() {
  const Rational half = Rational(1) / Rational(2), third = Rational(1) / Rational(3);
  return {detail::make_logistic(), detail::make_expo_rational({1, 1, 1, half}),
          detail::make_expo_rational({half, 1, 1, third})};  // the last one has a kink
}

TEST(ThreadsBFunction, Law10_TheFirstCallerDecidesNothing) {
  const auto plain = fresh_functions(), odd = fresh_functions(), shared = fresh_functions();
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string expected = all_of(*plain[i]);
    {
      const RoundingGuard upward;
      const BallPrecision precision(53);
      (void)detail::smooth_coefficients(*odd[i], Interval(0.25, 0.5), 1);
      (void)detail::smooth_derivatives(*odd[i], 0.3, 1);
    }
    EXPECT_EQ(all_of(*odd[i]), expected) << "function " << i << ": first asked with other roundings";

    // Half of the threads ask first with the rounding upward and other precisions.
    std::vector<std::string> said(kThreads);
    in_threads([&](std::size_t k) {
      if (k % 2 == 0) {
        const RoundingGuard upward;
        const BallPrecision precision(k % 4 == 0 ? 128 : 30);
        (void)detail::smooth_coefficients(*shared[i], Ball(0.4), 1);
        (void)shared[i]->table();
      }
      said[k] = all_of(*shared[i]);
    });
    for (const std::string& each : said) EXPECT_EQ(each, expected) << "function " << i;
  }
}

// Made, read and asked by all at a time: equal functions share their tables.
TEST(ThreadsBFunction, Law10_EqualFunctionsAreMadeByAll) {
  Together all;
  for (const char* text : {"expo-rational(1,1,1,2/5)", "expo-rational", "logistic", "trigonometric", "polynomial(2)",
                           "beta(2,1)", "rational(2)", "bernstein(0,1/3,1)"})
    all.add(text, [text] {
      const BFunction b = BFunction::parse(text).value();
      const RoundingGuard guard;
      return say(b.to_string(), derivatives(b, Interval(0.25, 0.375), 2), derivatives(b, Ball(0.25), 1),
                 derivatives(b, TaylorModel<3>::variable(Interval(0.5), Interval(0x1p-6)), 1), b.smoothness());
    });
  all.add("errors", [] { return say(BFunction::parse("expo-rational(1,1,1,2)").error().text()); });
  all.run();
}

TEST(ThreadsBFunction, GerbsCurvesAndSurfacesAreReadByAll) {
  RandomRationals random;
  const std::vector<Rational> breaks{0, 1, 3, 4};
  const BFunction expo = b_function("expo-rational(1,1,1,3/7)"), exact = b_function("rational(1)");
  const auto curve = random_gerbs<4>(random, expo, breaks, false, Weights::different),
             exact_curve = random_gerbs<4>(random, exact, breaks, true);
  const auto surface = random_surface(random, expo, {0, 1, 2}, false, {0, 1, 2}, true),
             exact_surface = random_surface(random, exact, {0, 1, 2}, false, {0, 1, 2}, true);
  const Rational t = Rational(5) / Rational(4), u = Rational(1) / Rational(3);
  const std::array<Rational, 2> at{u, t};
  const std::array<Side, 2> sides{Side::right, Side::left};
  Together all;
  all.add("curve", [&] {
    const RoundingGuard guard;
    return say(derivatives_at(curve, t, Side::right, Interval(1.25), 2),
               derivatives_at(curve, t, Side::right, Ball(t), 2),
               derivatives_at(curve, t, Side::right, TaylorModel<3>::variable(Interval(1.5), Interval(0.25)), 1));
  });
  all.add("curve in doubles", [&] { return say(derivatives_at(curve, t, Side::right, 1.25, 2)); });
  all.add("surface", [&] {
    const RoundingGuard guard;
    return say(partial_derivatives_at(surface, at, sides, Interval(0.25, 0.375), Interval(1.25), 1, 1),
               partial_derivatives_at(surface, at, sides, Ball(u), Ball(t), 1, 1));
  });
  all.add("surface in doubles", [&] { return say(partial_derivatives_at(surface, at, sides, 0.3, 1.25, 2, 2)); });
  all.add("exact", [&] {
    return say(derivatives_at(exact_curve, t, Side::left, t, 3), exact_curve.breaks(), to_spline(exact_curve),
               partial_derivatives_at(exact_surface, at, sides, u, t, 2, 2), exact_surface.breaks(Direction::u));
  });
  all.add("smoothness", [&] {
    Said out;
    for (const auto& each : smoothness(curve)) out.add(each.t), out.add(each.order), out.add(each.jump);
    return out.text();
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
