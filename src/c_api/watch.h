// SPDX-License-Identifier: Apache-2.0
// Long work with a callback: the work runs on a thread of its own, and the callback is called on the caller's.
#pragma once

#include <cstdint>
#include <functional>

#include "c_api/handles.h"

namespace patchproof::c_api {

struct Progress {
  std::atomic<std::uint64_t> done{0}, all{0};
};

// Without a callback the work runs on the caller's thread. Ends the call when the callback stops it or throws, or the work throws.
void watch(const patchproof_callback* callback, Progress& progress, const std::function<void()>& work);

}  // namespace patchproof::c_api
