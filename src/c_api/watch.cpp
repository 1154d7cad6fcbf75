// SPDX-License-Identifier: Apache-2.0
#include "c_api/watch.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace patchproof::c_api {
namespace {

// The work on a thread of its own; it is over when this is destroyed.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work)
      : thread_([this, &work] {
          const FloatingPointGuard guard;
          const StopScope scope(&stop_);
          try {
            work();
          } catch (...) {
            thrown_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          over_ = true;
          wake_.notify_all();
        }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() { thread_.join(); }

  bool is_over_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, time, [this] { return over_; });
  }
  void stop() {
    stop_ = true;
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return over_; });
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;  // the last member: it uses the others
};

[[noreturn]] void end(patchproof_status status, const char* message) {
  throw Failure{status, {ErrorCode::usage, "callback", message, ""}};
}

}  // namespace

void watch(const patchproof_callback* callback, Progress& progress, const std::function<void()>& work) {
  if (callback == nullptr || callback->progress == nullptr) return work();
  Worker worker(work);
  bool over = false;
  while (!over) {
    over = worker.is_over_within(std::chrono::milliseconds(50));
    if (over) worker.rethrow();
    std::int32_t answer = 0;
    try {
      answer = callback->progress(callback->user, progress.done, progress.all);
    } catch (...) {
      worker.stop();
      end(PATCHPROOF_CALLBACK_THREW, "threw an exception");
    }
    if (answer != 0) {
      worker.stop();
      end(PATCHPROOF_STOPPED, "asked to stop");
    }
  }
}

}  // namespace patchproof::c_api
