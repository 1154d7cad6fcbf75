// SPDX-License-Identifier: Apache-2.0
// B-spline curves C(t) = Σ d_i N_{i,p}(t) with control points d_i in T^N. A rational curve in the plane or in space is a
// curve of homogeneous points (w·x, w·y, w·z, w): see homogeneous.h.
#pragma once

#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

// T: scalar of the control points.  K: scalar of the knots.
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
class BsplineCurve {
 public:
  using Point = Vec<T, N>;

  // ERRORS wrong_count unless there are knots.control_count() points.
  static Result<BsplineCurve> make(KnotVector<K> knots, std::vector<Point> points) {
    if (static_cast<int>(points.size()) != knots.control_count())
      return Error{ErrorCode::wrong_count, "", "the knots need " + std::to_string(knots.control_count()) +
                   " control points", std::to_string(points.size())};
    return BsplineCurve(std::move(knots), std::move(points));
  }
  // REQUIRES what make() checks.
  BsplineCurve(KnotVector<K> knots, std::vector<Point> points) : knots_(std::move(knots)), points_(std::move(points)) {
    PATCHPROOF_REQUIRES(static_cast<int>(points_.size()) == knots_.control_count(), "BsplineCurve: wrong point count");
  }
  // A Bézier curve on [0, 1]. REQUIRES at least one point.
  static BsplineCurve bezier(std::vector<Point> points) {
    const int degree = static_cast<int>(points.size()) - 1;
    return BsplineCurve(KnotVector<K>::bezier(degree), std::move(points));
  }

  int degree() const { return knots_.degree(); }
  const KnotVector<K>& knots() const { return knots_; }
  const std::vector<Point>& points() const { return points_; }

 private:
  KnotVector<K> knots_;
  std::vector<Point> points_;
};

}  // namespace patchproof
