// SPDX-License-Identifier: Apache-2.0
#include "patchproof/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "patchproof/contract.h"
#include "patchproof/deadline.h"

namespace patchproof {

void for_each_item(int jobs, std::size_t count, const std::function<void(std::size_t)>& item) {
  PATCHPROOF_REQUIRES(jobs >= 0, "for_each_item: the number of threads is not negative");
  const int threads = jobs > 0 ? jobs : std::max(1, tbb::this_task_arena::max_concurrency());
  // Otherwise more jobs than processors make TBB talk on standard error.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  const std::atomic<bool>* flag = StopScope::flag();
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
