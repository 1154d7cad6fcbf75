// SPDX-License-Identifier: Apache-2.0
// Numbers from the whole range and its edges, for tests of the scalars themselves.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "patchproof/scalar/integer.h"
#include "patchproof/scalar/rational.h"

namespace patchproof::test {

inline constexpr double kLargest = std::numeric_limits<double>::max();
inline constexpr double kTiniest = std::numeric_limits<double>::denorm_min();
inline constexpr double kSmallestNormal = std::numeric_limits<double>::min();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// x · 2^e, exactly.
inline Rational scaled(const Rational& x, long e) {
  Rational r;
  if (e < 0)
    mpq_div_2exp(r.backend().data(), x.backend().data(), static_cast<unsigned long>(-e));
  else
    mpq_mul_2exp(r.backend().data(), x.backend().data(), static_cast<unsigned long>(e));
  return r;
}
inline Rational power_of_two(long e) { return scaled(Rational(1), e); }

// Doubles where rounding, underflow and overflow change their behaviour.
inline std::vector<double> edge_doubles() {
  std::vector<double> out;
  for (double x : {0.0, kTiniest, 3 * kTiniest, kSmallestNormal, 1.0, 0.1, 1.0 / 3, 0x1p53, 1e22, 1e308, kLargest})
    for (double y : {std::nextafter(x, 0.0), x, x == kLargest ? x : std::nextafter(x, kInfinity)}) {
      out.push_back(y);
      out.push_back(-y);
    }
  return out;
}

// The seed is printed with every failure while the generator lives; PATCHPROOF_TEST_SEED replaces it.
class WildNumbers {
 public:
  explicit WildNumbers(std::uint64_t seed = 20240301)
      : seed_(chosen(seed)),
        engine_(seed_),
        trace_(__FILE__, __LINE__, "PATCHPROOF_TEST_SEED=" + std::to_string(seed_)) {}

  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  // Any finite double: random bits, so every exponent is as likely as every other.
  double finite() {
    for (;;) {
      const double x = std::bit_cast<double>(engine_());
      if (std::isfinite(x)) return x;
    }
  }
  // ± a random 53-bit mantissa · 2^e with |e| ≤ exponents.
  double moderate(int exponents = 30) {
    const double mantissa = static_cast<double>(static_cast<std::int64_t>(engine_() >> 11)) * 0x1p-52;
    return (engine_() & 1 ? -1 : 1) * std::ldexp(mantissa, below(2 * exponents + 1) - exponents);
  }
  // A random integer of at most `bits` bits, of either sign.
  Integer integer(int bits) {
    Integer z = 0;
    for (int i = 0; i < bits; i += 32) z = z * Integer(std::int64_t{1} << 32) + Integer(engine_() & 0xffffffffu);
    mpz_fdiv_r_2exp(z.backend().data(), z.backend().data(), static_cast<unsigned long>(bits));
    return engine_() & 1 ? Integer(-z) : z;
  }
  // Numerator and denominator of at most `bits` bits.
  Rational rational(int bits = 40) {
    const Integer p = integer(bits);
    Integer q = integer(bits);
    if (q == 0) q = 1;
    return Rational(p) / Rational(q);
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
