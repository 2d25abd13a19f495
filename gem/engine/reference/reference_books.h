// Ledger, quality, events and platform samples of the reference engine.
#pragma once

#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem::reference {

/// Momentum, angular momentum and energy of body `i`.
Quantity quantity_of(const Bodies& bodies, std::size_t i);

/// Total of all active bodies, with the energy of the mooring.
Quantity total_of(const Rules& rules, const State& s);

/// Updates `now` and the scales of the ledger. Residuals are relative to the largest scales so far.
void close_ledger(const Rules& rules, State& s);

/// Thickness of the ice that crushes: the thinner floe. Platform and fixed bodies do not crush [m].
double crushed_thickness(const Bodies& bodies, std::int32_t a, std::int32_t b);

/// Velocity of B relative to A at a point [m/s].
Vec2 relative_velocity(const Bodies& bodies, const Touch& touch, const TouchPoint& point);

/// Impulse on B in world axes [N s].
Vec2 world_impulse(const Touch& touch, const TouchPoint& point);

/// Books the work of the contacts, and what fixed bodies and the yaw lock gave. Velocities are those after the
/// contacts, positions those before the motion.
void book_touches(State& s, const std::vector<Touch>& touches);

/// Overlap depth of each point, and how well it obeys the contact laws.
void judge_touches(const Bodies& bodies, const std::vector<Touch>& touches, StepQuality& quality, StepLog& log);

/// Appends the platform's events. Positions are those before the motion of the floes.
void log_platform_events(const Rules& rules, const State& s, const std::vector<Touch>& touches, StepLog& log);

/// Loads on the platform in the time step, and its state at the end.
PlatformStep platform_sample(const State& s, const std::vector<Touch>& touches);

}  // namespace gem::reference
