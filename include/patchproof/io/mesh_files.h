// SPDX-License-Identifier: Apache-2.0
// Meshes as files for other programs: OBJ, STL (binary), PLY (binary), VTU and glTF (.glb).
//
//   OBJ    points, normals, polylines, polygons; of a solid its boundary. Text with every double in full
//   STL    triangles in single precision; of a solid its boundary; no curves
//   PLY    points in double precision, polygons and lines; of a solid its boundary
//   VTU    VTK's unstructured grid: lines, triangles, quadrangles, tetrahedra, hexahedra; parameters as u, v, w, and normals,
//          where every part has them; "part" says for each cell from which part it comes
//   glb    glTF 2.0 in one file: lines and triangles in single precision, one node for each part, turned so that z points up
//
// ENSURES  (1) the file holds the cells of the parts, in order: quadrangles as polygons (STL, glb: as two triangles each),
//              facets of a solid's boundary oriented outwards, a solid whose cells have a negative volume altogether
//              mirrored;  (2) the same parts give the same bytes, in any locale;
//          (3) normals appear only where there are some: for a corner in OBJ when all corners of its polygon have one, for a
//              part in glb and for the file in VTU when all vertices have one;  (4) STL leaves out triangles of which two
//              corners are the same in single precision.
// ERRORS   usage: no part has anything that the format can hold;  bad_number: a coordinate beyond single precision.
// COST     linear in the cells.
// NEIGHBOURS mesh/tessellate.h (makes the meshes), plot.h (from models), svg.h (pictures).
// TEST     tests/io/mesh_files_test.cpp checks (1)–(4).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "patchproof/error.h"
#include "patchproof/mesh/cell_complex.h"
#include "patchproof/mesh/tessellate.h"

namespace patchproof {

struct MeshPart {
  std::string name;
  CellComplex<double, 3> mesh;                         // cells of dimension 1, 2 or 3
  std::vector<std::optional<Vec<double, 3>>> normals;  // of each vertex, or empty
  std::array<std::vector<double>, 3> parameters{};     // u, v, w of each vertex, or empty
};

template <std::size_t D>
MeshPart make_part(std::string name, Tessellation<D> piece) {
  static_assert(1 <= D && D <= 3, "curves, surfaces and solids");
  MeshPart part{std::move(name), std::move(piece.mesh), std::move(piece.normals), {}};
  for (const Vec<double, D>& x : piece.parameters)
    for (std::size_t i = 0; i < D; ++i) part.parameters[i].push_back(x[i]);
  return part;
}

Result<std::string> write_obj(const std::vector<MeshPart>& parts);
Result<std::string> write_stl(const std::vector<MeshPart>& parts);
Result<std::string> write_ply(const std::vector<MeshPart>& parts);
Result<std::string> write_vtu(const std::vector<MeshPart>& parts);
Result<std::string> write_glb(const std::vector<MeshPart>& parts);

}  // namespace patchproof
