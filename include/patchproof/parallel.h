// SPDX-License-Identifier: Apache-2.0
// Independent items on several threads.
//
// ENSURES  (1) item(i) is called once for each i < count, from any thread, in any order;  (2) what an item throws comes out
//          of the call, and then some items may not have been called;  (3) the StopScope of the calling thread holds in all
//          of them, and when its flag is raised no further item begins and stop_requested is thrown;  (4) one job is done in
//          the calling thread, in order;  (5) calls from several threads at a time do not slow each other down, but where one
//          asks for more jobs than there are processors.
// REQUIRES jobs ≥ 0.
// NEIGHBOURS deadline.h
// TEST     tests/join/deadline_test.cpp (1)–(3); tests/threads/parallel_test.cpp (4), (5).
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

namespace patchproof {

class stop_requested : public std::runtime_error {
 public:
  stop_requested() : std::runtime_error("the caller asked to stop") {}
};

// jobs: threads; 0: one for each processor.
void for_each_item(int jobs, std::size_t count, const std::function<void(std::size_t)>& item);

}  // namespace patchproof
