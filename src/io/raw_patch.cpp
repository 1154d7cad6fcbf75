// SPDX-License-Identifier: Apache-2.0
#include "raw_patch.h"

#include <fmt/format.h>

namespace patchproof {

std::string RawPatch::knot_pointer(int direction, std::size_t k) const {
  if (layout == JsonLayout::model) return fmt::format("{}/knots/{}/{}", pointer, direction, k);
  if (layout == JsonLayout::geomdl) return fmt::format("{}/knotvector_{}/{}", pointer, direction == 0 ? 'u' : 'v', k);
  return {};
}

std::string RawPatch::coordinate_pointer(std::size_t point, int component) const {
  const std::size_t row_length = static_cast<std::size_t>(count[1]);
  if (layout == JsonLayout::model)
    return fmt::format("{}/control_points/{}/{}/{}", pointer, point / row_length, point % row_length, component);
  if (layout == JsonLayout::geomdl) return fmt::format("{}/control_points/points/{}/{}", pointer, point, component);
  return {};
}

std::string RawPatch::weight_pointer(std::size_t point) const {
  const std::size_t row_length = static_cast<std::size_t>(count[1]);
  if (layout == JsonLayout::model)
    return fmt::format("{}/weights/{}/{}", pointer, point / row_length, point % row_length);
  if (layout == JsonLayout::geomdl) return fmt::format("{}/control_points/weights/{}", pointer, point);
  return {};
}

std::string RawPatch::member_pointer(std::string_view member) const {
  return layout == JsonLayout::none ? std::string() : fmt::format("{}/{}", pointer, member);
}

std::string RawPatch::weights_pointer() const {
  return member_pointer(layout == JsonLayout::geomdl ? "control_points/weights" : "weights");
}

}  // namespace patchproof
