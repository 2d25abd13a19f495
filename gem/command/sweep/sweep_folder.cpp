// Locks on bytes of one file, the manifest as JSON, and the state of a run read from its file.
#include "gem/command/sweep/sweep_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/error.h"
#include "gem/base/hash.h"
#include "gem/command/command.h"
#include "gem/command/sweep/sweep_row_json.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

std::string system_reason(int code) { return std::generic_category().message(code); }

std::string manifest_path(const std::string& folder) { return folder + "/manifest.json"; }

/// Bytes of the lock file: one for the manifest, one for the folder, then one per run name (by hash). Two names with
/// the same byte only wait for each other.
constexpr std::int64_t manifest_place = 0, folder_place = 1, first_run_place = 2;

std::int64_t place_of(const std::string& run_name) {
  Hash hash;
  for (const char c : run_name) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return first_run_place + static_cast<std::int64_t>(hash.value() >> 2);
}

/// Replaces the file atomically: a reader sees the old text or the new one.
void write_at_one_stroke(const std::string& path, const std::string& text) {
  const std::string draft = path + "." + std::to_string(getpid());
  std::ofstream file(draft, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file || std::rename(draft.c_str(), path.c_str()) != 0) {
    const int fault = errno;
    unlink(draft.c_str());
    throw Error(ExitCode::file_system, "cannot write " + shown(path) + " (" + system_reason(fault) +
                                           ") free disk space or choose another --out");
  }
}

// A row takes about 400 bytes and 150 for each drawn number, and a sweep has at most 100,000 runs.
constexpr std::size_t manifest_bytes_maximum = std::size_t{256} << 20;
constexpr int manifest_depth_maximum = 8;

std::string manifest_text(std::istream& file) {
  std::string text;
  std::vector<char> block(65536);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > manifest_bytes_maximum) throw std::length_error("the file is too large");
  }
  return text;
}

double last_of(const RunFile& file, const std::string& dataset) {
  const std::vector<double> values = file.has(dataset) ? file.column(dataset) : std::vector<double>{};
  return values.empty() ? 0.0 : values.back();
}

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
  row.time_s = last_of(file, "stats/time");
  row.wall_time_s = last_of(file, "stats/wall_time");
  row.state_hash = status == "running" ? "" : file.attribute("gem_state_hash");
  const bool failed = status.rfind("stopped:numerical", 0) == 0 || status.rfind("stopped:failure", 0) == 0;
  row.status = status == "complete" ? "done" : failed ? "failed" : "stopped";
  row.error = status == "complete" ? "" : status == "running" ? "the run was interrupted" : status;
}

int open_locks(const std::string& folder) {
  const std::string path = folder + "/.lock";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file >= 0) return file;
  throw Error(ExitCode::file_system,
              "cannot open " + shown(path) + " (" + system_reason(errno) + ") choose a folder that can be written");
}

/// Locks one byte (F_OFD_SETLK, F_OFD_SETLKW) or asks who holds it (F_OFD_GETLK). `kind` is F_WRLCK (exclusive) or
/// F_RDLCK (shared). Returns false if another process holds it.
bool lock_byte(int file, int command, std::int64_t place, const std::string& folder, short kind = F_WRLCK) {
  struct flock range {};
  range.l_type = kind;
  range.l_whence = SEEK_SET;
  range.l_start = place;
  range.l_len = 1;
  int result = 0;
  do {
    result = fcntl(file, command, &range);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return command != F_OFD_GETLK || range.l_type == F_UNLCK;
  if (errno == EAGAIN || errno == EACCES) return false;
  throw Error(ExitCode::file_system, "cannot lock " + shown(folder) + "/.lock (" + system_reason(errno) +
                                         ") choose a folder on a file system with locks");
}

std::vector<SweepRow> laid_over(std::vector<SweepRow> all, const std::vector<SweepRow>& rows) {
  std::set<std::string> names;
  for (const SweepRow& row : rows) names.insert(row.name);
  std::erase_if(all, [&names](const SweepRow& old) { return names.count(old.name) > 0; });
  all.insert(all.end(), rows.begin(), rows.end());
  std::stable_sort(all.begin(), all.end(), [](const SweepRow& a, const SweepRow& b) { return a.index < b.index; });
  return all;
}

void write_manifest(const std::string& folder, const std::vector<SweepRow>& rows) {
  const Json document = {{"gem_build", build_text()}, {"runs", json_of(rows)}};
  write_at_one_stroke(manifest_path(folder), document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

std::optional<SweepLock> SweepLock::try_run(const std::string& folder, const std::string& run_name) {
  SweepLock held(open_locks(folder));
  if (!lock_byte(held.file_, F_OFD_SETLK, place_of(run_name), folder)) return std::nullopt;
  return held;
}

bool SweepLock::is_held(const std::string& folder, const std::string& run_name) {
  if (access((folder + "/.lock").c_str(), F_OK) != 0) return false;
  const SweepLock file(open_locks(folder));
  return !lock_byte(file.file_, F_OFD_GETLK, place_of(run_name), folder);
}

std::optional<SweepLock> SweepLock::try_folder(const std::string& folder, bool alone) {
  SweepLock held(open_locks(folder));
  if (!lock_byte(held.file_, F_OFD_SETLK, folder_place, folder, alone ? F_WRLCK : F_RDLCK)) return std::nullopt;
  return held;
}

SweepLock SweepLock::wait_manifest(const std::string& folder) {
  SweepLock held(open_locks(folder));
  lock_byte(held.file_, F_OFD_SETLKW, manifest_place, folder);
  return held;
}

SweepLock::~SweepLock() {
  if (file_ >= 0) close(file_);
}

SweepLock::SweepLock(SweepLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

SweepLock& SweepLock::operator=(SweepLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

std::string run_path(const std::string& folder, const std::string& run_name) {
  return folder + "/" + run_file_name(run_name);
}

std::vector<SweepRow> read_manifest(const std::string& folder) {
  const std::string path = manifest_path(folder);
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  try {
    const std::string text = manifest_text(file);
    std::vector<SweepRow> rows;
    const Json document = Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > manifest_depth_maximum) throw std::length_error("values are nested too deep");
      return true;
    });
    for (const Json& object : document.at("runs")) rows.push_back(row_of_json(object));
    return rows;
  } catch (const std::exception& fault) {  // of JSON, or a limit
    throw Error(ExitCode::file_system, "cannot read " + shown(path) + " (" + fault.what() +
                                           ") remove it; the next `gem sweep run` makes it again from the run files");
  }
}

void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows) {
  const SweepLock held = SweepLock::wait_manifest(folder);
  write_manifest(folder, laid_over(read_manifest(folder), rows));
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
                                           " has another case than here) choose another --out");
  auto share = SweepLock::try_folder(folder, false);
  std::vector<SweepRow> added = rows;
  std::erase_if(added, [&known](const SweepRow& row) { return known.count({row.name, row.case_sha256}) > 0; });
  if (!added.empty()) write_manifest(folder, laid_over(all, added));
  return std::move(*share);
}

SweepRow look_at_run(const std::string& folder, SweepRow row, const std::string& engine) {
  if (SweepLock::is_held(folder, row.name)) {
    row.status = "running";
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
