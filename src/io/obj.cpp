// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/mesh_parts.h"

namespace patchproof {
namespace {

using Buffer = fmt::memory_buffer;

template <class... Arguments>
void put(Buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

// Edges that follow each other become one polyline.
void put_lines(Buffer& out, const CellComplex<double, 3>& mesh, std::size_t first) {
  int last = -1;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto edge = mesh.cell(c);
    if (edge[0] != last) put(out, "{}l {}", c == 0 ? "" : "\n", first + edge[0]);
    last = edge[1];
    put(out, " {}", first + last);
  }
  if (last >= 0) put(out, "\n");
}

}  // namespace

Result<std::string> write_obj(const std::vector<MeshPart>& parts) {
  Buffer out;
  put(out, "# patchproof\n");
  std::size_t vertices = 1, normals = 1, cells = 0;  // OBJ counts from 1
  for (const MeshPart& given : parts) {
    const MeshPart part = visible(given);
    put(out, "o {}\n", part.name.empty() ? "part" : printable(part.name));
    for (const Vec<double, 3>& p : part.mesh.vertices) put(out, "v {} {} {}\n", p[0], p[1], p[2]);
    std::vector<std::size_t> number(part.mesh.vertices.size(), 0);  // of the vertex's normal
    for (std::size_t v = 0; v < part.normals.size(); ++v)
      if (const auto& n = part.normals[v]) {
        number[v] = normals++;
        put(out, "vn {} {} {}\n", (*n)[0], (*n)[1], (*n)[2]);
      }
    cells += part.mesh.cell_count();
    if (part.mesh.dimension == 1) {
      put_lines(out, part.mesh, vertices);
    } else {
      for (std::size_t c = 0; c < part.mesh.cell_count(); ++c) {
        const std::vector<int> corners = polygon(part.mesh, c);
        const bool smooth = std::all_of(corners.begin(), corners.end(), [&](int v) { return number[v] > 0; });
        put(out, "f");
        for (const int v : corners)
          smooth ? put(out, " {}//{}", vertices + v, number[v]) : put(out, " {}", vertices + v);
        put(out, "\n");
      }
    }
    vertices += part.mesh.vertices.size();
  }
  if (cells == 0) return Error{ErrorCode::usage, "OBJ", "there is nothing to write", ""};
  return fmt::to_string(out);
}

}  // namespace patchproof
