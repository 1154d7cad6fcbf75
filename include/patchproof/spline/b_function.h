// SPDX-License-Identifier: Apache-2.0
// B-functions: how a blend goes from 0 to 1. B maps [0, 1] onto itself, strictly increasing, B(0) = 0, B(1) = 1; its order is
// the number of derivatives that vanish at the ends, and decides how smooth a blend is (gerbs_curve.h, curve_blend.h).
//
//   polynomial(n)   (2n+1)!/(n!)² ∫ s^n (1−s)^n          beta(a, b)      c ∫ s^a (1−s)^b: orders a at 0, b at 1
//   rational(n)     t^(n+1) / (t^(n+1) + (1−t)^(n+1))     trigonometric   sin²(πt/2), of order 1
//   logistic        1 / (1 + e^(1/t − 1/(1−t)))           from_polynomial any polynomial that is proved to be one
//   expo-rational   S ∫ φ,  φ(s) = exp(−β |s−λ|^p / (s (1−s)^γ)^α),  p = α(1+γ),  S = 1/∫_0^1 φ       (order: all)
//
// A function that is exact (polynomials, rational) is evaluated in the field of t. The others are enclosed: the expo-rational
// one by Taylor panels with proved remainders, its constant S by the same panels, never from a table of digits.
//
// REQUIRES 0 ≤ t ≤ 1. Enclosures may stick out of [0, 1], or lie beyond: exact functions and the trigonometric one go on by their
//          formula there; logistic and expo-rational ones, all of whose derivatives vanish at the ends, as 0 and 1. A
//          RoundingGuard for Interval and TaylorModel.
// ENSURES  (1) order_at_begin() and order_at_end() derivatives vanish at 0 and at 1 exactly, and for exact functions no more;
//          polynomial(n) has B^(n+1)(0) = (2n+1)!/n! and B^(n+1)(1) = (−1)^n (2n+1)!/n!;
//          (2) is_symmetric() ⇔ B(t) + B(1−t) = 1;  (3) B is strictly increasing, B(0) = 0, B(1) = 1;
//          (4) numerator and denominator are B's Bernstein coefficients: B = Σ n_i B_i^m / Σ d_i B_i^m';
//          (5) Interval, Ball and TaylorModel contain every derivative of B, also where the argument touches 0 or 1, where all
//          bounds stay finite;  (6) enclosures are narrow: Ball of 128 bits at a point of the middle has 30 digits (fewer
//          for an expo-rational one whose p is not an even integer, which is not analytic at λ: 16 for p = 1); models have
//          remainders of order N + 1;
//          (7) double: |derivative k − exact| ≤ double_error(b, k), k ≤ 3, and values lie in [0, 1], are 0 and 1 at the ends,
//          and are ordered wherever the exact ones differ by 2·double_error(b, 0) or more; no NaN;
//          (8) parse(to_string()) is the same function;  (9) parameters that make no B-function are errors, with the place;
//          (10) the tables of logistic and expo-rational functions are the same bits whoever asks first, in any rounding and
//          precision; then they never change: any number of threads may use one function, or equal ones.
// SCALARS  exact functions: any Field into which Rational embeds. Others: Transcendental, and Rational and Quadratic at t = 0
//          and t = 1 for the derivatives that are exactly 0 there (contract_error beyond).
// ERRORS   usage: an order below 0 or above kMaxOrder; λ not in (0, 1), where a derivative at an end would not vanish; α, β, γ
//          not positive; parameters beyond the limits said below; parse: syntax, bad_number.
//          not_monotone: a polynomial whose derivative is negative somewhere, with the place where it changes sign, or with
//          B(0) ≠ 0 or B(1) ≠ 1.
// COST     exact: O(n²) per derivative. Ball of expo-rational: some hundred products, after tables that are built once per
//          32 bits of precision (a tenth of a second to one; who asks meanwhile waits) and shared by equal functions. double: one
//          polynomial of degree 15 up to k = 3; higher derivatives go through Ball.
// SOURCE   L. Dechevsky, A. Lakså, B. Bang, Expo-rational B-splines, IJPAM 27 (2006); certified panels: Cauchy's estimate.
// NEIGHBOURS bernstein.h, real_roots.h; gerbs_curve.h.
// TEST     tests/spline/b_function_test.cpp (1)–(4), (8), (9); tests/spline/b_function_bounds_test.cpp (5)–(7);
//          tests/threads/b_function_test.cpp (10).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "patchproof/contract.h"
#include "patchproof/error.h"
#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/scalar/taylor_model.h"
#include "patchproof/scalar/transcendental.h"
#include "patchproof/spline/bernstein.h"

namespace patchproof {

namespace detail {
class SmoothBFunction;  // logistic and expo-rational, with their tables
}

class BFunction {
 public:
  enum class Kind { polynomial, rational, trigonometric, logistic, expo_rational };
  static constexpr int kMaxOrder = 40;         // of polynomial, beta and rational
  static constexpr int kMaxCoefficients = 82;  // of from_polynomial
  struct Intrinsic {                           // of expo-rational functions
    Rational alpha{1}, beta{1}, gamma{1}, lambda = Rational(1) / Rational(2);
    friend bool operator==(const Intrinsic&, const Intrinsic&) = default;
  };

