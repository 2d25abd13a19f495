// Asks the library, since a shared one may be newer than its header.
#include "gem/analysis/gsl_version.h"

#include <gsl/gsl_version.h>

namespace gem {

std::string gsl_library_version() { return gsl_version; }

}  // namespace gem
