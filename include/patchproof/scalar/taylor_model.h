// SPDX-License-Identifier: Apache-2.0
// Taylor models: enclosures of functions of one local parameter s ∈ [−1, 1], not only of their values.
//
//   f(s) ∈ c_0 + c_1 s + … + c_N s^N + R       for every s in [−1, 1]; c_k and R are intervals
//
// A formula of ours that is evaluated at such models composes: S at the models of u(t) and v(t) is a model of S(u(t), v(t))
// on the whole interval, whose excess is of order N + 1 in its length, where an interval's would be of order 1. What
// cancels symbolically (the difference of two nearly equal curves) cancels in the coefficients before anything is bounded.
//
// REQUIRES a RoundingGuard (interval.h).  sqrt: an argument that is not negative throughout.
// ENSURES  (1) every operation's result contains the exact function for all functions in its operands: + − × ÷, sqrt, exp,
//          sin, cos;  (2) value(s), range() and bernstein_range() contain f(s);  (3) where the operands are smooth the
//          remainder of a composition over an interval of half-width r is O(r^(N+1));  (4) a quotient by a model
//          whose range contains 0 is "anything", never NaN;
//          (5) sign() answers only when the whole range has one sign, or f is exactly 0;
//          (6) composed(…) contains F(f(s)) for every F with those Taylor coefficients.
// COST     + − : N intervals; × : N²; ÷, sqrt, exp, sin, cos: N products.
// SOURCE   K. Makino, M. Berz, Taylor models and other validated functional inclusion methods, Int. J. Pure Appl. Math. 4
//          (2003) 379–456; remainders by Lagrange's form.
// NEIGHBOURS power_series.h (exact polynomials, no remainder), ball.h.
// TEST     tests/scalar/taylor_model_test.cpp checks (1)–(5), tests/scalar/transcendental_test.cpp (6).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <optional>

#include "patchproof/contract.h"
#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/concepts.h"
#include "patchproof/scalar/interval.h"

namespace patchproof {

template <int N>
requires(N >= 1 && N <= 30) class TaylorModel {
 public:
  TaylorModel() = default;  // 0
  explicit TaylorModel(int value) : TaylorModel(Interval(value)) {}
  explicit TaylorModel(const Interval& value) { c_[0] = value; }
  // centre + radius · s
  static TaylorModel variable(const Interval& centre, const Interval& radius) {
    TaylorModel out(centre);
    out.c_[1] = radius;
    return out;
  }

  const Interval& coefficient(int k) const { return c_[k]; }
  const Interval& remainder() const { return remainder_; }
  // Encloses f(s). REQUIRES s within [−1, 1].
  Interval value(const Interval& s) const {
    PATCHPROOF_REQUIRES(-1 <= s.inf() && s.sup() <= 1, "TaylorModel: s lies outside [-1, 1]");
    Interval sum = c_[N];
    for (int k = N; k-- > 0;) sum = sum * s + c_[k];
    return sum + remainder_;
  }
  // Encloses f([−1, 1]).
  Interval range() const {
    Interval sum = c_[0] + remainder_;
    for (int k = 1; k <= N; ++k) sum += c_[k] * power_range(k);
    return sum;
  }
  // b_0 … b_N with f(s) ∈ Σ b_i B_i^N((s + 1)/2); each b_i holds the remainder.
  std::array<Interval, N + 1> bernstein_coefficients() const;
  // range() through them: narrower when f is monotone or nearly so, at the cost of N² products.
  Interval bernstein_range() const {
    const std::array<Interval, N + 1> b = bernstein_coefficients();
    Interval all = b[0];
    for (const Interval& x : b) all = hull(all, x);
    return all;
  }

  TaylorModel& operator+=(const TaylorModel& o) { return *this = *this + o; }
  friend TaylorModel operator+(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel out;
    for (int k = 0; k <= N; ++k) out.c_[k] = a.c_[k] + b.c_[k];
    out.remainder_ = a.remainder_ + b.remainder_;
    return out;
  }
  friend TaylorModel operator-(const TaylorModel& a) {
    TaylorModel out;
    for (int k = 0; k <= N; ++k) out.c_[k] = -a.c_[k];
    out.remainder_ = -a.remainder_;
    return out;
  }
  friend TaylorModel operator-(const TaylorModel& a, const TaylorModel& b) { return a + -b; }
  friend TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel out;
    if (a.is_zero() || b.is_zero()) return out;
    if (a.is_unbounded() || b.is_unbounded()) return anything();
    if (a.is_constant() || b.is_constant()) {
      const Interval& factor = a.is_constant() ? a.c_[0] : b.c_[0];
      out = a.is_constant() ? b : a;
      for (Interval& c : out.c_) c *= factor;
      out.remainder_ *= factor;
      return out;
    }
    std::array<Interval, N> beyond{};  // coefficients of s^(N+1) … s^2N
    for (int i = 0; i <= N; ++i)
      for (int j = 0; j <= N; ++j) (i + j <= N ? out.c_[i + j] : beyond[i + j - N - 1]) += a.c_[i] * b.c_[j];
    out.remainder_ =
        a.polynomial_range() * b.remainder_ + a.remainder_ * b.polynomial_range() + a.remainder_ * b.remainder_;
    for (int k = 0; k < N; ++k) out.remainder_ += beyond[k] * power_range(k + N + 1);
    return out;
  }
  friend TaylorModel operator/(const TaylorModel& a, const TaylorModel& b) {
    if (b.is_constant() && !(b.c_[0].inf() <= 0 && b.c_[0].sup() >= 0)) {
      TaylorModel out;
      for (int k = 0; k <= N; ++k) out.c_[k] = a.c_[k] / b.c_[0];
      out.remainder_ = a.remainder_ / b.c_[0];
      return out;
    }
    const TaylorModel inverse = reciprocal(b);
    return inverse.is_unbounded() ? anything() : a * inverse;
  }

