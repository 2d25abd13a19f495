// Checks whether a run file can be written at a path, before anything is computed.
#pragma once

#include <cstdint>
#include <string>

namespace gem {

/// Throws Error(file_system) if the path is a directory or an existing file (and not overwrite), or if its folder is
/// missing or does not accept a test file. Leaves no file behind.
void check_output_path(const std::string& path, bool overwrite);

/// Throws Error(file_system) if --overwrite would replace a file that is neither HDF5 nor empty: a case, notes or a
/// manifest. A kill may leave an empty file.
void check_replaceable(const std::string& path);

/// Bytes that can still be written in the folder of `path`: its free space, or the file size limit of the process if
/// that is less.
std::uint64_t room_at(const std::string& path);

/// Path for messages. Control characters are escaped, so that a message stays on one line.
std::string shown(const std::string& path);

}  // namespace gem
