// SPDX-License-Identifier: Apache-2.0
// What typed tests need to state a law once and check it in every scalar.
//
// The reference of every check is the exact result, computed with Rational. A computed number agrees with it when it is
// equal (exact scalars), contains it and is narrow (Interval, Ball), or lies within its own error bound (Tracked). A bare
// double has no bound of its own: check<double> runs the same template on Tracked and takes the bound from there.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "patchproof/scalar/ball.h"
#include "patchproof/scalar/interval.h"
#include "patchproof/scalar/quadratic.h"
#include "patchproof/scalar/rational.h"
#include "patchproof/scalar/tracked.h"
#include "patchproof/spline/curve.h"
#include "patchproof/spline/knot_vector.h"
#include "patchproof/vec.h"

namespace patchproof::test {

using ExactScalars = ::testing::Types<Rational, Quadratic>;
using AllScalars = ::testing::Types<Rational, Quadratic, Interval, Ball, Tracked, double>;
using BoundedScalars = ::testing::Types<Rational, Quadratic, Interval, Ball, Tracked>;  // all with a bound of their own

struct ScalarNames {
  template <class T>
  static std::string GetName(int) {
    if (std::is_same_v<T, Rational>) return "Rational";
    if (std::is_same_v<T, Quadratic>) return "Quadratic";
    if (std::is_same_v<T, Interval>) return "Interval";
    if (std::is_same_v<T, Ball>) return "Ball";
    if (std::is_same_v<T, Tracked>) return "Tracked";
    return "Double";
  }
};

// Holds a RoundingGuard while T is Interval, and nothing otherwise (Tracked and double need rounding to nearest).
struct NoGuard {};
template <class T>
using GuardFor = std::conditional_t<std::is_same_v<T, Interval>, RoundingGuard, NoGuard>;

// The fixture of typed tests: the guard lives as long as the test.
template <class T>
class ScalarTest : public ::testing::Test {
 private:
  [[maybe_unused]] GuardFor<T> guard_;
};

// ---- exact data into a scalar ---------------------------------------------------------------------------------------

template <class T>
T make(const Rational& x) {
  return embed<T>(x);
}

// A knot beside control values of type T. Knots are exact data: fails when a double knot could not hold x.
template <class T>
knot_scalar_t<T> make_knot(const Rational& x) {
  const auto k = embed<knot_scalar_t<T>>(x);
  if constexpr (std::is_same_v<knot_scalar_t<T>, double>) {
    EXPECT_EQ(from_double(k), x) << "not a double";
  }
  return k;
}

template <class T>
KnotVector<knot_scalar_t<T>> make_knots(int degree, const std::vector<Rational>& knots) {
  std::vector<knot_scalar_t<T>> out;
  for (const Rational& x : knots) out.push_back(make_knot<T>(x));
  return KnotVector<knot_scalar_t<T>>::make(degree, std::move(out)).value();
}

template <class T, std::size_t N>
Vec<T, N> make_point(const Vec<Rational, N>& p) {
  Vec<T, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = make<T>(p[i]);
  return out;
}

template <class T, std::size_t N>
std::vector<Vec<T, N>> make_points(const std::vector<Vec<Rational, N>>& points) {
  std::vector<Vec<T, N>> out;
  for (const auto& p : points) out.push_back(make_point<T>(p));
  return out;
}

template <class T>
std::vector<T> make_numbers(const std::vector<Rational>& numbers) {
  std::vector<T> out;
  for (const Rational& x : numbers) out.push_back(make<T>(x));
  return out;
}

template <class T, std::size_t N>
BsplineCurve<T, N> make_curve(const BsplineCurve<Rational, N>& c) {
  return BsplineCurve<T, N>(make_knots<T>(c.degree(), c.knots().knots()), make_points<T>(c.points()));
}

// ---- agreement ------------------------------------------------------------------------------------------------------

inline void expect_agrees(const Rational& computed, const Rational& exact) { EXPECT_EQ(computed, exact); }

inline void expect_agrees(const Quadratic& computed, const Rational& exact) {
  EXPECT_TRUE(computed == Quadratic(exact)) << "rational part " << computed.rational_part() << ", expected " << exact;
}

// Contained, and no wider than 1e-9·(1 + |exact|).
inline void expect_agrees(const Interval& computed, const Rational& exact) {
  ASSERT_TRUE(std::isfinite(computed.inf()) && std::isfinite(computed.sup())) << "expected " << exact;
  const Rational lower = from_double(computed.inf()), upper = from_double(computed.sup());
  EXPECT_TRUE(lower <= exact && exact <= upper) << "[" << lower << ", " << upper << "] misses " << exact;
  const Rational size = exact < 0 ? Rational(1 - exact) : Rational(1 + exact);
  EXPECT_LE((upper - lower) * Rational(1000000000), size) << "too wide around " << exact;
}

inline void expect_agrees(const Ball& computed, const Rational& exact) {
  EXPECT_TRUE(computed.contains(exact)) << "misses " << exact;
  expect_agrees(computed.to_interval(), exact);
}

inline void expect_agrees(const Tracked& computed, const Rational& exact) {
  ASSERT_TRUE(std::isfinite(computed.value()) && std::isfinite(computed.error())) << "expected " << exact;
  const Rational distance = abs(Rational(from_double(computed.value()) - exact));
  EXPECT_LE(distance, from_double(computed.error())) << computed.value() << " for " << exact;
}

// |computed − exact| ≤ error: the bound is the caller's, see with_bound.
inline void expect_agrees(double computed, const Rational& exact, double error) {
  expect_agrees(Tracked(computed, error), exact);
}

template <class T, std::size_t N>
void expect_agrees(const Vec<T, N>& computed, const Vec<Rational, N>& exact) {
  for (std::size_t i = 0; i < N; ++i) {
    SCOPED_TRACE("component " + std::to_string(i));
    expect_agrees(computed[i], exact[i]);
  }
}

template <class P, class Q>
void expect_agrees(const std::vector<P>& computed, const std::vector<Q>& exact) {
  ASSERT_EQ(computed.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    SCOPED_TRACE("entry " + std::to_string(i));
    expect_agrees(computed[i], exact[i]);
  }
}

// The double is the value that Tracked carried, bit for bit, so Tracked's bound holds for it.
inline void expect_same_bits(double computed, const Tracked& tracked) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(computed), std::bit_cast<std::uint64_t>(tracked.value()))
      << computed << " and " << tracked.value();
}
template <std::size_t N>
void expect_same_bits(const Vec<double, N>& computed, const Vec<Tracked, N>& tracked) {
  for (std::size_t i = 0; i < N; ++i) expect_same_bits(computed[i], tracked[i]);
}
template <class P, class Q>
void expect_same_bits(const std::vector<P>& computed, const std::vector<Q>& tracked) {
  ASSERT_EQ(computed.size(), tracked.size());
  for (std::size_t i = 0; i < tracked.size(); ++i) expect_same_bits(computed[i], tracked[i]);
}

