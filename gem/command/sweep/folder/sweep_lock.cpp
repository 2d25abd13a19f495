// Locks on bytes of one file.
#include "gem/command/sweep/folder/sweep_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/hash.h"
#include "gem/command/command.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

std::string system_reason(int code) { return std::generic_category().message(code); }

/// Bytes of the lock file: one for the manifest, one for the folder, then one per run name (by hash). Two names with
/// the same byte only wait for each other.
constexpr std::int64_t manifest_place = 0, folder_place = 1, first_run_place = 2;

std::int64_t place_of(const std::string& run_name) {
  Hash hash;
  for (const char c : run_name) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return first_run_place + static_cast<std::int64_t>(hash.value() >> 2);
}

int open_locks(const std::string& folder) {
  const std::string path = folder + "/.lock";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file >= 0) return file;
  throw Error(ExitCode::file_system,
              "cannot open " + shown(path) + " (" + system_reason(errno) + "); choose a folder that can be written");
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
                                         "); choose a folder on a file system with locks");
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

}  // namespace gem
