// SPDX-License-Identifier: Apache-2.0
// Shapes of Open CASCADE and their meshes by its BRepMesh.
#pragma once

#include <TopoDS_Shape.hxx>

#include <optional>
#include <string>
#include <vector>

#include "patchproof/mesh/watertight.h"
#include "validation/tessellation/surface_distance.h"

namespace patchproof::tessellation {

// Of this process: unlike the time on the wall, hardly moved by other programs.
double processor_seconds();

std::optional<TopoDS_Shape> read_step(const std::string& path);
std::optional<TopoDS_Shape> read_brep(const std::string& bytes);
// With the edges shared that lie on each other within the tolerance.
TopoDS_Shape sewn(const TopoDS_Shape& shape, double tolerance);
bool write_brep(const TopoDS_Shape& shape, const std::string& path);

// In the order of TopExp::MapShapes.
std::vector<FaceSurface> surfaces_of(const TopoDS_Shape& shape);

// On one thread. Triangles that have two equal corners are left out; `free` are the edges of triangles on edges of the shape that
// one face has once.
struct OcctMesh {
  CertifiedMesh mesh;
  double seconds = 0;
  int faces_without = 0;  // faces that it leaves without triangles
};
OcctMesh mesh_by_occt(const TopoDS_Shape& shape, double deflection, double radians);

std::string occt_version();

}  // namespace patchproof::tessellation
