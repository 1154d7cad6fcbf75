// SPDX-License-Identifier: Apache-2.0
// Time limits of long exact computations. A scope sets one for its thread; products, greatest common divisors and evaluations
// look at it between their steps, and give up when it has passed. Where no scope is alive there is no limit.
//
//   const DeadlineScope scope(std::chrono::steady_clock::now() + std::chrono::seconds(1));
//   try { … } catch (const deadline_passed&) { … undecided … }
//
// A StopScope is a limit that somebody else sets off: a flag that another thread may raise at any time.
//
// ENSURES  (1) check_deadline throws once any limit of a scope alive in this thread has passed, and from then on as long as
//          that scope lives;  (2) a limit of n checks lets n pass, on every machine the same;  (3) with the flag of a StopScope
//          raised every deadline of its thread has passed, and of the threads that for_each_item (parallel.h) uses under it.
// COST     a nanosecond without a scope; with a time limit, what the clock costs.
// TEST     tests/join/deadline_test.cpp
#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace patchproof {

class deadline_passed : public std::runtime_error {
 public:
  deadline_passed() : std::runtime_error("the time is up") {}
};

// The innermost flag counts. REQUIRES that it outlives the scope. nullptr: none.
class StopScope {
 public:
  explicit StopScope(const std::atomic<bool>* flag) : outer_(innermost()) { innermost() = flag; }
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;
  ~StopScope() { innermost() = outer_; }

  static const std::atomic<bool>* flag() { return innermost(); }
  static bool is_raised() { return innermost() != nullptr && innermost()->load(std::memory_order_relaxed); }

 private:
  static const std::atomic<bool>*& innermost() {
    static thread_local const std::atomic<bool>* flag = nullptr;
    return flag;
  }
  const std::atomic<bool>* outer_;
};

class DeadlineScope {
 public:
  using Clock = std::chrono::steady_clock;
  explicit DeadlineScope(Clock::time_point until) : until_(until), outer_(innermost()) { innermost() = this; }
  // After so many looks at it instead of at a time.
  static DeadlineScope after_checks(long checks) { return DeadlineScope(checks); }
  DeadlineScope(const DeadlineScope&) = delete;
  DeadlineScope& operator=(const DeadlineScope&) = delete;
  ~DeadlineScope() { innermost() = outer_; }

  // How often it was looked at.
  long checks() const { return checks_; }

  static bool has_passed() {
    bool passed = StopScope::is_raised();
    for (DeadlineScope* scope = innermost(); scope; scope = scope->outer_) passed = scope->look() || passed;
    return passed;
  }

 private:
  explicit DeadlineScope(long checks) : limit_(checks), outer_(innermost()) { innermost() = this; }

  bool look() {
    ++checks_;
    if (passed_) return true;
    passed_ = checks_ > limit_ || (until_ != Clock::time_point::max() && Clock::now() > until_);
    return passed_;
  }
  static DeadlineScope*& innermost() {
    static thread_local DeadlineScope* scope = nullptr;
    return scope;
  }

  Clock::time_point until_ = Clock::time_point::max();
  long limit_ = std::numeric_limits<long>::max(), checks_ = 0;
  bool passed_ = false;
  DeadlineScope* outer_;
};

// A look at the limits; true from the moment on that one has passed.
inline bool has_deadline_passed() { return DeadlineScope::has_passed(); }

// ERRORS throws deadline_passed.
inline void check_deadline() {
  if (has_deadline_passed()) throw deadline_passed();
}

// A time so many seconds from now. REQUIRES seconds is not negative.
inline DeadlineScope::Clock::time_point seconds_from_now(double seconds) {
  constexpr double kLongest = 1e6;
  return DeadlineScope::Clock::now() + std::chrono::duration_cast<DeadlineScope::Clock::duration>(
                                           std::chrono::duration<double>(seconds < kLongest ? seconds : kLongest));
}

}  // namespace patchproof
