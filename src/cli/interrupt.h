// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its like: a file that is being written is removed, and the program ends with 128 + the signal's number (130).
#pragma once

#include <string>

namespace patchproof::cli {

// From here on SIGINT, SIGTERM and SIGHUP end the program as above, unless whoever started it had them ignored; and a file that
// grows beyond the system's limit is an error, not the end.
void end_cleanly_on_signals();

// A file that is removed when the program is interrupted while this lives. One at a time.
class Unfinished {
 public:
  explicit Unfinished(const std::string& path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
};

}  // namespace patchproof::cli
