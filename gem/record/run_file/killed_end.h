// A run that was killed when all of it was written, and only the closing of its file was left.
#pragma once

#include <string>

namespace gem {

/// Such a file says that it is complete, and carries the mark that somebody writes it: other programs refuse to open
/// it. Removes the mark if nobody holds the file. Returns whether it did. The caller knows that the file is complete.
/// Does not throw: a file that cannot be mended stays as it is.
bool close_killed_end(const std::string& path);

}  // namespace gem
