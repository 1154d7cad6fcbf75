// SPDX-License-Identifier: Apache-2.0
#include "rehearsal.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace patchproof::occt {
namespace {

[[noreturn]] void child(const std::function<void()>& work, unsigned seconds) {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0}, time{seconds, seconds + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  try {
    work();
  } catch (...) {  // the second reading will meet it as well, and name it
  }
  _exit(0);
}

}  // namespace

Rehearsal rehearse(const std::function<void()>& work, unsigned seconds) {
  const pid_t id = fork();
  if (id == 0) child(work, seconds);
  if (id < 0) return Rehearsal::fine;
  int status = 0;
  while (waitpid(id, &status, 0) < 0)
    if (errno != EINTR) return Rehearsal::fine;
  if (WIFSIGNALED(status))
    return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? Rehearsal::too_long : Rehearsal::crashed;
  return WEXITSTATUS(status) == 0 ? Rehearsal::fine : Rehearsal::crashed;
}

}  // namespace patchproof::occt
