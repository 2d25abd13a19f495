// Where the files that came with the program are.
#pragma once

#include <filesystem>

namespace gem {

/// The folder share/gem beside the folder of the running program, wherever the whole was installed or moved to. Empty
/// if there is none, as for a program in its build folder.
std::filesystem::path installed_share();

}  // namespace gem