  BFunction() : BFunction(*beta(1, 1)) {}  // 3t² − 2t³
  static Result<BFunction> polynomial(int order) { return beta(order, order); }
  static Result<BFunction> beta(int a, int b);
  static Result<BFunction> rational(int order);
  static BFunction trigonometric();
  static BFunction logistic();
  // 1/2 ≤ α ≤ 8, 1/2 ≤ αγ ≤ 8, 1/16 ≤ β ≤ 16, 1/16 ≤ λ ≤ 15/16.
  static Result<BFunction> expo_rational(const Rational& alpha = Rational(1), const Rational& beta = Rational(1),
                                         const Rational& gamma = Rational(1),
                                         const Rational& lambda = Rational(1) / Rational(2));
  // Σ b_i B_i^n. Monotonicity is decided exactly, by isolating the roots of the derivative.
  static Result<BFunction> from_polynomial(std::vector<Rational> bernstein);

  // "polynomial(2)", "beta(2,1)", "rational(1)", "trigonometric", "logistic", "expo-rational(1,1,1,1/2)",
  // "bernstein(0,1/2,1)"; parse also reads "expo-rational".
  std::string to_string() const;
  static Result<BFunction> parse(std::string_view text);

  Kind kind() const { return kind_; }
  std::optional<int> order_at_begin() const;  // empty: all derivatives vanish
  std::optional<int> order_at_end() const;
  std::optional<int> order() const;  // the smaller one
  // B is C^k on [0, 1] and no more; empty: for every k. Only expo-rational functions whose p is not an even integer have a
  // limit, at λ.
  std::optional<int> smoothness() const;
  bool is_symmetric() const;
  bool is_polynomial() const { return kind_ == Kind::polynomial; }
  bool is_exact() const { return is_polynomial() || kind_ == Kind::rational; }
  // Bernstein coefficients over [0, 1]; the denominator of a polynomial is {1}. REQUIRES is_exact().
  const std::vector<Rational>& numerator() const;
  const std::vector<Rational>& denominator() const;
  const Intrinsic& intrinsic() const;  // REQUIRES kind() == expo_rational

  friend bool operator==(const BFunction& a, const BFunction& b) {
    return a.kind_ == b.kind_ && a.numerator_ == b.numerator_ && a.intrinsic_ == b.intrinsic_;
  }

  const detail::SmoothBFunction& smooth() const;  // for the templates below

