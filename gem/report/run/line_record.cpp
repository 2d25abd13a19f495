// Takes the columns of the mooring lines apart.
#include "gem/report/run/line_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"

namespace gem {

namespace {

bool are_numbers(const std::vector<double>& values, std::size_t count) {
  return values.size() == count &&
         std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

[[noreturn]] void refuse_lines(const RunFile& file) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) +
                                         " (its mooring lines do not fit the case and the samples, or are no "
                                         "numbers); the file may be damaged");
}

}  // namespace

std::vector<LineRecord> line_record(const RunFile& file, const SceneDef& scene) {
  if (!file.has("platform/line_break_time")) return {};
  const std::size_t lines = scene.mooring_design.lines.size();
  std::vector<LineRecord> record(lines);
  for (std::size_t k = 0; k < lines; ++k) record[k].strength = scene.mooring_design.lines[k][7];
  std::vector<std::string> columns = {"platform/time", "platform/line_break_time"};
  if (file.has("platform/line_tension")) columns.emplace_back("platform/line_tension");
  for_each_piece(file, columns, [&](const ColumnPiece& piece) {
    for (std::size_t column = 1; column < columns.size(); ++column)
      if (!are_numbers(piece.values[column], piece.rows * lines)) refuse_lines(file);
    for (std::size_t k = 0; k < lines; ++k) {
      record[k].break_time = piece.values[1][(piece.rows - 1) * lines + k];
      if (columns.size() < 3) continue;
      for (std::size_t i = k; i < piece.values[2].size(); i += lines) record[k].tension.push_back(piece.values[2][i]);
    }
  });
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

std::vector<double> last_break_times(const RunFile& file, const SceneDef& scene) {
  const std::string column = "platform/line_break_time";
  const std::size_t lines = scene.mooring_design.lines.size();
  const std::size_t rows = file.has(column) ? file.rows(column) : 0;
  if (rows == 0) return std::vector<double>(lines, 0.0);
  std::vector<double> times = file.column_rows(column, rows - 1, 1);
  if (!are_numbers(times, lines)) refuse_lines(file);
  return times;
}

}  // namespace gem
