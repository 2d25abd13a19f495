// Forks processes and waits for their end.
#include "gem/command/sweep/process_pool.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "gem/base/error.h"

namespace gem {

ProcessPool::~ProcessPool() {
  for (const auto& [process, job] : job_) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
}

void ProcessPool::start(std::size_t job, const std::function<void()>& work) {
  sigset_t stops, former;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  sigaddset(&stops, SIGHUP);
  sigprocmask(SIG_BLOCK, &stops, &former);  // blocked before the fork, so that the new process never handles them
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try {
      if (getppid() == parent) work();
    } catch (...) {
      std::abort();  // abort: the parent's stack must not be unwound here, and the parent sees the signal
    }
    _exit(0);
  }
  const int fault = errno;
  sigprocmask(SIG_SETMASK, &former, nullptr);
  if (process < 0)
    throw Error(ExitCode::resource_limit, "cannot start a process (" + std::generic_category().message(fault) +
                                              "); use fewer --jobs or raise the limit of processes");
  job_[process] = job;
}

void ProcessPool::reap(const std::function<void(std::size_t job, ProcessEnd end)>& ended) {
  for (;;) {
    int status = 0;
    const pid_t process = waitpid(-1, &status, WNOHANG);
    if (process <= 0) return;
    const auto found = job_.find(process);
    if (found == job_.end()) continue;
    const std::size_t job = found->second;
    job_.erase(found);
    ended(job, {WIFSIGNALED(status) ? WTERMSIG(status) : 0, WIFEXITED(status) ? WEXITSTATUS(status) : 0});
  }
}

}  // namespace gem
