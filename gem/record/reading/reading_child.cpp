// Forks, sets limits, passes signals on, and says how the child ended.
#include "gem/record/reading/reading_child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/base/sanitizers.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

// A limit ends what would never end. Chosen by hand, far above what reading takes: 50 MB of packed rows per second.
constexpr long seconds_least = 120;
constexpr double seconds_per_byte = 1e-6;

void lower_limit(int resource, rlim_t most) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// The child ends with its parent, and never takes more memory than the machine has.
void begin_child(pid_t parent, long seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  lower_limit(RLIMIT_CORE, 0);
  if (seconds > 0) lower_limit(RLIMIT_CPU, static_cast<rlim_t>(seconds));
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (!is_sanitized && pages > 0 && page > 0)
    lower_limit(RLIMIT_AS, static_cast<rlim_t>(pages) * static_cast<rlim_t>(page));
}

/// Signals that the parent waits for instead of acting on them, as long as this object lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal_number : {SIGCHLD, SIGHUP, SIGINT, SIGTERM}) sigaddset(&held_, signal_number);
    sigprocmask(SIG_BLOCK, &held_, &former_);
    signal(SIGCHLD, SIG_DFL);  // whoever started this program may have had it ignored, and then no end is reported
  }
  ~HeldSignals() { release(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  void release() const { sigprocmask(SIG_SETMASK, &former_, nullptr); }

  /// Waits for the end of the child; returns its status.
  int wait_for(pid_t child) const {
    for (;;) {
      int status = 0;
      const pid_t ended = waitpid(child, &status, WNOHANG);
      if (ended == child) return status;
      if (ended < 0 && errno != EINTR) return 0;
      siginfo_t info{};
      const int signal_number = sigwaitinfo(&held_, &info);
      // what a terminal sends reaches the child too
      if (signal_number > 0 && signal_number != SIGCHLD && info.si_code != SI_KERNEL) kill(child, signal_number);
    }
  }

 private:
  sigset_t held_{}, former_{};
};

std::string names_of(const ReadInChild& reading) {
  std::string names;
  for (const std::string& file : reading.files) names += (names.empty() ? "" : " or ") + shown(file);
  return names;
}

/// Returns whether a signal that asks for an end has ended the child. Throws if any other did.
bool ended_by_user(const ReadInChild& reading, int status, long seconds) {
  if (!WIFSIGNALED(status)) return false;
  const int signal_number = WTERMSIG(status);
  if (signal_number == SIGHUP || signal_number == SIGINT || signal_number == SIGTERM) return true;
  if (signal_number == SIGXCPU)
    throw Error(ExitCode::file_system, "cannot read " + names_of(reading) + " (it took more than " +
                                           std::to_string(seconds) +
                                           " s of processor time); the file is damaged, or made to do harm");
  if (signal_number == SIGKILL)
    throw Error(ExitCode::resource_limit, "cannot read " + names_of(reading) +
                                              " (the system ended the program, probably for its memory); free memory, "
                                              "or use a machine with more");
  throw Error(ExitCode::file_system, "cannot read " + names_of(reading) +
                                         " (reading it crashed: " + strsignal(signal_number) +
                                         "); the file is damaged, or made to do harm, or memory ended");
}

}  // namespace

long processor_seconds(const ReadInChild& reading) {
  double bytes = 0.0;
  for (const std::string& file : reading.files) {
    std::error_code fault;
    bytes += static_cast<double>(std::filesystem::file_size(file, fault));
    if (fault) return 0;
  }
  return reading.timed ? seconds_least + static_cast<long>(bytes * seconds_per_byte) : 0;
}

std::optional<int> left_to_child(const ReadInChild& reading) {
  const long seconds = processor_seconds(reading);
  const HeldSignals held;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    held.release();
    begin_child(parent, seconds);
    return std::nullopt;
  }
  const int status = held.wait_for(child);
  if (!ended_by_user(reading, status, seconds)) return WEXITSTATUS(status);
  held.release();
  signal(WTERMSIG(status), SIG_DFL);
  raise(WTERMSIG(status));
  return 128 + WTERMSIG(status);
}

void tried_in_child(const ReadInChild& reading, const std::function<void()>& work, long seconds) {
  if (seconds == 0) seconds = processor_seconds(reading);
  const HeldSignals held;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) return;
  if (child == 0) {
    held.release();
    begin_child(parent, seconds);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    try {
      work();
    } catch (...) {  // the caller meets it too
    }
    _exit(0);
  }
  const int status = held.wait_for(child);
  if (!ended_by_user(reading, status, seconds)) return;
  held.release();
  signal(WTERMSIG(status), SIG_DFL);
  raise(WTERMSIG(status));
}

}  // namespace gem
