// SPDX-License-Identifier: Apache-2.0
// Curve meshes that all threads fill and prove, and models that all tessellate: one job to each call.
#include "patchproof/io/curve_mesh_file.h"
#include "patchproof/io/mesh_files.h"
#include "patchproof/io/read.h"
#include "patchproof/join/edge_match.h"
#include "patchproof/mesh/adaptive_mesh.h"
#include "patchproof/mesh/chord_bound.h"
#include "patchproof/mesh/fill_faces.h"
#include "patchproof/mesh/prove_fill.h"
#include "patchproof/mesh/tessellate.h"
#include "threads/said.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

constexpr const char* kExamples = PATCHPROOF_SOURCE_DIR "/examples/";

template <class R>
std::string said_of(const FilledMesh<R>& filled) {
  Said out;
  for (const auto& patch : filled.patches) out.add(patch.u_surface()), out.add(patch.v_surface());
  return out.text();
}

TEST(ThreadsMesh, OneMeshIsFilledAndProvedByAll) {
  const CurveMesh mesh = read_curve_mesh(std::string(kExamples) + "meshes/two_faces.json").value().mesh;
  const MeshTopology topology = analyse(mesh).value();
  const FilledMesh<Rational> filled = fill_faces<Rational>(mesh, topology, {}, 1).value();
  Request request;
  request.seconds_per_join = 1e5;
  Together all;
  all.add("topology", [&] {
    const MeshTopology again = analyse(mesh).value();
    return say(again.kinds, again.left, again.right, again.uses_of_face);
  });
  all.add("filled", [&] { return said_of(fill_faces<Rational>(mesh, topology, {}, 1).value()); });
  all.add("filled by the former method",
          [&] { return said_of(fill_faces<Rational>(mesh, topology, {.method = FillMethod::former}, 1).value()); });
  all.add("filled in intervals", [&] { return said_of(fill_faces<Interval>(mesh, topology, {}, 1).value()); });
  all.add("filled in doubles", [&] { return said_of(fill_faces<double>(mesh, topology, {}, 1).value()); });
  all.add("proved", [&] {
    const FillProof proof = prove_fill(mesh, topology, filled.patches, request, 1);
    Said out;
    for (const Certificate& each : proof.certificates)
      out.add(each.c0.verdict), out.add(each.g1.verdict), out.add(each.angle.upper);
    for (const GregoryProof& each : proof.patches)
      out.add(each.is_c1()), out.add(each.regular.verdict), out.add(each.boxes);
    return out.text();
  });
  all.add("written", [&] { return write_curve_mesh(mesh, "mm"); });
  all.run();
}

TEST(ThreadsMesh, OneModelIsTessellatedByAll) {
  const ModelFile torus = read_model(std::string(kExamples) + "torus_q.json").value();
  const auto& model = std::get<Model<Rational>>(torus.model);
  std::vector<const BsplinePatch<Rational, 4>*> patches;
  for (const auto& patch : model.patches) patches.push_back(&patch.surface);
  const EdgeMatch<Rational> match = match_edges(patches);
  const MeshRequest request{.chord = 0.5, .angle = 30, .jobs = 1};
  const auto said_of = [](const Result<CertifiedMesh>& result) {
    const CertifiedMesh& mesh = result.value();
    const Watertight found = check_watertight(mesh);
    return say(mesh.vertices, mesh.triangles, mesh.faces, mesh.free, mesh.chord, mesh.angle, mesh.gap, mesh.notes,
               found.edges, found.is_closed(), found.oriented);
  };
  Together all;
  for (const CellMethod method : {CellMethod::adaptive, CellMethod::regular})
    all.add(method == CellMethod::adaptive ? "adaptive" : "regular",
            [&, method] { return said_of(adaptive_mesh(patches, match.joins, match.collapsed, request, method)); });
  all.add("pieces", [&] {
    const RoundingGuard guard;
    const SurfacePieces pieces = SurfacePieces::of(*patches[0], PieceParameters::spans);
    const SurfaceHull hull = pieces.bound(pieces.domain());
    return say(pieces.point(0.5, 0.25), hull.uu, hull.uv, hull.vv, hull.chord(0.5, 0.5));
  });
  all.add("cells in files", [&] {
    std::vector<MeshPart> parts;
    std::vector<Tessellation<2>> pieces = tessellate(*patches[0], {3, 4}).value();
    for (Tessellation<2>& piece : pieces) parts.push_back(make_part("patch", std::move(piece)));
    return say(write_obj(parts), write_stl(parts), write_ply(parts), write_vtu(parts), write_glb(parts));
  });
  all.run();
}

}  // namespace
}  // namespace patchproof::test
