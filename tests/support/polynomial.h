// SPDX-License-Identifier: Apache-2.0
// Exact polynomials by their monomial coefficients: the second opinion that spline formulas are compared with. Nothing
// here uses the library's splines; two polynomials are the same exactly when their coefficients are.
#pragma once

#include <vector>

#include "patchproof/scalar/rational.h"

namespace patchproof::test {

// Σ c_i t^i, without zero coefficients at the end.
struct Polynomial {
  std::vector<Rational> c;

  Polynomial() = default;
  Polynomial(std::vector<Rational> coefficients) : c(std::move(coefficients)) {
    while (!c.empty() && c.back() == 0) c.pop_back();
  }

  Rational operator()(const Rational& t) const {
    Rational sum(0);
    for (auto it = c.rbegin(); it != c.rend(); ++it) sum = sum * t + *it;
    return sum;
  }
  Polynomial derivative(int order = 1) const {
    std::vector<Rational> d = c;
    for (; order > 0 && !d.empty(); --order) {
      for (std::size_t i = 1; i < d.size(); ++i) d[i - 1] = Rational(static_cast<int>(i)) * d[i];
      d.pop_back();
    }
    return Polynomial(d);
  }
  friend Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    std::vector<Rational> sum(std::max(a.c.size(), b.c.size()), Rational(0));
    for (std::size_t i = 0; i < a.c.size(); ++i) sum[i] += a.c[i];
    for (std::size_t i = 0; i < b.c.size(); ++i) sum[i] += b.c[i];
    return Polynomial(sum);
  }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    if (a.c.empty() || b.c.empty()) return {};
    std::vector<Rational> r(a.c.size() + b.c.size() - 1, Rational(0));
    for (std::size_t i = 0; i < a.c.size(); ++i)
      for (std::size_t j = 0; j < b.c.size(); ++j) r[i + j] += a.c[i] * b.c[j];
    return Polynomial(r);
  }
  // this(inner(t))
  Polynomial compose(const Polynomial& inner) const {
    Polynomial sum;
    for (auto it = c.rbegin(); it != c.rend(); ++it) sum = sum * inner + Polynomial({*it});
    return sum;
  }
  friend bool operator==(const Polynomial& a, const Polynomial& b) { return a.c == b.c; }
};

inline Polynomial power(const Polynomial& base, int exponent) {
  Polynomial r({Rational(1)});
  for (; exponent > 0; --exponent) r = r * base;
  return r;
}

// Σ b_i C(n,i) t^i (1−t)^(n−i), multiplied out.
inline Polynomial from_bernstein(const std::vector<Rational>& b) {
  const int n = static_cast<int>(b.size()) - 1;
  Polynomial sum;
  Rational choose(1);
  for (int i = 0; i <= n; ++i) {
    sum = sum + Polynomial({choose * b[i]}) * power(Polynomial({Rational(0), Rational(1)}), i) *
                    power(Polynomial({Rational(1), Rational(-1)}), n - i);
    choose = choose * Rational(n - i) / Rational(i + 1);
  }
  return sum;
}

// N_{i,p} on the span [t_span, t_{span+1}], by the recursion of Cox and de Boor over all knots with 0/0 = 0.
inline Polynomial bspline_piece(const std::vector<Rational>& t, int i, int p, int span) {
  if (p == 0) return i == span ? Polynomial({Rational(1)}) : Polynomial();
  Polynomial sum;
  if (t[i] != t[i + p]) {
    const Rational d = t[i + p] - t[i];
    sum = sum + Polynomial({-t[i] / d, 1 / d}) * bspline_piece(t, i, p - 1, span);
  }
  if (t[i + 1] != t[i + p + 1]) {
    const Rational d = t[i + p + 1] - t[i + 1];
    sum = sum + Polynomial({t[i + p + 1] / d, -1 / d}) * bspline_piece(t, i + 1, p - 1, span);
  }
  return sum;
}

}  // namespace patchproof::test
