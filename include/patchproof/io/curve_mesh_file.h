// SPDX-License-Identifier: Apache-2.0
// Curve meshes as JSON files (docs/formats.md, "Curve meshes").
//
// ENSURES  (1) every number is read exactly (Decimals::exact) or as the nearest double (Decimals::binary64);
//          (2) read_curve_mesh_text(write_curve_mesh(m)) gives m back, for ids in UTF-8;
//          (3) ids are unique, each in its list, and references by id are resolved; what the mesh means is for analyse() to check.
// ERRORS   cannot_open, syntax, unknown_format, unsupported, bad_number, wrong_count, bad_reference; `where` is the file at a
//          JSON pointer.
// TEST     tests/io/curve_mesh_file_test.cpp checks (1)–(3).
#pragma once

#include <string>
#include <string_view>

#include "patchproof/error.h"
#include "patchproof/mesh/curve_mesh.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof {

struct CurveMeshFile {
  std::string path, sha256, units;
  CurveMesh mesh;
};

Result<CurveMeshFile> read_curve_mesh(const std::string& path, Decimals decimals = Decimals::exact);
Result<CurveMeshFile> read_curve_mesh_text(std::string_view bytes, const std::string& path,
                                           Decimals decimals = Decimals::exact);

std::string write_curve_mesh(const CurveMesh& mesh, const std::string& units = "");

// Does the text begin a curve mesh, by its "format"?
bool looks_like_curve_mesh(std::string_view bytes);

}  // namespace patchproof
