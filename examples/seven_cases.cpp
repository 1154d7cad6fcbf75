// SPDX-License-Identifier: Apache-2.0
// Joins on which a check by samples, or at one point, answers wrongly. In each model patch A ends where patch B begins.
//
// Unless said otherwise A is the flat square [−1, 0] × [0, 1] at z = 0 and the common edge is x = 0.
#include "models.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/affine.h"
#include "patchproof/patch/patch_knots.h"

namespace patchproof::examples {
namespace {

using Knots = KnotVector<Rational>;
using Patch = ModelPatch<Rational>;

NamedModel model(const std::string& name, Patch a, Patch b, bool declare_join = false) {
  Model<Rational> out;
  out.units = "mm";
  out.patches = {std::move(a), std::move(b)};
  if (declare_join) out.joins.push_back({0, 1, EdgeName::u_max, EdgeName::u_min, false});
  return {"seven/" + name + ".json", write_model_json(out)};
}

Patch flat() {
  return bezier_model_patch("a", {{{{-1_q, 0_q, 0_q}}, {{-1_q, 1_q, 0_q}}}, {{{0_q, 0_q, 0_q}}, {{0_q, 1_q, 0_q}}}});
}

// (x, y, f(y) x) for x in [0, 1], where f is the quadratic spline with these coefficients: the kink at y is arctan f(y).
Patch wing(const Knots& knots, const std::vector<Rational>& f) {
  Row edge, outside;
  for (int j = 0; j < knots.control_count(); ++j) {
    const Rational y = (knots[j + 1] + knots[j + 2]) / 2_q;  // so that the second parameter is y
    edge.push_back({{0_q, y, 0_q}});
    outside.push_back({{1_q, y, f[j]}});
  }
  return polynomial_patch("b", Knots::bezier(1), knots, {edge, outside});
}

// Smooth for y ≤ 0.996, then a kink that grows to 45° at the end y = 1.
NamedModel kink_at_end() {
  const Knots knots = *Knots::make(2, {0_q, 0_q, 0_q, 0.996_q, 1_q, 1_q, 1_q});
  return model("kink_at_end", flat(), wing(knots, {0_q, 0_q, 0_q, 1_q}));
}

// Smooth but for 0.51 < y < 0.54, with f(0.525) = 3. The nearest of 21 samples are 0.5 and 0.55, or 0.5 and 0.549 when
// a hundredth is cut off at each end.
NamedModel kink_between_samples() {
  const Knots knots = *Knots::make(2, {0_q, 0_q, 0_q, 0.51_q, 0.52_q, 0.53_q, 0.54_q, 1_q, 1_q, 1_q});
  return model("kink_between_samples", flat(), wing(knots, {0_q, 0_q, 0_q, 4_q, 0_q, 0_q, 0_q}));
}

// B is the square [0, 1] × [0, 1] at z = 1/2.
NamedModel parallel_gap() {
  return model(
      "parallel_gap", flat(),
      bezier_model_patch("b", {{{{0_q, 0_q, 0.5_q}}, {{0_q, 1_q, 0.5_q}}}, {{{1_q, 0_q, 0.5_q}}, {{1_q, 1_q, 0.5_q}}}}),
      true);
}

// B = (λ(y) s, y, s²): the cross-boundary derivative is λ times that of A, λ = 1 for y ≤ 0.1 and 2 at y = 1.
NamedModel c1_at_first_sample() {
  const Knots knots = *Knots::make(2, {0_q, 0_q, 0_q, 0.1_q, 0.2_q, 1_q, 1_q, 1_q});
  const std::vector<Rational> lambda{1_q, 1_q, 1_q, 2_q, 2_q};
  std::vector<Row> rows(3);
  for (int j = 0; j < 5; ++j) {
    const Rational y = (knots[j + 1] + knots[j + 2]) / 2_q;
    rows[0].push_back({{0_q, y, 0_q}});
    rows[1].push_back({{lambda[j] / 2_q, y, 0_q}});
    rows[2].push_back({{lambda[j], y, 1_q}});
  }
  return model("c1_at_first_sample", flat(), polynomial_patch("b", Knots::bezier(2), knots, rows));
}

// One bicubic patch, cut at u = 2/5 by de Casteljau's algorithm, then mapped. The parts keep their parameters.
NamedModel split(const std::string& name, const AffineMap<Rational>& map) {
  const Patch whole = bezier_model_patch(
      "whole",
      {{{{0_q, 0_q, 0.13_q}}, {{0.07_q, 0.31_q, 0.44_q}}, {{-0.05_q, 0.71_q, 0.25_q}}, {{0.02_q, 1.03_q, -0.11_q}}},
       {{{0.36_q, -0.08_q, 0.57_q}},
        {{0.29_q, 0.37_q, 0.91_q}},
        {{0.41_q, 0.63_q, 0.78_q}},
        {{0.33_q, 0.95_q, 0.22_q}}},
       {{{0.61_q, 0.05_q, 0.38_q}}, {{0.72_q, 0.28_q, 0.66_q}}, {{0.58_q, 0.74_q, 0.83_q}}, {{0.69_q, 1.01_q, 0.17_q}}},
       {{{1.04_q, -0.03_q, -0.19_q}},
        {{0.97_q, 0.35_q, 0.21_q}},
        {{1.02_q, 0.66_q, 0.14_q}},
        {{0.99_q, 0.98_q, 0.09_q}}}});
  const auto [a, b] = patchproof::split(whole.surface, Direction::u, 0.4_q);
  return model(name, {"a", apply(map, a), false}, {"b", apply(map, b), false});
}

// An arc of radius 10 that touches z = 0 from below at t = 0: homogeneous (X, Z, w) of degree 2 for t in [begin, 1/20].
// With w = 1 + t²:  X = 20 t,  Z = −20 t².
std::array<Vec<Rational, 3>, 3> arc(const Rational& begin) {
  const Rational end = 0.05_q;
  const auto blossom = [](const Rational& s, const Rational& t) {
    return Vec<Rational, 3>{{10_q * (s + t), -20_q * s * t, 1_q + s * t}};
  };
  return {blossom(begin, begin), blossom(begin, end), blossom(end, end)};
}

// The cylinder along y over [0, 400/401] in x, its rulings reaching from y = −400/401 to 400/401.
Patch cylinder_along_y() {
  std::vector<Vec<Rational, 4>> net;
  const Rational reach = 1_q / 1.0025_q;
  for (const Vec<Rational, 3>& p : arc(0_q))
    for (const Rational& y : {Rational(-reach), reach}) net.push_back({{p[0], y * p[2], p[1], p[2]}});
  return {"b", BsplinePatch<Rational, 4>(Knots::bezier(2), Knots::bezier(1), std::move(net)), true};
}

// The cylinder along x over x in [−1, 0] against the cylinder along y: they touch only in the origin, where the normal
// curvatures across the edge are 0 and 1/10.
NamedModel perpendicular_cylinders() {
  std::vector<Vec<Rational, 4>> net;
  for (const Rational& x : {-1_q, 0_q})
    for (const Vec<Rational, 3>& p : arc(-0.05_q)) net.push_back({{x * p[2], p[0], p[1], p[2]}});
  return model("perpendicular_cylinders",
               {"a", BsplinePatch<Rational, 4>(Knots::bezier(1), Knots::bezier(2), std::move(net)), true},
               cylinder_along_y(), true);
}

// The same jump of curvature along a whole edge: a plane against the cylinder along y. C1, and not C2.
NamedModel plane_and_cylinder() {
  const Rational reach = 1_q / 1.0025_q;
  return model("plane_and_cylinder",
               bezier_model_patch(
                   "a", {{{{-1_q, -reach, 0_q}}, {{-1_q, reach, 0_q}}}, {{{0_q, -reach, 0_q}}, {{0_q, reach, 0_q}}}}),
               cylinder_along_y());
}

// Both sheets lie over x ≥ 0 and are tangent to z = 0 along the edge: the angle between the outward sides is 180°.
NamedModel fold_back_cusp() {
  return model(
      "fold_back_cusp",
      bezier_model_patch("a", {{{{1_q, 0_q, 0_q}}, {{1_q, 1_q, 0_q}}}, {{{0_q, 0_q, 0_q}}, {{0_q, 1_q, 0_q}}}}),
      bezier_model_patch("b", {{{{0_q, 0_q, 0_q}}, {{0_q, 1_q, 0_q}}},
                               {{{0.5_q, 0_q, 0_q}}, {{0.5_q, 1_q, 0_q}}},
                               {{{1_q, 0_q, 1_q}}, {{1_q, 1_q, 1_q}}}}));
}

}  // namespace

std::vector<NamedModel> seven_cases() {
  const auto moved = [](const Rational& by) { return translation<Rational>({{by, by, by}}); };
  const Rational small = 0.001_q;
  return {kink_at_end(),
          kink_between_samples(),
          parallel_gap(),
          c1_at_first_sample(),
          split("split_moved_1e3", moved(1000_q)),
          split("split_moved_1e6", moved(1000000_q)),
          split("split_scaled_1e-3", scaling<Rational>({{small, small, small}})),
          perpendicular_cylinders(),
          plane_and_cylinder(),
          fold_back_cusp()};
}

}  // namespace patchproof::examples