 private:
  BFunction(Kind kind, std::vector<Rational> numerator, std::vector<Rational> denominator);
  Kind kind_;
  std::vector<Rational> numerator_, denominator_;
  std::optional<Intrinsic> intrinsic_;
  std::shared_ptr<const detail::SmoothBFunction> smooth_;
};

// B(t), B′(t), …, B^(order)(t). REQUIRES 0 ≤ order ≤ kMaxDerivative.
inline constexpr int kMaxDerivative = 100;
template <class R>
std::vector<R> derivatives(const BFunction& b, const R& t, int order);

// Bounds |derivatives<double>(b, t, …)[k] − B^(k)(t)| for every double t in [0, 1]. Proved when the tables are built, from the
// remainders of their polynomials and the roundings of Horner's rule. REQUIRES 0 ≤ k ≤ 3 (k ≤ smoothness()), b is not exact.
// Where p is not an even integer the tables end beside λ, at a distance where φ differs from 1 by less than the enclosures show.
double double_error(const BFunction& b, int k);
// double_error(b, 0) of the trigonometric, the logistic and the usual expo-rational function is at most this: 2^-50.
inline constexpr double kBFunctionDoubleError = 1 / static_cast<double>(1LL << 50);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

// B^(k)(t)/k!, k = 0…order, t cut to [0, 1].
std::vector<Interval> smooth_coefficients(const SmoothBFunction& b, const Interval& t, int order);
std::vector<Ball> smooth_coefficients(const SmoothBFunction& b, const Ball& t, int order);
// B^(k)(t).
std::vector<double> smooth_derivatives(const SmoothBFunction& b, double t, int order);

// A^(r), W^(r) by differences of exact coefficients; then the quotient rule R^(r) = (A^(r) − Σ_{j≥1} C(r,j) W^(j) R^(r−j)) / W.
template <Field R>
std::vector<R> exact_derivatives(std::vector<Rational> numerator, std::vector<Rational> denominator, const R& t,
                                 int order) {
  const bool is_rational = denominator.size() > 1;
  const auto value = [&t](const std::vector<Rational>& coefficients) {
    std::vector<R> points;
    for (const Rational& x : coefficients) points.push_back(embed<R>(x));
    return de_casteljau(std::move(points), t);
  };
  std::vector<R> a, w;
  for (int k = 0; k <= order; ++k) {
    a.push_back(value(numerator));
    numerator = hodograph(numerator);
    if (!is_rational) continue;
    w.push_back(value(denominator));
    denominator = hodograph(denominator);
  }
  if (!is_rational) return a;
  std::vector<R> out;
  for (int r = 0; r <= order; ++r) {
    const std::vector<R> choose = binomial_row<R>(r);
    R rest = a[r];
    for (int j = 1; j <= r; ++j) rest = rest - choose[j] * w[j] * out[r - j];
    out.push_back(rest / w[0]);
  }
  return out;
}

// (1 − cos πt)/2, written as a square so that small values keep their digits; B^(k) = (π/2) π^(k−1) sin(πt + (k−1) π/2).
template <Transcendental R>
std::vector<R> trigonometric_derivatives(const R& t, int order) {
  const R half = R(1) / R(2), root = cos_sin_pi(R(t * half))[1];
  std::vector<R> out{root * root};
  if (order == 0) return out;
  const std::array<R, 2> cs = cos_sin_pi(t);
  R factor = half;
  for (int k = 1; k <= order; ++k) {
    factor = factor * pi<R>();
    const R& size = cs[k % 2];
    out.push_back((k - 1) % 4 < 2 ? factor * size : -(factor * size));
  }
  return out;
}

template <class R>
struct SmoothDerivatives {  // scalars without exponentials: only what is exactly 0 or 1
  static std::vector<R> apply(const BFunction& b, const R& t, int order) {
    PATCHPROOF_REQUIRES(scalar_traits<R>::is_exact, "derivatives: this B-function has no values in this scalar");
    const auto is = [&t](int end) { return scalar_traits<R>::sign(t - R(end)) == std::optional(Sign::zero); };
    const std::optional<int> limit = b.order();
    PATCHPROOF_REQUIRES((is(0) || is(1)) && (!limit || order <= *limit),
                        "derivatives: exact values of this B-function exist at 0 and 1 only, up to its order");
    std::vector<R> out(order + 1, R(0));
    if (is(1)) out[0] = R(1);
    return out;
  }
};
template <class R>
requires std::same_as<R, Interval> || std::same_as<R, Ball>
struct SmoothDerivatives<R> {
  static std::vector<R> apply(const BFunction& b, const R& t, int order) {
    std::vector<R> out = smooth_coefficients(b.smooth(), t, order);
    R factorial(1);
    for (int k = 2; k <= order; ++k) {
      factorial = factorial * R(k);
      out[k] = factorial * out[k];
    }
    return out;
  }
};
template <>
struct SmoothDerivatives<double> {
  static std::vector<double> apply(const BFunction& b, double t, int order) {
    return smooth_derivatives(b.smooth(), t, order);
  }
};
// B^(k) composed with the model; where that says less than the range of B^(k) does, the range.
template <int N>
struct SmoothDerivatives<TaylorModel<N>> {
  static std::vector<TaylorModel<N>> apply(const BFunction& b, const TaylorModel<N>& t, int order) {
    using Model = TaylorModel<N>;
    const std::vector<Interval> at = smooth_coefficients(b.smooth(), t.coefficient(0), order + N + 1);
    const std::vector<Interval> on = smooth_coefficients(b.smooth(), t.argument_range(), order + N + 1);
    std::vector<Model> out;
    Interval factorial(1);  // k!
    for (int k = 0; k <= order; ++k) {
      if (k > 0) factorial *= Interval(k);
      std::array<Interval, N + 1> f;
      Interval ratio = factorial;  // (k + j)!/j!
      for (int j = 0; j <= N; ++j) {
        f[j] = ratio * at[k + j];
        ratio = ratio * Interval(k + j + 1) / Interval(j + 1);
      }
      const Model composed = t.composed(f, ratio * on[k + N + 1]);
      const Interval values = factorial * on[k], error = composed.remainder();
      const bool is_better = error.sup() - error.inf() < values.sup() - values.inf();
      out.push_back(is_better ? composed : Model::unknown(values));
    }
    return out;
  }
};

}  // namespace detail

template <class R>
std::vector<R> derivatives(const BFunction& b, const R& t, int order) {
  PATCHPROOF_REQUIRES(0 <= order && order <= kMaxDerivative, "derivatives: an order from 0 to kMaxDerivative");
  if (b.is_exact()) {
    std::vector<R> out = detail::exact_derivatives<R>(b.numerator(), b.denominator(), t, order);
    if constexpr (std::same_as<R, Interval>)
      if (!t.is_point() && t.inf() >= 0 && t.sup() <= 1)  // B increases
        out[0] = Interval(detail::exact_derivatives<R>(b.numerator(), b.denominator(), Interval(t.inf()), 0)[0].inf(),
                          detail::exact_derivatives<R>(b.numerator(), b.denominator(), Interval(t.sup()), 0)[0].sup());
    return out;
  }
  if constexpr (Transcendental<R>)
    if (b.kind() == BFunction::Kind::trigonometric) return detail::trigonometric_derivatives(t, order);
  return detail::SmoothDerivatives<R>::apply(b, t, order);
}

}  // namespace patchproof
