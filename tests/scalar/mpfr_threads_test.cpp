// SPDX-License-Identifier: Apache-2.0
// What MPFR keeps for each thread: nothing that others see, and nothing that is left when it ends.
#include <gmp.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "patchproof/scalar/transcendental.h"
#include "threads/said.h"

namespace patchproof::test {
namespace {

// All else about threads rests on it: MPFR's range of exponents, flags and tables belong to a thread.
TEST(MpfrThreads, MpfrIsBuiltForThreads) { EXPECT_TRUE(mpfr_buildopt_tls_p()); }

// Blocks that GMP, MPFR and MPFI asked for and have not given back. The functions are those of GMP itself, counting.
std::atomic<long> alive{0};
void* count_allocate(std::size_t size) { return ++alive, std::malloc(size); }
void count_free(void* block, std::size_t) { --alive, std::free(block); }
void* count_reallocate(void* block, std::size_t, std::size_t size) { return std::realloc(block, size); }

TEST(MpfrThreads, AThreadThatEndsLeavesNothingBehind) {
  const auto work = [] {
    const BallPrecision precision(1000);
    const Ball x(Rational(1) / Rational(3));
    const std::string said = say(exp(x), sin(x), cos(x), atan(x), sqrt(x), Ball::pi(), x / x, x.is_tight(20));
    return say(said, cos_sin_pi(x), nearest_double(Rational(2) / Rational(7)), enclose(Rational(2) / Rational(7)),
               x.contains(Rational(1)));
  };
  mp_set_memory_functions(count_allocate, count_reallocate, count_free);
  const long before = alive;
  std::string said;
  std::thread([&] { said = work(); }).join();
  EXPECT_EQ(alive, before);
  mp_set_memory_functions(nullptr, nullptr, nullptr);
  EXPECT_EQ(said, work());
}

}  // namespace
}  // namespace patchproof::test
