// The state of a run, read from its file.
#include "gem/command/sweep/folder/sweep_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/folder/sweep_row_json.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/column_pieces.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {
namespace {

/// All engines of gem compute the same bits.
bool same_physics(const std::string& asked, const std::string& found) {
  return asked.empty() || asked == found || (!is_baseline(asked) && !is_baseline(found));
}

void judge(SweepRow& row, const RunFile& file, const std::string& engine) {
  const std::string status = file.status();
  const std::string found = file.attribute("gem_engine");
  if (file.attribute("gem_case_sha256") != row.case_sha256 || !same_physics(engine, found)) {
    const bool other_case = file.attribute("gem_case_sha256") != row.case_sha256;
    row.status = "other";
    row.error = other_case ? "the file holds another case (" + file.attribute("gem_case_sha256").substr(0, 12) +
                                 ", requested " + row.case_sha256.substr(0, 12) + ")"
                           : "the file was made by the engine " + found;
    return;
  }
  row.engine = found;
  const RunVerdict verdict = verdict_of(file);
  row.verdict = grade_name(verdict.grade);
  row.doubts = doubts_of(verdict);
  row.time_s = last_value(file, "stats/time");
  row.wall_time_s = last_value(file, "stats/wall_time");
  row.state_hash = status == "running" ? "" : file.attribute("gem_state_hash");
  const bool failed = status.rfind("stopped:numerical", 0) == 0 || status.rfind("stopped:failure", 0) == 0;
  row.status = status == "complete" ? "done" : failed ? "failed" : "stopped";
  row.error = status == "complete" ? "" : status == "running" ? "the run was interrupted" : status;
}

/// How far a run has come. Its file has this from its first flush on, unless it is still that of an earlier run.
void look_how_far(const std::string& path, SweepRow& row) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;
  try {
    const RunFile file(path, true);
    if (file.status() != "running" || file.attribute("gem_case_sha256") != row.case_sha256) return;
    row.time_s = last_value(file, "stats/time");
    row.wall_time_s = last_value(file, "stats/wall_time");
  } catch (const Error&) {  // it is being made
  }
}

}  // namespace

std::string run_path(const std::string& folder, const std::string& run_name) {
  return folder + "/" + run_file_name(run_name);
}

SweepLock enter_folder(const std::string& folder, const std::vector<SweepRow>& rows) {
  const SweepLock held = SweepLock::wait_manifest(folder);
  const std::vector<SweepRow> all = read_manifest(folder);
  std::map<std::string, std::string> case_of;
  for (const SweepRow& row : rows) case_of[row.name] = row.case_sha256;
  std::set<std::pair<std::string, std::string>> known;
  for (const SweepRow& row : all) known.insert({row.name, row.case_sha256});
  const auto other = std::find_if(all.begin(), all.end(), [&](const SweepRow& row) {
    const auto found = case_of.find(row.name);
    return found != case_of.end() && found->second != row.case_sha256;
  });
  if (other != all.end() && !SweepLock::try_folder(folder, true))
    throw Error(ExitCode::file_system, "another sweep runs in " + shown(folder) + " (its " + shown(other->name) +
                                           " has another case than here); choose another --out");
  auto share = SweepLock::try_folder(folder, false);
  std::vector<SweepRow> added = rows;
  std::erase_if(added, [&known](const SweepRow& row) { return known.count({row.name, row.case_sha256}) > 0; });
  if (!added.empty()) write_manifest(folder, added);
  return std::move(*share);
}

SweepRow look_at_run(const std::string& folder, SweepRow row, const std::string& engine) {
  if (SweepLock::is_held(folder, row.name)) {
    row.status = "running";
    row.time_s = row.wall_time_s = 0.0;
    look_how_far(run_path(folder, row.name), row);
    return row;
  }
  return look_at_file(folder, std::move(row), engine);
}

SweepRow look_at_file(const std::string& folder, SweepRow row, const std::string& engine) {
  const std::string path = run_path(folder, row.name);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    if (row.status != "failed") {
      row.status = "missing";
      row.error.clear();
    }
    return row;
  }
  row.engine.clear();
  row.state_hash.clear();
  row.verdict.clear();
  row.doubts.clear();
  row.time_s = row.wall_time_s = 0.0;
  try {
    judge(row, RunFile(path, true), engine);
  } catch (const Error& fault) {
    row.status = "stopped";
    row.error = fault.what();
  }
  return row;
}

}  // namespace gem
