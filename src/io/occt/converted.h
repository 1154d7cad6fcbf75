// SPDX-License-Identifier: Apache-2.0
// A model together with the shapes that its numbers were taken from: for tests that hold Open CASCADE's own evaluation
// against the model.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <string>
#include <vector>

#include "patchproof/io/cad.h"

namespace patchproof::occt {

// An edge as it bounds a face, the face oriented forward.
struct Source {
  TopoDS_Edge edge;
  TopoDS_Face face;
};
using Sources = std::vector<Source>;

struct Converted {
  CadModel model;
  std::vector<Sources> sources;  // of each edge of the model: of its uses, in their order (fewer when it is unusable)
};
Result<Converted> read_converted(const std::string& path, UnusableFaces unusable);

}  // namespace patchproof::occt
