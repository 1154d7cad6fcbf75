// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_parts.h"

namespace patchproof {
namespace {

Vec<double, 3> single(const Vec<double, 3>& p) {
  return {{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}};
}

}  // namespace

Result<std::string> write_stl(const std::vector<MeshPart>& parts) {
  std::string triangles;
  std::uint32_t count = 0;
  for (const MeshPart& given : parts) {
    const MeshPart part = triangulated(visible(given));
    if (part.mesh.dimension != 2) continue;
    if (auto error = beyond_single_precision(part)) return *error;
    for (std::size_t t = 0; t < part.mesh.cell_count(); ++t) {
      const auto corners = part.mesh.cell(t);
      const Vec<double, 3> a = single(part.mesh.vertices[corners[0]]), b = single(part.mesh.vertices[corners[1]]),
                           c = single(part.mesh.vertices[corners[2]]);
      if (a == b || b == c || c == a) continue;
      const Vec<double, 3> normal = unit(cross(b - a, c - a)).value_or(Vec<double, 3>{});  // (0, 0, 0): not stated
      for (const Vec<double, 3>& v : {normal, a, b, c})
        for (const double x : v.c) put_float(triangles, x);
      put_bytes(triangles, 0, 2);
      ++count;
    }
  }
  if (count == 0)
    return Error{ErrorCode::usage, "STL", "there are no triangles to write, and STL holds nothing else", ""};
  std::string out = "binary STL written by patchproof";  // must not begin with "solid"
  out.resize(80, ' ');
  put_bytes(out, count);
  return out + triangles;
}

}  // namespace patchproof
