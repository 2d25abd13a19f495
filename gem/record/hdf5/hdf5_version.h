// The version of the HDF5 library that this process uses.
#pragma once

#include <string>

namespace gem::hdf5 {

/// For example "1.10.8".
std::string version();

}  // namespace gem::hdf5
