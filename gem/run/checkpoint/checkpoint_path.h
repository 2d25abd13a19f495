// Where the two checkpoint files of a run stand.
#pragma once

#include <cstdint>
#include <string>

namespace gem {

/// The file whose turn it is, by `checkpoint.serial`.
std::string checkpoint_path(const std::string& run_file, std::uint64_t serial);

/// Whether there is one, whole or not.
bool has_checkpoint(const std::string& run_file);

}  // namespace gem
