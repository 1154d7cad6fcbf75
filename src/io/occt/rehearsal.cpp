// SPDX-License-Identifier: Apache-2.0
#include "rehearsal.h"

#include <fcntl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace patchproof::occt {
namespace {

// Ends with its parent, however that ends: nobody would wait for it any more.
void end_with_parent([[maybe_unused]] pid_t parent) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
#endif
}

[[noreturn]] void child(const std::function<void()>& work, unsigned seconds, pid_t parent) {
  end_with_parent(parent);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0}, time{seconds, seconds + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  alarm(10 * seconds);  // a child that waits uses no processor
  try {
    work();
  } catch (...) {  // the second reading will meet it as well, and name it
  }
  _exit(0);
}

}  // namespace

Rehearsal rehearse(const std::function<void()>& work, unsigned seconds) {
  const pid_t parent = getpid(), id = fork();
  if (id == 0) child(work, seconds, parent);
  if (id < 0) return Rehearsal::fine;
  int status = 0;
  while (waitpid(id, &status, 0) < 0)
    if (errno != EINTR) return Rehearsal::fine;
  if (WIFSIGNALED(status)) switch (WTERMSIG(status)) {
      case SIGXCPU:
      case SIGALRM:
      case SIGKILL: return Rehearsal::too_long;
      default: return Rehearsal::crashed;
    }
  return WEXITSTATUS(status) == 0 ? Rehearsal::fine : Rehearsal::crashed;
}

}  // namespace patchproof::occt
