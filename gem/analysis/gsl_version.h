// The version of the GNU Scientific Library that this process uses.
#pragma once

#include <string>

namespace gem {

/// For example "2.7.1".
std::string gsl_library_version();

}  // namespace gem
