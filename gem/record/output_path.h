// Checks whether a run file can be written at a path, before anything is computed.
#pragma once

#include <cstdint>
#include <string>

namespace gem {

/// Throws Error(file_system) if the path is a directory or an existing file (and not overwrite), or if its folder is
/// missing or does not accept a test file. Leaves no file behind.
void check_output_path(const std::string& path, bool overwrite);

/// Reserves a file for this process: creates it empty, or locks an existing file that is to be replaced. The destructor
/// removes a created file unless let_go() was called.
class OutputClaim {
 public:
  /// Throws Error(file_system) if the file exists (and not overwrite), cannot be created, or is locked by another
  /// process, as by a run that writes it.
  OutputClaim(const std::string& path, bool overwrite);
  ~OutputClaim();
  OutputClaim(const OutputClaim&) = delete;
  OutputClaim& operator=(const OutputClaim&) = delete;

  /// Whether the file was created, that is, did not exist before.
  bool made() const { return made_; }
  /// Releases the file. To be called just before a library opens the file and locks it itself.
  void let_go();

 private:
  std::string path_;
  int file_ = -1;
  bool made_ = false;
};

/// Throws Error(file_system) if --overwrite would replace a file that is neither HDF5 nor empty: a case, notes or a
/// manifest. A kill may leave an empty file.
void check_replaceable(const std::string& path);

/// Bytes that can still be written in the folder of `path`: its free space, or the file size limit of the process if
/// that is less.
std::uint64_t room_at(const std::string& path);

/// Path for messages. Control characters are escaped, so that a message stays on one line.
std::string shown(const std::string& path);

}  // namespace gem
