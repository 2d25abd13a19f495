// The list of runs given to --index: "3", "1-4" or "1-4,7".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gem {

/// Positions from 0 to count - 1, ascending, without repeats; an empty text means all. Throws Error(usage) unless the
/// text is a list of whole numbers from 1 to count.
std::vector<std::size_t> parse_index_list(const std::string& text, std::size_t count);

}  // namespace gem
