// SPDX-License-Identifier: Apache-2.0
// A model as triangles with a proved error, and in files whose numbers may be single.
//
// B-spline patches, and GERBS surfaces that are splines, are meshed by adaptive_mesh.h. Faces of CAD files are not: they need
// trimmed_mesh.h and a triangulation that is under the GPL; everything below the first function serves their meshes, too.
//
//   rounding  formats of single precision (STL, glb) move a vertex by at most √3 (2^-24 |x| + 2^-149), |x| the largest
//             coordinate; this comes on top of the proved chord error, so meshes for them are made a little finer
//
// ENSURES   (1) tessellate_model: the laws of adaptive_mesh for the model's patches, matched by geometry or as the model
//           declares; faces of the mesh are numbers of patches, or of their parts where a patch may jump at a knot (a note says
//           so, and what is left out);  (2) mesh_for_file: where both meshes that it may ask for reach the chord error asked of
//           them, chord + rounding ≤ request.chord unless the rounding alone is above that;  (3) write_mesh: the file holds the
//           mesh's triangles in order (those that collapse in single precision are not in STL), each vertex within rounding_of
//           it;  (4) judge_mesh: proved if no triangle misses, chord + rounding ≤ asked and the mesh is watertight;  (5) the
//           same model and request give the same bytes, with any number of jobs.
// ERRORS    unsupported: a model without patches, with Gregory patches only, with a GERBS that is no spline (`where`: "patch 3");
//           those of adaptive_mesh: usage, bad_number; those of mesh_files.h. Throws stop_requested or deadline_passed under a
//           StopScope that is raised.
// COST      as adaptive_mesh; expanding GERBS takes up to some seconds.
// NEIGHBOURS mesh/adaptive_mesh.h, mesh_files.h, plot.h (meshes without a proof).
// TEST      tests/io/tessellate_model_test.cpp checks (1)–(5).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/io/model.h"
#include "patchproof/mesh/adaptive_mesh.h"
#include "patchproof/mesh/watertight.h"

namespace patchproof {

struct ModelMesh {
  CertifiedMesh mesh;
  std::string units;
  std::string method;              // "adaptive", "regular"; of CAD files "delaunay"
  std::vector<std::string> notes;  // of the reader, and what was expanded, left out or split
};

Result<ModelMesh> tessellate_model(const ModelFile& file, const MeshRequest& request,
                                   CellMethod method = CellMethod::adaptive);

enum class MeshFormat { stl, obj, ply, glb, vtu };
// ".stl", ".obj", ".ply", ".glb", ".vtu"
std::optional<MeshFormat> mesh_format_of(std::string_view extension);
bool is_single_precision(MeshFormat format);

// By how much the format moves a vertex of the mesh at most; 0 where it holds doubles.
double rounding_of(const CertifiedMesh& mesh, MeshFormat format);

// A mesh by `make`, of which the request holds in a file of that format: `make` is asked for a smaller chord error where it needs
// room for the rounding, and again where that was too little.
Result<ModelMesh> mesh_for_file(MeshFormat format, const MeshRequest& request,
                                const std::function<Result<ModelMesh>(const MeshRequest&)>& make);

// The bytes of the file; `name` stands in formats that hold one.
Result<std::string> write_mesh(const CertifiedMesh& mesh, const std::string& name, MeshFormat format);

struct MeshJudgement {
  Watertight watertight;
  double rounding = 0;
  bool proved = false;
};
// format: of the file that it is written to, if any.
MeshJudgement judge_mesh(const CertifiedMesh& mesh, const MeshRequest& asked,
                         std::optional<MeshFormat> format = std::nullopt);

}  // namespace patchproof
