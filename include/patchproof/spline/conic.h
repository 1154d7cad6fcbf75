// SPDX-License-Identifier: Apache-2.0
// Conic sections as rational quadratic Bézier arcs: homogeneous points b_0, b_1, b_2 in T^M, the weight last.
//
//   class      the sign of w_1² − w_0 w_2, the discriminant of the denominator: −, 0, + means 0, 1, 2 points at infinity on
//              the whole conic, so an ellipse, a parabola, a hyperbola; no conic when b_0, b_1, b_2 are dependent
//   equation   Q(X) = λ_1² − 4 λ_0 λ_2,   λ_0 = X·(b_1 × b_2), λ_1 = X·(b_2 × b_0), λ_2 = X·(b_0 × b_1)   in the plane;
//              with barycentric coordinates τ of an affine point this is w_0 w_2 τ_1² = 4 w_1² τ_0 τ_2
//   circle     the point with homogeneous coordinates (r² − s², 2 r s, r² + s²): the square of r + i s, on the unit circle at
//              twice its angle; r, s rational gives a Pythagorean triple. The arc between two such numbers y, z has
//              b_0 = y², b_1 = y z, b_2 = z², and |y|², y·z, |z|² as weights. z and −z are one point: their arcs complete
//              each other to the whole circle
//   hyperbola  (r² + s², 2 r s, r² − s²) on x² − y² = 1;     parabola  (r s, s², r²) on y = x²
//
// ENSURES   (1) implicit_form(b) vanishes identically on the arc, and is positive at b_1: the outside;
//           (2) conic_class depends on the conic only: it is the same for every part of it, its complementary arc and its
//               affine images; it agrees with the sign of the upper 2 × 2 determinant of the implicit form (+, 0, −);
//           (3) complementary_arc: the same ends and the same conic, the other way round;
//           (4) the arcs of circle, hyperbola and parabola lie on x² + y² = w², x² − y² = w², x² = y w and end where said;
//           (5) unit_circle(): nine points in T, C¹, half circles from (0, ±1) to (0, ∓1) without a break;
//               unit_circle(√½): the symmetric one with weights 1, √½, 1, …, C¹ with the same speed at all four joints;
//           (6) place: (x, y) ↦ center + x a + y b. With conjugate half-diameters a, b a circle becomes their ellipse.
// SCALARS   T: Ring; conic_class: ExactRing; parabola_arc: Field.
// SOURCE    L. Piegl, W. Tiller, The NURBS Book, 2nd ed., chapter 7; G. Farin, Curves and Surfaces for CAGD, 5th ed., ch. 12.
// NEIGHBOURS curve.h (BsplineCurve::bezier makes a curve of an arc), homogeneous.h, curve_denominator.h (poles).
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/spline/curve.h"
#include "patchproof/vec.h"

namespace patchproof {

// Homogeneous Bézier points of an arc.
template <Ring T, std::size_t M>
using ConicArc = std::array<Vec<T, M>, 3>;

enum class ConicClass { ellipse, parabola, hyperbola, degenerate };

// Of the whole conic on which the arc lies; degenerate: a line, a point, or everything at infinity. M = 3: in the plane.
template <ExactRing T, std::size_t M>
requires(M >= 3) ConicClass conic_class(const ConicArc<T, M>& arc);

// A symmetric form: Q(X) = Σ rows[i][j] X_i X_j.
template <Ring T>
struct QuadraticForm {
  std::array<Vec<T, 3>, 3> rows;

  T operator()(const Vec<T, 3>& x) const {
    return dot(x, Vec<T, 3>{{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)}});
  }
};

// The form that is zero on the conic of the arc; for points on one line it is a square.
template <Ring T>
QuadraticForm<T> implicit_form(const ConicArc<T, 3>& arc);

// The rest of the conic between the same ends: the middle point negated.
template <Ring T, std::size_t M>
ConicArc<T, M> complementary_arc(const ConicArc<T, M>& arc) {
  return {arc[0], -arc[1], arc[2]};
}

// From y² to z² on the unit circle; turns by twice the angle from y to z, which lies between −π and π.
// REQUIRES y and z not zero. Opposite ones (z = −λ y, λ > 0) give an arc with a pole: its middle weight is negative.
template <Ring T>
ConicArc<T, 3> unit_circle_arc(const Vec<T, 2>& y, const Vec<T, 2>& z) {
  const T yy = y[0] * y[0] + y[1] * y[1], yz = y[0] * z[0] + y[1] * z[1], zz = z[0] * z[0] + z[1] * z[1];
  PATCHPROOF_REQUIRES(scalar_traits<T>::sign(yy) != Sign::zero && scalar_traits<T>::sign(zz) != Sign::zero,
                      "unit_circle_arc: the numbers are not zero");
  const auto product = [](const Vec<T, 2>& a, const Vec<T, 2>& b, const T& weight) {
    return Vec<T, 3>{{a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0], weight}};
  };
  return {product(y, y, yy), product(y, z, yz), product(z, z, zz)};
}

