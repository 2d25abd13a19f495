// The manifest as JSON, and its updates as one JSON object a line.
#include "gem/command/sweep/folder/sweep_manifest.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include "gem/base/error.h"
#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_lock.h"
#include "gem/command/sweep/folder/sweep_row_json.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

std::string manifest_path(const std::string& folder) { return folder + "/manifest.json"; }
std::string updates_path(const std::string& folder) { return folder + "/manifest.updates"; }

[[noreturn]] void throw_unwritable(const std::string& path, int fault) {
  throw Error(ExitCode::file_system, "cannot write " + shown(path) + " (" + std::generic_category().message(fault) +
                                         "); free disk space or choose another --out");
}

/// Tells one file of a name from the next: inode, and seconds and nanoseconds of its last change. Zeros: no file.
using FileStamp = std::tuple<ino_t, time_t, long>;

FileStamp stamp_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
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
    throw_unwritable(path, fault);
  }
}

// A row takes about 400 bytes and 150 for each drawn number, and a sweep has at most 100,000 runs.
constexpr std::size_t manifest_bytes_maximum = std::size_t{256} << 20;
constexpr int manifest_depth_maximum = 8;

/// Whether runs have left files: run files, or checkpoints of them.
bool has_run_files(const std::filesystem::path& folder) {
  std::error_code none;
  const std::filesystem::directory_iterator entries(folder, none);
  return std::any_of(begin(entries), end(entries), [](const std::filesystem::directory_entry& entry) {
    return entry.path().filename().string().find(".h5") != std::string::npos;
  });
}

[[noreturn]] void throw_unreadable(const std::string& path, const std::string& why, const std::string& advice) {
  throw Error(ExitCode::file_system, "cannot read " + shown(path) + " (" + why + ") " + advice);
}

/// The manifest, or its updates, make no sense. A manifest of runs that were made also says why runs failed, so it is
/// kept.
[[noreturn]] void throw_damaged(const std::string& path, const std::string& why) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string out = " --out " + shown(folder.string());
  throw_unreadable(path, why,
                   has_run_files(folder) ? "rename it; then `gem sweep status SWEEPFILE" + out +
                                               "` shows which runs are done, by their files, and `gem sweep run "
                                               "SWEEPFILE" +
                                               out + "` makes the others and a new manifest"
                                         : "remove it; no run has been made here, so nothing is lost");
}

/// Empty if there is no file. Throws Error(file_system).
std::optional<std::string> text_of(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOENT) return std::nullopt;
  std::string text;
  std::vector<char> block(65536);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > manifest_bytes_maximum) throw_damaged(path, "the file is too large");
  }
  if (!file.eof()) throw_unreadable(path, std::generic_category().message(errno), "make it a file that can be read");
  return text;
}

std::uintmax_t size_of(const std::string& path) {
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(path, none);
  return none ? 0 : bytes;
}

Json checked_json(const std::string& text) {
  return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
    if (depth > manifest_depth_maximum) throw std::length_error("values are nested too deep");
    return true;
  });
}

/// The newest row of each name. A line that a killed process left unfinished says nothing.
std::vector<SweepRow> read_updates(const std::string& folder) {
  std::istringstream text(text_of(updates_path(folder)).value_or(""));
  std::map<std::string, SweepRow> newest;
  for (std::string line; std::getline(text, line);) {
    try {
      const SweepRow row = row_of_json(checked_json(line));
      newest[row.name] = row;
    } catch (const Json::exception&) {
      continue;
    } catch (const std::length_error&) {
      continue;
    }
  }
  std::vector<SweepRow> rows;
  for (const auto& [name, row] : newest) rows.push_back(row);
  return rows;
}

bool write_whole(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t bytes = write(file, text.data() + done, text.size() - done);
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes <= 0) return false;
    done += static_cast<std::size_t>(bytes);
  }
  return true;
}

/// Puts the lines at the end of the file, or leaves it as it was.
void append_updates(const std::string& folder, const std::string& lines) {
  const std::string path = updates_path(folder);
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) throw_unwritable(path, errno);
  const off_t end = lseek(file, 0, SEEK_END);
  char last = '\n';
  const bool is_cut = end > 0 && pread(file, &last, 1, end - 1) == 1 && last != '\n';
  const bool written = write_whole(file, is_cut ? "\n" + lines : lines);
  const int fault = errno;
  // If the rest of a line cannot be removed either, readers pass over it.
  const bool restored = written || ftruncate(file, end) == 0;
  close(file);
  if (!written || !restored) throw_unwritable(path, fault);
}

void append_rows(const std::string& folder, const std::vector<SweepRow>& rows) {
  std::string lines;
  for (const Json& object : json_of(rows)) lines += object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  append_updates(folder, lines);
}

void remove_updates(const std::string& folder) {
  const std::string path = updates_path(folder);
  if (unlink(path.c_str()) != 0 && errno != ENOENT) throw_unwritable(path, errno);
}

/// `all` with the rows of `newer` in place of those of the same name, by index.
std::vector<SweepRow> laid_over(std::vector<SweepRow> all, const std::vector<SweepRow>& newer) {
  std::set<std::string> names;
  for (const SweepRow& row : newer) names.insert(row.name);
  std::erase_if(all, [&names](const SweepRow& old) { return names.count(old.name) > 0; });
  all.insert(all.end(), newer.begin(), newer.end());
  std::stable_sort(all.begin(), all.end(), [](const SweepRow& a, const SweepRow& b) { return a.index < b.index; });
  return all;
}

void replace_manifest(const std::string& folder, const std::vector<SweepRow>& rows) {
  const Json document = {{"gem_build", build_text()}, {"runs", json_of(rows)}};
  write_at_one_stroke(manifest_path(folder), document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

bool has_manifest(const std::string& folder) { return access(manifest_path(folder).c_str(), F_OK) == 0; }

/// A process that is killed before the updates are removed leaves the rows that the manifest has: none is older.
void settle(const std::string& folder) {
  replace_manifest(folder, read_manifest(folder));
  remove_updates(folder);
}

}  // namespace

std::vector<SweepRow> read_manifest(const std::string& folder) {
  const std::string path = manifest_path(folder);
  std::vector<SweepRow> updates;
  std::optional<std::string> text;
  // If another process settled the updates in between, those of before may be older than the manifest.
  FileStamp before;
  do {
    before = stamp_of(path);
    updates = read_updates(folder);
    text = text_of(path);
  } while (stamp_of(path) != before);
  if (!text) return {};
  try {
    std::vector<SweepRow> rows;
    const Json document = checked_json(*text);
    for (const Json& object : document.at("runs")) rows.push_back(row_of_json(object));
    return updates.empty() ? rows : laid_over(std::move(rows), updates);
  } catch (const std::exception& fault) {  // of JSON, or a limit
    throw_damaged(path, fault.what());
  }
}

void write_manifest(const std::string& folder, const std::vector<SweepRow>& rows) {
  if (has_manifest(folder)) {
    append_rows(folder, rows);
    return settle(folder);
  }
  remove_updates(folder);  // of a manifest that somebody removed
  replace_manifest(folder, laid_over({}, rows));
}

void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows) {
  const SweepLock held = SweepLock::wait_manifest(folder);
  if (!has_manifest(folder)) return write_manifest(folder, rows);
  append_rows(folder, rows);
  if (size_of(updates_path(folder)) > size_of(manifest_path(folder))) settle(folder);
}

void settle_manifest(const std::string& folder) {
  const SweepLock held = SweepLock::wait_manifest(folder);
  if (size_of(updates_path(folder)) > 0) settle(folder);
}

}  // namespace gem
