// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bit>

#include "io/mesh_parts.h"

namespace patchproof {
namespace {

void put_double(std::string& out, double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  put_bytes(out, static_cast<std::uint32_t>(bits));
  put_bytes(out, static_cast<std::uint32_t>(bits >> 32));
}

}  // namespace

Result<std::string> write_ply(const std::vector<MeshPart>& parts) {
  std::string vertices, faces, edges;
  std::size_t vertex_count = 0, face_count = 0, edge_count = 0;
  std::string names;
  for (const MeshPart& given : parts) {
    const MeshPart part = visible(given);
    if (vertex_count + part.mesh.vertices.size() >= std::size_t{1} << 31)
      return Error{ErrorCode::usage, "PLY", "the file would have 2^31 vertices or more", ""};
    names += fmt::format("comment {}\n", part.name.empty() ? "part" : printable(part.name));
    for (const Vec<double, 3>& p : part.mesh.vertices)
      for (const double x : p.c) put_double(vertices, x);
    for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) {
      const std::vector<int> corners = polygon(part.mesh, c);
      std::string& out = part.mesh.dimension == 1 ? edges : faces;
      if (part.mesh.dimension == 2) put_bytes(out, static_cast<std::uint32_t>(corners.size()), 1);
      for (const int v : corners) put_bytes(out, static_cast<std::uint32_t>(vertex_count + v));
      ++(part.mesh.dimension == 1 ? edge_count : face_count);
    }
    vertex_count += part.mesh.vertices.size();
  }
  if (face_count + edge_count == 0)
    return Error{ErrorCode::usage, "PLY", "there are no lines and polygons to write", ""};
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment patchproof\n" + names;
  out += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", vertex_count);
  if (face_count > 0) out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", face_count);
  if (edge_count > 0) out += fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n", edge_count);
  return out + "end_header\n" + vertices + faces + edges;
}

}  // namespace patchproof
