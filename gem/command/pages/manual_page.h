// The manual page of the program.
#pragma once

#include <string>

#include "gem/command/pages/command_text.h"

namespace gem {

/// The page gem(1) as roff, for `man`.
std::string manual_page(const CommandText& program, const std::string& version);

}  // namespace gem
