// SPDX-License-Identifier: Apache-2.0
// A model together with the shape, converted to B-splines, that its numbers were taken from: for tests that hold Open
// CASCADE's own evaluation against the model. The model's edges stand in the order of
// TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE).
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>

#include "patchproof/io/cad.h"

namespace patchproof::occt {

struct Converted {
  CadModel model;
  TopoDS_Shape shape;
};
Result<Converted> read_converted(const std::string& path, UnusableFaces unusable);

}  // namespace patchproof::occt
