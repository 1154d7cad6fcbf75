// SPDX-License-Identifier: Apache-2.0
// Patches that all threads read: B-splines, rational ones, Coons and transfinite patches.
#include "patchproof/patch/coons_gregory_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/patch/transfinite_expand.h"
#include "support/coons.h"
#include "support/patches.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

template <class T>
void add_operations(Together& all, const std::string& scalar, const BsplinePatch<T, 4>& patch, const Rational& at_u,
                    const Rational& at_v) {
  using K = knot_scalar_t<T>;
  const K u = make_knot<T>(at_u), v = make_knot<T>(at_v);
  all.add(scalar + ": values", [&patch, u, v] {
    [[maybe_unused]] const GuardFor<T> guard{};
    return say(evaluate(patch, u, v), partial_derivatives(patch, u, v, 3, 2, Side::left, Side::right),
               evaluate_rational(patch, u, v), rational_derivatives(patch, u, v, 2, 2), normal(patch, u, v),
               corner_twists(patch));
  });
  all.add(scalar + ": knots", [&patch, u, v] {
    [[maybe_unused]] const GuardFor<T> guard{};
    return say(insert_knot(patch, Direction::u, u, 2), elevate_degree(patch, Direction::v),
               split(patch, Direction::v, v), extract_bezier(patch), reverse(patch, Direction::u),
               swap_directions(patch));
  });
}

TEST(ThreadsPatch, PatchesAreReadByAllInEveryScalar) {
  RandomRationals random;
  const auto u = make_knots<Rational>(3, {0, 0, 0, 0, 1, 2, 2, 4, 4, 4, 4}),
             v = make_knots<Rational>(2, {0, 0, 0, 1, 1, 3, 3, 3});
  std::vector<Vec<Rational, 4>> net = random.points<4>(u.control_count() * v.control_count());
  for (auto& p : net) p[3] = Rational(random.integer(4, 9)) / Rational(4);
  const BsplinePatch<Rational, 4> exact(u, v, net);
  const auto quadratic = make_patch<Quadratic>(exact);
  const auto interval = make_patch<Interval>(exact);
  const auto ball = make_patch<Ball>(exact);
  const auto rounded = make_patch<double>(exact);
  const Rational at_u = Rational(3) / Rational(2), at_v = Rational(5) / Rational(4);
  Together all;
  add_operations(all, "Rational", exact, at_u, at_v);
  add_operations(all, "Quadratic", quadratic, at_u, at_v);
  add_operations(all, "Interval", interval, at_u, at_v);
  add_operations(all, "Ball", ball, at_u, at_v);
  add_operations(all, "double", rounded, at_u, at_v);
  all.add("exact patch at models", [&] {
    const RoundingGuard guard;
    using Model = TaylorModel<4>;
    return say(partial_derivatives_in_span<Model>(exact, u.find_span(at_u), v.find_span(at_v),
                                                  Model::variable(Interval(1.5), Interval(0.25)),
                                                  Model::variable(Interval(1.25), Interval(0.125)), 1, 1));
  });
  all.add("exact decisions", [&] {
    return say(remove_redundant_knots(insert_knot(exact, Direction::u, at_u), Direction::u),
               reduce_degree(elevate_degree(exact, Direction::v), Direction::v));
  });
  all.run();
}

TEST(ThreadsPatch, SurfacesFromCurvesAreReadByAll) {
  RandomRationals random;
  const Surface transfinite = four_curves(), free_form = random_surface(random, 3);
  const Sides boundary = reference_boundary();
  const Surface tensor = random_patch(random, 0, 1, 0, 1);
  const Surface coons = coons_patch(boundary).value();
  const auto gregory = CoonsGregoryPatch<Rational, 3>::make(sides_of(tensor), across_of(tensor)).value();
  const auto place = place_of<2>({"1/3"_q, "2/5"_q});
  const auto coefficients = [](const auto& series) {
    Said out;
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k <= 2; ++k)
        for (int l = 0; k + l <= 2; ++l) out.add(series[c].coefficient({k, l}));
    return out.text();
  };
  Together all;
  all.add("transfinite", [&] {
    return say(evaluate(transfinite, place), evaluate(free_form, place), coefficients(taylor(transfinite, place, 2)),
               evaluate(derivative(free_form, 0), place), evaluate(fix(transfinite, 0, "1/7"_q), place));
  });
  all.add("expanded", [&] { return say(to_bspline_patch(transfinite), to_bspline_patch(coons)); });
  all.add("coons", [&] {
    return say(evaluate(coons, place), coefficients(taylor(coons, place, 2)), interpolates(coons, boundary),
               identical(coons, coons), identical(coons, transfinite));
  });
  all.add("made from shared curves", [&] {
    return say(evaluate(coons_patch(boundary).value(), place), interpolates(coons_patch(boundary).value(), boundary));
  });
  all.add("coons with Gregory's correction", [&] {
    return say(evaluate(gregory, place), evaluate(gregory, place_of<2>({"0"_q, "1"_q})),
               coefficients(taylor(gregory, place, 2)));
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
