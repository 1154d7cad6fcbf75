// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/mesh/watertight.h"

namespace patchproof::cli {

// The faces of a STEP, IGES or BREP file as triangles, by constrained Delaunay triangulations.
Result<CertifiedMesh> mesh_of_cad(const std::string& path, const MeshRequest& request, std::string& units,
                                  std::vector<std::string>& notes);

}  // namespace patchproof::cli
