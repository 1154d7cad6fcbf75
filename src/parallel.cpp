// SPDX-License-Identifier: Apache-2.0
#include "patchproof/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "patchproof/contract.h"
#include "patchproof/deadline.h"

namespace patchproof {

void for_each_item(int jobs, std::size_t count, const std::function<void(std::size_t)>& item) {
  PATCHPROOF_REQUIRES(jobs >= 0, "for_each_item: the number of threads is not negative");
  const std::atomic<bool>* flag = StopScope::flag();
  if (jobs == 1 || count < 2) {  // without a scheduler, and in this thread for certain
    for (std::size_t i = 0; i < count; ++i) {
      if (StopScope::is_raised()) throw stop_requested();
      item(i);
    }
    if (StopScope::is_raised()) throw stop_requested();
    return;
  }
  const int threads = jobs > 0 ? jobs : std::max(1, tbb::this_task_arena::max_concurrency());
  // More threads than processors make TBB talk on standard error unless they are allowed. The limit is one of the whole
  // process, the least of all that are alive: a smaller number here would slow down what other threads do meanwhile.
  std::optional<tbb::global_control> control;
  if (threads > tbb::info::default_concurrency())
    control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const StopScope scope(flag);
      if (StopScope::is_raised()) throw stop_requested();
      item(i);
    });
  });
  if (StopScope::is_raised()) throw stop_requested();
}

}  // namespace patchproof
