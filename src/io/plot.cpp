// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "io/drawing.h"
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
    const ModelPatch<T>& p = model.patches[i];
    if (auto error = add_parts(parts, title_of("patch", i, p.name), tessellate(p.surface, {cells, cells})))
      return *error;
  }
  for (const int i : which->solids) {
    const ModelSolid<T>& s = model.solids[i];
    if (auto error = add_parts(parts, title_of("solid", i, s.name), tessellate(s.map, cells))) return *error;
  }
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
  if (options.cells && *options.cells < 1)
    return Error{ErrorCode::usage, "--cells", "at least one cell in each span", std::to_string(*options.cells)};
  if (options.basis && format != PlotFormat::svg)
    return Error{ErrorCode::usage, "--basis", "basis functions are drawn as svg only", ""};
  if (model.curves.empty() && model.patches.empty() && model.solids.empty() && !options.curve && !options.patch &&
      !options.solid)
    return Error{ErrorCode::usage, "plot", "there is nothing to draw: the model has no curves, patches or solids", ""};
  if (options.basis) {
    const auto panels = draw_basis(model, options);
    if (!panels) return panels.error();
    return svg_basis(*panels, options);
  }
  if (format == PlotFormat::svg) {
    const auto drawing = draw(model, options);
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
