// SPDX-License-Identifier: Apache-2.0
// Bézier curves and polynomials on [0, 1] by their control points:  P(t) = Σ b_i B_i^n(t),  i = 0…n.
//
//   B_i^n(t) = C(n,i) t^i (1−t)^(n−i)          de Casteljau: repeat  b_i ← (1−t) b_i + t b_{i+1}
//
// Control points are a std::vector<P>; P is a scalar T (a polynomial) or a Vec<T, N> (a curve), t is a T. The degree is
// the number of points less one. t may lie outside [0, 1]: the formulas are polynomial identities.
//
// REQUIRES  at least one control point, everywhere.
// ENSURES   (1) the basis sums to 1;  (2) B_i^n(t) = B_{n−i}^n(1−t);  (3) P(0) and P(1) are the end points;
//           (4) k-th derivatives are n!/(n−k)! times k-th differences, and zero for k > n;
//           (5) de_casteljau equals Σ b_i B_i^n(t);
//           (6) split: left(s) = P(t s), right(s) = P(t + (1−t) s);  restrict: Q(s) = P(a + (b−a) s);
//           (7) elevate_degree leaves P unchanged; reduce_degree undoes it, and answers nothing exactly when no polynomial
//               of lower degree equals P;  (8) product(f, P)(t) = f(t) P(t);
//           (9) the blossom is symmetric, affine in each argument, and P(t) on the diagonal;  (10) reverse(P)(t) = P(1−t).
// SCALARS   T: Ring;  elevate_degree, product: Field;  reduce_degree: ExactField.
// COST      O(n²) combinations of points unless said otherwise.
// NEIGHBOURS binary_form.h (the same polynomials without binomials in the way, for any Ring); bspline_basis.h.
// SOURCE    G. Farin, Curves and Surfaces for CAGD, 5th ed., chapters 4–6.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/vec.h"

namespace patchproof {

namespace detail {

template <class P>
struct ScalarOf {
  using type = P;
};
template <class T, std::size_t N>
struct ScalarOf<Vec<T, N>> {
  using type = T;
};

// Is every component zero?
template <ExactRing T>
bool is_zero_point(const T& x) {
  return *scalar_traits<T>::sign(x) == Sign::zero;
}
template <ExactRing T, std::size_t N>
bool is_zero_point(const Vec<T, N>& p) {
  for (const T& x : p.c)
    if (!is_zero_point(x)) return false;
  return true;
}

}  // namespace detail

// The scalar T of a control point: T itself, or T of Vec<T, N>.
template <class P>
using scalar_of_t = typename detail::ScalarOf<P>::type;

// (1−t) a + t b: the point between a (t = 0) and b (t = 1).
template <class P>
P between(const scalar_of_t<P>& t, const P& a, const P& b) {
  return (scalar_of_t<P>(1) - t) * a + t * b;
}

// C(n,0), …, C(n,n), by Pascal's additions: exact in exact scalars, enclosed or bounded in the others, whatever n.
template <Ring T>
std::vector<T> binomial_row(int n) {
  std::vector<T> row{T(1)};
  for (int m = 1; m <= n; ++m) {
    row.push_back(T(1));
    for (int i = m - 1; i > 0; --i) row[i] += row[i - 1];
  }
  return row;
}

// B_0^n(t), …, B_n^n(t). REQUIRES n ≥ 0.
template <Ring T>
std::vector<T> bernstein_basis(int n, const T& t);

// The order-th derivatives of the basis at t. REQUIRES n ≥ 0, order ≥ 0.
template <Ring T>
std::vector<T> bernstein_basis_derivative(int n, int order, const T& t);

// P(t).
template <class P>
P de_casteljau(std::vector<P> points, const scalar_of_t<P>& t);

// The control points of P', of degree n − 1 (of degree 0 when n = 0).
template <class P>
std::vector<P> hodograph(const std::vector<P>& points);

// The order-th derivative of P at t. REQUIRES order ≥ 0.
template <class P>
P derivative(std::vector<P> points, const scalar_of_t<P>& t, int order);

// The polar form of P: the only function of n arguments that is symmetric, affine in each, and P(t) when all are t.
// REQUIRES n arguments.
template <class P>
P blossom(std::vector<P> points, const std::vector<scalar_of_t<P>>& arguments);

// P on [0, t] and on [t, 1], each on [0, 1] again.
template <class P>
struct BezierHalves {
  std::vector<P> left, right;
};
template <class P>
BezierHalves<P> split(std::vector<P> points, const scalar_of_t<P>& t);

// P on [a, b] as a Bézier curve on [0, 1]; a and b in any order. COST O(n³).
template <class P>
std::vector<P> restrict(const std::vector<P>& points, const scalar_of_t<P>& a, const scalar_of_t<P>& b);

// The same P with `times` more control points. REQUIRES times ≥ 0.
template <class P>
std::vector<P> elevate_degree(std::vector<P> points, int times = 1);

// The same P with one control point less, when there is such a curve. Degree 0 has none.
template <class P>
requires ExactField<scalar_of_t<P>> std::optional<std::vector<P>> reduce_degree(const std::vector<P>& points);

// P run backwards.
template <class P>
std::vector<P> reverse(const std::vector<P>& points) {
  return std::vector<P>(points.rbegin(), points.rend());
}

// f · P, of the sum of the degrees.
template <class P>
std::vector<P> product(const std::vector<scalar_of_t<P>>& f, const std::vector<P>& points);

// ---------------------------------------------------------------------------------------------------------------------

template <Ring T>
std::vector<T> bernstein_basis(int n, const T& t) {
  return bernstein_basis_derivative(n, 0, t);
}

// Degree by degree: a value step sends B_i^{m−1} to (1−t) B_i + t B_{i+1}, a derivative step to m (−B_i + B_{i+1}).
template <Ring T>
std::vector<T> bernstein_basis_derivative(int n, int order, const T& t) {
  PATCHPROOF_REQUIRES(n >= 0 && order >= 0, "bernstein_basis: degree and order are not negative");
  if (order > n) return std::vector<T>(n + 1, T(0));
  const T s = T(1) - t;
  std::vector<T> b{T(1)};
  for (int m = 1; m <= n; ++m) {
    const bool is_value_step = m <= n - order;
    const T down = is_value_step ? s : T(-m), up = is_value_step ? t : T(m);
    b.push_back(up * b.back());
    for (int i = m - 1; i > 0; --i) b[i] = down * b[i] + up * b[i - 1];
    b[0] = down * b[0];
  }
  return b;
}

template <class P>
P de_casteljau(std::vector<P> points, const scalar_of_t<P>& t) {
  PATCHPROOF_REQUIRES(!points.empty(), "de_casteljau: no control points");
  for (std::size_t count = points.size() - 1; count > 0; --count)
    for (std::size_t i = 0; i < count; ++i) points[i] = between(t, points[i], points[i + 1]);
  return points[0];
}

template <class P>
std::vector<P> hodograph(const std::vector<P>& points) {
  using T = scalar_of_t<P>;
  PATCHPROOF_REQUIRES(!points.empty(), "hodograph: no control points");
  if (points.size() == 1) return {T(0) * points[0]};
  const T n(static_cast<int>(points.size()) - 1);
  std::vector<P> out;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) out.push_back(n * (points[i + 1] - points[i]));
  return out;
}

