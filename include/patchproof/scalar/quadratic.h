// SPDX-License-Identifier: Apache-2.0
// Quadratic: numbers a + b·√d with rational a, b and one square-free integer d > 1 per computation. Circles, cylinders,
// spheres and tori with weights √2/2 are exact here.
//
// ENSURES  (1) + − × ÷, == and < are exact;  (2) sign always answers.
// REQUIRES operands with the same d (a rational operand fits every d); otherwise contract_error. Readers refuse models
//          that mix roots (ErrorCode::mixed_roots).
// SOURCE   CGAL::Sqrt_extension.
#pragma once

#include <CGAL/Sqrt_extension.h>
#include <CGAL/boost_mp.h>

#include <compare>

#include "patchproof/contract.h"
#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/rational.h"

namespace patchproof {

class Quadratic {
 public:
  Quadratic() = default;
  explicit Quadratic(int a) : x_(Rational(a)) {}
  explicit Quadratic(const Rational& a) : x_(a) {}
  // a + b·√d; squares in d are taken out of the root, so √8 is 2·√2. REQUIRES d > 1 and not a square.
  Quadratic(const Rational& a, const Rational& b, int d);

  Rational rational_part() const { return x_.a0(); }
  Rational root_coefficient() const { return is_rational() ? Rational(0) : x_.a1(); }
  int root() const;  // the square-free d, or 1 for a rational number
  bool is_rational() const { return !x_.is_extended(); }

  Quadratic& operator+=(const Quadratic& o) { return *this = *this + o; }
  friend Quadratic operator-(const Quadratic& a) { return Quadratic(-a.x_); }
  friend Quadratic operator+(const Quadratic& a, const Quadratic& b) { return checked(a, b), Quadratic(a.x_ + b.x_); }
  friend Quadratic operator-(const Quadratic& a, const Quadratic& b) { return checked(a, b), Quadratic(a.x_ - b.x_); }
  friend Quadratic operator*(const Quadratic& a, const Quadratic& b) { return checked(a, b), Quadratic(a.x_ * b.x_); }
  friend Quadratic operator/(const Quadratic& a, const Quadratic& b) {
    PATCHPROOF_REQUIRES(b.sign() != Sign::zero, "Quadratic: division by zero");
    return checked(a, b), Quadratic(a.x_ / b.x_);
  }
  friend bool operator==(const Quadratic& a, const Quadratic& b) { return (a - b).sign() == Sign::zero; }
  friend std::strong_ordering operator<=>(const Quadratic& a, const Quadratic& b) {
    return static_cast<int>((a - b).sign()) <=> 0;
  }

  Sign sign() const;

 private:
  using Extension = CGAL::Sqrt_extension<Rational, Rational>;
  // A sum whose roots cancel is rational again and so fits every d.
  explicit Quadratic(Extension x) : x_(std::move(x)) {
    if (x_.is_extended() && scalar_traits<Rational>::sign(x_.a1()) == Sign::zero) x_ = Extension(Rational(x_.a0()));
  }
  static void checked(const Quadratic& a, const Quadratic& b) {
    PATCHPROOF_REQUIRES(!a.x_.is_extended() || !b.x_.is_extended() || a.x_.root() == b.x_.root(),
                        "Quadratic: operands with different roots");
  }

  Extension x_;
};

template <>
struct scalar_traits<Quadratic> {
  static constexpr bool is_exact = true;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = true;
  static std::optional<Sign> sign(const Quadratic& x) { return x.sign(); }
  using knot_scalar = Quadratic;
};

template <>
struct embedding<Quadratic, Rational> {
  static Quadratic apply(const Rational& x) { return Quadratic(x); }
};

// Enclosures that stay tight when a and b·√d nearly cancel (the precision grows until they are).
ScaledInterval enclose_scaled(const Quadratic& x);
Interval enclose(const Quadratic& x);
double nearest_double(const Quadratic& x);

template <>
struct embedding<Interval, Quadratic> {
  static Interval apply(const Quadratic& x) { return enclose(x); }
};
template <>
struct embedding<double, Quadratic> {
  static double apply(const Quadratic& x) { return nearest_double(x); }
};
template <>
struct embedding<Ball, Quadratic> {
  static Ball apply(const Quadratic& x) {
    return Ball(x.rational_part()) + Ball(x.root_coefficient()) * sqrt(Ball(x.root()));
  }
};

}  // namespace patchproof
