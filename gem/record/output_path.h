// Whether a run file can be written at a path, asked before anything is computed.
#pragma once

#include <cstdint>
#include <string>

namespace gem {

/// Throws Error(file_system) if the path is a directory, exists (and not overwrite), or its folder is missing or does
/// not accept a test file. Leaves nothing behind.
void check_output_path(const std::string& path, bool overwrite);

/// A file that nobody else may write until it is let go: made, empty, or locked where it is to be replaced. One that
/// was made goes again with a claim that was not let go.
class OutputClaim {
 public:
  /// Throws Error(file_system) if the file exists (and not overwrite), cannot be made, or another process has it open
  /// and locked, as a run does with the file that it writes.
  OutputClaim(const std::string& path, bool overwrite);
  ~OutputClaim();
  OutputClaim(const OutputClaim&) = delete;
  OutputClaim& operator=(const OutputClaim&) = delete;

  /// Whether there was no such file before.
  bool made() const { return made_; }
  /// Just before the file is opened by a library that locks it too.
  void let_go();

 private:
  std::string path_;
  int file_ = -1;
  bool made_ = false;
};

/// Throws Error(file_system) if what --overwrite would replace is a case, notes or a manifest: neither HDF5 nor what a
/// kill left empty.
void check_replaceable(const std::string& path);

/// Bytes that may still be written beside `path`: free space, or less if the process has a file size limit.
std::uint64_t room_at(const std::string& path);

/// Path for messages: control characters escaped, so that a message stays one line.
std::string shown(const std::string& path);

}  // namespace gem
