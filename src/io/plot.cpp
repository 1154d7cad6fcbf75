// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "io/drawing_gerbs.h"
#include "io/drawing_patches.h"
#include "io/gerbs_splines.h"
#include "io/mesh_parts.h"
#include "patchproof/io/mesh_files.h"
#include "patchproof/mesh/tessellate_transfinite.h"

namespace patchproof {
namespace {

constexpr int kCurveCells = 16, kPatchCells = 8;  // in each span of a mesh

// "cup", "cup, component 2"
std::string part_name(const std::string& name, std::size_t component, std::size_t count) {
  return count == 1 ? name : fmt::format("{}, component {}", name, component);
}

template <std::size_t D>
std::optional<Error> add_parts(std::vector<MeshPart>& parts, const std::string& name,
                               Result<std::vector<Tessellation<D>>> pieces) {
  if (!pieces) return Error{pieces.error().code, name, pieces.error().message, pieces.error().where};
  for (std::size_t c = 0; c < pieces->size(); ++c)
    parts.push_back(make_part(part_name(name, c, pieces->size()), std::move((*pieces)[c])));
  return std::nullopt;
}

void add_segment(MeshPart& part, const Point3& a, const Point3& b) {
  const int first = static_cast<int>(part.mesh.vertices.size());
  part.mesh.vertices.insert(part.mesh.vertices.end(), {a, b});
  part.mesh.corners.insert(part.mesh.corners.end(), {first, first + 1});
}
MeshPart lines_named(std::string name) { return {std::move(name), {CellKind::cuboid, 1, {}, {}}, {}, {}}; }

// Of the surfaces among these parts.
std::vector<MeshPart> sections_of(const std::vector<MeshPart>& parts, int count) {
  std::vector<const MeshPart*> surfaces;
  for (const MeshPart& part : parts)
    if (part.mesh.dimension == 2) surfaces.push_back(&part);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const MeshPart* part : surfaces)
    for (const Point3& p : part->mesh.vertices) low = std::min(low, p[2]), high = std::max(high, p[2]);
  std::vector<MeshPart> out;
  for (const double level : section_levels(low, high, count)) {
    MeshPart lines = lines_named(fmt::format("section z = {:.6g}", level));
    for (const MeshPart* part : surfaces)
      for (std::size_t c = 0; c < part->mesh.cell_count(); ++c) {
        const std::vector<int> v = polygon(part->mesh, c);
        const auto at = [&](std::size_t k) { return part->mesh.vertices[v[k]]; };
        for (const auto& [a, b] : section({at(0), at(1), at(2), at(3)}, level)) add_segment(lines, a, b);
      }
    if (!lines.mesh.corners.empty()) out.push_back(std::move(lines));
  }
  return out;
}

void add_normals(std::vector<MeshPart>& parts, const std::vector<DrawnNormal>& normals) {
  const double length = normal_length(normals);
  for (const bool left : {true, false}) {
    MeshPart lines = lines_named(left ? "normals from the left" : "normals from the right");
    for (const DrawnNormal& n : normals)
      if (n.from_left == left) add_segment(lines, n.at, n.at + length * n.direction);
    if (!lines.mesh.corners.empty()) parts.push_back(std::move(lines));
  }
}

template <ExactField T>
Result<std::vector<MeshPart>> parts_of(const Model<T>& model, bool surfaces_only, const PlotOptions& options) {
  const Result<Chosen> which = chosen(model, options);
  if (!which) return which.error();
  std::vector<MeshPart> parts;
  for (const int i : which->curves) {
    if (surfaces_only) break;
    const ModelCurve<T>& c = model.curves[i];
    if (auto error =
            add_parts(parts, title_of("curve", i, c.name), tessellate(c.curve, options.cells.value_or(kCurveCells))))
      return *error;
  }
  const int cells = options.cells.value_or(kPatchCells);
  for (const int i : which->patches) {
    const GregoryPatch<T>* gregory = gregory_patch(model, i);
    if (auto error = add_parts(
            parts, title_of("patch", i, patch_name(model, i)),
            gregory ? tessellate(*gregory, {cells, cells}) : tessellate(model.patches[i].surface, {cells, cells})))
      return *error;
  }
  std::vector<MeshPart> lines;
  if (options.sections) lines = sections_of(parts, *options.sections);
  if (options.normals) {
    const auto normals = normals_along_lines(model, which->patches);
    if (!normals) return normals.error();
    add_normals(lines, *normals);
  }
  for (const int i : which->solids) {
    const ModelSolid<T>& s = model.solids[i];
    if (auto error = add_parts(parts, title_of("solid", i, s.name), tessellate(s.map, cells))) return *error;
  }
  std::move(lines.begin(), lines.end(), std::back_inserter(parts));
  return parts;
}

}  // namespace

std::optional<PlotFormat> plot_format(std::string_view name) {
  if (!name.empty() && name[0] == '.') name.remove_prefix(1);
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (lower == "svg") return PlotFormat::svg;
  if (lower == "obj") return PlotFormat::obj;
  if (lower == "stl") return PlotFormat::stl;
  if (lower == "vtu") return PlotFormat::vtu;
  if (lower == "glb") return PlotFormat::glb;
  return std::nullopt;
}

template <ExactField T>
Result<std::string> plot(const Model<T>& model, PlotFormat format, const PlotOptions& options) {
  // Pictures show GERBS as they are; outlines are near enough for meshes.
  if (has_gerbs(model) && (format != PlotFormat::svg || options.basis))
    return plot(gerbs_to_splines(model).model, format, options);
  if (options.cells && *options.cells < 1)
    return Error{ErrorCode::usage, "--cells", "at least one cell in each span", std::to_string(*options.cells)};
  if (options.basis && format != PlotFormat::svg)
    return Error{ErrorCode::usage, "--basis", "basis functions are drawn as svg only", ""};
  if (options.sections && *options.sections < 1)
    return Error{ErrorCode::usage, "--sections", "at least one section", std::to_string(*options.sections)};
  if ((options.normals || options.sections) && (format == PlotFormat::stl || options.basis))
    return Error{ErrorCode::usage, options.normals ? "--normals" : "--sections",
                 options.basis ? "graphs of functions have none" : "stl holds triangles only, no lines", ""};
  if (model.curves.empty() && model.patches.empty() && model.gregory_patches.empty() && model.solids.empty() &&
      !has_gerbs(model) && !options.curve && !options.patch && !options.solid)
    return Error{ErrorCode::usage, "plot", "there is nothing to draw: the model has no curves, patches or solids", ""};
  if (options.basis) {
    const auto panels = draw_basis(model, options);
    if (!panels) return panels.error();
    return svg_basis(*panels, options);
  }
  if (format == PlotFormat::svg) {
    const auto drawing = has_gerbs(model) ? draw_with_gerbs(model, options) : draw(model, options);
    if (!drawing) return drawing.error();
    return svg_scene(*drawing, options);
  }
  const auto parts = parts_of(model, format == PlotFormat::stl, options);
  if (!parts) return parts.error();
  switch (format) {
    case PlotFormat::obj: return write_obj(*parts);
    case PlotFormat::stl: return write_stl(*parts);
    case PlotFormat::vtu: return write_vtu(*parts);
    default: return write_glb(*parts);
  }
}

template Result<std::string> plot(const Model<Rational>&, PlotFormat, const PlotOptions&);
template Result<std::string> plot(const Model<Quadratic>&, PlotFormat, const PlotOptions&);

}  // namespace patchproof
