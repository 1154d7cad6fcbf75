// SPDX-License-Identifier: Apache-2.0
// Tensor-product B-spline patches S(u,v) = Σ_i Σ_j d_ij N_{i,p}(u) N_{j,q}(v) with control points d_ij in T^N.
//
// The net is stored with j (along v) running fastest: d_ij = net[i · count_v + j]. A Bézier patch is one with Bézier knots.
// Rational patches are patches of homogeneous points: rational_patch.h.
#pragma once

#include <vector>

#include "patchproof/error.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof {

// The two parameter directions of a patch.
enum class Direction { u, v };

template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
class BsplinePatch {
 public:
  using Point = Vec<T, N>;

  // ERRORS wrong_count unless the net has u.control_count() · v.control_count() points.
  static Result<BsplinePatch> make(KnotVector<K> u, KnotVector<K> v, std::vector<Point> net) {
    const std::size_t count = static_cast<std::size_t>(u.control_count()) * v.control_count();
    if (net.size() != count)
      return Error{ErrorCode::wrong_count, "", "the knots need " + std::to_string(u.control_count()) + " x " +
                   std::to_string(v.control_count()) + " control points", std::to_string(net.size())};
    return BsplinePatch(std::move(u), std::move(v), std::move(net));
  }
  // REQUIRES what make() checks.
  BsplinePatch(KnotVector<K> u, KnotVector<K> v, std::vector<Point> net)
      : u_(std::move(u)), v_(std::move(v)), net_(std::move(net)) {
    PATCHPROOF_REQUIRES(net_.size() == static_cast<std::size_t>(u_.control_count()) * v_.control_count(),
                        "BsplinePatch: wrong point count");
  }

  const KnotVector<K>& knots(Direction d) const { return d == Direction::u ? u_ : v_; }
  int degree(Direction d) const { return knots(d).degree(); }
  int count(Direction d) const { return knots(d).control_count(); }
  const Point& point(int i, int j) const { return net_[static_cast<std::size_t>(i) * v_.control_count() + j]; }
  const std::vector<Point>& net() const { return net_; }

 private:
  KnotVector<K> u_, v_;
  std::vector<Point> net_;
};

}  // namespace patchproof
