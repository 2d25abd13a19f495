// Which runs of a sweep are meant: "3", "1-4" or "1-4,7".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gem {

/// Places from 0 to count - 1, ascending, each once; an empty text means all. Throws Error(usage) for anything that is
/// no list of whole numbers from 1 to count.
std::vector<std::size_t> parse_index_list(const std::string& text, std::size_t count);

}  // namespace gem
