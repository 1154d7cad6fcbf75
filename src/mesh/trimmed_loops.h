// SPDX-License-Identifier: Apache-2.0
// Parameter curves with bounds, and how those of a face follow each other.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "patchproof/mesh/chord_bound.h"
#include "patchproof/mesh/trimmed_mesh.h"

namespace patchproof {

// A curve in the (u, v) plane, each coordinate as a surface that does not depend on its second parameter.
class ParameterCurve {
 public:
  explicit ParameterCurve(const BsplineCurve<Rational, 3>& curve);
  double begin() const { return begin_; }
  double end() const { return end_; }
  std::vector<double> breaks() const { return coordinates_[0].breaks(Direction::u); }
  // REQUIRES a RoundingGuard alive, as the next.
  Vec<Interval, 2> at(double t) const;
  // How far the coordinates are from linear ones over [a, b], at most.
  std::array<double, 2> bend(double a, double b) const;

 private:
  std::array<SurfacePieces, 2> coordinates_;
  double begin_, end_;
};

Vec<double, 2> middle(const Vec<Interval, 2>& p);

// An edge as it bounds a face: run through so that the face lies to the left.
struct DirectedUse {
  int edge, use;
  bool forward;
  Vec<double, 2> begin{}, end{};  // parameters
  Vec<double, 3> from{}, to{};    // points
  double tolerance = 0;
};

// What follows the end of a use.
struct Joint {
  int next = -1;     // the use that begins there
  bool gap = false;  // its parameters are elsewhere: at a pole
};

// Empty when the uses do not close. size: of the domain, for comparing parameters.
std::optional<std::vector<Joint>> close_loops(const std::vector<DirectedUse>& uses, const std::array<double, 2>& size);

}  // namespace patchproof
