// SPDX-License-Identifier: Apache-2.0
#include "io/drawing_gerbs.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/drawing_patches.h"
#include "io/gerbs_splines.h"
#include "patchproof/patch/gerbs_surface.h"

namespace patchproof {
namespace {

// Marks at the knots of the GERBS curve only, and no polygon: the points of an outline are nobody's controls.
template <ExactField T>
void keep_own_marks(CurveDrawing& drawing, const BsplineCurve<T, 4>& drawn, const GerbsCurve<T, 4>& curve) {
  const std::vector<T> own = curve.knots().breaks(), all = drawn.knots().breaks();
  std::size_t next = 0;
  for (auto& component : drawing.components) {
    std::vector<CurveDrawing::Mark> kept;
    for (std::size_t k = 0; k < component.marks.size(); ++k) {
      auto& mark = component.marks[k];
      if (!std::binary_search(own.begin(), own.end(), all[next + k])) continue;
      mark.label = mark.label.substr(0, mark.label.find(" ×"));  // how often it stands in the expansion
      kept.push_back(mark);
    }
    next += component.marks.size() - 1;
    component.marks = std::move(kept);
  }
  drawing.controls.clear();
  drawing.kind = fmt::format("GERBS, {}{} local curves, B-function {}", curve.is_closed() ? "closed, " : "",
                             curve.locals().size() - (curve.is_closed() ? 1 : 0), curve.b_function().to_string());
}

template <ExactField T>
Result<std::vector<Tessellation<2>>> tessellate(const GerbsSurface<T, 4>& surface, std::array<int, 2> cells) {
  const KnotVector<T>&u = surface.knots(Direction::u), &v = surface.knots(Direction::v);
  if (auto error = detail::too_many_vertices(
          std::array{detail::vertices_along(u, cells[0]), detail::vertices_along(v, cells[1])}))
    return *error;
  std::vector<Tessellation<2>> out;
  const std::array directions{sample_spans(u, cells[0]), sample_spans(v, cells[1])};
  for (const DomainGrid<T, 2>& grid : domain_grids(directions)) {
    Tessellation<2> piece;
    piece.parameters = detail::rounded_parameters(grid);
    std::size_t next = 0;
    bool finite = true;
    piece.mesh = map_domain(grid, [&](const std::array<T, 2>& inside, const std::array<Side, 2>& sides) {
      const Vec<double, 2>& at = piece.parameters[next++];
      const auto s = partial_derivatives_at<double>(surface, inside, sides, at[0], at[1], 1, 1);
      finite = finite && detail::is_finite(s.at(0, 0));
      piece.normals.push_back(unit(cross(s.at(1, 0), s.at(0, 1))));
      return s.at(0, 0);
    });
    if (!finite) return detail::not_a_double(piece.parameters[0].c, false);
    detail::borrow_normals(piece.normals, directions[0][0].size());
    out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace

template <ExactField T>
Result<Drawing> draw_with_gerbs(const Model<T>& model, const PlotOptions& options, int most_cells) {
  const SplineModel<T> splines = gerbs_to_splines(model);
  const Result<Chosen> which = chosen(splines.model, options);
  if (!which) return which.error();
  Result<Drawing> out = draw(splines.model, options);
  if (!out) return out;
  for (std::size_t k = 0; k < which->curves.size(); ++k) {
    const std::size_t i = which->curves[k];
    if (i < model.curves.size()) continue;
    keep_own_marks(out->curves[k], splines.model.curves[i].curve, model.gerbs_curves[i - model.curves.size()].curve);
  }
  for (std::size_t k = 0; k < which->patches.size(); ++k) {
    const std::size_t i = which->patches[k], first = model.patches.size();
    if (i < first || i >= first + model.gerbs_patches.size()) continue;
    const GerbsSurface<T, 4>& surface = model.gerbs_patches[i - first].surface;
    PatchDrawing& drawing = out->patches[k];
    // The cells were chosen for the spans of the spline.
    for (const Direction d : {Direction::u, Direction::v}) {
      const std::size_t own = surface.knots(d).breaks().size() - 1,
                        drawn = splines.model.patches[i].surface.knots(d).breaks().size() - 1;
      int& cells = drawing.cells[d == Direction::u ? 0 : 1];
      if (!options.cells)
        cells = std::clamp(static_cast<int>(cells * drawn / own), std::min(8, most_cells), most_cells) / 4 * 4;
    }
    auto pieces = tessellate(surface, drawing.cells);
    if (!pieces) return Error{pieces.error().code, drawing.name, pieces.error().message, pieces.error().where};
    drawing.pieces = std::move(*pieces);
    drawing.nets.clear();
    drawing.kind = fmt::format("GERBS, {} × {} local patches, B-function {}", surface.axis(Direction::u).distinct(),
                               surface.axis(Direction::v).distinct(), surface.b_function().to_string());
  }
  if (options.sections) out->levels = section_levels(out->patches, *options.sections);
  return out;
}

template Result<Drawing> draw_with_gerbs(const Model<Rational>&, const PlotOptions&, int);
template Result<Drawing> draw_with_gerbs(const Model<Quadratic>&, const PlotOptions&, int);

}  // namespace patchproof
