// Jobs in processes of their own. A job that crashes stops no other job, and libraries need not be thread-safe.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <map>

namespace gem {

/// How a process ended.
struct ProcessEnd {
  int signal = 0;     // that killed it; 0: none did
  int exit_code = 0;  // if it was not killed
};

/// Child processes that die with this process, however it ends. SIGINT, SIGTERM and SIGHUP are blocked in them; the
/// owner must tell them to stop in another way. Only for a process without threads.
class ProcessPool {
 public:
  ProcessPool() = default;
  /// Kills the processes that still run.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  /// Runs `work` in a new process, which then exits without further output. Throws Error(resource_limit) if no process
  /// can be started.
  void start(std::size_t job, const std::function<void()>& work);
  std::size_t running() const { return job_.size(); }
  /// Reports each process that has ended, with its job.
  void reap(const std::function<void(std::size_t job, ProcessEnd end)>& ended);

 private:
  std::map<pid_t, std::size_t> job_;
};

}  // namespace gem
