#include "gem/record/run_file/killed_end.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "gem/record/hdf5/hdf5_handle.h"

namespace gem {
namespace {

/// The first bytes of a file whose head has the form of version 3, the only one that keeps the mark: signature,
/// version, size of addresses, size of lengths, marks (HDF5 File Format Specification 3.0, II.A).
constexpr std::array<unsigned char, 9> start = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n', 3};
constexpr std::size_t marks_at = 11;

bool is_marked(int file) {
  std::array<unsigned char, marks_at + 1> head{};
  return pread(file, head.data(), head.size(), 0) == ssize_t{head.size()} &&
         std::equal(start.begin(), start.end(), head.begin()) && head[marks_at] != 0;
}

bool open_and_close(const std::string& path) {
  const std::lock_guard library(hdf5::library_mutex());
  hdf5::quiet_errors();
  try {
    return hdf5::open_left_file(path).close();
  } catch (const hdf5::Failure&) {
    return false;
  }
}

}  // namespace

bool close_killed_end(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  // marked once more behind the lock: the writer may have closed the file meanwhile
  const bool mine = is_marked(file) && flock(file, LOCK_EX | LOCK_NB) == 0 && is_marked(file);
  const bool closed = mine && open_and_close(path);
  close(file);
  return closed;
}

}  // namespace gem
