// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "patchproof/error.h"
#include "patchproof/io/tessellate_model.h"

namespace patchproof::cli {

// The faces of a STEP, IGES or BREP file as triangles, by constrained Delaunay triangulations.
Result<ModelMesh> mesh_of_cad(const std::string& path, const MeshRequest& request);

}  // namespace patchproof::cli
