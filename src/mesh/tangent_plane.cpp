// SPDX-License-Identifier: Apache-2.0
#include "patchproof/mesh/tangent_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "patchproof/contract.h"
#include "patchproof/scalar/integer.h"

namespace patchproof {
namespace {

using Vector = Vec<Rational, 3>;

// ⌊log2 |x|⌋ or one more. REQUIRES x ≠ 0.
int exponent(const Rational& x) {
  return static_cast<int>(msb(Integer(abs(numerator(x))))) - static_cast<int>(msb(denominator(x)));
}

Rational power_of_two(int e) {
  return e < 0 ? Rational(Integer(1), Integer(1) << static_cast<unsigned>(-e))
               : Rational(Integer(1) << static_cast<unsigned>(e));
}

Integer floor_of(const Rational& x) {
  Integer quotient = numerator(x) / denominator(x);  // towards zero
  return x < 0 && Rational(quotient) != x ? Integer(quotient - 1) : quotient;
}

// The nearest multiple of a step.
Rational to_step(const Rational& x, const Rational& step) {
  return Rational(floor_of(x / step + Rational(1, 2))) * step;
}

Rational largest_component(const Vector& v) {
  return std::max({Rational(abs(v[0])), Rational(abs(v[1])), Rational(abs(v[2]))});
}

// About v, scaled so that its largest component is 1; 0 for 0.
std::array<double, 3> direction_in_double(const Vector& v) {
  const Rational largest = largest_component(v);
  if (largest == 0) return {0, 0, 0};
  return {nearest_double(v[0] / largest), nearest_double(v[1] / largest), nearest_double(v[2] / largest)};
}

// The eigenvector of the least eigenvalue of a symmetric matrix, by Jacobi's rotations.
std::array<double, 3> least_eigenvector(std::array<std::array<double, 3>, 3> m) {
  std::array<std::array<double, 3>, 3> vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 40; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (m[p][q] == 0) continue;
      const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (int k = 0; k < 3; ++k) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
      }
      for (int k = 0; k < 3; ++k) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        const double x = vectors[k][p], y = vectors[k][q];
        vectors[k][p] = c * x - s * y;
        vectors[k][q] = s * x + c * y;
      }
    }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (m[k][k] < m[least][least]) least = k;
  return {vectors[0][least], vectors[1][least], vectors[2][least]};
}

}  // namespace

Rational rounded(const Rational& x, int bits) {
  if (x == 0) return x;
  return to_step(x, power_of_two(exponent(x) - bits));
}

Rational rounded_root(const Rational& square, int bits) {
  PATCHPROOF_REQUIRES(square >= 0, "rounded_root: of a negative number");
  if (square == 0) return square;
  const int half = exponent(square) / 2 - bits - 2;  // of the last digit of the root
  return rounded(Rational(boost::multiprecision::sqrt(floor_of(square / power_of_two(2 * half)))) * power_of_two(half),
                 bits);
}

Vec<Rational, 3> on_grid(const Vec<Rational, 3>& v, const Vec<Rational, 3>& size, int bits) {
  if (size == Vector{}) return v;
  const Rational step = power_of_two(exponent(largest_component(size)) - bits);
  return {{to_step(v[0], step), to_step(v[1], step), to_step(v[2], step)}};
}

TangentPlane plane_of(const Vec<Rational, 3>& normal) {
  PATCHPROOF_REQUIRES(!(normal == Vector{}), "plane_of: the normal is zero");
  Integer multiple = lcm(lcm(denominator(normal[0]), denominator(normal[1])), denominator(normal[2])), divisor(0);
  TangentPlane out;
  for (std::size_t c = 0; c < 3; ++c) divisor = gcd(divisor, numerator(Rational(normal[c] * Rational(multiple))));
  for (std::size_t c = 0; c < 3; ++c) out.normal[c] = normal[c] * Rational(multiple, divisor);
  std::size_t axis = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (abs(out.normal[c]) < abs(out.normal[axis])) axis = c;
  Vector unit;
  unit[axis] = 1;
  out.first = cross(out.normal, unit);
  out.second = cross(out.normal, out.first);
  return out;
}

TangentPlane plane_near(const Vec<Rational, 3>& normal, int bits) {
  PATCHPROOF_REQUIRES(!(normal == Vector{}), "plane_near: the normal is zero");
  return plane_of(on_grid(normal, normal, bits));
}

Vec<Rational, 2> plane_coordinates(const TangentPlane& plane, const Vec<Rational, 3>& v, int bits) {
  if (v == Vector{}) return {};
  const int size = exponent(largest_component(v));
  const auto coordinate = [&](const Vector& e) {
    return to_step(dot(v, e) / dot(e, e), power_of_two(size - exponent(largest_component(e)) - bits));
  };
  return {{coordinate(plane.first), coordinate(plane.second)}};
}

Vec<Rational, 3> in_plane(const TangentPlane& plane, const Vec<Rational, 3>& v, int bits) {
  const Vec<Rational, 2> at = plane_coordinates(plane, v, bits);
  return at[0] * plane.first + at[1] * plane.second;
}

Vec<Rational, 3> projected(const Vec<Rational, 3>& v, const Vec<Rational, 3>& normal) {
  return v - Rational(dot(v, normal) / dot(normal, normal)) * normal;
}

std::optional<Vec<Rational, 3>> common_normal(const std::vector<Vec<Rational, 3>>& directions) {
  const Vector zero;
  const auto first = std::find_if(directions.begin(), directions.end(), [&](const Vector& d) { return !(d == zero); });
  if (first == directions.end()) return std::nullopt;
  Vector normal;
  for (const Vector& d : directions) {
    if (normal == zero)
      normal = cross(*first, d);
    else if (dot(normal, d) != 0)
      return std::nullopt;
  }
  return normal == zero ? std::nullopt : std::optional(normal);
}

Vec<Rational, 3> fitted_normal(const std::vector<Vec<Rational, 3>>& directions) {
  if (const std::optional<Vector> exact = common_normal(directions)) return *exact;
  std::array<std::array<double, 3>, 3> moments{};
  for (const Vector& d : directions) {
    const std::array<double, 3> v = direction_in_double(d);
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (square == 0) continue;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) moments[i][j] += v[i] * v[j] / square;
  }
  const std::array<double, 3> n = least_eigenvector(moments);
  return {{from_double(n[0]), from_double(n[1]), from_double(n[2])}};
}

}  // namespace patchproof
