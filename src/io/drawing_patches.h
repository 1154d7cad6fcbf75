// SPDX-License-Identifier: Apache-2.0
// Patches of either kind, and solids, on their way to a drawing. A Gregory patch's number comes after those of all B-spline
// patches.
#pragma once

#include <vector>

#include "io/drawing.h"
#include "patchproof/patch/gregory_patch.h"

namespace patchproof {

// Nothing when patch i is a B-spline patch.
template <ExactField T>
const GregoryPatch<T>* gregory_patch(const Model<T>& model, int i) {
  const int before = static_cast<int>(model.patches.size());
  return i < before ? nullptr : &model.gregory_patches[i - before].patch;
}
template <ExactField T>
const std::string& patch_name(const Model<T>& model, int i) {
  const std::size_t before = model.patches.size();
  return gregory_patch(model, i) ? model.gregory_patches[i - before].name : model.patches[i].name;
}
// The knots of the patch's lines.
template <ExactField T>
const KnotVector<T>& patch_knots(const Model<T>& model, int i, Direction d) {
  const GregoryPatch<T>* gregory = gregory_patch(model, i);
  if (!gregory) return model.patches[i].surface.knots(d);
  return (d == Direction::u ? gregory->v_surface() : gregory->u_surface()).knots(d);
}
template <ExactField T>
std::size_t spans_of(const Model<T>& model, int i) {
  return (patch_knots(model, i, Direction::u).breaks().size() - 1) *
         (patch_knots(model, i, Direction::v).breaks().size() - 1);
}

template <ExactField T>
DrawnControl control_of(const Vec<T, 4>& p) {
  const bool is_vector = p[3] == T(0);
  DrawnControl out{{}, is_vector};
  for (std::size_t i = 0; i < 3; ++i) out.at[i] = nearest_double(is_vector ? p[i] : p[i] / p[3]);
  return out;
}

// The control net of one more surface. The error: a point that is no number in doubles.
template <ExactField T>
std::optional<Error> add_net(PatchDrawing& drawing, const BsplinePatch<T, 4>& surface) {
  drawing.nets.push_back({{surface.count(Direction::u), surface.count(Direction::v)}, {}});
  for (const Vec<T, 4>& p : surface.net()) {
    drawing.nets.back().controls.push_back(control_of(p));
    if (!detail::is_finite(drawing.nets.back().controls.back().at))
      return Error{ErrorCode::bad_number, drawing.name, "a control point is no finite number in doubles", ""};
  }
  return std::nullopt;
}

// As tessellate() does with B-spline patches: points and normals of the patch itself, in double.
template <ExactField T>
Result<std::vector<Tessellation<2>>> tessellate(const GregoryPatch<T>& patch, std::array<int, 2> cells);

template <ExactField T>
Result<PatchDrawing> draw_gregory(const Model<T>& model, int i, std::array<int, 2> cells, bool control);

// At the edges of these patches and, from both sides, at the lines of their knots.
template <ExactField T>
Result<std::vector<DrawnNormal>> normals_along_lines(const Model<T>& model, const std::vector<int>& patches);

// How long they are drawn.
double normal_length(const std::vector<DrawnNormal>& normals);

// So many planes z = …, evenly between the lowest and the highest vertex. None when they are the same.
std::vector<double> section_levels(double low, double high, int count);
std::vector<double> section_levels(const std::vector<PatchDrawing>& patches, int count);
// Where a quadrangle (its corners in order) meets the plane z = level: ends of segments.
std::vector<std::array<Point3, 2>> section(const std::array<Point3, 4>& corners, double level);

// How many spans the six faces have together.
template <ExactField T>
std::size_t face_spans(const TransfiniteMap<T, 3, 4>& map);
template <ExactField T>
Result<PatchDrawing> draw_solid(const ModelSolid<T>& model, int index, int cells);

}  // namespace patchproof
