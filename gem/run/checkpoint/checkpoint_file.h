// The two checkpoint files beside a run file. They are written in turn, so that one of them is always whole.
#pragma once

#include <ctime>
#include <string>
#include <vector>

#include "gem/run/checkpoint/checkpoint.h"
#include "gem/run/checkpoint/checkpoint_path.h"

namespace gem {

/// Writes a checkpoint to the file whose turn it is (by `checkpoint.serial`): under another name first, then renamed,
/// and on the disk when this returns. The file gets the time `taken` of its state. Throws Error(file_system); the
/// earlier checkpoint is still there then.
void write_checkpoint(const std::string& run_file, const Checkpoint& checkpoint, const std::timespec& taken);

/// What the checkpoint files of a run hold.
struct FoundCheckpoints {
  std::vector<Checkpoint> whole;  // the newest first
  std::string faults;             // why a file could not be used; empty: every file that exists is whole
};
FoundCheckpoints find_checkpoints(const std::string& run_file);

/// Removes the checkpoint files of a run, as far as there are any.
void remove_checkpoints(const std::string& run_file);

}  // namespace gem