// The same on x² − y² = w²: its branches where r² > s² (x > 0 for w > 0), between them infinity.
template <Ring T>
ConicArc<T, 3> unit_hyperbola_arc(const Vec<T, 2>& y, const Vec<T, 2>& z) {
  const auto half = [](const Vec<T, 2>& a, const Vec<T, 2>& b) {
    return Vec<T, 3>{{a[0] * b[0] + a[1] * b[1], a[0] * b[1] + a[1] * b[0], a[0] * b[0] - a[1] * b[1]}};
  };
  return {half(y, y), half(y, z), half(z, z)};
}

// y = x² from x = begin to x = end; polynomial, weights 1.
template <Field T>
ConicArc<T, 3> parabola_arc(const T& begin, const T& end) {
  return {{{{begin, begin * begin, T(1)}}, {{(begin + end) / T(2), begin * end, T(1)}}, {{end, end * end, T(1)}}}};
}

// The arc with end weights 1 through affine control points; w_1 < 1, = 1, > 1: ellipse, parabola, hyperbola (|w_1|).
template <Ring T, std::size_t N>
ConicArc<T, N + 1> conic_arc(const std::array<Vec<T, N>, 3>& points, const T& middle_weight);

// Arcs of the unit circle one after the other, from z_0² to z_1² to …, one unit of the parameter each. Knots 0,0,0,1,1,2,2,…
// REQUIRES at least 2 numbers, none zero.
template <Ring T, OrderedField K = knot_scalar_t<T>>
BsplineCurve<T, 3, K> unit_circle_spline(const std::vector<Vec<T, 2>>& z);

// The whole unit circle, counterclockwise from (1, 0), on [0, 4]: weights 1, 1, 2, 1, 1, 1, 2, 1, 1.
template <Ring T, OrderedField K = knot_scalar_t<T>>
BsplineCurve<T, 3, K> unit_circle() {
  const T o(0), e(1);
  return unit_circle_spline<T, K>({{{e, o}}, {{e, e}}, {{o, e}}, {{-e, e}}, {{-e, o}}});
}

// The same in four equal arcs. REQUIRES root_half = √½, exactly when T can tell.
template <Ring T, OrderedField K = knot_scalar_t<T>>
BsplineCurve<T, 3, K> unit_circle(const T& root_half);

// (x, y) ↦ center + x a + y b in any dimension, on homogeneous points, arcs and curves.
template <Ring T, std::size_t N>
Vec<T, N + 1> place(const Vec<T, 3>& h, const Vec<T, N>& center, const Vec<T, N>& a, const Vec<T, N>& b);
template <Ring T, std::size_t N>
ConicArc<T, N + 1> place(const ConicArc<T, 3>& arc, const Vec<T, N>& center, const Vec<T, N>& a, const Vec<T, N>& b) {
  return {place(arc[0], center, a, b), place(arc[1], center, a, b), place(arc[2], center, a, b)};
}
template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N + 1, K> place(const BsplineCurve<T, 3, K>& curve, const Vec<T, N>& center, const Vec<T, N>& a,
                                const Vec<T, N>& b);

// An arc as a curve on [0, 1].
template <Ring T, std::size_t M, OrderedField K = knot_scalar_t<T>>
BsplineCurve<T, M, K> to_curve(const ConicArc<T, M>& arc) {
  return BsplineCurve<T, M, K>::bezier({arc[0], arc[1], arc[2]});
}

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// Is some 3 × 3 determinant of the three points not zero?
template <ExactRing T, std::size_t M>
bool are_independent(const ConicArc<T, M>& b) {
  const auto chosen = [](const Vec<T, M>& p, std::size_t i, std::size_t j, std::size_t k) {
    return Vec<T, 3>{{p[i], p[j], p[k]}};
  };
  for (std::size_t i = 0; i < M; ++i)
    for (std::size_t j = i + 1; j < M; ++j)
      for (std::size_t k = j + 1; k < M; ++k) {
        const T det = dot(chosen(b[0], i, j, k), cross(chosen(b[1], i, j, k), chosen(b[2], i, j, k)));
        if (*scalar_traits<T>::sign(det) != Sign::zero) return true;
      }
  return false;
}

}  // namespace detail

