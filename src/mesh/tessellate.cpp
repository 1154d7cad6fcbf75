// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/tessellate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace patchproof {

std::optional<Vec<double, 3>> unit(const Vec<double, 3>& v) {
  if (!detail::is_finite(v)) return std::nullopt;
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (largest == 0) return std::nullopt;
  const int exponent = std::ilogb(largest);
  Vec<double, 3> scaled;
  for (std::size_t i = 0; i < 3; ++i) scaled[i] = std::scalbn(v[i], -exponent);
  const double length = std::sqrt(dot(scaled, scaled));
  for (std::size_t i = 0; i < 3; ++i) scaled[i] /= length;
  return scaled;
}

namespace detail {

bool is_finite(const Vec<double, 3>& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

Error not_a_double(std::span<const double> parameters, bool no_weight) {
  const std::string where = fmt::format("at ({})", fmt::join(parameters, ", "));
  return no_weight
             ? Error{ErrorCode::vanishing_weight, where, "the denominator is 0 when it is computed in doubles", ""}
             : Error{ErrorCode::bad_number, where, "the point is no finite number when it is computed in doubles", ""};
}

void borrow_normals(std::vector<std::optional<Vec<double, 3>>>& normals, std::size_t columns) {
  const auto own = normals;  // nobody borrows what was borrowed
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (own[k]) continue;
    Vec<double, 3> sum;
    const auto add = [&](bool exists, std::size_t neighbour) {
      if (exists && own[neighbour]) sum += *own[neighbour];
    };
    add(k % columns > 0, k - 1);
    add(k % columns + 1 < columns, k + 1);
    add(k >= columns, k - columns);
    add(k + columns < own.size(), k + columns);
    // Opposite neighbours cancel but for rounding: such a sum has no direction.
    if (dot(sum, sum) > 0x1p-40) normals[k] = unit(sum);
  }
}

std::vector<std::optional<Vec<double, 3>>> normals_of_cells(const CellComplex<double, 3>& mesh) {
  std::vector<Vec<double, 3>> sums(mesh.vertices.size());
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto corners = mesh.cell(c);
    const auto at = [&](int i) { return mesh.vertices[corners[i]]; };
    const Vec<double, 3> doubled = cross(at(3) - at(0), at(2) - at(1));  // twice the area, along the normal
    for (const int v : corners) sums[v] += doubled;
  }
  std::vector<std::optional<Vec<double, 3>>> out;
  out.reserve(sums.size());
  for (const Vec<double, 3>& sum : sums) out.push_back(unit(sum));
  return out;
}

}  // namespace detail
}  // namespace patchproof
