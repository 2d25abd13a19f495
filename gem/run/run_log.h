// What a run prints on standard error: messages and progress, as text or as one JSON object per line.
#pragma once

#include <chrono>
#include <cstddef>
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
  bool quiet = false;  ///< errors only
  bool json = false;
};

/// Progress of a run.
struct RunProgress {
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
  /// `level` is info, warning or error. Errors are printed even if quiet.
  void message(const std::string& level, const std::string& text);
  /// Whether show() would print now. If not, the caller need not prepare the progress text.
  bool wants(double time, double duration) const;
  void show(const RunProgress& progress);
  /// Prints `line`, or `object` if progress is in JSON. `fraction` is the completed part of the run.
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

/// Hours, minutes and seconds: 1:02:03 or 02:03.
std::string clock_text(double seconds);

/// Simulated over wall time for people: two significant digits below ten, whole numbers above.
std::string rate_text(double rate);

/// `text` cut or filled with spaces to one column less than the terminal has: a full line would wrap, and then the next
/// one could not replace it.
std::string fitted_line(const std::string& text, std::size_t columns);

/// Progress in one line for people. A `duration` of 0 counts as done.
std::string progress_text(const RunProgress& progress);

}  // namespace gem
