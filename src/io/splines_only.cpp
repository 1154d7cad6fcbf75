// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <numbers>

#include "gerbs_splines.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/gregory_approximate.h"
#include "write_doubles.h"

namespace patchproof {
namespace {

// Four digits, not below x.
std::string at_most(double x) {
  std::string text = fmt::format("{:.4g}", x);
  for (double y = x; std::stod(text) < x;) {
    y *= 1 + 1e-4;
    text = fmt::format("{:.4g}", y);
  }
  return text;
}

// The largest bound and whose it is.
struct Largest {
  double bound = 0;
  std::string patch;
  void take(double x, const std::string& of) {
    if (x > bound) bound = x, patch = of;
  }
  std::string text() const { return at_most(bound) + (patch.empty() ? "" : " (" + patch + ")"); }
};

}  // namespace

template <ExactField T>
Result<SplinesOnly<T>> with_splines_only(Model<T> model, int cells) {
  SplinesOnly<T> out{std::move(model), {}};
  if (has_gerbs(out.model)) {
    SplineModel<T> splines = gerbs_to_splines(out.model);
    const auto refused = [](const char* what, std::size_t i) {
      return Error{ErrorCode::unsupported, fmt::format("{} {}", what, i),
                   "a GERBS that is no spline, or a very large one: only patchproof JSON holds it; plot draws it", ""};
    };
    if (!splines.outlined_patches.empty()) return refused("patch", splines.outlined_patches.front());
    if (!splines.outlined_curves.empty()) return refused("curve", splines.outlined_curves.front());
    out = {std::move(splines.model), std::move(splines.notes)};
  }
  std::vector<ModelGregoryPatch<T>> patches = std::move(out.model.gregory_patches);
  out.model.gregory_patches.clear();
  if (patches.empty()) return out;
  const BlendSpline blend = BlendSpline::make(cells);
  Largest point, angle;
  std::size_t changed = 0, unbounded = 0;
  std::string first_unbounded;
  for (ModelGregoryPatch<T>& patch : patches) {
    const std::string number = fmt::format("patch {}", out.model.patches.size());
    Result<ApproximatedGregory<T>> spline = approximate(patch.patch, blend);
    if (!spline) return Error{spline.error().code, number, spline.error().message, spline.error().values};
    out.model.patches.push_back({std::move(patch.name), std::move(spline->surface), false});
    changed += spline->point_deviation > 0;
    point.take(spline->point_deviation, number);
    if (!spline->normal_angle && unbounded++ == 0) first_unbounded = number;
    // An upper bound of the degrees.
    if (spline->normal_angle) angle.take(*spline->normal_angle * (180 / std::numbers::pi) * (1 + 1e-15), number);
  }
  if (changed == 0) {
    out.notes.push_back(plural(patches.size(), "Gregory patch is", "Gregory patches are") +
                        " written as a B-spline patch, exactly: no corner has two twists");
    return out;
  }
  std::string note = fmt::format(
      "{} of {} approximated by B-spline patches of {} x {} cells, for "
      "positive weights: edges exact, points within "
      "{}, ",
      changed, plural(patches.size(), "Gregory patch", "Gregory patches"), cells, cells, point.text());
  note += unbounded == patches.size() ? "normals without a bound" : "normals within " + angle.text() + " degrees";
  if (unbounded > 0 && unbounded < patches.size())
    note += fmt::format(", without a bound for {} (the first: {})", unbounded, first_unbounded);
  out.notes.push_back(note + "; patchproof JSON holds them exactly");
  return out;
}

template Result<SplinesOnly<Rational>> with_splines_only(Model<Rational>, int);
template Result<SplinesOnly<Quadratic>> with_splines_only(Model<Quadratic>, int);

}  // namespace patchproof
