// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <deque>

namespace patchproof::cli {
namespace {

std::deque<std::string> paths;  // none is freed or moved while the handler may be reading it
std::atomic<const char*> unfinished{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

void write_text(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody is listening
}

extern "C" void on_signal(int signal) {
  if (const char* path = unfinished.load()) unlink(path);
  if (isatty(STDERR_FILENO)) write_text("\r\x1b[K");  // the progress bar
  write_text("patchproof: interrupted\n");
  _exit(128 + signal);
}

}  // namespace

void end_cleanly_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

Unfinished::Unfinished(const std::string& path) { unfinished = paths.emplace_back(path).c_str(); }
Unfinished::~Unfinished() { unfinished = nullptr; }

}  // namespace patchproof::cli
