// Takes the columns of the mooring lines apart.
#include "gem/report/run/line_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"

namespace gem {

std::vector<LineRecord> line_record(const RunFile& file, const SceneDef& scene) {
  if (!file.has("platform/line_break_time")) return {};
  const std::size_t lines = scene.mooring_design.lines.size(), samples = file.rows("platform/time");
  const bool has_tension = file.has("platform/line_tension");
  const std::vector<double> broke = file.column("platform/line_break_time"),
                            tension = has_tension ? file.column("platform/line_tension") : std::vector<double>{};
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (broke.size() != samples * lines || (has_tension && tension.size() != broke.size()) ||
      !std::all_of(broke.begin(), broke.end(), is_number) || !std::all_of(tension.begin(), tension.end(), is_number))
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) +
                                           " (its mooring lines do not fit the case and the samples, or are no "
                                           "numbers) the file may be damaged");
  std::vector<LineRecord> record(lines);
  for (std::size_t k = 0; k < lines; ++k) {
    record[k].strength = scene.mooring_design.lines[k][7];
    if (samples > 0) record[k].break_time = broke[(samples - 1) * lines + k];
    for (std::size_t i = k; i < tension.size(); i += lines) record[k].tension.push_back(tension[i]);
  }
  return record;
}

LargestTension largest_tension(const LineRecord& line, std::size_t first) {
  LargestTension largest{0.0, first};
  for (std::size_t i = first; i < line.tension.size(); ++i)
    if (line.tension[i] > largest.value) largest = {line.tension[i], i};
  return largest;
}

std::string broken_lines_text(const std::vector<double>& break_times) {
  std::string text;
  for (std::size_t k = 0; k < break_times.size(); ++k)
    if (break_times[k] > 0.0)
      text +=
          (text.empty() ? "line " : ", line ") + std::to_string(k + 1) + " at " + number_text(break_times[k]) + " s";
  return text.empty() ? "none" : text;
}

std::vector<double> break_times(const std::vector<LineRecord>& lines) {
  std::vector<double> times;
  for (const LineRecord& line : lines) times.push_back(line.break_time);
  return times;
}

}  // namespace gem
