// What the platform felt in a Box2D step, summed from the step's own contact impulses.
#pragma once

#include <vector>

#include "baseline_box2d/touches.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

namespace gem::baseline {

/// Impulse of everything that touches the platform, on it.
struct PlatformImpulse {
  Vec2 impulse;      // [N s]
  double yaw = 0.0;  // about its centre at the instant of the events [N m s]
};

/// Sum over all touches of the platform, fixed bodies included.
PlatformImpulse platform_impulse(const FieldState& f, const std::vector<Touch>& touches);

/// Appends one event for each floe that hit the platform: touches of several fixtures are one event, at the
/// impulse-weighted middle of their points. Needs velocities and outlines from before the step.
void log_events(const FieldState& f, const std::vector<Touch>& touches, double time, double event_speed,
                std::vector<ContactEvent>& events);

/// What the ice gave to the platform; the other members of the row are left for the time step's end.
PlatformStep ice_row(const FieldState& f, const std::vector<Touch>& touches);

}  // namespace gem::baseline
