// SPDX-License-Identifier: Apache-2.0
#include "cli/tessellate_cad.h"

#include <fmt/format.h>

#include <map>

#include "patchproof/io/cad.h"
#include "patchproof/mesh/delaunay.h"
#include "patchproof/mesh/trimmed_mesh.h"

namespace patchproof::cli {

Result<ModelMesh> mesh_of_cad(const std::string& path, [[maybe_unused]] const MeshRequest& request) {
#ifndef PATCHPROOF_HAVE_OCCT_READER
  return Error{ErrorCode::unsupported, path,
               "STEP, IGES and BREP files are read by builds with Open CASCADE (Debian: libocct-data-exchange-dev)",
               ""};
#elif !defined(PATCHPROOF_HAVE_DELAUNAY)
  return Error{
      ErrorCode::unsupported, path,
      "trimmed faces are meshed by builds with the GPL part patchproof::delaunay (CMake: PATCHPROOF_DELAUNAY=ON)", ""};
#else
  const Result<CadModel> cad = read_cad_model(path);
  if (!cad) return cad.error();
  if (cad->faces.empty()) return Error{ErrorCode::wrong_count, path, "the file has no faces", "0"};
  ModelMesh out{{}, cad->units, "delaunay", cad->notes};
  std::vector<TrimmedFace> faces;
  for (const CadFace& face : cad->faces) faces.push_back({face.label, &face.surface});
  std::vector<TrimmedEdge> edges;
  std::map<std::string, std::size_t> unusable;
  for (const CadEdge& edge : cad->edges) {
    if (edge.kind == CadEdgeKind::unusable) ++unusable[edge.note];
    if (edge.kind == CadEdgeKind::unusable || edge.kind == CadEdgeKind::degenerate) continue;
    edges.push_back({edge.label, {}, edge.tolerance});
    for (const CadUse& use : edge.uses) edges.back().uses.push_back({use.face, use.forward, &use.parameters});
  }
  for (const auto& [note, count] : unusable)
    out.notes.push_back(fmt::format("{} edges are not usable: {}", count, note));
  Result<CertifiedMesh> mesh = trimmed_mesh(faces, edges, request, constrained_delaunay);
  if (!mesh) return mesh.error();
  out.mesh = std::move(*mesh);
  return out;
#endif
}

}  // namespace patchproof::cli
