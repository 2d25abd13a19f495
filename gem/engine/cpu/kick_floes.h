// Drag of the current on many floes, vectorised.
#pragma once

#include <cstdint>

#include "gem/engine/step/field_state.h"

namespace gem {

/// kick_floe() for every floe of [begin, end), with the same bits.
void kick_floes(FieldState& f, std::int64_t begin, std::int64_t end);

}  // namespace gem
