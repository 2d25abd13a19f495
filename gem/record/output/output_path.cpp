// Checks the output path by asking the file system.
#include "gem/record/output/output_path.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>

#include "gem/base/error.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

namespace {

std::string folder_of(const std::string& path) {
  const auto slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string system_reason(int code) { return std::generic_category().message(code); }

[[noreturn]] void refuse(const std::string& path, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot write " + shown(path) + " (" + why + ") " + hint);
}

/// Creates, fills and removes a test file beside the output.
void test_write(const std::string& path) {
  std::string probe = folder_of(path) + "/.gem-write-test-XXXXXX";
  const int file = mkstemp(probe.data());
  if (file < 0) {
    const int fault = errno;
    struct stat status {};
    // /proc and similar folders answer "no such file" when a file is created in them
    const bool there = fault == ENOENT && stat(folder_of(path).c_str(), &status) == 0;
    refuse(path, "folder " + shown(folder_of(path)) + ": " + (there ? "it takes no files" : system_reason(fault)),
           "choose another --out");
  }
  const bool written = write(file, "gem", 3) == 3;
  const int write_errno = errno;
  const bool closed = close(file) == 0;
  const int fault = written ? errno : write_errno;
  unlink(probe.c_str());
  if (!written || !closed) refuse(path, system_reason(fault), "make room or choose another --out");
}

}  // namespace

std::string shown(const std::string& path) {
  static const char* digits = "0123456789abcdef";
  std::string text;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool wide_control = byte >= 0x80 && byte < 0xa0 && text.ends_with('\xc2');  // U+0080 to U+009F
    if (wide_control) {
      text.pop_back();
      text += std::string("\\u00") + digits[byte >> 4] + digits[byte & 15];
    } else if (byte < 0x20 || byte == 0x7f) {
      text += std::string("\\x") + digits[byte >> 4] + digits[byte & 15];
    } else {
      text += c;
    }
  }
  return text;
}

void check_output_path(const std::string& path, bool overwrite) {
  if (path.empty()) refuse(path, "empty path", "give a file name with --out");
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) refuse(path, "it is a directory", "give a file name with --out");
    if (!overwrite) refuse(path, "the file exists", "use --overwrite or another --out");
    if (!S_ISREG(status.st_mode)) refuse(path, "it is not a regular file", "choose another --out");
    if (access(path.c_str(), W_OK) != 0)
      refuse(path, system_reason(errno), "change its permissions or choose another --out");
  } else if (errno != ENOENT) {
    refuse(path, system_reason(errno), "choose another --out");
  } else if (lstat(path.c_str(), &status) == 0) {
    refuse(path, "it is a link to a file that does not exist", "remove the link or choose another --out");
  }
  if (path.back() == '/') refuse(path, "it names a directory", "give a file name with --out");
  test_write(path);
}

void check_replaceable(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && status.st_size > 0 && !is_run_file(path))
    refuse(path, "it is not a file of gem's, which --overwrite replaces", "choose another --out");
}

std::uint64_t room_at(const std::string& path) {
  std::uint64_t room = std::numeric_limits<std::uint64_t>::max();
  struct statvfs system {};
  if (statvfs(folder_of(path).c_str(), &system) == 0) room = std::uint64_t{system.f_bavail} * system.f_frsize;
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    struct stat status {};
    const std::uint64_t used = stat(path.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
    room = std::min<std::uint64_t>(room, limit.rlim_cur > used ? limit.rlim_cur - used : 0);
  }
  return room;
}

}  // namespace gem
