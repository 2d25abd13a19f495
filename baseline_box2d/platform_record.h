// The platform's record in a Box2D step, summed from the contact impulses of the step.
#pragma once

#include <vector>

#include "baseline_box2d/touches.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

namespace gem::baseline {

/// Impulse of all bodies that touch the platform, on the platform.
struct PlatformImpulse {
  Vec2 impulse;      // [N s]
  double yaw = 0.0;  // about its centre at the time of the events [N m s]
};

/// Sum over all touches of the platform, also with fixed bodies.
PlatformImpulse platform_impulse(const FieldState& f, const std::vector<Touch>& touches);

/// Appends one event for each floe that hit the platform. Touches of several fixtures are one event, at the
/// impulse-weighted mean of their points. Needs velocities and outlines from before the step.
void log_events(const FieldState& f, const std::vector<Touch>& touches, double time, std::vector<ContactEvent>& events);

/// The ice's part of a row; the other members are filled at the end of the time step.
PlatformStep ice_row(const FieldState& f, const std::vector<Touch>& touches);

}  // namespace gem::baseline
