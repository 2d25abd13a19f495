#include "gem/record/output/output_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {

namespace {

std::string reason_of(int code) { return std::generic_category().message(code); }

[[noreturn]] void refuse_claim(const std::string& path, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot write " + shown(path) + " (" + why + ") " + hint);
}

[[noreturn]] void refuse_held(const std::string& path) {
  refuse_claim(path, "another process writes or reads it", "wait for that or choose another --out");
}

/// A link is kept: the draft stands beside the file it leads to.
std::string behind_links(const std::string& path) {
  std::error_code fault;
  if (!std::filesystem::is_symlink(path, fault)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, fault);
  return fault ? path : target.string();
}

std::string draft_of(const std::string& path) {
  const auto slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  const std::string name = path.substr(folder.size());
  constexpr std::size_t longest = 250;  // a name holds 255 bytes
  return folder + "." + (name.size() <= longest ? name : name.substr(name.size() - 200)) + ".new";
}

/// Returns whether nobody else holds the file. Where the file system has no locks, nobody does.
bool lock(int file, int kind) { return flock(file, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

/// The same, with patience: readers as `gem sweep status` hold a file for moments, a run that writes it to its end.
bool lock_soon(int file) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    if (lock(file, LOCK_EX)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// Whether `get_lock` fails for the file. A file that is not there, and one that cannot be opened, are free.
bool is_held(const std::string& path, const std::function<bool(int)>& get_lock) {
  // a pipe would wait for its writer
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  const bool free = get_lock(file);
  close(file);
  return !free;
}

bool same_file(const struct stat& one, const struct stat& other) {
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

}  // namespace

bool is_claimed(const std::string& path) {
  return is_held(path, [](int file) { return lock(file, LOCK_EX); });
}

void check_unclaimed(const std::string& path) {
  if (is_held(path, lock_soon)) refuse_claim(path, "another process writes or reads it", "wait for its end");
}

OutputClaim::OutputClaim(const std::string& path, bool overwrite)
    : path_(behind_links(path)), draft_(draft_of(path_)), overwrite_(overwrite) {
  hold_existing(overwrite);
  try {
    open_draft();
  } catch (...) {
    if (former_ >= 0) close(former_);
    throw;
  }
}

void OutputClaim::hold_existing(bool overwrite) {
  former_ = open(path_.c_str(), O_RDWR | O_CLOEXEC);
  if (former_ < 0 && errno == ENOENT) return;
  if (former_ < 0) refuse_claim(path_, reason_of(errno), "choose another --out");
  if (overwrite && lock_soon(former_)) return;
  close(former_);
  if (!overwrite) refuse_claim(path_, "the file exists", "use --overwrite or another --out");
  refuse_held(path_);
}

void OutputClaim::open_draft() {
  for (int attempt = 0; attempt < 10; ++attempt) {
    file_ = open(draft_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) refuse_claim(path_, reason_of(errno), "choose another --out");
    struct stat held {
    }, named{};
    const bool free = lock(file_, LOCK_EX);
    // another process may have given the draft its name meanwhile
    const bool stands = fstat(file_, &held) == 0 && stat(draft_.c_str(), &named) == 0 && same_file(held, named);
    if (free && stands) return;
    close(file_);
    if (stands) break;
  }
  refuse_held(path_);
}

OutputClaim::~OutputClaim() {
  if (!published_ && !removed_) unlink(draft_.c_str());
  close(file_);
  if (former_ >= 0) close(former_);
}

std::string OutputClaim::publish() {
  lock(file_, LOCK_SH);  // from now on others may read
  int fault = 0;
  if (overwrite_) {
    if (std::rename(draft_.c_str(), path_.c_str()) != 0) fault = errno;
  } else if (renameat2(AT_FDCWD, draft_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) != 0) {
    fault = errno;
    if (fault == EINVAL || fault == ENOSYS) {  // a file system without it
      fault = link(draft_.c_str(), path_.c_str()) == 0 ? 0 : errno;
      if (fault == 0) unlink(draft_.c_str());
    }
  }
  if (fault != 0) return fault == EEXIST ? "another process made the file" : reason_of(fault);
  published_ = true;
  return "";
}

std::string OutputClaim::sync() const {
  // some file systems cannot, and say EINVAL
  return fdatasync(file_) == 0 || errno == EINVAL ? "" : reason_of(errno);
}

bool OutputClaim::in_place() const {
  struct stat held {
  }, named{};
  return fstat(file_, &held) == 0 && stat(path().c_str(), &named) == 0 && same_file(held, named);
}

bool OutputClaim::is_cut() {
  struct stat held {};
  if (fstat(file_, &held) != 0) return true;
  const auto size = static_cast<std::uint64_t>(held.st_size);
  return std::exchange(size_, size) > size;
}

bool OutputClaim::reserve(std::uint64_t bytes) const {
  struct stat held {};
  if (fstat(file_, &held) != 0) return false;
  const auto size = static_cast<std::uint64_t>(held.st_size);
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && size + bytes > limit.rlim_cur)
    return false;
  constexpr std::uint64_t last_part = 1 << 20;  // the library may have left holes near the end of the file
  const std::uint64_t from = size > last_part ? size - last_part : 0;
  int fault = 0;
  do {
    fault =
        fallocate(file_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from), static_cast<off_t>(size + bytes - from)) == 0
            ? 0
            : errno;
  } while (fault == EINTR);
  if (fault == EOPNOTSUPP || fault == ENOSYS || fault == EINVAL) return room_at(path_) >= bytes;
  return fault == 0;
}

void OutputClaim::trim() const {
  struct stat held {};
  // the old size: frees what stands behind it
  if (fstat(file_, &held) == 0 && ftruncate(file_, held.st_size) != 0) return;
}

void OutputClaim::remove() {
  unlink(path().c_str());
  removed_ = true;
}

}  // namespace gem
