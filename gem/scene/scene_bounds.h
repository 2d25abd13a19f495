// Bounds on speeds and floe widths that are known before the field is made.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// Initial speed of the floe's farthest corner about its centroid, from its spin [m/s].
double rim_speed(const FloeDef& floe);

/// Largest speed of the platform's free swing from its start state and in the wind [m/s]; 0 without a platform. The ice
/// can push the platform no faster than the ice moves.
double platform_speed_bound(const SceneDef& scene);

/// Largest speed at which points of two bodies may approach each other [m/s]: from the current and the wind, fixed
/// bodies, listed floes with the two largest rim speeds, and the platform's start state.
double closing_speed_bound(const SceneDef& scene);

/// Largest speed of any point in the initial state or in current and wind [m/s]: the scale of the residual and of the
/// contact margin.
double fastest_point(const SceneDef& scene);

/// Speed at which faces may close in one time step and count as contacts before they touch [m/s]; 0 where contacts are
/// found only once they overlap.
double speed_foreseen(const SceneDef& scene);

/// Longest time step in which bodies overlap by at most a tenth of the smallest floe before their contact is seen [s],
/// well before the contact normal can flip (an overlap of the width). `foreseen`: closing speed that is seen before
/// [m/s].
double longest_unseen_step(const SceneDef& scene, double foreseen);

/// Smallest width of any floe known before the field is made [m]; infinity without floes.
double smallest_floe_width(const SceneDef& scene);

}  // namespace gem
