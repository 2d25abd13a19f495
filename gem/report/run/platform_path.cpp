// Picks samples of a run file by time.
#include "gem/report/run/platform_path.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"

namespace gem {
namespace {

/// Index of the last sample at or before each time. Sample times are sums and therefore rounded.
std::vector<std::size_t> samples_at(const std::vector<double>& time, double interval_s) {
  std::vector<std::size_t> samples;
  for (double at = 0.0; at <= time.back() + 1e-6 * (1.0 + at); at = interval_s * static_cast<double>(samples.size())) {
    const auto next = std::upper_bound(time.begin(), time.end(), at + 1e-6 * (1.0 + at));
    samples.push_back(static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, next - time.begin())) - 1);
  }
  return samples;
}

std::vector<double> picked(const RunFile& file, const std::string& dataset, const std::vector<std::size_t>& samples,
                           double less) {
  const std::vector<double> column = file.column(dataset);
  if (column.size() <= samples.back())
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + dataset +
                                           " is shorter than platform/time); the file may be damaged");
  std::vector<double> values;
  for (const std::size_t i : samples) values.push_back(column[i] - less);
  return values;
}

}  // namespace

PlatformPath read_path(const std::string& run_file, double interval_s) {
  const RunFile file(run_file);
  PlatformPath path{interval_s, true, {}, {}, {}, {}};
  if (!file.has("platform/time") || !(interval_s > 0.0)) return path;
  const std::vector<double> time = file.column("platform/time");
  if (time.empty()) return path;
  constexpr double samples_maximum = 1e8;
  if (!(time.back() / interval_s < samples_maximum) || !std::is_sorted(time.begin(), time.end()))
    throw Error(ExitCode::file_system, "cannot read " + shown(run_file) +
                                           " (its platform record has no valid times); the file may be damaged");
  const Vec2 rest = stored_scene(file).platform.anchor_m;
  const std::vector<std::size_t> samples = samples_at(time, interval_s);
  path.x = picked(file, "platform/x", samples, rest.x);
  path.y = picked(file, "platform/y", samples, rest.y);
  path.vx = picked(file, "platform/vx", samples, 0.0);
  path.vy = picked(file, "platform/vy", samples, 0.0);
  return path;
}

}  // namespace gem
