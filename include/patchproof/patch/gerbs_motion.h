// SPDX-License-Identifier: Apache-2.0
// GERBS curves and surfaces in motion: each local curve or surface goes its own way, and the blend follows.
//
//   M(s): p ↦ R(s) H(s) D(s) (p − o) + o + s τ                    s ∈ [0, 1]: the phase;  o: a point, at rest the local's centre
//   D = diag(1 + s (c_k − 1)),   H = 1 + s K,   R: rotation by the quaternion 1 + s h a  (about a by the angle 2 arctan(s h |a|))
//
// All of it is exact: maps at rational phases are rational, and their rotations are rotations. f_s = Σ G_i M_i(s) c_i.
//
// The centre of local curve i is c_i(t_{i+1}), of local surface (p, q) c_pq(u_{p+1}, v_{q+1}). Of trigonometric ones that
// point has no exact coordinates in general: a point near it takes its place, rounded to 24 bits of the largest coordinate.
//
// REQUIRES  0 ≤ p (, q) < the number of distinct local curves (rows, columns); weights without a zero at the centres.
// ENSURES   (1) at phase 0 nothing moves: moved(f, …, 0) is f with the same control data;  (2) one map of all local curves,
//           about one point, maps f: f_s = M(s) f;  (3) what is closed stays closed, with the same smoothness: the local that
//           is shared moves once;  (4) where all maps are translations f_s − f = s Σ G_i τ_i;  (5) local curves that are not
//           named are as they were; one that is named more than once goes through the maps in turn, about its centre at
//           rest;  (6) the linear part of a motion that only rotates preserves lengths, for every s;  (7) frame_phase runs
//           0 … 1 … 0 with period n, and the frames k and n − k are the same.
// SCALARS   T: ExactField.
// NEIGHBOURS affine.h, spline/gerbs_curve.h, gerbs_surface.h; io/motion.h (motions in files).
// TEST      tests/patch/gerbs_motion_test.cpp checks (1)–(7).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "patchproof/patch/affine.h"
#include "patchproof/patch/gerbs_surface.h"

