// Letters as lines, so that a film needs no font of the machine.
#pragma once

#include <vector>

#include "gem/base/vec2.h"

namespace gem::film {

/// Letters are 4 wide and 6 high; some go 2 below. Distance from one to the next: 6.
inline constexpr double letter_height = 6.0, letter_advance = 6.0;

/// The lines of a letter, y down from its upper edge. Those of `?` for a letter that is not known.
std::vector<std::vector<Vec2>> strokes_of(char letter);

}  // namespace gem::film
