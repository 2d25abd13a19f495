// Paths and parts of checkpoint files.
#include "gem/run/checkpoint/checkpoint_path.h"

#include <unistd.h>

namespace gem {

std::string checkpoint_path(const std::string& run_file, std::uint64_t serial) {
  return run_file + (serial % 2 == 0 ? ".checkpoint-a" : ".checkpoint-b");
}

bool has_checkpoint(const std::string& run_file) {
  return access(checkpoint_path(run_file, 0).c_str(), F_OK) == 0 ||
         access(checkpoint_path(run_file, 1).c_str(), F_OK) == 0;
}

}  // namespace gem
