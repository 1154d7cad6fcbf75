// SPDX-License-Identifier: Apache-2.0
// Laws 4 and 5 of parallel.h.
#include "patchproof/parallel.h"

#include <tbb/global_control.h>

#include "patchproof/deadline.h"
#include "threads/together.h"

namespace patchproof::test {
namespace {

TEST(ThreadsParallel, Law4_OneJobIsDoneInTheCallingThreadInOrder) {
  in_threads([](std::size_t) {
    const std::thread::id own = std::this_thread::get_id();
    std::size_t next = 0;
    for_each_item(1, 1000, [&](std::size_t i) {
      if (i == next && std::this_thread::get_id() == own) ++next;
    });
    EXPECT_EQ(next, 1000U);
  });
}

TEST(ThreadsParallel, Law5_CallsDoNotLimitEachOther) {
  using Control = tbb::global_control;
  const std::size_t allowed = Control::active_value(Control::max_allowed_parallelism);
  std::size_t in_items = allowed;
  for_each_item(1, 2, [&](std::size_t) { in_items = Control::active_value(Control::max_allowed_parallelism); });
  EXPECT_EQ(in_items, allowed);
}

// A flag stops the calls under its own scope, and no other thread's.
TEST(ThreadsParallel, AFlagStopsItsOwnThread) {
  std::array<std::atomic<bool>, kThreads> flags{};
  std::array<int, kThreads> done{};
  std::array<bool, kThreads> stopped{};
  in_threads([&](std::size_t k) {
    const StopScope scope(&flags[k]);
    try {
      for_each_item(1, 100, [&, k](std::size_t i) {
        ++done[k];
        if (i == k) flags[k] = k % 2 == 1;
      });
    } catch (const stop_requested&) {
      stopped[k] = true;
    }
  });
  for (std::size_t k = 0; k < kThreads; ++k) {
    EXPECT_EQ(stopped[k], k % 2 == 1);
    EXPECT_EQ(done[k], k % 2 == 1 ? static_cast<int>(k) + 1 : 100);
  }
}

}  // namespace
}  // namespace patchproof::test
