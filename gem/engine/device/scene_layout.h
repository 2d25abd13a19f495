// How large the arrays of a device scene are, and where they stand in its memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/engine/device/scene.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Sizes of a scene's arrays.
struct SceneSizes {
  std::int32_t bodies = 0, non_floes = 0, vertices = 0;
  std::size_t piece_corners = 0;   // corners of a platform of several pieces
  std::int32_t rows = 0;           // entries in the rows of all bodies; grows on demand
  std::int32_t platform_rows = 0;  // entries in the rows of the platform; grows on demand
  std::int32_t samples = 0;        // time steps in the ring
  std::int32_t blocks = 1;         // most blocks that work on the scene
  std::int32_t phase_blocks = 1;   // blocks that work on it on the phases route
  bool coupled = false, splitting = false;
  std::size_t momentum_coefficients = 0;  // numbers
  bool phases = true;                     // the scene can take the phases route
  bool drives = false;                    // current or wind change during the run
  std::int32_t mooring_branches = 0, mooring_knots = 0;
  bool dp = false;                           // dynamic positioning
  ForcesWanted forces = ForcesWanted::none;  // most that calls want
};

/// Sizes for a field, with a first guess for the list; `samples` and `blocks` are left to the caller.
SceneSizes scene_sizes(const FieldState& f);

/// Adds the corners of pieces that are not made yet, and room for the forces that the case asks for.
void allow_for(const SceneDef& scene, SceneSizes& sizes);

/// The three parts of a scene's memory. Each function points the scene's arrays into the memory at `base` and returns
/// the bytes needed. With a null base it only computes the bytes.
std::size_t place_field(DeviceScene& s, const SceneSizes& sizes, std::byte* base);
std::size_t place_list(DeviceScene& s, const SceneSizes& sizes, std::byte* base);
std::size_t place_rings(DeviceScene& s, const SceneSizes& sizes, std::byte* base);

}  // namespace gem
