// SPDX-License-Identifier: Apache-2.0
// Polynomials in D variables as a number type: exact, or cut off after a total degree `order` (power series).
//
//   f(x) = Σ c_α x^α,   x^α = x_1^α_1 ⋯ x_D^α_D,   |α| = α_1 + … + α_D ≤ order
//
// A formula of ours that is evaluated at the series  a_i + x_i  of order k gives every partial derivative up to total order
// k at the point a, by the full product and quotient rules:  ∂^α f(a) = α! c_α. Evaluated at exact polynomials (order
// kExact) it gives the polynomial itself, and two formulas that give the same coefficients are the same function: that is
// how boundaries are proved to be interpolated.
//
// REQUIRES  operands: any orders (the result has the smaller one). Quotients: a divisor whose constant term is not certainly
//           zero, and, unless it is a constant, a finite order.
// ENSURES   (1) + − × ÷ are those of the ring of polynomials, or of series modulo terms of higher total degree;
//           (2) the series of a_i + x_i through a formula gives its Taylor coefficients at a;  (3) exact in exact R; in an
//           enclosure every coefficient is enclosed;  (4) a number embeds as a constant, without an error of its own.
// SCALARS   R: Ring (Field for ÷).
// COST      of a product: the product of the numbers of stored coefficients.
// SOURCE    A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., ch. 13.
// TEST      tests/scalar/power_series_test.cpp checks (1)–(4).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/scalar/concepts.h"

namespace patchproof {

template <Ring R, std::size_t D>
class PowerSeries {
 public:
  using Exponents = std::array<int, D>;
  static constexpr int kExact = std::numeric_limits<int>::max();  // a polynomial: nothing is cut off

  PowerSeries() : PowerSeries(0) {}
  explicit PowerSeries(int value) : PowerSeries(R(value)) {}
  explicit PowerSeries(const R& value) requires(!std::same_as<R, int>) : coefficients_{value} {}

  // value + x_i, up to total degree `order`. REQUIRES order ≥ 0.
  static PowerSeries variable(std::size_t i, const R& value, int order = kExact) {
    PATCHPROOF_REQUIRES(i < D && order >= 0, "PowerSeries: a variable of the D, an order that is not negative");
    PowerSeries out(value);
    out.order_ = order;
    if (order > 0) {
      out.degrees_[i] = 1;
      out.coefficients_.push_back(R(1));
    }
    return out;
  }

  int order() const { return order_; }
  // No term of a higher power of x_i is stored.
  int degree(std::size_t i) const { return degrees_[i]; }
  // c_α. REQUIRES |α| ≤ order.
  R coefficient(const Exponents& exponents) const {
    PATCHPROOF_REQUIRES(total(exponents) <= order_, "PowerSeries: the term lies beyond the order");
    for (std::size_t i = 0; i < D; ++i)
      if (exponents[i] > degrees_[i]) return R(0);
    return coefficients_[place(exponents)];
  }
  const R& constant_term() const { return coefficients_[0]; }
  // ∂^α at the point about which the variables were made: α! c_α. REQUIRES |α| ≤ order.
  R derivative(const Exponents& exponents) const {
    R factor(1);
    for (const int e : exponents)
      for (int k = 2; k <= e; ++k) factor = R(k) * factor;
    return factor * coefficient(exponents);
  }

