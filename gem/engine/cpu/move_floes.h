// Motion of many floes after the events: the divisions of several turns side by side.
#pragma once

#include <cstdint>

#include "gem/engine/step/field_state.h"

namespace gem {

/// drift_floe() and retire_floe() for every floe of [begin, end): the same bits. Returns whether all their states are
/// still made of numbers.
bool move_floes(FieldState& f, std::int64_t begin, std::int64_t end);

}  // namespace gem