  friend TaylorModel sqrt(const TaylorModel& a) {
    const Interval all = a.range();
    PATCHPROOF_REQUIRES(all.sup() >= 0, "sqrt of a negative TaylorModel");
    if (a.is_unbounded()) return anything();
    const Interval centre = a.c_[0], around = hull(centre, all);
    if (around.inf() <= 0) {  // no derivative at 0: only the values are enclosed
      TaylorModel out;
      out.remainder_ = sqrt(Interval(std::max(all.inf(), 0.0), all.sup()));
      return out;
    }
    const auto terms = [](const Interval& x) {
      std::array<Interval, N + 2> f;
      f[0] = sqrt(x);
      for (int k = 0; k <= N; ++k) f[k + 1] = f[k] * Interval(1 - 2 * k) / (Interval(2 * k + 2) * x);
      return f;
    };
    return a.compose(terms(centre), terms(around)[N + 1]);
  }
  friend TaylorModel exp(const TaylorModel& a) {
    const auto terms = [](const Interval& x) {
      std::array<Interval, N + 2> f;
      f[0] = exp(Ball(x)).to_interval();
      for (int k = 0; k <= N; ++k) f[k + 1] = f[k] / Interval(k + 1);
      return f;
    };
    return a.compose_everywhere(terms);
  }
  friend TaylorModel sin(const TaylorModel& a) { return a.circular(0); }
  friend TaylorModel cos(const TaylorModel& a) { return a.circular(1); }

  // F(f(s)) for a function F that is given by its Taylor coefficients: at_centre[k] encloses F^(k)/k! on coefficient(0),
  // beyond encloses F^(N+1)/(N+1)! on argument_range().
  TaylorModel composed(const std::array<Interval, N + 1>& at_centre, const Interval& beyond) const {
    std::array<Interval, N + 2> f;
    std::copy(at_centre.begin(), at_centre.end(), f.begin());
    return is_unbounded() ? anything() : compose(f, beyond);
  }
  // What Taylor's formula about coefficient(0) needs to know F on: coefficient(0) and range(), and all between them.
  Interval argument_range() const { return hull(c_[0], range()); }