  PowerSeries& operator+=(const PowerSeries& o) { return *this = *this + o; }
  friend PowerSeries operator-(PowerSeries a) {
    for (R& c : a.coefficients_) c = -c;
    return a;
  }
  friend PowerSeries operator-(const PowerSeries& a, const PowerSeries& b) { return a + -b; }
  friend PowerSeries operator+(const PowerSeries& a, const PowerSeries& b) {
    Exponents degrees;
    for (std::size_t i = 0; i < D; ++i) degrees[i] = std::max(a.degrees_[i], b.degrees_[i]);
    PowerSeries out(degrees, std::min(a.order_, b.order_));
    out.add(a);
    out.add(b);
    return out;
  }
  friend PowerSeries operator*(const PowerSeries& a, const PowerSeries& b) {
    const int order = std::min(a.order_, b.order_);
    Exponents degrees;
    for (std::size_t i = 0; i < D; ++i) degrees[i] = std::min(a.degrees_[i] + b.degrees_[i], order);
    PowerSeries out(degrees, order);
    a.for_each_term([&](const Exponents& of_a, const R& x) {
      if (total(of_a) > order) return;
      b.for_each_term([&](const Exponents& of_b, const R& y) {
        if (total(of_a) + total(of_b) > order) return;
        Exponents sum;
        for (std::size_t i = 0; i < D; ++i) sum[i] = of_a[i] + of_b[i];
        out.coefficients_[out.place(sum)] += x * y;
      });
    });
    return out;
  }
  // q_α = (a_α − Σ_{0 ≠ β ≤ α} b_β q_{α−β}) / b_0
  friend PowerSeries operator/(const PowerSeries& a, const PowerSeries& b) requires Field<R> {
    const R& divisor = b.constant_term();
    PATCHPROOF_REQUIRES(scalar_traits<R>::sign(divisor) != Sign::zero,
                        "PowerSeries: a quotient by a series that is 0 here");
    if (b.coefficients_.size() == 1) {
      PowerSeries out(a.degrees_, std::min(a.order_, b.order_));
      out.add(a);
      for (R& c : out.coefficients_) c = c / divisor;
      return out;
    }
    const int order = std::min(a.order_, b.order_);
    PATCHPROOF_REQUIRES(order != kExact, "PowerSeries: a quotient by a polynomial that is no constant needs an order");
    Exponents degrees;
    degrees.fill(order);
    PowerSeries out(degrees, order);
    out.for_each_term([&](const Exponents& alpha, const R&) {
      if (total(alpha) > order) return;
      R sum = a.coefficient(alpha);
      b.for_each_term([&](const Exponents& beta, const R& y) {
        Exponents rest;
        bool inside = total(beta) > 0;
        for (std::size_t i = 0; i < D; ++i) inside = (rest[i] = alpha[i] - beta[i]) >= 0 && inside;
        if (inside) sum = sum - y * out.coefficients_[out.place(rest)];
      });
      out.coefficients_[out.place(alpha)] = sum / divisor;
    });
    return out;
  }

  // The same series, coefficient by coefficient up to the smaller order.
  friend bool identical(const PowerSeries& a, const PowerSeries& b) requires ExactRing<R> {
    bool same = true;
    (a - b).for_each_term(
        [&](const Exponents&, const R& c) { same = same && *scalar_traits<R>::sign(c) == Sign::zero; });
    return same;
  }

 private:
  PowerSeries(const Exponents& degrees, int order) : degrees_(degrees), order_(order) {
    std::size_t count = 1;
    for (const int d : degrees) count *= d + 1;
    coefficients_.assign(count, R(0));
  }
  static long total(const Exponents& exponents) {
    long sum = 0;
    for (const int e : exponents) sum += e;
    return sum;
  }
  std::size_t place(const Exponents& exponents) const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < D; ++i) at = at * (degrees_[i] + 1) + exponents[i];
    return at;
  }
  // In an order in which every β ≤ α comes before α.
  template <class Visit>
  void for_each_term(Visit visit) const {
    Exponents exponents{};
    for (const R& c : coefficients_) {
      visit(std::as_const(exponents), c);
      for (std::size_t i = D; i-- > 0;) {
        if (++exponents[i] <= degrees_[i]) break;
        exponents[i] = 0;
      }
    }
  }
  void add(const PowerSeries& o) {
    o.for_each_term([&](const Exponents& exponents, const R& c) {
      if (total(exponents) <= order_) coefficients_[place(exponents)] += c;
    });
  }

  Exponents degrees_{};
  std::vector<R> coefficients_;  // the last exponent runs fastest
  int order_ = kExact;
};

template <Ring R, std::size_t D>
struct scalar_traits<PowerSeries<R, D>> {
  static constexpr bool is_exact = false;  // a series has no sign
  static constexpr bool is_field = scalar_traits<R>::is_field;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const PowerSeries<R, D>&) { return std::nullopt; }
  using knot_scalar = typename scalar_traits<R>::knot_scalar;
};

template <Ring R, std::size_t D, class X>
requires(!std::same_as<X, PowerSeries<R, D>>) struct embedding<PowerSeries<R, D>, X> {
  static PowerSeries<R, D> apply(const X& x) { return PowerSeries<R, D>(embed<R>(x)); }
};

}  // namespace patchproof
