// SPDX-License-Identifier: Apache-2.0
// The shape of a STEP, IGES or BREP file as Open CASCADE builds it, what the file calls its parts, and which of its faces are
// missing or not to be trusted.
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <string_view>
#include <vector>

#include "brep_text.h"
#include "patchproof/io/cad.h"

namespace patchproof::occt {

struct Loaded {
  TopoDS_Shape shape;
  std::string units;
  std::vector<std::string> notes;
  // In the orders of TopExp::MapShapes (faces) and TopExp::MapShapesAndAncestors (edges, with their faces).
  std::vector<std::string> face_labels, edge_labels;
  // Of faces, and of edges, that hold what could not be read as it stands in the file: Open CASCADE, or we, put something
  // else there. Those of edges may be missing.
  Damages face_faults, edge_faults;
  std::vector<LeftOutFace> missing;  // faces of the file that Open CASCADE builds no shape from
};

// "step", "iges" or "brep", by the first bytes.
std::string format_of(std::string_view bytes);

// "face 7"
std::string plain_label(const char* what, int index);

// About the first of these faces.  REQUIRES one.
Error about_faces(const std::string& path, const std::vector<LeftOutFace>& unusable);

// ERRORS syntax, and those of check_brep_text; where unusable faces are refused, about the first that cannot be read, before
// its shape is built: Open CASCADE may not come to an end with it.  THROWS Standard_Failure.
Result<Loaded> load(const std::string& path, std::string_view bytes, const std::string& format, UnusableFaces unusable);
Result<Loaded> load_brep(const std::string& path, std::string_view bytes, UnusableFaces unusable);

}  // namespace patchproof::occt
