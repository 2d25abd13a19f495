// Goes from the program's own path, so that an installation may be moved.
#include "gem/command/installed_files.h"

#include <system_error>

namespace gem {

std::filesystem::path installed_share() {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return {};
  const std::filesystem::path share = program.parent_path().parent_path() / "share" / "gem";
  return std::filesystem::is_directory(share / "cases", failed) ? share : std::filesystem::path();
}

}  // namespace gem
