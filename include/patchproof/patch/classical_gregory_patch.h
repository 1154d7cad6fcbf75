// SPDX-License-Identifier: Apache-2.0
// The classical Gregory patch: 20 points, of which each corner has two inner ones, so that the cross-boundary derivatives of
// its four cubic edges are independent of each other.
//
//   S(u,v) = Σ_ij B_i³(u) B_j³(v) P_ij,      P_1+p,1+q = ( x_p V_pq + y_q U_pq ) / ( x_p + y_q )  for p, q in {0, 1}
//   x_0 = u, x_1 = 1 − u,  y_0 = v, y_1 = 1 − v:  the distances from the corner (p, q)
//
//   V_pq decides about S_v on the edge v = q:    S_v(u,0) = 3 ( B_0 (P_01 − P_00) + B_1 (V_00 − P_10) + B_2 (V_10 − P_20) + … )
//   U_pq decides about S_u on the edge u = p
//
// At a corner S and its first derivatives are those of either bicubic patch; S_uv has one limit along each edge.
//
// REQUIRES  parameters in [0, 1]; second_derivatives: not at a corner.
// ENSURES   (1) evaluate: the formula, and P_00, P_30, P_03 or P_33 at a corner;  (2) the edges are the cubics of their four
//           points, with the cross-boundary derivatives above;  (3) frame and second_derivatives: the derivatives of (1), at a
//           corner S_u and S_v as their limits;  (4) corner_twists: the limits of S_uv along the two edges;
//           (5) expand: the same surface with homogeneous points (w S, w), in the degrees (3 + r, 3 + r), r the number of
//           corners with U_pq ≠ V_pq, at most (7, 7). The corner point of each of these corners is (0, 0, 0, 0), and all other
//           weights are positive;  (6) to_gregory_patch: the NURBS boundary Gregory patch, blended by squares, with the same
//           edges and cross-boundary derivatives. It is the same surface exactly when U_pq = V_pq at every corner, and never
//           further away than 3/100 Σ_pq |U_pq − V_pq|;  (7) to_classical undoes (6), and answers nothing unless the edges and
//           the cross-boundary derivatives are polynomials of degree 3 (all weights 1, no knots) and the corners agree;
//           (8) in double no parameter of the closed square gives a NaN: next to a corner (u, v) is moved along its ray to the
//           distance 2^-256.
// SCALARS   T: Field; evaluate_at: parameters of any ring with division; expand, to_classical: ExactField.
// COST      16 products of a point and a number.
// SOURCE    H. Chiyokura, F. Kimura, Design of solids with free-form surfaces, SIGGRAPH 1983; G. Farin, Curves and Surfaces for
//           CAGD, 5th ed., §22.5; the degree (7, 7): T. Takamura, M. Ohta, H. Toriya, H. Chiyokura (1990). (6): at the corner
//           (p, q) the two blends differ by x y (y − x) / ((x + y)(x² + y²)), at most 0.1502, and B_1³ B_1³ ≤ 16/81.
// NEIGHBOURS gregory_patch.h (B-spline edges, rational), coons_gregory_patch.h (from curves).
// TEST      tests/patch/classical_gregory_patch_test.cpp checks (1)–(8).
#pragma once

#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "patchproof/patch/bezier_patch.h"
#include "patchproof/patch/gregory_patch.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/patch/tensor_form.h"

namespace patchproof {

template <Field T>
class ClassicalGregoryPatch {
 public:
  using Point = Vec<T, 3>;
  using Inner = std::array<std::array<Point, 2>, 2>;  // [p][q]

  // The 12 points of the boundary counter-clockwise: P_00, P_10, P_20, P_30, P_31, P_32, P_33, P_23, P_13, P_03, P_02, P_01.
  ClassicalGregoryPatch(const std::array<Point, 12>& boundary, const Inner& across_u, const Inner& across_v) {
    constexpr int kPlaces[12][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2},
                                    {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 2}, {0, 1}};
    for (std::size_t k = 0; k < 12; ++k) u_[kPlaces[k][0]][kPlaces[k][1]] = boundary[k];
    v_ = u_;
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) u_[1 + p][1 + q] = across_u[p][q], v_[1 + p][1 + q] = across_v[p][q];
  }

  // The point (i, j) of the two bicubic nets: with U_pq, which has S_u on the edges in v, and with V_pq.
  const Point& across_u(std::size_t i, std::size_t j) const { return u_[i][j]; }
  const Point& across_v(std::size_t i, std::size_t j) const { return v_[i][j]; }

 private:
  std::array<std::array<Point, 4>, 4> u_, v_;
};

template <Field T>
Vec<T, 3> evaluate(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v);
template <Field T>
SurfaceFrame<T> frame(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v);
template <Field T>
SecondDerivatives<T> second_derivatives(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v);

// At parameters of a ring that T embeds into. REQUIRES no corner, unless R encloses.
template <Ring R, Field T>
Vec<R, 3> evaluate_at(const ClassicalGregoryPatch<T>& patch, const R& u, const R& v);

