// SPDX-License-Identifier: Apache-2.0
#include "patchproof/io/tessellate_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gerbs_splines.h"
#include "patchproof/io/mesh_files.h"
#include "patchproof/join/edge_match.h"

namespace patchproof {
namespace {

template <ExactField T>
Result<ModelMesh> mesh_of(const Model<T>& model, const MeshRequest& request, CellMethod method) {
  if (has_gerbs(model)) {
    SplineModel<T> splines = gerbs_to_splines(model);
    if (!splines.outlined_patches.empty())
      return Error{ErrorCode::unsupported, fmt::format("patch {}", splines.outlined_patches.front()),
                   "no error can be proved yet for a GERBS that is no spline; plot draws it, without a bound", ""};
    Result<ModelMesh> out = mesh_of(splines.model, request, method);
    if (out) out->notes.insert(out->notes.begin(), splines.notes.begin(), splines.notes.end());
    return out;
  }
  ModelMesh out{{}, model.units, method == CellMethod::regular ? "regular" : "adaptive", {}};
  const auto left_out = [&](std::size_t count, const char* what) {
    if (count > 0) out.notes.push_back(fmt::format("left out: {} {}", count, what));
  };
  left_out(model.gregory_patches.size(), "Gregory patches");
  left_out(model.curves.size(), "curves");
  left_out(model.solids.size(), "solids");
  std::vector<BsplinePatch<T, 4>> parts;
  bool torn = false;
  for (const ModelPatch<T>& p : model.patches) {
    std::vector<BsplinePatch<T, 4>> of_patch = split_torn(p.surface);
    torn = torn || of_patch.size() > 1;
    for (auto& part : of_patch) parts.push_back(std::move(part));
  }
  if (parts.empty())
    return Error{ErrorCode::unsupported, "tessellate",
                 model.gregory_patches.empty()
                     ? "the model has no patches"
                     : "Gregory patches are not tessellated: convert writes B-spline patches near them",
                 ""};
  if (torn)
    out.notes.push_back("patches that may jump at a knot are meshed in parts, and patches are counted by parts");
  std::vector<const BsplinePatch<T, 4>*> patches;
  for (const auto& p : parts) patches.push_back(&p);
  EdgeMatch<T> match = match_edges(patches);
  if (!model.joins.empty() && !torn) {
    match.joins.clear();
    for (const DeclaredJoin& j : model.joins)
      match.joins.push_back(whole_edge_join(patches, j.patch_a, j.edge_a, j.patch_b, j.edge_b, j.reversed));
  }
  Result<CertifiedMesh> mesh = adaptive_mesh(patches, match.joins, match.collapsed, request, method);
  if (!mesh) return mesh.error();
  out.mesh = std::move(*mesh);
  return out;
}

}  // namespace

Result<ModelMesh> tessellate_model(const ModelFile& file, const MeshRequest& request, CellMethod method) {
  if (auto error = check_request(request)) return *error;
  Result<ModelMesh> out = std::visit([&](const auto& model) { return mesh_of(model, request, method); }, file.model);
  if (out) out->notes.insert(out->notes.begin(), file.notes.begin(), file.notes.end());
  return out;
}

std::optional<MeshFormat> mesh_format_of(std::string_view extension) {
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".glb") return MeshFormat::glb;
  if (extension == ".vtu") return MeshFormat::vtu;
  return std::nullopt;
}

bool is_single_precision(MeshFormat format) { return format == MeshFormat::stl || format == MeshFormat::glb; }

double rounding_of(const CertifiedMesh& mesh, MeshFormat format) {
  if (!is_single_precision(format)) return 0;
  double largest = 0;
  for (const auto& v : mesh.vertices)
    for (const double x : v.c) largest = std::max(largest, std::abs(x));
  return 1.7321 * (0x1p-24 * largest + 0x1p-149);
}

Result<ModelMesh> mesh_for_file(MeshFormat format, const MeshRequest& request,
                                const std::function<Result<ModelMesh>(const MeshRequest&)>& make) {
  MeshRequest first = request;
  if (is_single_precision(format)) first.chord = 0.995 * request.chord;
  Result<ModelMesh> out = make(first);
  if (!out) return out;
  const double rounding = rounding_of(out->mesh, format);
  if (out->mesh.chord <= request.chord && out->mesh.chord + rounding > request.chord) {
    MeshRequest less = request;
    less.chord = request.chord - 1.01 * rounding;
    if (less.chord > 0) return make(less);
  }
  return out;
}

Result<std::string> write_mesh(const CertifiedMesh& mesh, const std::string& name, MeshFormat format) {
  MeshPart part{name, {CellKind::simplex, 2, mesh.vertices, {}}, {}, {}};
  for (const auto& t : mesh.triangles) part.mesh.corners.insert(part.mesh.corners.end(), t.begin(), t.end());
  switch (format) {
    case MeshFormat::stl: return write_stl({part});
    case MeshFormat::obj: return write_obj({part});
    case MeshFormat::ply: return write_ply({part});
    case MeshFormat::glb: return write_glb({part});
    case MeshFormat::vtu: return write_vtu({part});
  }
  PATCHPROOF_REQUIRES(false, "write_mesh: no such format");
}

MeshJudgement judge_mesh(const CertifiedMesh& mesh, const MeshRequest& asked, std::optional<MeshFormat> format) {
  MeshJudgement out{check_watertight(mesh), format ? rounding_of(mesh, *format) : 0, false};
  out.proved = mesh.chord_misses == 0 && mesh.angle_misses == 0 && mesh.chord + out.rounding <= asked.chord &&
               out.watertight.is_watertight();
  return out;
}

}  // namespace patchproof
