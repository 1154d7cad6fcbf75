// SPDX-License-Identifier: Apache-2.0
// The shape of a STEP, IGES or BREP file as Open CASCADE builds it, what the file calls its parts, and which of its faces are
// missing or not to be trusted.
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <string_view>
#include <vector>

#include "patchproof/io/cad.h"

namespace patchproof::occt {

struct Loaded {
  TopoDS_Shape shape;
  std::string units;
  // In the orders of TopExp::MapShapes (faces) and TopExp::MapShapesAndAncestors (edges, with their faces).
  std::vector<std::string> face_labels, edge_labels;
  // Faces whose entities could not be read as they stand in the file ("" for the others): Open CASCADE puts zeros there.
  std::vector<std::string> face_faults;
  std::vector<LeftOutFace> missing;  // faces of the file that Open CASCADE builds no shape from
};

// "step", "iges" or "brep", by the first bytes.
std::string format_of(std::string_view bytes);

// "face 7"
std::string plain_label(const char* what, int index);

// ERRORS syntax; where unusable faces are refused, about the first that cannot be read, before its shape is built: Open
// CASCADE may not come to an end with it.  THROWS Standard_Failure.
Result<Loaded> load(const std::string& path, const std::string& format, UnusableFaces unusable);

}  // namespace patchproof::occt