// At (0,0), (1,0), (1,1), (0,1): from_u along the edge in v, by U_pq; from_v along the edge in u, by V_pq.
template <Field T>
std::array<TwoTwists<T>, 4> corner_twists(const ClassicalGregoryPatch<T>& patch);

template <ExactField T>
BezierPatch<T, 4> expand(const ClassicalGregoryPatch<T>& patch);

template <ExactField T>
GregoryPatch<T> to_gregory_patch(const ClassicalGregoryPatch<T>& patch);
template <ExactField T>
std::optional<ClassicalGregoryPatch<T>> to_classical(const GregoryPatch<T>& patch);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <Field T>
BezierPatch<T, 3> bicubic_of(const ClassicalGregoryPatch<T>& patch, Direction across) {
  std::vector<Vec<T, 3>> net;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      net.push_back(across == Direction::u ? patch.across_u(i, j) : patch.across_v(i, j));
  return BezierPatch<T, 3>(3, 3, std::move(net));
}

// The power series of S about (u, v). REQUIRES no corner.
template <Field T>
Vec<PowerSeries<T, 2>, 3> series(const ClassicalGregoryPatch<T>& patch, T u, T v, int order) {
  using Series = PowerSeries<T, 2>;
  if constexpr (std::same_as<T, double>) std::tie(u, v) = off_the_corners(u, v);
  return evaluate_at<Series>(patch, Series::variable(0, u, order), Series::variable(1, v, order));
}

// Enclosures cannot tell whether they are a corner; those of their parameters that are one point can.
template <Field T>
bool is_certainly_corner(const T& u, const T& v) {
  const auto is = [](const T& x) {
    if constexpr (OrderedField<T>)
      return x == T(0) || x == T(1);
    else
      return scalar_traits<T>::sign(x) == Sign::zero || scalar_traits<T>::sign(x - T(1)) == Sign::zero;
  };
  return is(u) && is(v);
}

}  // namespace detail

template <Ring R, Field T>
Vec<R, 3> evaluate_at(const ClassicalGregoryPatch<T>& patch, const R& u, const R& v) {
  const auto embedded = [](const Vec<T, 3>& p) { return Vec<R, 3>{{embed<R>(p[0]), embed<R>(p[1]), embed<R>(p[2])}}; };
  const std::vector<R> along_u = bernstein_basis(3, u), along_v = bernstein_basis(3, v);
  const std::array<R, 2> x{u, R(1) - u}, y{v, R(1) - v};
  Vec<R, 3> sum;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const R factor = along_u[i] * along_v[j];
      const Vec<T, 3>&of_u = patch.across_u(i, j), &of_v = patch.across_v(i, j);
      sum += factor * embedded(of_u);
      if (i == 0 || i == 3 || j == 0 || j == 3) continue;
      if constexpr (requires(const T& a) { a == a; })
        if (of_u == of_v) continue;
      sum += (factor * (x[i - 1] / (x[i - 1] + y[j - 1]))) * embedded(of_v - of_u);
    }
  return sum;
}

template <Field T>
Vec<T, 3> evaluate(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v) {
  if (detail::is_certainly_corner(u, v)) return evaluate(detail::bicubic_of(patch, Direction::u), u, v);
  return detail::derivative_of(detail::series(patch, u, v, 0), {0, 0});
}

template <Field T>
SurfaceFrame<T> frame(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v) {
  if (detail::is_certainly_corner(u, v)) {
    const BezierPatch<T, 3> s = detail::bicubic_of(patch, Direction::u);
    return {evaluate(s, u, v), evaluate(derivative_patch(s, Direction::u), u, v),
            evaluate(derivative_patch(s, Direction::v), u, v)};
  }
  const auto s = detail::series(patch, u, v, 1);
  return {detail::derivative_of(s, {0, 0}), detail::derivative_of(s, {1, 0}), detail::derivative_of(s, {0, 1})};
}

template <Field T>
SecondDerivatives<T> second_derivatives(const ClassicalGregoryPatch<T>& patch, const T& u, const T& v) {
  PATCHPROOF_REQUIRES(!detail::is_certainly_corner(u, v),
                      "second_derivatives: a Gregory patch has none at its corners");
  const auto s = detail::series(patch, u, v, 2);
  return {detail::derivative_of(s, {2, 0}), detail::derivative_of(s, {1, 1}), detail::derivative_of(s, {0, 2})};
}

template <Field T>
std::array<TwoTwists<T>, 4> corner_twists(const ClassicalGregoryPatch<T>& patch) {
  const auto of_u = corner_twists(detail::bicubic_of(patch, Direction::u)),
             of_v = corner_twists(detail::bicubic_of(patch, Direction::v));
  // Those of Bézier patches are at (0,0), (1,0), (0,1), (1,1).
  return {TwoTwists<T>{of_u[0], of_v[0]}, {of_u[1], of_v[1]}, {of_u[3], of_v[3]}, {of_u[2], of_v[2]}};
}

