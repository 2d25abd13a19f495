// Drag of the current on many floes: the divisions and logarithms of several side by side.
#pragma once

#include <cstdint>

#include "gem/engine/step/field_state.h"

namespace gem {

/// kick_floe() for every floe of [begin, end): the same bits.
void kick_floes(FieldState& f, std::int64_t begin, std::int64_t end);

}  // namespace gem