namespace patchproof {

template <ExactField T>
struct AffineMotion {
  Vec<T, 3> translation{};              // τ
  Vec<T, 3> axis{};                     // a
  T half_tangent{0};                    // h
  Vec<T, 3> scale{{T(1), T(1), T(1)}};  // c
  std::array<Vec<T, 3>, 3> shear{};     // K, by rows
  std::optional<Vec<T, 3>> about{};     // o; empty: the centre of the local curve or surface
  friend bool operator==(const AffineMotion&, const AffineMotion&) = default;
};

// M(s) about o.
template <ExactField T>
AffineMap<T> at_phase(const AffineMotion<T>& motion, const Vec<T, 3>& o, const T& s);

// What one local curve (p), or one local surface (p, q), does.
template <ExactField T>
struct LocalMotion {
  int p = 0, q = 0;
  AffineMotion<T> motion{};
  friend bool operator==(const LocalMotion&, const LocalMotion&) = default;
};

template <ExactField T>
Vec<T, 3> centre_point(const GerbsCurve<T, 4>& curve, int p);
template <ExactField T>
Vec<T, 3> centre_point(const GerbsSurface<T, 4>& surface, int p, int q);

template <ExactField T>
GerbsCurve<T, 4> moved(const GerbsCurve<T, 4>& curve, const std::vector<LocalMotion<T>>& motions, const T& s);
template <ExactField T>
GerbsSurface<T, 4> moved(const GerbsSurface<T, 4>& surface, const std::vector<LocalMotion<T>>& motions, const T& s);

// The phase of frame k of n: B(1 − |1 − 2k/n|). REQUIRES 0 ≤ k ≤ n, n ≥ 1, pace.is_exact().
inline Rational frame_phase(const BFunction& pace, int k, int n) {
  const Rational x = Rational(1) - Rational(2 * k) / Rational(n);
  return derivatives<Rational>(pace, Rational(1) - (x < 0 ? Rational(-x) : x), 0)[0];
}

// ---------------------------------------------------------------------------------------------------------------------

template <ExactField T>
AffineMap<T> at_phase(const AffineMotion<T>& motion, const Vec<T, 3>& o, const T& s) {
  Vec<T, 3> factors;
  AffineMap<T> shear = scaling(Vec<T, 3>{{T(1), T(1), T(1)}});
  for (std::size_t r = 0; r < 3; ++r) {
    factors[r] = T(1) + s * (motion.scale[r] - T(1));
    shear.linear[r] += s * motion.shear[r];
  }
  AffineMap<T> out = compose(rotation_about(motion.axis, T(s * motion.half_tangent)), compose(shear, scaling(factors)));
  out.shift = o - apply_to_direction(out, o) + s * motion.translation;
  return out;
}

namespace detail {

// The coordinates to 24 bits of the largest one.
Vec<Rational, 3> rounded_to_24_bits(const Vec<double, 3>& p);
template <ExactField T>
Vec<T, 3> near_centre(const Vec<double, 3>& p) {
  const Vec<Rational, 3> rounded = rounded_to_24_bits(p);
  return {{embed<T>(rounded[0]), embed<T>(rounded[1]), embed<T>(rounded[2])}};
}

// Before the domain's end what lies behind the parameter is meant, as everywhere inside.
template <OrderedField K>
Side side_inside(const KnotVector<K>& knots, const K& t) {
  return t == knots.domain_end() ? Side::left : Side::right;
}

template <ExactField T>
void check_local(int index, int count) {
  PATCHPROOF_REQUIRES(0 <= index && index < count, "moved: there is no such local curve or surface");
}

}  // namespace detail

template <ExactField T>
Vec<T, 3> centre_point(const GerbsCurve<T, 4>& curve, int p) {
  const auto& local = curve.locals()[p];
  const auto& t = curve.centre(p);
  const Side side = detail::side_inside(curve.knots(), t);
  if (local.basis().is_trigonometric())
    return detail::near_centre<T>(derivatives_at<double>(local, t, side, embed<double>(t), 0)[0]);
  return derivatives_at<T>(local, t, side, embed<T>(t), 0)[0];
}

template <ExactField T>
Vec<T, 3> centre_point(const GerbsSurface<T, 4>& surface, int p, int q) {
  const auto& local = surface.local(p, q);
  const auto &ku = surface.knots(Direction::u), &kv = surface.knots(Direction::v);
  const auto &u = ku[p + 1], &v = kv[q + 1];
  const std::array<Side, 2> sides{detail::side_inside(ku, u), detail::side_inside(kv, v)};
  if (local.is_trigonometric())
    return detail::near_centre<T>(
        partial_derivatives_at<double>(local, {u, v}, sides, embed<double>(u), embed<double>(v), 0, 0).at(0, 0));
  return partial_derivatives_at<T>(local, {u, v}, sides, embed<T>(u), embed<T>(v), 0, 0).at(0, 0);
}

template <ExactField T>
GerbsCurve<T, 4> moved(const GerbsCurve<T, 4>& curve, const std::vector<LocalMotion<T>>& motions, const T& s) {
  std::vector<LocalCurve<T, 4>> locals = curve.locals();
  if (curve.is_closed()) locals.pop_back();
  for (const LocalMotion<T>& m : motions) {
    detail::check_local<T>(m.p, static_cast<int>(locals.size()));
    const AffineMap<T> map = at_phase(m.motion, m.motion.about ? *m.motion.about : centre_point(curve, m.p), s);
    locals[m.p] = locals[m.p].map_points([&](const Vec<T, 4>& p) { return apply(map, p); });
  }
  return GerbsCurve<T, 4>::make(curve.b_function(), curve.knots(), std::move(locals), curve.is_closed()).value();
}

template <ExactField T>
GerbsSurface<T, 4> moved(const GerbsSurface<T, 4>& surface, const std::vector<LocalMotion<T>>& motions, const T& s) {
  const auto &u = surface.axis(Direction::u), &v = surface.axis(Direction::v);
  std::vector<LocalSurface<T, 4>> locals;
  for (int p = 0; p < u.distinct(); ++p)
    for (int q = 0; q < v.distinct(); ++q) locals.push_back(surface.local(p, q));
  for (const LocalMotion<T>& m : motions) {
    detail::check_local<T>(m.p, u.distinct());
    detail::check_local<T>(m.q, v.distinct());
    const AffineMap<T> map = at_phase(m.motion, m.motion.about ? *m.motion.about : centre_point(surface, m.p, m.q), s);
    auto& local = locals[static_cast<std::size_t>(m.p) * v.distinct() + m.q];
    local = local.map_points([&](const Vec<T, 4>& p) { return apply(map, p); });
  }
  return GerbsSurface<T, 4>::make(surface.b_function(), u, v, locals).value();
}

}  // namespace patchproof
