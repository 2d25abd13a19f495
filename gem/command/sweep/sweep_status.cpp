// Prints a table of runs. The state of a run is read from its lock and its file, not from the manifest.
#include "gem/command/sweep/sweep_status.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/folder/sweep_row_json.h"
#include "gem/command/sweep/sweep_plan.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

std::vector<SweepRow> rows_of(const SweepStatusChoice& choice, const std::string& folder) {
  if (!choice.folder.empty()) return known_rows(folder, read_sweep(choice.path, choice.overrides));
  std::vector<SweepRow> rows = read_manifest(folder);
  if (rows.empty())
    throw Error(ExitCode::file_system, shown(folder) +
                                           " is not the folder of a sweep (it has no manifest.json); name the sweep "
                                           "file and its folder with --out");
  return rows;
}

std::string drawn_text(const SweepDraw& draw) {
  std::string text;
  for (const DrawnValue& one : draw.values)
    text += (text.empty() ? "" : " ") + shown(one.variable) + "=" + number_text(one.value, 6);
  return text;
}

std::string table_text(const std::vector<SweepRow>& rows) {
  std::size_t width = 4;
  std::size_t drawn_width = 0;  // 0: nothing is drawn
  for (const SweepRow& row : rows) {
    width = std::max(width, shown(row.name).size());
    drawn_width = std::max(drawn_width, drawn_text(row.draw).size());
  }
  const auto cell = [](std::string text, std::size_t size) {
    text.resize(std::max(size, text.size()), ' ');
    return text + "  ";
  };
  std::string text = cell("run", 5) + cell("name", width) + cell("status", 7) + cell("state hash", 16) +
                     cell("engine", 6) + cell("simulated", 9) + cell("wall", 7) + cell("verdict", 10) +
                     (drawn_width > 0 ? cell("drawn", drawn_width) : "") + "why\n";
  std::map<std::string, int> count;
  for (const SweepRow& row : rows) {
    ++count[row.status];
    text += cell(std::to_string(row.index), 5) + cell(shown(row.name), width) + cell(row.status, 7) +
            cell(row.state_hash.empty() ? "-" : row.state_hash, 16) + cell(row.engine.empty() ? "-" : row.engine, 6) +
            cell(number_text(row.time_s, 6) + " s", 9) + cell(fixed_text(row.wall_time_s, 1) + " s", 7) +
            cell(row.verdict.empty() ? "-" : row.verdict, 10) +
            (drawn_width > 0 ? cell(drawn_text(row.draw), drawn_width) : "") +
            shown(row.error.empty() ? row.doubts : row.error) + "\n";
  }
  text += std::to_string(rows.size()) + " runs:";
  for (const auto& [status, runs] : count) text += " " + std::to_string(runs) + " " + status;
  return text + "\n";
}

}  // namespace

int sweep_status(const SweepStatusChoice& choice) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(choice.path, ignored);
  if (!is_folder && choice.folder.empty())
    throw Error(ExitCode::usage, shown(choice.path) +
                                     " is not a folder (a sweep file needs the folder of its runs) "
                                     "give it with --out");
  if (is_folder && !choice.folder.empty())
    throw Error(ExitCode::usage, "two folders (" + shown(choice.path) + " and " + shown(choice.folder) +
                                     "); leave out --out or name the sweep file");
  const std::string folder = is_folder ? choice.path : choice.folder;
  std::vector<SweepRow> rows = rows_of(choice, folder);
  for (SweepRow& row : rows) row = look_at_run(folder, row);
  print(choice.json ? json_of(rows).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
                    : table_text(rows));
  return 0;
}

}  // namespace gem
