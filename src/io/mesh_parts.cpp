// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <nlohmann/json.hpp>

namespace patchproof {

std::string printable(const std::string& name) {
  using nlohmann::json;
  // The writer of JSON replaces what is no UTF-8.
  std::string text = json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

bool is_inside_out(const CellComplex<double, 3>& mesh) {
  if (mesh.dimension < 3 || mesh.corners.empty()) return false;
  const CellComplex<double, 3> simplices = mesh.kind == CellKind::simplex ? mesh : to_simplices(mesh);
  // Halves, from the first vertex and in units of the extent: no product overflows, and a far origin costs no digits.
  const Vec<double, 3> origin = 0.5 * mesh.vertices[0];
  double extent = 0;
  for (const Vec<double, 3>& p : mesh.vertices)
    for (const double x : (0.5 * p - origin).c) extent = std::max(extent, std::abs(x));
  if (!(extent > 0)) return false;
  const auto place = [&](int v) {
    Vec<double, 3> p = 0.5 * mesh.vertices[v] - origin;
    for (double& x : p.c) x /= extent;
    return p;
  };
  double sum = 0;
  for (std::size_t c = 0; c < simplices.cell_count(); ++c) {
    const auto v = simplices.cell(c);
    const Vec<double, 3> a = place(v[0]);
    sum += dot(cross(place(v[1]) - a, place(v[2]) - a), place(v[3]) - a);
  }
  return sum < 0;
}

MeshPart visible(const MeshPart& part) {
  if (part.mesh.dimension < 3) return part;
  MeshPart out{part.name, boundary(part.mesh), {}, {}};
  if (is_inside_out(part.mesh)) {
    // The last two corners of a triangle; of a quadrangle the ends of its first axis.
    const std::size_t n = out.mesh.corners_per_cell();
    for (std::size_t first = 0; first < out.mesh.corners.size(); first += n) {
      std::swap(out.mesh.corners[first + n - 2], out.mesh.corners[first + n - 1]);
      if (n == 4) std::swap(out.mesh.corners[first], out.mesh.corners[first + 1]);
    }
  }
  std::vector<int> renamed(part.mesh.vertices.size(), -1);
  std::vector<Vec<double, 3>> vertices;
  for (int& v : out.mesh.corners) {
    if (renamed[v] < 0) {
      renamed[v] = static_cast<int>(vertices.size());
      vertices.push_back(part.mesh.vertices[v]);
    }
    v = renamed[v];
  }
  out.mesh.vertices = std::move(vertices);
  return out;
}

std::optional<Error> beyond_single_precision(const MeshPart& part) {
  for (const Vec<double, 3>& p : part.mesh.vertices)
    for (const double x : p.c)
      if (!(std::abs(x) <= FLT_MAX))
        return Error{ErrorCode::bad_number, printable(part.name), "a coordinate is beyond single precision",
                     fmt::format("{}", x)};
  return std::nullopt;
}

void put_float(std::string& out, double x) { put_bytes(out, std::bit_cast<std::uint32_t>(static_cast<float>(x))); }

}  // namespace patchproof
