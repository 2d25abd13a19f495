// Drafts, and what may be replaced.
#include "gem/export/export_output.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_output(const fs::path& path, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot write " + shown(path.string()) + " (" + why + ") " + hint);
}

void check_code(const std::error_code& code, const fs::path& path) {
  if (code) refuse_output(path, code.message(), "make room or choose another output");
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  if (stream) write(stream);
  stream.close();
  if (!stream) refuse_output(path, std::generic_category().message(errno), "make room or choose another output");
}

fs::path draft_of(const fs::path& path) { return path.parent_path() / ("." + path.filename().string() + ".new"); }

/// Refuses to remove what an export did not write.
void check_only_vtp(const fs::path& folder) {
  std::error_code code;
  const bool plain = fs::is_directory(fs::symlink_status(folder, code));
  if (!plain) refuse_output(folder, "it is not a folder", "choose another output");
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().extension() != ".vtp" || !entry->is_regular_file())
      refuse_output(folder, "the folder holds " + shown(entry->path().filename().string()) + ", no export wrote that",
                    "choose another output");
  check_code(code, folder);
}

}  // namespace

void write_export(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  const fs::path draft = draft_of(path);
  std::error_code code, ignored;
  try {
    write_file(draft, write);
    fs::rename(draft, path, code);
    check_code(code, path);
  } catch (...) {
    fs::remove(draft, ignored);
    throw;
  }
}

ExportFolder::ExportFolder(fs::path folder, bool overwrite) : folder_(std::move(folder)), draft_(draft_of(folder_)) {
  std::error_code code;
  if (fs::exists(fs::symlink_status(folder_, code))) {
    if (!overwrite) refuse_output(folder_, "the folder exists", "use --overwrite or another output");
    check_only_vtp(folder_);
  }
  if (fs::exists(fs::symlink_status(draft_, code))) check_only_vtp(draft_);
  fs::remove_all(draft_, code);
  check_code(code, draft_);
  fs::create_directory(draft_, code);
  check_code(code, draft_);
}

ExportFolder::~ExportFolder() {
  std::error_code ignored;
  if (!draft_.empty()) fs::remove_all(draft_, ignored);
}

void ExportFolder::write(const std::string& name, const std::function<void(std::ostream&)>& write) const {
  write_file(draft_ / name, write);
}

void ExportFolder::publish() {
  std::error_code code;
  fs::remove_all(folder_, code);
  check_code(code, folder_);
  fs::rename(draft_, folder_, code);
  check_code(code, folder_);
  draft_.clear();
}

}  // namespace gem
