// The repair: a copy, then lengths and status in the copy.
#include "gem/record/run_file/run_repair.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/hdf5/row_extent.h"
#include "gem/record/output/output_claim.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

using hdf5::check;
using hdf5::checked;
using hdf5::Handle;

namespace {

constexpr const char* mended_groups[] = {"floes", "platform", "events", "stats", "contacts", "splits"};

[[noreturn]] void refuse_repair(const std::string& path, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot repair " + shown(path) + " (" + why + ") " + hint);
}

/// A file in use is still being written, or read by somebody who counts on it.
void check_free(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool held = file >= 0 && flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (file >= 0) close(file);
  if (held) refuse_repair(path, "another process writes or reads it", "wait for that");
}

herr_t add_member(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Cuts one dataset to `rows`. Returns the rows that were cut.
hsize_t cut(hid_t group, const std::string& name, hsize_t rows) {
  const Handle dataset = checked(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name.c_str());
  const Handle space = checked(H5Dget_space(dataset), H5Sclose, name.c_str());
  hsize_t size[2] = {0, 0};
  if (H5Sget_simple_extent_ndims(space) > 2) throw hdf5::Failure{name + ": too many dimensions"};
  check(H5Sget_simple_extent_dims(space, size, nullptr), name.c_str());
  if (size[0] <= rows) return 0;
  const hsize_t before = size[0];
  size[0] = rows;
  check(H5Dset_extent(dataset, size), name.c_str());
  return before - rows;
}

/// Gives all datasets of a group the same length. Returns a line if one was longer.
std::string even_out(hid_t file, const std::string& group, std::uint64_t file_size) {
  if (H5Lexists(file, group.c_str(), H5P_DEFAULT) <= 0) return "";
  const hsize_t rows = hdf5::rows_of_group(file, group, file_size, hdf5::repaired_chunks);
  const Handle folder = checked(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose, group.c_str());
  std::vector<std::string> names;
  check(H5Literate(folder, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_member, &names), group.c_str());
  hsize_t most = 0;
  for (const std::string& name : names) most = std::max(most, cut(folder, name, rows));
  if (most == 0) return "";
  return "/" + group + ": " + std::to_string(rows) + " whole rows kept, up to " + std::to_string(most) +
         " rows without data cut";
}

std::vector<std::string> mend(const std::string& path, const std::string& status) {
  std::vector<std::string> done;
  const std::uint64_t size = std::filesystem::file_size(path);
  Handle file = hdf5::open_left_file(path);
  for (const char* group : mended_groups) {
    const std::string line = even_out(file, group, size);
    if (!line.empty()) done.push_back(line);
  }
  if (status == "running" || (status == "complete" && !done.empty())) {
    const std::string now = status == "running" ? "stopped:killed" : "stopped:repaired";
    hdf5::write_text(file, "gem_status", now);
    done.push_back("gem_status: " + status + " -> " + now);
  }
  if (!file.close()) throw hdf5::Failure{"cannot close: " + hdf5::last_reason()};
  return done;
}

}  // namespace

RepairReport repair_run_file(const std::string& path, const std::string& output, bool overwrite) {
  const std::string status = RunFile(path, true).status();
  check_free(path);
  std::error_code fault;
  if (std::filesystem::equivalent(path, output, fault))
    refuse_repair(path, "the output is the file itself", "choose another --out");
  check_output_path(output, overwrite);
  if (overwrite) check_replaceable(output);
  OutputClaim claim(output, overwrite);
  using std::filesystem::copy_options;
  if (!std::filesystem::copy_file(path, claim.path(), copy_options::overwrite_existing, fault))
    refuse_repair(path, fault.message(), "make room or choose another --out");
  RepairReport report;
  try {
    report.done = mend(claim.path(), status);
  } catch (const hdf5::Failure& failure) {
    refuse_repair(path, failure.text, "its index is damaged");
  }
  if (report.done.empty()) return report;
  std::string why = claim.sync();
  if (why.empty()) why = claim.publish();
  if (!why.empty()) refuse_repair(path, why, "make room or choose another --out");
  report.output = output;
  return report;
}

}  // namespace gem