  // A function of which only its values are known.
  static TaylorModel unknown(const Interval& values) {
    TaylorModel out;
    out.remainder_ = values;
    return out;
  }
  // Nothing is known.
  static TaylorModel anything() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return unknown(Interval(-kInfinity, kInfinity));
  }

 private:
  // Of s^k, k ≥ 1.
  static Interval power_range(int k) { return k % 2 == 0 ? Interval(0.0, 1.0) : Interval(-1.0, 1.0); }
  static Interval hull(const Interval& a, const Interval& b) {
    return Interval(std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup()));
  }
  static bool is_zero(const Interval& x) { return x.inf() == 0 && x.sup() == 0; }
  bool is_constant() const {  // an interval of constants
    for (int k = 1; k <= N; ++k)
      if (!is_zero(c_[k])) return false;
    return is_zero(remainder_);
  }
  bool is_zero() const { return is_constant() && is_zero(c_[0]); }
  bool is_unbounded() const {
    constexpr double kLargest = std::numeric_limits<double>::max();
    const Interval all = range();
    return !(-kLargest <= all.inf() && all.sup() <= kLargest);
  }
  Interval polynomial_range() const {
    Interval sum = c_[0];
    for (int k = 1; k <= N; ++k) sum += c_[k] * power_range(k);
    return sum;
  }
  // f(a) = Σ_{k ≤ N} f_k h^k + f_{N+1} h^(N+1),  h = a − c_0,  f_k = f^(k)(c_0)/k!,  f_{N+1} = f^(N+1)(ξ)/(N+1)!
  TaylorModel compose(const std::array<Interval, N + 2>& f, const Interval& last) const {
    TaylorModel h = *this;
    h.c_[0] = Interval(0);
    TaylorModel sum(f[N]);
    for (int k = N; k-- > 0;) sum = sum * h + TaylorModel(f[k]);
    const Interval size = h.range();
    Interval power(1);
    for (int k = 0; k <= N; ++k) power *= size;
    if (N % 2 == 1) power = Interval(std::max(power.inf(), 0.0), power.sup());  // an even power
    sum.remainder_ += last * power;
    return sum;
  }
  template <class Terms>
  TaylorModel compose_everywhere(const Terms& terms) const {
    if (is_unbounded()) return anything();
    return compose(terms(c_[0]), terms(hull(c_[0], range()))[N + 1]);
  }
  friend TaylorModel reciprocal(const TaylorModel& a) {
    if (a.is_unbounded()) return anything();
    const Interval centre = a.c_[0], around = hull(centre, a.range());
    if (around.inf() <= 0 && around.sup() >= 0) return anything();
    const auto terms = [](const Interval& x) {
      std::array<Interval, N + 2> f;
      f[0] = Interval(1) / x;
      for (int k = 0; k <= N; ++k) f[k + 1] = -(f[k] / x);
      return f;
    };
    return a.compose(terms(centre), terms(around)[N + 1]);
  }
  // The k-th derivative of sine is sin(x + k π/2); shift = 1 for cosine.
  TaylorModel circular(int shift) const {
    return compose_everywhere([shift](const Interval& x) {
      const Interval s = sin(Ball(x)).to_interval(), c = cos(Ball(x)).to_interval();
      const Interval cycle[4] = {s, c, -s, -c};
      std::array<Interval, N + 2> f;
      Interval factorial(1);
      for (int k = 0; k <= N + 1; ++k) {
        if (k > 1) factorial *= Interval(k);
        f[k] = cycle[(k + shift) % 4] / factorial;
      }
      return f;
    });
  }

  std::array<Interval, N + 1> c_{};
  Interval remainder_{};
};

// With s = 2x − 1 and a_j = Σ_k c_k C(k,j) 2^j (−1)^(k−j):  b_i = Σ_{j ≤ i} C(i,j)/C(N,j) a_j.
template <int N>
requires(N >= 1 && N <= 30) std::array<Interval, N + 1> TaylorModel<N>::bernstein_coefficients()
const {
  std::array<std::array<Interval, N + 1>, N + 1> choose{};
  for (int i = 0; i <= N; ++i) {
    choose[i][0] = choose[i][i] = Interval(1);
    for (int j = 1; j < i; ++j) choose[i][j] = choose[i - 1][j - 1] + choose[i - 1][j];
  }
  std::array<Interval, N + 1> a{};
  for (int k = 0; k <= N; ++k) {
    Interval power(1);
    for (int j = 0; j <= k; ++j, power *= Interval(2)) {
      const Interval term = c_[k] * choose[k][j] * power;
      a[j] += (k - j) % 2 == 0 ? term : -term;
    }
  }
  std::array<Interval, N + 1> b;
  for (int i = 0; i <= N; ++i) {
    b[i] = a[0] + remainder_;
    for (int j = 1; j <= i; ++j) b[i] += choose[i][j] / choose[N][j] * a[j];
  }
  return b;
}

template <int N>
struct scalar_traits<TaylorModel<N>> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = false;
  static std::optional<Sign> sign(const TaylorModel<N>& x) { return scalar_traits<Interval>::sign(x.range()); }
  using knot_scalar = Rational;
};

template <int N, class X>
requires(!std::same_as<X, TaylorModel<N>>) struct embedding<TaylorModel<N>, X> {
  static TaylorModel<N> apply(const X& x) { return TaylorModel<N>(embed<Interval>(x)); }
};

}  // namespace patchproof