// Runs f.operator()<S>() for S = Tracked and S = double and checks both against `exact`, which is a Rational, a
// Vec<Rational, N>, or a std::vector of either:  with_bound(exact, [&]<class S>() { return formula<S>(make<S>(x)); });
template <class Exact, class F>
void with_bound(const Exact& exact, F f) {
  const auto tracked = f.template operator()<Tracked>();
  const auto rounded = f.template operator()<double>();
  expect_agrees(tracked, exact);
  expect_same_bits(rounded, tracked);
}

// The same for any scalar T of AllScalars: f.operator()<T>() agrees with `exact`.
template <class T, class Exact, class F>
void check(const Exact& exact, F f) {
  if constexpr (std::is_same_v<T, double>)
    with_bound(exact, f);
  else
    expect_agrees(f.template operator()<T>(), exact);
}

// ---- random exact data ----------------------------------------------------------------------------------------------

// Small random rationals, the same in every run. The seed is printed with every failure while the generator lives;
// PATCHPROOF_TEST_SEED in the environment replaces it.
class RandomRationals {
 public:
  explicit RandomRationals(std::uint64_t seed = 20240229)
      : seed_(chosen(seed)),
        engine_(seed_),
        trace_(__FILE__, __LINE__, "PATCHPROOF_TEST_SEED=" + std::to_string(seed_)) {}

  // An integer in [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  // p/q with |p| ≤ 20 and 1 ≤ q ≤ 9.
  Rational operator()() {
    const int p = integer(-20, 20);
    return Rational(p) / Rational(integer(1, 9));
  }
  // A multiple of 1/16 in [0, 1]; a double holds it exactly.
  Rational unit() { return Rational(integer(0, 16)) / Rational(16); }

  template <std::size_t N>
  Vec<Rational, N> point() {
    Vec<Rational, N> p;
    for (std::size_t i = 0; i < N; ++i) p[i] = (*this)();
    return p;
  }
  template <std::size_t N>
  std::vector<Vec<Rational, N>> points(int count) {
    std::vector<Vec<Rational, N>> out;
    for (int i = 0; i < count; ++i) out.push_back(point<N>());
    return out;
  }
  std::vector<Rational> numbers(int count) {
    std::vector<Rational> out;
    for (int i = 0; i < count; ++i) out.push_back((*this)());
    return out;
  }
  // count + degree + 1 knots, multiples of 1/4 with steps from 0 to 2, so repeated knots are frequent; the domain is not
  // empty and seldom begins at 0.
  std::vector<Rational> knots(int degree, int count) {
    std::vector<Rational> out{Rational(integer(-8, 8)) / Rational(4)};
    while (static_cast<int>(out.size()) < count + degree + 1) {
      Rational next = out.back() + Rational(integer(0, 2) * integer(0, 4)) / Rational(4);
      if (static_cast<int>(out.size()) == count && next == out[degree]) next += Rational(1);
      out.push_back(next);
    }
    return out;
  }

 private:
  static std::uint64_t chosen(std::uint64_t fixed) {
    const char* text = std::getenv("PATCHPROOF_TEST_SEED");
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 10) : fixed;
  }

  std::uint64_t seed_;
  std::mt19937_64 engine_;
  ::testing::ScopedTrace trace_;
};

}  // namespace patchproof::test
