// What the mooring of a scene says about a whole run.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// Tables of the mooring; empty for a linear one.
MooringTables mooring_tables(const SceneDef& scene);

/// Largest stiffness of the mooring in surge and sway at any offset [N/m].
double largest_mooring_stiffness(const SceneDef& scene);

/// Stiffness of the mooring along a unit vector where the platform rests at its anchor [N/m]; 0 where the mooring is
/// slack there, without a platform, and for a fixed one, which needs no mooring.
double mooring_stiffness_at_rest(const SceneDef& scene, Vec2 along = {1.0, 0.0});

/// Natural period of small swings along a unit vector at the start yaw, without damping and if nothing moves across it
/// [s]; 0 without mooring, and where it is slack at rest.
double natural_period(const SceneDef& scene, Vec2 along = {1.0, 0.0});

/// Tensions of the lines at their fairleads at t = 0 [N].
std::vector<double> line_tensions_at_start(const SceneDef& scene);

/// Largest speed of the platform's free swing from its start offset [m/s].
double mooring_swing_speed(const SceneDef& scene);

/// Largest speed that a steady `force` [N] in any direction gives to the platform at rest on a mooring that is not
/// linear [m/s].
double mooring_pushed_speed(const SceneDef& scene, double force);

/// What holds the platform, for labels: "tow" or "thrust" of a ship in transit, "thrusters", "ground" of a fixed one,
/// or "mooring". The force of each stands where that of a mooring does.
const char* holder_of(const SceneDef& scene);

/// Whether a mooring, thrusters or a tow can pull the platform. A fixed one needs none.
bool is_held(const SceneDef& scene);

}  // namespace gem
