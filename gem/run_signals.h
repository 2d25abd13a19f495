// Stop signals: the first asks the run to end in order, the second ends the process at once.
#pragma once

namespace gem {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the process; the former handlers come back after it.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// SIGINT, SIGTERM or 0.
  static int received();
};

/// A closed pipe and a file size limit become failed writes instead of ending the process.
void ignore_write_signals();

}  // namespace gem