template <class P>
P derivative(std::vector<P> points, const scalar_of_t<P>& t, int order) {
  PATCHPROOF_REQUIRES(order >= 0, "derivative: the order is not negative");
  const int degree = static_cast<int>(points.size()) - 1;
  for (int k = 0; k < order && k <= degree; ++k) points = hodograph(points);
  return de_casteljau(std::move(points), t);
}

template <class P>
P blossom(std::vector<P> points, const std::vector<scalar_of_t<P>>& arguments) {
  PATCHPROOF_REQUIRES(!points.empty() && arguments.size() == points.size() - 1,
                      "blossom: as many arguments as the degree");
  std::size_t count = points.size() - 1;
  for (const auto& t : arguments) {
    for (std::size_t i = 0; i < count; ++i) points[i] = between(t, points[i], points[i + 1]);
    --count;
  }
  return points[0];
}

template <class P>
BezierHalves<P> split(std::vector<P> points, const scalar_of_t<P>& t) {
  PATCHPROOF_REQUIRES(!points.empty(), "split: no control points");
  std::vector<P> left{points[0]};
  // After the round with `count` points left, points[count] is final: it is the right half, from its end.
  for (std::size_t count = points.size() - 1; count > 0; --count) {
    for (std::size_t i = 0; i < count; ++i) points[i] = between(t, points[i], points[i + 1]);
    left.push_back(points[0]);
  }
  return {std::move(left), std::move(points)};
}

// Control point i is the blossom at (a^(n−i), b^i).
template <class P>
std::vector<P> restrict(const std::vector<P>& points, const scalar_of_t<P>& a, const scalar_of_t<P>& b) {
  PATCHPROOF_REQUIRES(!points.empty(), "restrict: no control points");
  const std::size_t n = points.size() - 1;
  std::vector<scalar_of_t<P>> arguments(n, a);
  std::vector<P> out{blossom(points, arguments)};
  for (std::size_t i = 1; i <= n; ++i) {
    arguments[n - i] = b;
    out.push_back(blossom(points, arguments));
  }
  return out;
}

template <class P>
std::vector<P> elevate_degree(std::vector<P> points, int times) {
  using T = scalar_of_t<P>;
  static_assert(Field<T>);
  PATCHPROOF_REQUIRES(!points.empty() && times >= 0, "elevate_degree: control points, and a number of times");
  for (; times > 0; --times) {
    const int m = static_cast<int>(points.size());  // the new degree
    points.push_back(points.back());
    for (int i = m - 1; i > 0; --i) points[i] = between(T(i) / T(m), points[i], points[i - 1]);
  }
  return points;
}

// Elevation q → p reads p_i = (i q_{i−1} + (n−i) q_i)/n, solved for q_i from the left; the last point is the test.
template <class P>
requires ExactField<scalar_of_t<P>> std::optional<std::vector<P>> reduce_degree(const std::vector<P>& points) {
  using T = scalar_of_t<P>;
  PATCHPROOF_REQUIRES(!points.empty(), "reduce_degree: no control points");
  const int n = static_cast<int>(points.size()) - 1;
  if (n == 0) return std::nullopt;
  std::vector<P> q{points[0]};
  for (int i = 1; i < n; ++i) q.push_back(T(1) / T(n - i) * (T(n) * points[i] - T(i) * q[i - 1]));
  if (!detail::is_zero_point(points[n] - q[n - 1])) return std::nullopt;
  return q;
}

template <class P>
std::vector<P> product(const std::vector<scalar_of_t<P>>& f, const std::vector<P>& points) {
  using T = scalar_of_t<P>;
  static_assert(Field<T>);
  PATCHPROOF_REQUIRES(!f.empty() && !points.empty(), "product: no control points");
  const int m = static_cast<int>(f.size()) - 1, n = static_cast<int>(points.size()) - 1;
  const std::vector<T> of_f = binomial_row<T>(m), of_points = binomial_row<T>(n), of_product = binomial_row<T>(m + n);
  std::vector<P> out(m + n + 1);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) out[i + j] += of_f[i] * of_points[j] / of_product[i + j] * f[i] * points[j];
  return out;
}

}  // namespace patchproof
