// Times on the command line.
#pragma once

#include <string>

namespace gem {

/// The time of a text such as "4680", "4680s", "78min" or "1.3h" [s]. Throws Error(usage) that names `flag` if it is no
/// such text or the number is negative.
double time_of_option(const std::string& flag, const std::string& text);

}  // namespace gem
