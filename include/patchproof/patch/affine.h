// SPDX-License-Identifier: Apache-2.0
// Affine and projective maps of space, applied to points, directions, homogeneous points and whole patches and curves.
//
//   affine      x ↦ A·x + b          on a homogeneous point (w·x, w):  (A·(w·x) + w·b, w)
//   projective  (w·x, w) ↦ M·(w·x, w) with a 4 × 4 matrix M; it changes weights, so it acts on homogeneous points only:
//               mapping the affine control points and keeping the weights gives another curve
//   rotation by the quaternion q = s + x·i + y·j + z·k:  p ↦ q·p·q⁻¹, rational in s, x, y, z: every rational quaternion
//   gives a rational rotation, and these lie dense among all rotations. About an axis a by the angle 2·arctan(h·|a|):
//   q = 1 + h·a (for a unit axis the cosine is (1−h²)/(1+h²) and the sine 2h/(1+h²), a Pythagorean triple).
//
// ENSURES  (1) a patch of mapped control points is the mapped patch: S(A·P) == A·S(P), polynomial or homogeneous;
//          (2) compose(f, g) applied to p == f applied to (g applied to p);
//          (3) a rotation preserves dot and cross products, and leaves its axis fixed;
//          (4) transforming normals: cross(A·a, A·b) == apply_to_normal(map, cross(a, b));
//          (5) a projective map commutes with evaluation of homogeneous patches: S(M·P) == M·S(P);
//          (6) curves: (1) and (5) hold for every polynomial piece, identically.
// SCALARS  T: Ring; rotations T: Field. Exact when T is.
// COST     linear in the control points.
// TEST     tests/patch/affine_test.cpp checks (1)–(6).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/patch/bspline_patch.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/curve.h"
#include "patchproof/vec.h"

