// SPDX-License-Identifier: Apache-2.0
// Knot insertion and Bézier extraction of whole surfaces.
#include <fmt/format.h>

#include <algorithm>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/refine_batch.h"
#include "validation/check/judge.h"

namespace patchproof::validation {
namespace {

// New knots: the parameters of the grid, ends and knots among them.
std::vector<double> added_knots(const std::vector<double>& grid) {
  return {grid.begin(), grid.begin() + std::min<std::ptrdiff_t>(4, static_cast<std::ptrdiff_t>(grid.size()))};
}

BsplinePatch<Rational, 4> inserted(BsplinePatch<Rational, 4> patch, const std::vector<double>& u,
                                   const std::vector<double>& v) {
  for (const double t : u) patch = insert_knot(patch, Direction::u, from_double(t));
  for (const double t : v) patch = insert_knot(patch, Direction::v, from_double(t));
  return patch;
}

void judge_nets(const SurfaceCase& s, const std::string& kernel, const SurfaceRefinement& refinement,
                const std::vector<Vec<Rational, 4>>& exact, const CheckOptions& options, Tallies& tallies) {
  const std::size_t numbers = s.weights.empty() ? 3 : 4;
  for (const InstructionSet set : options.sets) {
    Tally& tally = tallies[{kernel, set, s.group}];
    std::vector<double> out(refinement.point_count() * numbers);
    const Result<RefinementBounds> bounds = refinement.apply(s.points, s.weights, out, set);
    if (!bounds || exact.size() * numbers != out.size()) {
      if (tally.violations++ == 0)
        tally.violation =
            s.name + ": " + (bounds ? "another number of points than the exact net has" : bounds.error().text());
      continue;
    }
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Rational largest = largest_coordinate({{exact[i][0], exact[i][1], exact[i][2]}});
      for (std::size_t c = 0; c < numbers; ++c)
        Judge(tally, exact[i][c], c == 3 ? exact[i][3] : largest)
            .number(perhaps_broken(options, kernel, out[i * numbers + c]), c == 3 ? bounds->weight : bounds->coordinate,
                    [&] { return fmt::format("{}, control point {}.{}", s.name, i, "xyzw"[c]); });
    }
  }
}

}  // namespace

void check_refinement(const SurfaceCase& s, const CheckOptions& options, Tallies& tallies) {
  const BsplinePatch<Rational, 4> patch = exact_patch(s.data());
  const SurfaceRefinement::Knots knots{s.degree_u, s.degree_v, s.knots_u, s.knots_v};
  const auto refused = [&](const char* kernel, const Error& error) {
    Tally& t = tallies[{kernel, resolve(InstructionSet::fastest), s.group}];
    if (t.violations++ == 0) t.violation = s.name + ": refused: " + error.text();
  };
  const std::vector<double> u = added_knots(s.grid_u), v = added_knots(s.grid_v);
  const auto insertion = SurfaceRefinement::make_insertion(knots, u, v);
  if (insertion)
    judge_nets(s, "refine", *insertion, inserted(patch, u, v).net(), options, tallies);
  else
    refused("refine", insertion.error());

  const auto bezier = SurfaceRefinement::make_bezier(knots);
  if (!bezier) return refused("bezier", bezier.error());
  std::vector<Vec<Rational, 4>> nets;
  for (const auto& piece : extract_bezier(patch)) {
    const auto& net = piece.bezier.net();
    nets.insert(nets.end(), net.begin(), net.end());
  }
  judge_nets(s, "bezier", *bezier, nets, options, tallies);
}

}  // namespace patchproof::validation
