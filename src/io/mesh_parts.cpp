// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_parts.h"

#include <fmt/format.h>

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

MeshPart visible(const MeshPart& part) {
  if (part.mesh.dimension < 3) return part;
  MeshPart out{part.name, boundary(part.mesh), {}, {}};
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
