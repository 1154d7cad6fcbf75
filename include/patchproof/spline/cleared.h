// SPDX-License-Identifier: Apache-2.0
// Rational data on one common denominator, so that a formula runs in integers: exact like Rational, and much faster.
//
//   values_i = integers_i / scale,  scale the least positive integer for which all integers_i are whole
//
// A parameter t = numerator/denominator enters as the pair (s, t) = (denominator − numerator, numerator): in
//   P(s, t) = Σ C(n,i) s^(n−i) t^i b_i,      de Casteljau: repeat  b_i ← s b_i + t b_{i+1}
// nothing is divided, and P(t/(s + t)) = P(s, t)/(s + t)^n. The same template runs on Integer and on Rational.
//
// ENSURES   (1) restore(clear_denominators(x)) == x, the scale is positive and the least possible;
//           (2) homogeneous_de_casteljau(b, s, t) is the sum above; for s + t = 1 it is de_casteljau(b, t);
//           (3) evaluate(cleared, t) equals de_casteljau on the Rational points, for every rational t.
// SCALARS   homogeneous_de_casteljau: any Ring. The rest: Rational in, Integer inside, Rational out.
// COST      clearing: one pass of least common multiples. Evaluation: O(n²) products of integers, which grow by the
//           length of the parameter in each of the n rounds.
// NEIGHBOURS binary_form.h (products of integer polynomials), bernstein.h.
#pragma once

#include <utility>
#include <vector>

#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/spline/bernstein.h"
#include "patchproof/vec.h"

namespace patchproof {

// P: Integer or Vec<Integer, N>.
template <class P>
struct Cleared {
  Integer scale;  // positive
  std::vector<P> integers;
};

Cleared<Integer> clear_denominators(const std::vector<Rational>& values);
template <std::size_t N>
Cleared<Vec<Integer, N>> clear_denominators(const std::vector<Vec<Rational, N>>& points);

// integers_i / scale.
std::vector<Rational> restore(const Cleared<Integer>& cleared);
template <std::size_t N>
std::vector<Vec<Rational, N>> restore(const Cleared<Vec<Integer, N>>& cleared);

// Σ C(n,i) s^(n−i) t^i b_i. REQUIRES at least one point.
template <class P>
P homogeneous_de_casteljau(std::vector<P> points, const scalar_of_t<P>& s, const scalar_of_t<P>& t);

// The Bézier curve (or polynomial) with the control points integers_i / scale, at t. REQUIRES at least one point.
Rational evaluate(const Cleared<Integer>& cleared, const Rational& t);
template <std::size_t N>
Vec<Rational, N> evaluate(const Cleared<Vec<Integer, N>>& cleared, const Rational& t);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

inline void raise_to_multiple(Integer& scale, const Rational& x) {
  mpz_lcm(scale.backend().data(), scale.backend().data(), mpq_denref(x.backend().data()));
}

// x · scale. REQUIRES the denominator of x divides scale.
inline Integer times_scale(const Rational& x, const Integer& scale) {
  Integer out;
  mpz_divexact(out.backend().data(), scale.backend().data(), mpq_denref(x.backend().data()));
  mpz_mul(out.backend().data(), out.backend().data(), mpq_numref(x.backend().data()));
  return out;
}

// P(s, t) of the integers and the number scale · (s + t)^n to divide it by.
template <class P>
std::pair<P, Integer> evaluate_integers(const Cleared<P>& cleared, const Rational& t) {
  const Integer up = numerator(t), denominator_of_t = denominator(t);
  Integer divisor = cleared.scale;
  for (std::size_t i = 1; i < cleared.integers.size(); ++i) divisor = divisor * denominator_of_t;
  return {homogeneous_de_casteljau(cleared.integers, Integer(denominator_of_t - up), up), divisor};
}

}  // namespace detail

inline Cleared<Integer> clear_denominators(const std::vector<Rational>& values) {
  Cleared<Integer> out{Integer(1), {}};
  for (const Rational& x : values) detail::raise_to_multiple(out.scale, x);
  out.integers.reserve(values.size());
  for (const Rational& x : values) out.integers.push_back(detail::times_scale(x, out.scale));
  return out;
}

template <std::size_t N>
Cleared<Vec<Integer, N>> clear_denominators(const std::vector<Vec<Rational, N>>& points) {
  Cleared<Vec<Integer, N>> out{Integer(1), {}};
  for (const Vec<Rational, N>& p : points)
    for (const Rational& x : p.c) detail::raise_to_multiple(out.scale, x);
  out.integers.reserve(points.size());
  for (const Vec<Rational, N>& p : points) {
    Vec<Integer, N> q;
    for (std::size_t i = 0; i < N; ++i) q[i] = detail::times_scale(p[i], out.scale);
    out.integers.push_back(std::move(q));
  }
  return out;
}

inline std::vector<Rational> restore(const Cleared<Integer>& cleared) {
  std::vector<Rational> out;
  for (const Integer& x : cleared.integers) out.push_back(Rational(x, cleared.scale));
  return out;
}

template <std::size_t N>
std::vector<Vec<Rational, N>> restore(const Cleared<Vec<Integer, N>>& cleared) {
  std::vector<Vec<Rational, N>> out;
  for (const Vec<Integer, N>& p : cleared.integers) {
    Vec<Rational, N> q;
    for (std::size_t i = 0; i < N; ++i) q[i] = Rational(p[i], cleared.scale);
    out.push_back(std::move(q));
  }
  return out;
}

template <class P>
P homogeneous_de_casteljau(std::vector<P> points, const scalar_of_t<P>& s, const scalar_of_t<P>& t) {
  PATCHPROOF_REQUIRES(!points.empty(), "homogeneous_de_casteljau: no control points");
  for (std::size_t count = points.size() - 1; count > 0; --count)
    for (std::size_t i = 0; i < count; ++i) points[i] = s * points[i] + t * points[i + 1];
  return points[0];
}

inline Rational evaluate(const Cleared<Integer>& cleared, const Rational& t) {
  const auto [value, divisor] = detail::evaluate_integers(cleared, t);
  return Rational(value, divisor);
}

template <std::size_t N>
Vec<Rational, N> evaluate(const Cleared<Vec<Integer, N>>& cleared, const Rational& t) {
  const auto [value, divisor] = detail::evaluate_integers(cleared, t);
  Vec<Rational, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = Rational(value[i], divisor);
  return out;
}

}  // namespace patchproof
