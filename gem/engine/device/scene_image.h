// Lays a field out as a device scene and reads it back: the host's side of device_scene.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gem/engine/device/scene.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// How much a scene's memory holds.
struct SceneSizes {
  std::int32_t bodies = 0, large_bodies = 0, vertices = 0;
  std::int32_t rows = 0;           // places in the rows of all bodies; grows on demand
  std::int32_t platform_rows = 0;  // places in the platform's row; the same
  std::int32_t samples = 0;        // time steps in the ring
  std::int32_t blocks = 1;         // that work on the scene
  std::int32_t phase_blocks = 1;   // that work on it where a launch makes one phase
  bool coupled = false;
  std::size_t momentum_coefficients = 0;  // numbers
  bool phases = true;                     // a launch may make one phase of it
};

SceneSizes scene_sizes(const FieldState& f);

/// The three parts of a scene's memory. Each function points the scene's arrays into the memory at `base` and returns
/// the bytes needed; a null base only measures.
std::size_t place_field(DeviceScene& s, const SceneSizes& sizes, std::byte* base);
std::size_t place_list(DeviceScene& s, const SceneSizes& sizes, std::byte* base);
std::size_t place_rings(DeviceScene& s, const SceneSizes& sizes, std::byte* base);

/// What a scene keeps for all time steps, without its arrays.
DeviceScene scene_constants(const FieldState& f, double event_speed);

/// Writes the field as it stands at the start of `step`; `s` has its field memory on the host.
void write_field(const FieldState& f, std::int64_t step, const DeviceScene& s);

/// Coupled: what the points carried, by ascending bodies, as an engine saves it, and back.
std::vector<CarriedMemory> carried_memory(const EngineState& state);
void save_memory(std::vector<CarriedMemory> carried, EngineState& state);

/// Takes over the state at rest.
void read_state(const BodyState* state, FieldState& f);

/// Appends the rings of a call: samples and quality of its time steps, and its events.
void append_log(const FieldState& f, const DeviceScene& rings, const DeviceStatus& status, int blocks, StepLog& log);

}  // namespace gem
