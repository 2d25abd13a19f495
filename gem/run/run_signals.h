// Stop signals: the first asks the run to end properly, the second ends the process at once.
#pragma once

namespace gem {

/// While it exists, SIGINT, SIGTERM and SIGHUP are noted and do not end the process; the destructor restores the former
/// handlers. An ignored SIGHUP, as under nohup, stays ignored.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// SIGINT, SIGTERM, SIGHUP or 0.
  static int received();
};

/// Exit code of a process after such a signal; 0 without a signal.
int exit_code_of_signal(int signal_number);

/// Turns a closed pipe and a file size limit into failed writes, which otherwise end the process.
void ignore_write_signals();

}  // namespace gem
