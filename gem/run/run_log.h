// What a run says on standard error: messages and progress, as text or as one JSON object per line.
#pragma once

#include <chrono>
#include <string>

namespace gem {

enum class ProgressMode {
  automatic,  ///< line on a terminal, else ten_percent
  none,
  line,  ///< one line: rewritten on a terminal, else one per 10 %
  json,  ///< one object per 10 %, and at least every 10 s
};

struct LogOptions {
  ProgressMode progress = ProgressMode::automatic;
  bool quiet = false;  ///< faults only
  bool json = false;
};

/// Where a run stands.
struct Progress {
  double time = 0.0;       // simulated [s]
  double duration = 0.0;   // [s]
  double wall_time = 0.0;  // [s]
  int contacts = 0;
  double energy_residual = 0.0;
};

class RunLog {
 public:
  explicit RunLog(const LogOptions& options);
  ~RunLog() { clear_line(); }
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  /// level: info, warning or error. Errors are printed even if quiet.
  void message(const std::string& level, const std::string& text);
  /// Whether show() would print now; so that the caller need not work out what is not shown.
  bool wants(double time, double duration) const;
  void show(const Progress& progress);
  /// Shows `line`, or `object` where progress is asked for as JSON, at this fraction of the whole.
  void show(double fraction, const std::string& line, const std::string& object);

 private:
  void print(const std::string& line);
  void clear_line();

  LogOptions options_;
  bool terminal_;
  bool line_open_ = false;
  int tenths_shown_ = 0;
  std::chrono::steady_clock::time_point shown_at_;
};

/// Hours, minutes and seconds, as 1:02:03 or 02:03.
std::string clock_text(double seconds);

/// Simulated over wall time for people: two digits below ten, whole numbers above.
std::string rate_text(double rate);

/// One line for people; `duration` 0 counts as done.
std::string progress_text(const Progress& progress);

}  // namespace gem
