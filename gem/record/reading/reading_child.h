// Reads files of strangers in a child process, because the HDF5 library may crash on a damaged or hostile file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gem {

/// Files that a child process reads.
struct ReadInChild {
  std::vector<std::string> files;
  bool timed = true;  // whether a limit of processor time ends the child; not for a server
};

/// The seconds of processor time that the files may cost, by their sizes; 0: no limit, since one is no plain file.
long processor_seconds(const ReadInChild& reading);

/// Forks. Returns nothing in the child, which does the work and ends as usual, within limits of memory and time, and
/// without a core file. Returns the child's exit code in the parent when the child has ended. Signals that ask for an
/// end are passed on. Where no child can be made the caller works itself: nothing is returned. Throws Error that names
/// the files if the child crashed (file_system) or was killed (resource_limit). Call it while there is one thread.
std::optional<int> left_to_child(const ReadInChild& reading);

/// Does the work in a child process first, whose output and exceptions are dropped, so that the caller can do the same
/// without a crash. Throws as left_to_child(). `seconds` of processor time; 0: as many as the files may cost.
void tried_in_child(const ReadInChild& reading, const std::function<void()>& work, long seconds = 0);

}  // namespace gem
