// SPDX-License-Identifier: Apache-2.0
// Open CASCADE ends the process, or never comes back, on some damaged files. They are read in a child process first.
#pragma once

#include <functional>

namespace patchproof::occt {

enum class Rehearsal { fine, crashed, too_long };

// Runs `work` in a child process that writes nowhere, with so much time of the processor (and ten times as much
// by the clock). What it computes is lost. It dies with this process (Linux). Fine as well where there can be no child process.
Rehearsal rehearse(const std::function<void()>& work, unsigned seconds);

}  // namespace patchproof::occt