namespace patchproof {

// x ↦ linear·x + shift; linear[r] is row r.
template <Ring T>
struct AffineMap {
  std::array<Vec<T, 3>, 3> linear;
  Vec<T, 3> shift;
};

// Acts on homogeneous points; rows[r] is row r.
template <Ring T>
struct ProjectiveMap {
  std::array<Vec<T, 4>, 4> rows;
};

template <Ring T>
struct Quaternion {
  T s;
  Vec<T, 3> v;
};

template <Ring T>
AffineMap<T> translation(const Vec<T, 3>& by);

// Scaling by one factor per axis, about the origin.
template <Ring T>
AffineMap<T> scaling(const Vec<T, 3>& factors);

// p ↦ q·p·q⁻¹. REQUIRES q is not zero.
template <Field T>
AffineMap<T> rotation(const Quaternion<T>& q);

// Rotation about `axis` through the origin by the angle whose half has the tangent h·|axis|.
template <Field T>
AffineMap<T> rotation_about(const Vec<T, 3>& axis, const T& h);

// x ↦ outer(inner(x))
template <Ring T>
AffineMap<T> compose(const AffineMap<T>& outer, const AffineMap<T>& inner);

template <Ring T>
ProjectiveMap<T> to_projective(const AffineMap<T>& map);

// A point.
template <Ring T>
Vec<T, 3> apply(const AffineMap<T>& map, const Vec<T, 3>& point);

// A homogeneous point.
template <Ring T>
Vec<T, 4> apply(const AffineMap<T>& map, const Vec<T, 4>& point);
template <Ring T>
Vec<T, 4> apply(const ProjectiveMap<T>& map, const Vec<T, 4>& point);

// A difference of points or a derivative: the shift has no influence.
template <Ring T>
Vec<T, 3> apply_to_direction(const AffineMap<T>& map, const Vec<T, 3>& direction);

// A cross product of two directions: multiplied by the cofactors of the linear part.
template <Ring T>
Vec<T, 3> apply_to_normal(const AffineMap<T>& map, const Vec<T, 3>& normal);

// The patch of mapped control points. N = 3: points; N = 4: homogeneous points.
template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> apply(const AffineMap<T>& map, const BsplinePatch<T, N, K>& patch);
template <Ring T, OrderedField K>
BsplinePatch<T, 4, K> apply(const ProjectiveMap<T>& map, const BsplinePatch<T, 4, K>& patch);

// The curve of mapped control points. N = 3: points; N = 4: homogeneous points.
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> apply(const AffineMap<T>& map, const BsplineCurve<T, N, K>& curve);
template <Ring T, OrderedField K>
BsplineCurve<T, 4, K> apply(const ProjectiveMap<T>& map, const BsplineCurve<T, 4, K>& curve);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring T>
AffineMap<T> translation(const Vec<T, 3>& by) {
  AffineMap<T> out = scaling(Vec<T, 3>{{T(1), T(1), T(1)}});
  out.shift = by;
  return out;
}

template <Ring T>
AffineMap<T> scaling(const Vec<T, 3>& factors) {
  AffineMap<T> out;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out.linear[r][c] = r == c ? factors[r] : T(0);
  out.shift = {{T(0), T(0), T(0)}};
  return out;
}

template <Field T>
AffineMap<T> rotation(const Quaternion<T>& q) {
  const T square = q.s * q.s + dot(q.v, q.v);
  PATCHPROOF_REQUIRES(scalar_traits<T>::sign(square) != Sign::zero, "rotation: the quaternion is zero");
  AffineMap<T> out;
  for (int c = 0; c < 3; ++c) {
    Vec<T, 3> e{{T(0), T(0), T(0)}};
    e[c] = T(1);
    // q·e·q̄ = (s² − v·v) e + 2 (v·e) v + 2 s (v × e)
    const Vec<T, 3> image = (q.s * q.s - dot(q.v, q.v)) * e + (T(2) * q.v[c]) * q.v + (T(2) * q.s) * cross(q.v, e);
    for (int r = 0; r < 3; ++r) out.linear[r][c] = image[r] / square;
  }
  out.shift = {{T(0), T(0), T(0)}};
  return out;
}

template <Field T>
AffineMap<T> rotation_about(const Vec<T, 3>& axis, const T& h) {
  return rotation(Quaternion<T>{T(1), h * axis});
}

template <Ring T>
Vec<T, 3> apply_to_direction(const AffineMap<T>& map, const Vec<T, 3>& direction) {
  Vec<T, 3> out;
  for (int r = 0; r < 3; ++r) out[r] = dot(map.linear[r], direction);
  return out;
}

template <Ring T>
Vec<T, 3> apply(const AffineMap<T>& map, const Vec<T, 3>& point) {
  return apply_to_direction(map, point) + map.shift;
}

template <Ring T>
Vec<T, 4> apply(const AffineMap<T>& map, const Vec<T, 4>& point) {
  const Vec<T, 3> out = apply_to_direction(map, Vec<T, 3>{{point[0], point[1], point[2]}}) + point[3] * map.shift;
  return {{out[0], out[1], out[2], point[3]}};
}

template <Ring T>
Vec<T, 4> apply(const ProjectiveMap<T>& map, const Vec<T, 4>& point) {
  Vec<T, 4> out;
  for (int r = 0; r < 4; ++r) {
    T sum = map.rows[r][0] * point[0];
    for (int c = 1; c < 4; ++c) sum += map.rows[r][c] * point[c];
    out[r] = sum;
  }
  return out;
}

template <Ring T>
Vec<T, 3> apply_to_normal(const AffineMap<T>& map, const Vec<T, 3>& normal) {
  // The rows of the cofactor matrix are the cross products of the other two rows.
  return {{dot(cross(map.linear[1], map.linear[2]), normal), dot(cross(map.linear[2], map.linear[0]), normal),
           dot(cross(map.linear[0], map.linear[1]), normal)}};
}

template <Ring T>
AffineMap<T> compose(const AffineMap<T>& outer, const AffineMap<T>& inner) {
  AffineMap<T> out;
  for (int c = 0; c < 3; ++c) {
    const Vec<T, 3> column{{inner.linear[0][c], inner.linear[1][c], inner.linear[2][c]}};
    const Vec<T, 3> image = apply_to_direction(outer, column);
    for (int r = 0; r < 3; ++r) out.linear[r][c] = image[r];
  }
  out.shift = apply(outer, inner.shift);
  return out;
}

template <Ring T>
ProjectiveMap<T> to_projective(const AffineMap<T>& map) {
  ProjectiveMap<T> out;
  for (int r = 0; r < 3; ++r) out.rows[r] = {{map.linear[r][0], map.linear[r][1], map.linear[r][2], map.shift[r]}};
  out.rows[3] = {{T(0), T(0), T(0), T(1)}};
  return out;
}

template <Ring T, std::size_t N, OrderedField K>
BsplinePatch<T, N, K> apply(const AffineMap<T>& map, const BsplinePatch<T, N, K>& patch) {
  static_assert(N == 3 || N == 4, "affine maps act on points or on homogeneous points of space");
  return map_points(patch, [&](const Vec<T, N>& p) { return apply(map, p); });
}

template <Ring T, OrderedField K>
BsplinePatch<T, 4, K> apply(const ProjectiveMap<T>& map, const BsplinePatch<T, 4, K>& patch) {
  return map_points(patch, [&](const Vec<T, 4>& p) { return apply(map, p); });
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N, K> apply(const AffineMap<T>& map, const BsplineCurve<T, N, K>& curve) {
  static_assert(N == 3 || N == 4, "affine maps act on points or on homogeneous points of space");
  std::vector<Vec<T, N>> points;
  for (const Vec<T, N>& p : curve.points()) points.push_back(apply(map, p));
  return {curve.knots(), std::move(points)};
}

template <Ring T, OrderedField K>
BsplineCurve<T, 4, K> apply(const ProjectiveMap<T>& map, const BsplineCurve<T, 4, K>& curve) {
  std::vector<Vec<T, 4>> points;
  for (const Vec<T, 4>& p : curve.points()) points.push_back(apply(map, p));
  return {curve.knots(), std::move(points)};
}

}  // namespace patchproof
