// What this program was built from, for people who report a fault.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gem {

struct BuildIdentity {
  std::string version, commit, build_type, compiler;
  bool has_cuda = false;  // whether the CUDA engine is built in
  /// Name and version of each library: the loaded one for HDF5, else that of the build.
  std::vector<std::pair<std::string, std::string>> libraries;
};

BuildIdentity build_identity();

}  // namespace gem
