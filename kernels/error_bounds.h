// SPDX-License-Identifier: Apache-2.0
// How far the kernels' results can be from exact ones.
//
// A piece is Σ_ij c_ij x^i y^j, with x = fl(u − centre) · 2^k. Horner's rule multiplies c_ij by i (and j) computed
// parameters and rounds, at worst without fused multiply-add, twice for each of these steps, once when c_ij is added to
// its row and once when the row is added; c_ij itself was rounded once, each factor x once. So the computed point is
//     Σ_ij c_ij (1 + θ_ij) x^i y^j,   |θ_ij| ≤ γ(3(i + j) + 3),   γ(n) = n u / (1 − n u),   u = 2⁻⁵³
// and in each coordinate
//     |computed − exact| ≤ Σ_ij γ(3(i + j) + 3) |c_ij| |x|^i |y|^j                                            (pointwise)
//                        ≤ γ(3(p + q) + 3) · 2^(p+q) · max |P|      P: the control points of the piece's spans  (a priori)
// (about its middle, with |x| at the ends, the moduli of the i-th Bernstein polynomial's terms sum up to C(p, i), together
// 2^p; the piece's own Bernstein points are means of the P).
// The same counting, for derivatives and quotients, is done by running the bodies of horner.h on Magnitude: the size of a
// number and of its error. Where w has a zero in a piece, the a-priori bound is +infinity and the pointwise one speaks:
//     |S − exact| ≤ (E_A + |S| E_w) / (|w| − E_w) + 3u |S|,    E_A, E_w: the bounds of numerator and denominator.
// (With S̃ = A/w of the computed A, w the exact value is S̃ + (a − S̃ e)/(w + e) for some |a| ≤ E_A, |e| ≤ E_w; the reciprocal
// and the product round S̃ twice.)
// Underflow: every operation may lose 2⁻¹⁰⁷⁴; kUnderflow covers all operations of a kernel.
// TEST     tests/patch/evaluate_batch_test.cpp holds computed results against them, tests/kernels/horner_test.cpp
//          the counting against Tracked.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/horner.h"

namespace patchproof::kernels {

constexpr double kUnitRoundoff = 0x1p-53;
// The roundings of a bound's own computation, to be on its safe side.
constexpr double kBoundSlack = 1 + 0x1p-40;
constexpr double kUnderflow = 0x1p-1050;

// γ(n). REQUIRES n < 2^40.
constexpr double gamma(double n) { return n * kUnitRoundoff * kBoundSlack; }

// A number known by |computed| ≤ size and |computed − exact| ≤ error.
struct Magnitude {
  double size = 0, error = 0;
  Magnitude() = default;
  explicit Magnitude(double s, double e = 0) : size(s), error(e) {}
};
namespace detail {
inline Magnitude bounded(double size, double error) {
  return Magnitude(size * kBoundSlack, error * kBoundSlack + kUnderflow);
}
inline double product_error(const Magnitude& a, const Magnitude& b) {
  return a.error * b.size + a.size * b.error + a.error * b.error;
}
}  // namespace detail
inline Magnitude operator*(const Magnitude& a, const Magnitude& b) {
  const double size = a.size * b.size;
  return detail::bounded(size, detail::product_error(a, b) + kUnitRoundoff * size);
}
// ±a·x + c: a rounding of the product and one of the sum.
inline Magnitude fma(const Magnitude& a, const Magnitude& x, const Magnitude& c) {
  const double product = a.size * x.size, size = product + c.size;
  return detail::bounded(size, detail::product_error(a, x) + c.error + kUnitRoundoff * (product + size));
}
// 1/w for |exact w| ≥ smallest.
struct WeightMagnitude {
  Magnitude value;
  double smallest;
};

// A point of a surface: one coordinate stands for all three; its weight, if it has one.
struct PointMagnitude {
  Magnitude coordinate, weight;
  double smallest_weight = 0;
};
inline PointMagnitude fma(const PointMagnitude& a, const Magnitude& x, const PointMagnitude& c) {
  return {fma(a.coordinate, x, c.coordinate), fma(a.weight, x, c.weight), c.smallest_weight};
}
// A factor that is a power of two scales without rounding.
struct PowerOfTwo {
  double x;
  explicit PowerOfTwo(double value) : x(value) {}
  friend PowerOfTwo operator*(PowerOfTwo a, PowerOfTwo b) { return PowerOfTwo(a.x * b.x); }
};
inline PointMagnitude scale(const PointMagnitude& a, PowerOfTwo f) {
  return {detail::bounded(a.coordinate.size * f.x, a.coordinate.error * f.x),
          detail::bounded(a.weight.size * f.x, a.weight.error * f.x), a.smallest_weight};
}
inline PointMagnitude scale(const PointMagnitude& a, const Magnitude& f) {
  return {a.coordinate * f, Magnitude(), a.smallest_weight};
}
inline WeightMagnitude weight_of(const PointMagnitude& a) { return {a.weight, a.smallest_weight}; }
inline PointMagnitude minus_product(const PointMagnitude& a, const PointMagnitude& s, const WeightMagnitude& w) {
  return {fma(s.coordinate, w.value, a.coordinate), Magnitude(), a.smallest_weight};
}
inline Magnitude reciprocal(const WeightMagnitude& w) {
  const double computed = w.smallest - w.value.error;  // ≤ |computed w|
  if (!(computed > 0))
    return Magnitude(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  return detail::bounded(1 / computed, w.value.error / (w.smallest * computed) + kUnitRoundoff / computed);
}

// Compensated evaluation (compensated_kernels.h) keeps a number R of Horner's rule as r + E, r computed, E the exact
// correction, of which e is computed. With the parameter x + x′ (|x′| ≤ u|x| ≤ u) and the coefficient c + c′ + c″, where
// |c′| ≤ u|c| is known and |c″| is not, a step is exactly
//     R x + c:   r ← fl(fl(r x) + c),   E ← E x + E x′ + r x′ + π + σ + c′ + c″,   |π| ≤ u|r x|, |σ| ≤ u|fl(r x) + c|
// and e ← e x + (r x′ + ((π + σ) + c′)) in double leaves out E x′ and c″. Let M = Σ|c_ij||x|^i|y|^j, n = p + q + 2 the number of
// steps from an innermost coefficient to the end (rows count as coefficients with c′ = e). What a step makes of r, and
// errs, is multiplied by the remaining powers of x and y: measured by that, up to factors 1 + 2⁻⁴⁰,
// |r| ≤ M; each step adds at most r x′ + π + σ + c′ ≤ 4uM to E, so |E| ≤ 4nuM; each step adds to |e − E| at most
// u|E| for what is left out and, for five roundings of sums no larger than |E| + 4uM, 5u(|E| + 4uM): together
//     |e − E| ≤ n (u·4nuM + 5u(4n + 4)uM) + Σ|c″| ≤ (24n² + 20n) u² M + Σ|c″|.
inline double compensated_error(int steps, double sum_of_moduli, double unknown) {
  if (sum_of_moduli == 0 && unknown == 0) return 0;  // a coordinate that is 0 everywhere is exactly 0
  const double n = steps;
  return kUnderflow + ((24 * n * n + 20 * n) * kUnitRoundoff * kUnitRoundoff * sum_of_moduli + unknown) * kBoundSlack;
}

}  // namespace patchproof::kernels