template <ExactRing T, std::size_t M>
requires(M >= 3) ConicClass conic_class(const ConicArc<T, M>& arc) {
  const auto sign_of = [](const T& x) { return *scalar_traits<T>::sign(x); };
  const T &w0 = arc[0][M - 1], &w1 = arc[1][M - 1], &w2 = arc[2][M - 1];
  const bool at_infinity = sign_of(w0) == Sign::zero && sign_of(w1) == Sign::zero && sign_of(w2) == Sign::zero;
  if (at_infinity || !detail::are_independent(arc)) return ConicClass::degenerate;
  switch (sign_of(w1 * w1 - w0 * w2)) {
    case Sign::negative: return ConicClass::ellipse;
    case Sign::zero: return ConicClass::parabola;
    default: return ConicClass::hyperbola;
  }
}

template <Ring T>
QuadraticForm<T> implicit_form(const ConicArc<T, 3>& b) {
  const Vec<T, 3> l0 = cross(b[1], b[2]), l1 = cross(b[2], b[0]), l2 = cross(b[0], b[1]);
  QuadraticForm<T> q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) q.rows[i][j] = l1[i] * l1[j] - T(2) * (l0[i] * l2[j] + l2[i] * l0[j]);
  return q;
}

template <Ring T, std::size_t N>
ConicArc<T, N + 1> conic_arc(const std::array<Vec<T, N>, 3>& points, const T& middle_weight) {
  const T weights[] = {T(1), middle_weight, T(1)};
  ConicArc<T, N + 1> out;
  for (int i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < N; ++c) out[i][c] = weights[i] * points[i][c];
    out[i][N] = weights[i];
  }
  return out;
}

template <Ring T, OrderedField K>
BsplineCurve<T, 3, K> unit_circle_spline(const std::vector<Vec<T, 2>>& z) {
  PATCHPROOF_REQUIRES(z.size() >= 2, "unit_circle_spline: two numbers at least");
  std::vector<Vec<T, 3>> points;
  std::vector<K> knots{K(0)};
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const ConicArc<T, 3> arc = unit_circle_arc(z[i], z[i + 1]);
    points.insert(points.end(), arc.begin(), arc.end() - 1);
    knots.insert(knots.end(), 2, K(static_cast<int>(i)));
  }
  points.push_back(unit_circle_arc(z.back(), z.back())[2]);
  knots.insert(knots.end(), 3, K(static_cast<int>(z.size()) - 1));
  return BsplineCurve<T, 3, K>(KnotVector<K>::make_unchecked(2, std::move(knots)), std::move(points));
}

template <Ring T, OrderedField K>
BsplineCurve<T, 3, K> unit_circle(const T& root_half) {
  const T o(0), e(1), r = root_half;
  const std::optional<Sign> rest = scalar_traits<T>::sign(r * r + r * r - e);
  PATCHPROOF_REQUIRES(!rest || *rest == Sign::zero, "unit_circle: twice the square of root_half is not 1");
  BsplineCurve<T, 3, K> circle = unit_circle_spline<T, K>({{{e, o}}, {{r, r}}, {{o, e}}, {{-r, r}}, {{-e, o}}});
  // (r, r)² is (0, 2 r²): written as (0, 1), since rounded numbers would not say so.
  std::vector<Vec<T, 3>> points = circle.points();
  points[2] = {{o, e, e}};
  points[6] = {{o, -e, e}};
  return BsplineCurve<T, 3, K>(circle.knots(), std::move(points));
}

template <Ring T, std::size_t N>
Vec<T, N + 1> place(const Vec<T, 3>& h, const Vec<T, N>& center, const Vec<T, N>& a, const Vec<T, N>& b) {
  Vec<T, N + 1> out;
  for (std::size_t c = 0; c < N; ++c) out[c] = h[0] * a[c] + h[1] * b[c] + h[2] * center[c];
  out[N] = h[2];
  return out;
}

template <Ring T, std::size_t N, OrderedField K>
BsplineCurve<T, N + 1, K> place(const BsplineCurve<T, 3, K>& curve, const Vec<T, N>& center, const Vec<T, N>& a,
                                const Vec<T, N>& b) {
  std::vector<Vec<T, N + 1>> points;
  for (const Vec<T, 3>& h : curve.points()) points.push_back(place(h, center, a, b));
  return BsplineCurve<T, N + 1, K>(curve.knots(), std::move(points));
}

}  // namespace patchproof
