// What the tables of current, tide and wind say about a whole run.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// The drive of each time step of a run.
DriveSchedule drive_schedule(const SceneDef& scene);

/// The path of a ship in transit; without transit: none.
TransitPath transit_path(const SceneDef& scene);

/// The thrust of a ship in transit of the mass `mass` [kg]; of one that is towed: none.
ThrustLaw transit_thrust(const SceneDef& scene, double mass);

/// The drive at t = 0.
Drive drive_at_start(const SceneDef& scene);

/// Whether there is wind at any time.
bool has_wind(const SceneDef& scene);

/// Largest speed of the water, and of the air, at any time of the tables [m/s].
double largest_current(const SceneDef& scene);
double largest_wind(const SceneDef& scene);

/// Whether the direction of the current may change by more than a right angle at once: a tide or a table takes its
/// velocity through zero or close past it.
bool current_turns_back(const SceneDef& scene);

/// Largest speed at which current and wind together drive a floe [m/s]. Coriolis force and the turn of the drag only
/// turn the way through the water; a floe that starts at rest may be a few hundredths faster for a while.
double drive_speed(const SceneDef& scene);

/// Bounds of the velocities at which current and wind drive floes, with 0 [m/s].
struct VelocityBox {
  Vec2 low, high;
};
VelocityBox drive_velocities(const SceneDef& scene);

/// Largest speed to which the wind moves a platform from rest [m/s]; 0 without wind on it.
double platform_wind_speed(const SceneDef& scene);

}  // namespace gem
