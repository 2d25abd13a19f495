// The output file of a run from its draft to its end: lock, name, room on the disk.
#pragma once

#include <cstdint>
#include <string>

namespace gem {

/// Whether a process holds the file, as a run that writes it, or a reader. A file that is not there is free.
bool is_claimed(const std::string& path);

/// Throws Error(file_system) if another process holds the file for longer than a second, as a run that writes it. A
/// file that is not there is free.
void check_unclaimed(const std::string& path);

/// The output file of this process, locked against other processes that write. It begins as a draft, `.NAME.new` beside
/// `path`, and gets its name when it can be read: a kill leaves a readable file or none. The destructor removes a
/// draft. Others can read the file; `--overwrite` and programs that write are refused while it is claimed.
class OutputClaim {
 public:
  /// Throws Error(file_system) if the file exists (and not overwrite), the draft cannot be created, or another process
  /// holds one of them, as a run that writes it; a reader may hold the file for up to a second.
  OutputClaim(const std::string& path, bool overwrite);
  ~OutputClaim();
  OutputClaim(const OutputClaim&) = delete;
  OutputClaim& operator=(const OutputClaim&) = delete;

  /// Path of the file now: of the draft, then of the output.
  const std::string& path() const { return published_ ? path_ : draft_; }
  /// Gives the draft its name. Returns the reason of a failure, or an empty text.
  std::string publish();
  bool published() const { return published_; }
  /// Hands all that was written to the disk. Returns the reason of a failure, or an empty text.
  std::string sync() const;
  /// Whether the path still leads to the file: it was not deleted, moved or replaced.
  bool in_place() const;
  /// Whether the file became shorter since the last call.
  bool is_cut();
  /// Reserves so many bytes behind the end of the file, so that writing cannot find the disk full. Returns whether they
  /// are there. On a file system without reservations it only asks for free space.
  bool reserve(std::uint64_t bytes) const;
  /// Gives back what was reserved and not used.
  void trim() const;
  /// Removes the file.
  void remove();

 private:
  void hold_existing(bool overwrite);
  void open_draft();

  std::string path_, draft_;
  bool overwrite_ = false;
  bool published_ = false;
  bool removed_ = false;
  int former_ = -1;  // the file that is to be replaced
  int file_ = -1;
  std::uint64_t size_ = 0;  // at the last look
};

}  // namespace gem
