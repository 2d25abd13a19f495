// Stop signals: the first asks the run to end in order, the second ends the process at once.
#pragma once

namespace gem {

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted instead of ending the process; the former handlers come back
/// after it. A SIGHUP that is ignored, as under nohup, stays so.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// SIGINT, SIGTERM, SIGHUP or 0.
  static int received();
};

/// What a process ends with after such a signal, or 0.
int exit_code_of_signal(int signal_number);

/// A closed pipe and a file size limit become failed writes instead of ending the process.
void ignore_write_signals();

}  // namespace gem
