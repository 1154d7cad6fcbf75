// SPDX-License-Identifier: Apache-2.0
// Knots and curves that all threads read, in every scalar.
#include <limits>

#include "patchproof/spline/bspline_basis.h"
#include "patchproof/spline/degree.h"
#include "patchproof/spline/fit_double.h"
#include "patchproof/spline/homogeneous.h"
#include "patchproof/spline/knot_insertion.h"
#include "patchproof/spline/least_squares.h"
#include "patchproof/spline/smoothness.h"
#include "support/curves.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

TEST(ThreadsSpline, KnotsAreReadByAll) {
  RandomRationals random;
  const KnotVector<Rational> knots = make_knots<Rational>(3, random.knots(3, 12));
  const std::vector<Rational> at = places(knots);
  Together all;
  all.add("breaks", [&] { return say(knots.breaks(), knots.is_clamped(), knots.control_count()); });
  all.add("spans", [&] {
    Said out;
    for (const Rational& t : at)
      if (knots.in_domain(t)) out.add(knots.find_span(t, Side::left)), out.add(knots.multiplicity(t));
    return out.text();
  });
  all.add("changed degree", [&] { return say(change_degree(knots, 2)); });
  all.run();
}

// Everything that a curve in the scalar T can do.
template <class T>
void add_operations(Together& all, const std::string& scalar, const BsplineCurve<T, 3>& curve,
                    const std::vector<Rational>& at) {
  using K = knot_scalar_t<T>;
  const K inside = make_knot<T>((at[0] + Rational(3) * at[1]) / Rational(4));
  all.add(scalar + ": values", [&curve, &at] {
    [[maybe_unused]] const GuardFor<T> guard{};
    Said out;
    for (const Rational& x : at)
      for (const Side side : {Side::left, Side::right}) {
        const K t = make_knot<T>(x);
        out.add(evaluate(curve, t, side)), out.add(derivatives(curve, t, 4, side));
      }
    return out.text();
  });
  all.add(scalar + ": blossom", [&curve, inside] {
    [[maybe_unused]] const GuardFor<T> guard{};
    const int span = curve.knots().find_span(inside);
    return say(blossom(curve, span, std::vector<K>(curve.degree(), inside)), derivative_curve(curve));
  });
  all.add(scalar + ": insertion", [&curve, inside] {
    [[maybe_unused]] const GuardFor<T> guard{};
    return say(insert_knot(curve, inside, 2), raise_multiplicity(curve, inside, curve.degree()));
  });
  all.add(scalar + ": elevation", [&curve] {
    [[maybe_unused]] const GuardFor<T> guard{};
    return say(elevate_degree(curve, 2));
  });
  all.add(scalar + ": pieces", [&curve, inside] {
    [[maybe_unused]] const GuardFor<T> guard{};
    return say(extract_bezier(curve), split(curve, inside), clamp(curve));
  });
}

TEST(ThreadsSpline, CurvesAreReadByAllInEveryScalar) {
  RandomRationals random;
  const std::vector<Rational> knots{0, 0, 0, 0, 1, 3, 3, 4, 6, 6, 6, 6};
  const auto k = make_knots<Rational>(3, knots);
  const BsplineCurve<Rational, 3> exact(k, random.points<3>(k.control_count()));
  const auto quadratic = make_curve<Quadratic>(exact);
  const auto interval = make_curve<Interval>(exact);
  const auto ball = make_curve<Ball>(exact);
  const auto tracked = make_curve<Tracked>(exact);
  const auto rounded = make_curve<double>(exact);
  std::vector<Rational> at = places(exact.knots());
  std::sort(at.begin(), at.end());
  Together all;
  add_operations(all, "Rational", exact, at);
  add_operations(all, "Quadratic", quadratic, at);
  add_operations(all, "Interval", interval, at);
  add_operations(all, "Ball", ball, at);
  add_operations(all, "Tracked", tracked, at);
  add_operations(all, "double", rounded, at);
  all.add("exact curve at intervals, balls, models", [&] {
    const RoundingGuard guard;
    using Model = TaylorModel<5>;
    const int span = exact.knots().find_span(Rational(2));
    return say(derivative_in_span<Interval>(exact, span, Interval(1.5, 2.5), 1),
               derivative_in_span<Ball>(exact, span, Ball(Interval(1.5, 2.5)), 2),
               derivative_in_span<Model>(exact, span, Model::variable(Interval(2.0), Interval(0.5)), 1));
  });
  all.add("exact decisions", [&] {
    return say(remove_redundant_knots(insert_knot(exact, Rational(2), 2)), reduce_degree(elevate_degree(exact)),
               remove_knot(exact, Rational(1)), reduce_degree(exact));
  });
  all.run();
}

TEST(ThreadsSpline, FitsOfSharedSamples) {
  const KnotVector<Rational> knots = make_knots<Rational>(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3});
  CurveSamples<Rational, 2> samples;
  RandomRationals random;
  for (int i = 0; i <= 12; ++i) {
    samples.parameters.push_back(Rational(i) / Rational(4));
    samples.points.push_back(random.point<2>());
  }
  const auto prepared = LeastSquares<Rational>::make(knots, samples.parameters).value();
  Together all;
  all.add("exact", [&] { return say(fit_curve(knots, samples), prepared.control_points(samples.points)); });
  all.add("in doubles", [&] {
    const auto fit = fit_curve_double(knots, samples).value();
    EXPECT_TRUE(fit.is_certified());
    return say(fit.curve, fit.errors, fit.inverse);
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
