// SPDX-License-Identifier: Apache-2.0
#include "raw_spline.h"

#include <fmt/format.h>

namespace patchproof {

std::string_view RawSpline::along(int direction) const {
  return is_curve() ? "" : direction == 0 ? " along u" : " along v";
}

std::string RawSpline::member_pointer(std::string_view member) const {
  return layout == JsonLayout::none ? std::string() : fmt::format("{}/{}", pointer, member);
}

std::string RawSpline::degree_pointer(int direction) const {
  if (is_curve()) return member_pointer("degree");
  if (layout == JsonLayout::geomdl) return member_pointer(direction == 0 ? "degree_u" : "degree_v");
  return member_pointer(direction == 0 ? "degree/0" : "degree/1");
}

std::string RawSpline::knots_pointer(int direction) const {
  if (layout == JsonLayout::geomdl)
    return member_pointer(is_curve() ? "knotvector" : direction == 0 ? "knotvector_u" : "knotvector_v");
  return member_pointer(is_curve() ? "knots" : direction == 0 ? "knots/0" : "knots/1");
}

std::string RawSpline::points_pointer() const { return member_pointer("control_points"); }

std::string RawSpline::weights_pointer() const {
  return member_pointer(layout == JsonLayout::geomdl ? "control_points/weights" : "weights");
}

// Our model nests the points of a patch, geomdl lists them.
std::string RawSpline::element_pointer(std::string_view array, std::size_t point) const {
  if (layout == JsonLayout::none) return {};
  if (layout == JsonLayout::geomdl || is_curve()) return fmt::format("{}/{}", array, point);
  const std::size_t row_length = static_cast<std::size_t>(count[1]);
  return fmt::format("{}/{}/{}", array, point / row_length, point % row_length);
}

std::string RawSpline::knot_pointer(int direction, std::size_t k) const {
  return layout == JsonLayout::none ? std::string() : fmt::format("{}/{}", knots_pointer(direction), k);
}

std::string RawSpline::coordinate_pointer(std::size_t point, int component) const {
  if (layout == JsonLayout::none) return {};
  if (layout == JsonLayout::tinyspline)
    return fmt::format("{}/{}", points_pointer(), point * static_cast<std::size_t>(per_point) + component);
  if (layout == JsonLayout::point) return fmt::format("{}/{}", pointer, component);
  const std::string array = layout == JsonLayout::geomdl ? member_pointer("control_points/points") : points_pointer();
  return fmt::format("{}/{}", element_pointer(array, point), component);
}

std::string RawSpline::weight_pointer(std::size_t point) const { return element_pointer(weights_pointer(), point); }

}  // namespace patchproof
