// Takes the build apart and asks HDF5 for its version.
#include "gem/record/build_identity.h"

#include <gem_version.h>

#include <sstream>

#include "gem/record/hdf5/hdf5_version.h"

namespace gem {

BuildIdentity build_identity() {
  BuildIdentity identity{GEM_VERSION,  GEM_COMMIT,   GEM_BUILD_TYPE,
                         GEM_COMPILER, GEM_HAS_CUDA, {{"HDF5", hdf5::version()}}};
  std::istringstream libraries(GEM_LIBRARIES);
  for (std::string name, version; libraries >> name >> version;) identity.libraries.emplace_back(name, version);
  return identity;
}

}  // namespace gem
