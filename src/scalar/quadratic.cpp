// SPDX-License-Identifier: Apache-2.0
#include "patchproof/scalar/quadratic.h"

#include <cmath>

#include "patchproof/scalar/ball.h"

namespace patchproof {

Quadratic::Quadratic(const Rational& a, const Rational& b, int d) : x_(a) {
  PATCHPROOF_REQUIRES(d > 1, "Quadratic: the root must be at least 2");
  long free = d, outside = 1;  // √d = outside · √free
  for (long p = 2; p * p <= free; ++p) {
    for (; free % (p * p) == 0; free /= p * p) outside *= p;
  }
  PATCHPROOF_REQUIRES(free != 1, "Quadratic: the root must not be a square");
  if (b != 0) x_ = Extension(a, b * Rational(outside), Rational(free));
}

int Quadratic::root() const { return is_rational() ? 1 : static_cast<int>(nearest_double(x_.root())); }

Sign Quadratic::sign() const {
  const Rational& a = x_.a0();
  const Rational b = root_coefficient();
  const int sa = mpq_sgn(a.backend().data()), sb = mpq_sgn(b.backend().data());
  if (sb == 0 || sa == sb) return static_cast<Sign>(sa);
  if (sa == 0) return static_cast<Sign>(sb);
  // Opposite signs: the larger of a² and b²·d wins; they are never equal because √d is irrational.
  const Rational difference = a * a - b * b * x_.root();
  return static_cast<Sign>(mpq_sgn(difference.backend().data()) > 0 ? sa : sb);
}

namespace {

// An enclosure with 64 good bits. Terminates: the value is not zero, so some precision separates it from zero.
Ball tight_ball(const Quadratic& x) {
  for (int bits = 128;; bits *= 2) {
    const BallPrecision precision(bits);
    const Ball value = Ball(x.rational_part()) + Ball(x.root_coefficient()) * sqrt(Ball(x.root()));
    if (value.is_tight(64)) return value;
  }
}

// Infinity stands at ±2^1024 for rounding, where the next double would be.
Rational binary_value(double x) {
  if (std::isfinite(x)) return from_double(x);
  const Rational below = from_double(std::ldexp(1, 1023));
  return x > 0 ? Rational(below + below) : Rational(-below - below);
}

}  // namespace

ScaledInterval enclose_scaled(const Quadratic& x) {
  if (x.is_rational()) return enclose_scaled(x.rational_part());
  return tight_ball(x).to_scaled_interval();
}

Interval enclose(const Quadratic& x) {
  if (x.is_rational()) return enclose(x.rational_part());
  return tight_ball(x).to_interval();
}

double nearest_double(const Quadratic& x) {
  if (x.is_rational()) return nearest_double(x.rational_part());
  // Enclose by two neighbouring doubles, then compare with their midpoint exactly (never a tie: x is irrational).
  for (int bits = 128;; bits *= 2) {
    const BallPrecision precision(bits);
    const Ball value = Ball(x.rational_part()) + Ball(x.root_coefficient()) * sqrt(Ball(x.root()));
    const Interval coarse = value.to_interval();
    if (coarse.inf() == coarse.sup()) return coarse.inf();
    if (std::nextafter(coarse.inf(), coarse.sup()) != coarse.sup()) continue;
    const Rational middle = (binary_value(coarse.inf()) + binary_value(coarse.sup())) / Rational(2);
    return (x - Quadratic(middle)).sign() == Sign::positive ? coarse.sup() : coarse.inf();
  }
}

}  // namespace patchproof
