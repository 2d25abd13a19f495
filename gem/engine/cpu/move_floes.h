// Motion of many floes after the events, with vectorised turns.
#pragma once

#include <cstdint>

#include "gem/engine/step/field_state.h"

namespace gem {

/// drift_floe() and retire_floe() for every floe of [begin, end), with the same bits. Returns whether all states are
/// finite.
bool move_floes(FieldState& f, std::int64_t begin, std::int64_t end);

}  // namespace gem
