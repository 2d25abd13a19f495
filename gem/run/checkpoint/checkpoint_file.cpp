#include "gem/run/checkpoint/checkpoint_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "gem/base/byte_stream.h"
#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

std::string draft_of(const std::string& path) { return path + ".tmp"; }

/// A file descriptor that closes itself.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags) : file_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~OpenFile() {
    if (file_ >= 0) ::close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return file_ >= 0; }
  bool write_all(const std::vector<std::byte>& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t part = ::write(file_, bytes.data() + done, bytes.size() - done);
      if (part < 0 && errno == EINTR) continue;
      if (part <= 0) return false;
      done += static_cast<std::size_t>(part);
    }
    return true;
  }
  void set_time(const std::timespec& time) const {
    const std::timespec both[2] = {time, time};
    futimens(file_, both);
  }
  /// Some file systems cannot wait for a folder: EINVAL.
  bool sync() const { return fsync(file_) == 0 || errno == EINVAL; }

 private:
  int file_;
};

bool write_draft(const std::string& draft, const std::vector<std::byte>& bytes, const std::timespec& taken) {
  const OpenFile file(draft, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open() || !file.write_all(bytes)) return false;
  file.set_time(taken);
  return file.sync();
}

bool sync_folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const OpenFile file(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  return file.is_open() && file.sync();
}

std::optional<Checkpoint> read_checkpoint(const std::string& path, std::string& faults) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  try {
    return checkpoint_of({first, first + text.size()});
  } catch (const ByteFault& fault) {
    faults += (faults.empty() ? "" : "; ") + shown(path) + ": " + fault.what();
    return std::nullopt;
  }
}

}  // namespace

void write_checkpoint(const std::string& run_file, const Checkpoint& checkpoint, const std::timespec& taken) {
  const std::string path = checkpoint_path(run_file, checkpoint.serial), draft = draft_of(path);
  if (write_draft(draft, checkpoint_bytes(checkpoint), taken) && std::rename(draft.c_str(), path.c_str()) == 0 &&
      sync_folder_of(path))
    return;
  const int fault = errno;
  unlink(draft.c_str());
  throw Error(ExitCode::file_system, "cannot write " + shown(path) + " (" + std::generic_category().message(fault) +
                                         "); the run goes on, but a kill would cost more of it; make room");
}

FoundCheckpoints find_checkpoints(const std::string& run_file) {
  FoundCheckpoints found;
  for (const std::uint64_t turn : {0, 1})
    if (auto one = read_checkpoint(checkpoint_path(run_file, turn), found.faults))
      found.whole.push_back(std::move(*one));
  if (found.whole.size() == 2 && found.whole[0].serial < found.whole[1].serial)
    std::swap(found.whole[0], found.whole[1]);
  return found;
}

void remove_checkpoints(const std::string& run_file) {
  for (const std::uint64_t turn : {0, 1}) {
    unlink(checkpoint_path(run_file, turn).c_str());
    unlink(draft_of(checkpoint_path(run_file, turn)).c_str());
  }
}

}  // namespace gem