template <ExactField T>
BezierPatch<T, 4> expand(const ClassicalGregoryPatch<T>& patch) {
  using Form = TensorForm<T>;
  const BinaryForm<T> one = BinaryForm<T>::constant(T(1));
  const auto distance = [](std::size_t which) {
    return BinaryForm<T>::from_bernstein(which == 0 ? std::vector<T>{T(0), T(1)} : std::vector<T>{T(1), T(0)});
  };
  const auto is_blended = [&](std::size_t p, std::size_t q) {
    return !(patch.across_u(1 + p, 1 + q) == patch.across_v(1 + p, 1 + q));
  };
  // E: the product of x_p + y_q over the blended corners, and E / (x_p + y_q).
  const auto product_without = [&](std::size_t p, std::size_t q) {
    Form out = Form::constant(T(1));
    for (std::size_t k = 0; k < 4; ++k)
      if (is_blended(k / 2, k % 2) && k != 2 * p + q)
        out = out * (Form(distance(k / 2), one) + Form(one, distance(k % 2)));
    return out;
  };
  const Form blend = product_without(2, 2);
  std::array<Form, 4> out;
  out[3] = blend * Form(BinaryForm<T>(binomials<T>(3)), BinaryForm<T>(binomials<T>(3)));  // 1 in degree (3, 3)
  for (std::size_t c = 0; c < 3; ++c) out[c] = blend * Form::from_bernstein(detail::bicubic_of(patch, Direction::u), c);
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      if (!is_blended(p, q)) continue;
      std::vector<T> at_u(4), at_v(4);
      at_u[1 + p] = at_v[1 + q] = T(1);
      const Form weight = product_without(p, q) * Form(distance(p), one) *
                          Form(BinaryForm<T>::from_bernstein(at_u), BinaryForm<T>::from_bernstein(at_v));
      const Vec<T, 3> d = patch.across_v(1 + p, 1 + q) - patch.across_u(1 + p, 1 + q);
      for (std::size_t c = 0; c < 3; ++c) out[c] = out[c] + Form::constant(d[c]) * weight;
    }
  const int degree = out[3].degree_u();
  std::vector<Vec<T, 4>> net((degree + 1) * static_cast<std::size_t>(degree + 1));
  for (std::size_t c = 0; c < 4; ++c) {
    const std::vector<T> b = out[c].bernstein();
    for (std::size_t k = 0; k < b.size(); ++k) net[k][c] = b[k];
  }
  return BezierPatch<T, 4>(degree, degree, std::move(net));
}

template <ExactField T>
GregoryPatch<T> to_gregory_patch(const ClassicalGregoryPatch<T>& patch) {
  const auto surface = [&](Direction across) { return to_homogeneous(to_bspline(detail::bicubic_of(patch, across))); };
  return GregoryPatch<T>::make(surface(Direction::u), surface(Direction::v)).value();
}

template <ExactField T>
std::optional<ClassicalGregoryPatch<T>> to_classical(const GregoryPatch<T>& patch) {
  // The net of a surface that is one bicubic polynomial.
  const auto bicubic = [](BsplinePatch<T, 4> s, Direction along) -> std::optional<BsplinePatch<T, 4>> {
    for (const Vec<T, 4>& p : s.net())
      if (!(p[3] == T(1))) return std::nullopt;
    s = remove_redundant_knots(std::move(s), along);
    if (s.knots(along).breaks().size() != 2) return std::nullopt;
    if (s.degree(along) < 3) s = elevate_degree(s, along, 3 - s.degree(along));
    return s.degree(along) == 3 ? std::optional(std::move(s)) : reduce_degree(s, along, s.degree(along) - 3);
  };
  const std::optional<BsplinePatch<T, 4>> of_u = bicubic(patch.u_surface(), Direction::v);
  const std::optional<BsplinePatch<T, 4>> of_v = bicubic(patch.v_surface(), Direction::u);
  if (!of_u || !of_v) return std::nullopt;
  const auto point = [](const BsplinePatch<T, 4>& s, int i, int j) {
    const Vec<T, 4>& p = s.point(i, j);
    return Vec<T, 3>{{p[0], p[1], p[2]}};
  };
  std::array<Vec<T, 3>, 12> boundary;
  std::size_t next = 0;
  for (const auto& [i, j] :
       {std::pair{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 2}, {0, 1}}) {
    if (!(point(*of_u, i, j) == point(*of_v, i, j))) return std::nullopt;
    boundary[next++] = point(*of_u, i, j);
  }
  typename ClassicalGregoryPatch<T>::Inner inner_u, inner_v;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) inner_u[p][q] = point(*of_u, 1 + p, 1 + q), inner_v[p][q] = point(*of_v, 1 + p, 1 + q);
  return ClassicalGregoryPatch<T>(boundary, inner_u, inner_v);
}

}  // namespace patchproof
