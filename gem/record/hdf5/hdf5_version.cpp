// Asks the library, since a shared one may be newer than its header.
#include "gem/record/hdf5/hdf5_version.h"

#include <hdf5.h>

namespace gem::hdf5 {

std::string version() {
  unsigned major = 0, minor = 0, release = 0;
  if (H5get_libversion(&major, &minor, &release) < 0) return "unknown";
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace gem::hdf5
