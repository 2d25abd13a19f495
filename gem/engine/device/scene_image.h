// Writes a field to the memory of a device scene and reads it back: the host's side of scene.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gem/engine/device/scene.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Most time steps from t = 0 to the end of a run. The device counts them in 32 bits; stamps are kept apart from them.
constexpr std::int64_t device_steps_maximum = (std::int64_t{1} << 31) - 3;

/// Throws Error(usage) if a run of so many time steps, counted from t = 0, is too long for the device.
void check_device_steps(std::int64_t steps);

/// Writes the drive of `steps` time steps from `first` on, and of the one after them.
void write_drives(const DriveSchedule& drives, std::int64_t first, std::int64_t steps, Drive* to);

/// Returns a scene with its constants set and its arrays null.
DeviceScene scene_constants(const FieldState& f);

/// Writes the field as it is at the start of `step`. The field memory of `s` must be on the host.
void write_field(const FieldState& f, std::int64_t step, const DeviceScene& s);

/// Coupled: converts the impulses of contact points from and to the form that an engine saves, which is sorted by pair.
std::vector<CarriedMemory> carried_memory(const EngineState& state);
void save_memory(std::vector<CarriedMemory> carried, EngineState& state);

/// Copies the state that a call left into the field.
void read_state(const BodyState* state, FieldState& f);

/// The forces that a call recorded, ascending in (step, a, b).
std::vector<StepForce> forces_of_call(const DeviceScene& rings, const DeviceStatus& status);

/// Those of the time step after which `step` time steps are done.
std::vector<ContactForce> forces_of_last_step(const std::vector<StepForce>& forces, std::int64_t step);

/// Appends the rings of a call to `log`: its events and, if the scene wants samples, the samples, quality and overlaps
/// of its time steps.
void append_log(const FieldState& f, const DeviceScene& rings, const DeviceStatus& status, int blocks, StepLog& log);

}  // namespace gem
