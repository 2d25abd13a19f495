// Jobs in processes of their own: a job that crashes takes no other with it, and libraries that are not safe for
// threads need not be.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <map>

namespace gem {

/// Processes that die with this one, however it ends. They get no SIGINT, SIGTERM and SIGHUP: whoever starts them tells
/// them to stop in another way. For a program without threads.
class ProcessPool {
 public:
  ProcessPool() = default;
  /// Kills what still runs.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  /// Runs `work` in a new process, which then ends without another word. Throws Error(resource_limit) if the system
  /// gives no process.
  void start(std::size_t job, const std::function<void()>& work);
  std::size_t running() const { return job_.size(); }
  /// Tells of each process that has ended: its job, and the signal that killed it or 0.
  void reap(const std::function<void(std::size_t job, int killed_by)>& ended);

 private:
  std::map<pid_t, std::size_t> job_;
};

}  // namespace gem
