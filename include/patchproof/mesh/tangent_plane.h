// SPDX-License-Identifier: Apache-2.0
// Exact planes through directions, and short numbers: where a construction may choose a direction or a length, it should
// choose one of few digits, for all that is computed from it grows with them.
//
//   plane       all α first + β second, with integer vectors at right angles to each other and to the normal, and
//               first × second a positive multiple of the normal
//   rounded     to `bits` binary digits
//   on_grid     to multiples of a power of two that is about 2^-bits of the largest component of `size`
//
// ENSURES   (1) rounded, rounded_root: |result − exact| ≤ 2^(1 − bits) |exact|, zero only from zero; on_grid: each
//           component within 2^-bits of that largest component, v itself when size is zero;  (2) plane_of: that plane
//           exactly, plane_near: a normal of small integers within 2^(2 − bits) of the direction given;  (3) in_plane: exactly
//           in the plane, and there within 2^(3 − bits) |v| of v's projection;  (4) projected: exactly in the plane of the
//           normal, v itself when it lies there;  (5) common_normal: a normal of all directions, exactly when they lie in one
//           plane and not on one line;  (6) fitted_normal: nearly the normal for which the sum of the squared sines is least;
//           not zero, and the common normal where there is one.
// REQUIRES  normals that are not zero; rounded_root: a square ≥ 0; bits ≥ 4.
// TEST      tests/mesh/tangent_plane_test.cpp checks (1)–(6).
#pragma once

#include <optional>
#include <vector>

#include "patchproof/scalar/rational.h"
#include "patchproof/vec.h"

namespace patchproof {

Rational rounded(const Rational& x, int bits = 16);
// √square.
Rational rounded_root(const Rational& square, int bits = 16);
Vec<Rational, 3> on_grid(const Vec<Rational, 3>& v, const Vec<Rational, 3>& size, int bits = 16);

struct TangentPlane {
  Vec<Rational, 3> normal, first, second;
};
TangentPlane plane_of(const Vec<Rational, 3>& normal);
TangentPlane plane_near(const Vec<Rational, 3>& normal, int bits = 10);

// The coordinates (α, β) of v's projection, rounded.
Vec<Rational, 2> plane_coordinates(const TangentPlane& plane, const Vec<Rational, 3>& v, int bits = 16);
Vec<Rational, 3> in_plane(const TangentPlane& plane, const Vec<Rational, 3>& v, int bits = 16);

// v − (v·n / n·n) n.
Vec<Rational, 3> projected(const Vec<Rational, 3>& v, const Vec<Rational, 3>& normal);

std::optional<Vec<Rational, 3>> common_normal(const std::vector<Vec<Rational, 3>>& directions);
Vec<Rational, 3> fitted_normal(const std::vector<Vec<Rational, 3>>& directions);

}  // namespace patchproof
