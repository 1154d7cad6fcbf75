// SPDX-License-Identifier: Apache-2.0
// What the writers of meshes share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "patchproof/io/mesh_files.h"
#include "patchproof/mesh/facets.h"

namespace patchproof {

// The name on one line of valid UTF-8.
std::string printable(const std::string& name);

// Whether the signed volumes of the cells sum to less than 0. The map of a solid may turn space inside out: its cells, and
// with them their facets, are then written the other way round. Never so for lines and surfaces.
bool is_inside_out(const CellComplex<double, 3>& mesh);

// The part as lines or surfaces: a solid's boundary turned outwards, without the vertices and normals inside.
MeshPart visible(const MeshPart& part);

// The same with triangles for quadrangles.
inline MeshPart triangulated(MeshPart part) {
  if (part.mesh.dimension == 2 && part.mesh.kind == CellKind::cuboid) part.mesh = to_simplices(part.mesh);
  return part;
}

// The corners of a polygon in the order of its boundary: those of a quadrangle are numbered 00, 10, 01, 11.
inline std::vector<int> polygon(const CellComplex<double, 3>& mesh, std::size_t c) {
  const auto corners = mesh.cell(c);
  if (mesh.kind == CellKind::simplex || mesh.dimension < 2) return {corners.begin(), corners.end()};
  return {corners[0], corners[1], corners[3], corners[2]};
}

inline bool has_all_normals(const MeshPart& part) {
  for (const auto& n : part.normals)
    if (!n) return false;
  return !part.normals.empty();
}

// Says which coordinate single precision cannot hold, if any.
std::optional<Error> beyond_single_precision(const MeshPart& part);

// Appends the bytes of an unsigned number, or of a float, the lowest first.
inline void put_bytes(std::string& out, std::uint32_t x, int bytes = 4) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(x >> 8 * i & 0xff));
}
void put_float(std::string& out, double x);

}  // namespace patchproof
