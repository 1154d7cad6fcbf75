// SPDX-License-Identifier: Apache-2.0
// Surfaces for the tests of proved meshes, and how far their points are from triangles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "patchproof/mesh/watertight.h"
#include "patchproof/patch/rational_patch.h"
#include "patchproof/scalar/rational.h"

namespace patchproof::test {

using Patch = BsplinePatch<Rational, 4>;

inline KnotVector<Rational> clamped(int degree, std::vector<Rational> inner = {}, int end = 1) {
  std::vector<Rational> knots(degree + 1, Rational(0));
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), degree + 1, Rational(end));
  return KnotVector<Rational>::make_unchecked(degree, std::move(knots));
}

// z = f(i, j) over an even grid.
template <class F>
Patch graph(const KnotVector<Rational>& u, const KnotVector<Rational>& v, F f) {
  std::vector<Vec<Rational, 4>> net;
  for (int i = 0; i < u.control_count(); ++i)
    for (int j = 0; j < v.control_count(); ++j)
      net.push_back({{Rational(i), Rational(j), Rational(f(i, j)), Rational(1)}});
  return Patch(u, v, std::move(net));
}

inline Patch bumpy() {
  return graph(clamped(3, {Rational(1, 3), Rational(1, 2)}), clamped(2, {Rational(3, 7)}),
               [](int i, int j) { return (i * i * 3 + j * 5 + i * j) % 4; });
}

// An eighth of the unit sphere as four biquadratic rows would have it: a quarter circle turned by a quarter, pole at v = 1.
inline Patch octant() {
  const int circle[3][3] = {{1, 0, 1}, {1, 1, 1}, {0, 2, 2}};  // (w x, w y, w) of (1 − t²)/(1 + t²), 2t/(1 + t²)
  std::vector<Vec<Rational, 4>> net;
  for (const auto& a : circle)
    for (const auto& b : circle)
      net.push_back({{Rational(b[0] * a[0]), Rational(b[0] * a[1]), Rational(b[1] * a[2]), Rational(a[2] * b[2])}});
  return Patch(clamped(2), clamped(2), std::move(net));
}

inline double distance(const Vec<double, 3>& a, const Vec<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// To the triangle, within rounding.
inline double distance_to(const Vec<double, 3>& p, const Vec<double, 3>& a, const Vec<double, 3>& b,
                          const Vec<double, 3>& c) {
  const auto to_segment = [&](const Vec<double, 3>& x, const Vec<double, 3>& y) {
    const Vec<double, 3> d = y - x;
    const double t = std::clamp(dot(p - x, d) / std::max(dot(d, d), 1e-300), 0.0, 1.0);
    return distance(p, x + t * d);
  };
  double out = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
  const Vec<double, 3> n = cross(b - a, c - a);
  const double area = dot(n, n);
  if (area > 0 && dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
      dot(cross(a - c, p - c), n) >= 0)
    out = std::min(out, std::abs(dot(p - a, n)) / std::sqrt(area));
  return out;
}

inline double distance_to(const Vec<double, 3>& p, const CertifiedMesh& mesh) {
  double out = 1e300;
  for (const auto& t : mesh.triangles)
    out = std::min(out, distance_to(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  return out;
}

inline Vec<double, 3> point(const Patch& patch, double u, double v) {
  const auto p = evaluate_rational(patch, from_double(u), from_double(v));
  return {{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}};
}

inline bool is_proved(const CertifiedMesh& mesh, const MeshRequest& request) {
  return mesh.chord_misses == 0 && mesh.angle_misses == 0 && mesh.chord <= request.chord && mesh.angle <= request.angle;
}

}  // namespace patchproof::test
