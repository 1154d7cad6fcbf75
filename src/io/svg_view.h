// SPDX-License-Identifier: Apache-2.0
// From space to the page.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/drawing.h"
#include "io/svg_page.h"

namespace patchproof {

// The step of 1, 2 or 5 times a power of ten that cuts the extent into at most `most` parts.
inline double round_step(double extent, int most) {
  double step = std::pow(10, std::floor(std::log10(extent / most)));
  for (const double factor : {2.0, 2.5, 2.0})
    if (extent / step > most) step *= factor;
  return step;
}

// An orthographic view: coordinates to the right, upwards, and towards the eye.
class View {
 public:
  static constexpr double kLargestHeight = 620, kSmallestHeight = 150;

  explicit View(bool plane) {
    const double azimuth = -55 * std::numbers::pi / 180, elevation = 28 * std::numbers::pi / 180;
    eye_ = plane ? Point3{{0, 0, 1}}
                 : Point3{{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                           std::sin(elevation)}};
    right_ = plane ? Point3{{1, 0, 0}} : Point3{{-std::sin(azimuth), std::cos(azimuth), 0}};
    up_ = cross(eye_, right_);
  }
  void include(const Point3& p) {
    const std::array<double, 2> seen{dot(right_, p), dot(up_, p)};
    for (int i : {0, 1}) {
      low_[i] = std::min(low_[i], seen[i]);
      high_[i] = std::max(high_[i], seen[i]);
    }
  }
  // Chooses the scale for a page of the given width; returns the height used.
  double fit(double left, double width, double top) {
    const double wide = high_[0] - low_[0], tall = high_[1] - low_[1], extent = std::max(wide, tall);
    if (!(extent > 0)) {  // a point
      unit_ = 1;
      per_unit_ = 0;
    } else {
      unit_ = extent;
      per_unit_ = std::min(width / (wide / extent), kLargestHeight / (tall / extent));
    }
    const double used = std::clamp(tall / unit_ * per_unit_, kSmallestHeight, kLargestHeight);
    centre_ = {left + width / 2, top + used / 2};
    return used;
  }
  PagePoint place(const Point3& p) const {
    const double x = dot(right_, p), y = dot(up_, p);
    return {centre_.x + ((x - low_[0]) - (high_[0] - x)) / 2 / unit_ * per_unit_,
            centre_.y - ((y - low_[1]) - (high_[1] - y)) / 2 / unit_ * per_unit_};
  }
  double depth(const Point3& p) const { return dot(eye_, p); }
  // How bright a facet is, from 0 to 1: light from above on the left, equal on both of its sides.
  double brightness(const Point3& normal) const {
    const Point3 light = *unit(-0.45 * right_ + 0.55 * up_ + 0.7 * eye_);
    return std::abs(dot(unit(normal).value_or(eye_), light));
  }
  const Point3& right() const { return right_; }
  const Point3& up() const { return up_; }
  const std::array<double, 2>& low() const { return low_; }
  const std::array<double, 2>& high() const { return high_; }
  double page_units_per_unit() const { return per_unit_ / unit_; }

 private:
  Point3 eye_, right_, up_;
  std::array<double, 2> low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
  double unit_ = 1, per_unit_ = 0;
  PagePoint centre_{};
};

}  // namespace patchproof
