// Messages and the progress line. Failed writes are ignored, so that a run survives the loss of its terminal.
#include "gem/run/run_log.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/base/number_text.h"

namespace gem {

namespace {

using Clock = std::chrono::steady_clock;

double fraction(double time, double duration) { return duration > 0.0 ? std::min(1.0, time / duration) : 1.0; }

double rate(const RunProgress& p) { return p.wall_time > 0.0 ? p.time / p.wall_time : 0.0; }

/// The simulated time, rounded to three significant digits of the duration.
std::string time_text(const RunProgress& p) {
  const double size = std::max(p.duration, 1e-6);
  return fixed_text(p.time, std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6));
}

/// Columns of the terminal; asked each time, because a window may be resized.
std::size_t columns_of_terminal() {
  constexpr std::size_t usual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

double left(const RunProgress& p) { return rate(p) > 0.0 ? (p.duration - p.time) / rate(p) : 0.0; }

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::min(std::round(seconds), 1e9));
  const auto two = [](long long n) { return std::string(n < 10 ? "0" : "") + std::to_string(n); };
  const std::string tail = two(whole / 60 % 60) + ":" + two(whole % 60);
  return whole >= 3600 ? std::to_string(whole / 3600) + ":" + tail : tail;
}

std::string rate_text(double rate) { return rate < 10.0 ? number_text(rate, 2) : fixed_text(rate, 0); }

std::string progress_text(const RunProgress& p) {
  return fixed_text(std::floor(100.0 * fraction(p.time, p.duration)), 0) + " %  " + time_text(p) + " s  " +
         rate_text(rate(p)) + " x real time  " + std::to_string(p.contacts) + " contacts  " + clock_text(left(p)) +
         " left";
}

std::string fitted_line(const std::string& text, std::size_t columns) {
  std::string line = text;
  line.resize(columns > 1 ? columns - 1 : 1, ' ');
  return line;
}

RunLog::RunLog(const LogOptions& options)
    : options_(options), terminal_(isatty(STDERR_FILENO) == 1), shown_at_(Clock::now()) {
  if (options_.progress == ProgressMode::automatic) {
    options_.progress = options_.json ? ProgressMode::json : ProgressMode::line;
  }
  if (options_.quiet) options_.progress = ProgressMode::none;
}

void RunLog::print(const std::string& line) {
  std::size_t done = 0;
  while (done < line.size()) {
    const auto part = ::write(STDERR_FILENO, line.data() + done, line.size() - done);
    if (part <= 0) return;
    done += static_cast<std::size_t>(part);
  }
}

void RunLog::clear_line() {
  if (line_open_) print("\n");
  line_open_ = false;
}

void RunLog::message(const std::string& level, const std::string& text) {
  if (options_.quiet && level != "error") return;
  clear_line();
  if (options_.json) {
    const nlohmann::json object = {{"level", level}, {"message", text}};
    print(object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } else {
    print(std::string("gem: ") + (level == "info" ? "" : level + ": ") + text + "\n");
  }
}

bool RunLog::wants(double time, double duration) const {
  if (options_.progress == ProgressMode::none) return false;
  const double waited = std::chrono::duration<double>(Clock::now() - shown_at_).count();
  const bool next_tenth = static_cast<int>(10.0 * fraction(time, duration)) > tenths_shown_;
  if (options_.progress == ProgressMode::line) return terminal_ ? waited > 0.2 || time >= duration : next_tenth;
  return next_tenth || waited > 10.0;
}

void RunLog::show(const RunProgress& p) {
  const nlohmann::json object = {{"level", "progress"},
                                 {"fraction", fraction(p.time, p.duration)},
                                 {"time_s", p.time},
                                 {"wall_time_s", p.wall_time},
                                 {"sim_rate", rate(p)},
                                 {"contacts", p.contacts},
                                 {"residual_energy", p.energy_residual},
                                 {"left_s", left(p)}};
  show(fraction(p.time, p.duration), progress_text(p), object.dump());
}

void RunLog::show(double done, const std::string& text, const std::string& object) {
  shown_at_ = Clock::now();
  tenths_shown_ = static_cast<int>(10.0 * done);
  if (options_.progress == ProgressMode::json) {
    print(object + "\n");
  } else if (terminal_) {
    print("\r" + fitted_line(text, columns_of_terminal()));
    line_open_ = true;
  } else {
    print(text + "\n");
  }
}

}  // namespace gem
