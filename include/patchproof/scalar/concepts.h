// SPDX-License-Identifier: Apache-2.0
// What a number must be able to do to enter a formula of ours.
//
//   Lane                                          + − × only (SIMD lanes)
//   Ring ⊃ Field ⊃ OrderedField ⊃ ExactField      (each adds to the one before)
//
// A type enters by specialising scalar_traits; float, int and expression-template numbers cannot slip in, because every
// operation must return exactly T (so `auto` is safe in all templates).
// Ring has no == and no <: an interval cannot answer them. It has sign(), which may answer "cannot tell".
// None of these concepts has sqrt, trigonometry or a tolerance.
// NEIGHBOURS rational.h integer.h quadratic.h (exact), interval.h ball.h (enclosures), tracked.h (error bounds).
#pragma once

#include <concepts>
#include <optional>

namespace patchproof {

enum class Sign : int { negative = -1, zero = 0, positive = 1 };

// Opt-in; no primary definition. A specialisation has
//   static constexpr bool is_exact;              // every operation returns the exact result
//   static constexpr bool is_field;              // a / b is a divided by b (Integer's `/` truncates: false)
//   static constexpr bool is_ordered;            // == and < compare the values
//   static std::optional<Sign> sign(const T&);   // empty: this scalar cannot tell
//   using knot_scalar = …;                       // the OrderedField in which knots beside control values of type T live
template <class T>
struct scalar_traits;

// Version 14 would take a * b below for a pointer.
// clang-format off
template <class T>
concept Lane = std::copyable<T> && std::constructible_from<T, double> && requires(const T a, const T b) {
  { a + b } -> std::same_as<T>;
  { a - b } -> std::same_as<T>;
  { a * b } -> std::same_as<T>;
};

// Enough for de Casteljau, derivatives and join polynomials.
template <class T>
concept Ring = std::copyable<T> && std::default_initializable<T> && std::constructible_from<T, int> &&
               requires(const T a, const T b, T c) {
                 { a + b } -> std::same_as<T>;
                 { a - b } -> std::same_as<T>;
                 { a * b } -> std::same_as<T>;
                 { -a } -> std::same_as<T>;
                 { c += a } -> std::same_as<T&>;
                 { scalar_traits<T>::is_exact } -> std::convertible_to<bool>;
                 { scalar_traits<T>::is_field } -> std::convertible_to<bool>;
                 { scalar_traits<T>::is_ordered } -> std::convertible_to<bool>;
                 { scalar_traits<T>::sign(a) } -> std::same_as<std::optional<Sign>>;
               };
// clang-format on

template <class T>
concept Field = Ring<T> && scalar_traits<T>::is_field && requires(const T a, const T b) {
  { a / b } -> std::same_as<T>;
};

template <class T>
concept OrderedField = Field<T> && std::totally_ordered<T> && scalar_traits<T>::is_ordered;

template <class T>
concept ExactField = OrderedField<T> && scalar_traits<T>::is_exact;

// A ring in which sign() always answers: Integer, Rational, Quadratic.
template <class T>
concept ExactRing = Ring<T> && scalar_traits<T>::is_exact;

template <Ring T>
using knot_scalar_t = typename scalar_traits<T>::knot_scalar;

// Upward conversions, and only those: double → Interval, Ball, Tracked, Rational;  Rational → Interval, Ball, Quadratic; …
// Each header that can receive a conversion specialises this; embed<T>(x) names it at the call site.
template <class To, class From>
struct embedding;

template <class T>
struct embedding<T, T> {
  static const T& apply(const T& x) { return x; }
};

template <Ring To, class From>
To embed(const From& x) {
  return embedding<To, From>::apply(x);
}

template <>
struct scalar_traits<double> {
  static constexpr bool is_exact = false;
  static constexpr bool is_field = true;
  static constexpr bool is_ordered = true;
  // A rounded number proves nothing, not even its own sign.
  static std::optional<Sign> sign(double) { return std::nullopt; }
  using knot_scalar = double;
};

}  // namespace patchproof
