// SPDX-License-Identifier: Apache-2.0
// Operations on shared objects: first by many threads at a time, then by one thread alone. All must say the same.
//
// The threads come first, so that whatever the first call makes is made while all of them ask for it. Each begins with another
// operation, so that different ones meet on one object. Results are compared as text (said.h): exact numbers as they stand,
// doubles bit by bit. Built with ThreadSanitizer the program also proves that no access raced (CMakeLists.txt).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace patchproof::test {

inline constexpr std::size_t kThreads = 8;

// f(k) by kThreads threads, k = 0 …, which begin together.
template <class F>
void in_threads(const F& f) {
  std::atomic<std::size_t> ready{0};
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < kThreads; ++k)
    threads.emplace_back([&f, &ready, k] {
      ++ready;
      while (ready < kThreads) std::this_thread::yield();
      f(k);
    });
  for (std::thread& thread : threads) thread.join();
}

class Together {
 public:
  // What the operation says does not depend on how often it was called, or by whom. It does not change what it uses.
  void add(std::string name, std::function<std::string()> operation) {
    operations_.push_back({std::move(name), std::move(operation)});
  }

  void run() const {
    const std::size_t count = operations_.size();
    std::vector<std::vector<std::string>> said(kThreads, std::vector<std::string>(count));
    in_threads([&](std::size_t k) {
      for (std::size_t i = 0; i < count; ++i) said[k][(k + i) % count] = operations_[(k + i) % count].said();
    });
    for (std::size_t i = 0; i < count; ++i) {
      const std::string alone = operations_[i].said();
      EXPECT_FALSE(alone.empty()) << operations_[i].name << " says nothing";
      EXPECT_NE(alone.rfind(kThrown, 0), 0U) << operations_[i].name << ": " << alone;
      for (std::size_t k = 0; k < kThreads; ++k)
        EXPECT_TRUE(said[k][i] == alone) << operations_[i].name << ": thread " << k << difference(said[k][i], alone);
    }
  }

 private:
  static constexpr const char* kThrown = "thrown: ";
  struct Operation {
    std::string name;
    std::function<std::string()> operation;
    std::string said() const {
      try {
        return operation();
      } catch (const std::exception& thrown) {
        return std::string(kThrown) + thrown.what();
      }
    }
  };
  static std::string difference(const std::string& a, const std::string& b) {
    const auto at = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    const std::size_t place = static_cast<std::size_t>(at.first - a.begin()),
                      from = place - std::min<std::size_t>(place, 40);
    return " says …" + a.substr(from, 120) + "… instead of …" + b.substr(from, 120) + "… at " + std::to_string(place);
  }

  std::vector<Operation> operations_;
};

}  // namespace patchproof::test
