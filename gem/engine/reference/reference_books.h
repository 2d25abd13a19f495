// Ledger, quality, events and samples of the reference engine, from the bodies and touches of a time step.
#pragma once

#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem::reference {

/// Momentum, angular momentum and energy of body `i`.
Quantity quantity_of(const Bodies& bodies, std::size_t i);

/// The same of all active bodies, with the energy of the mooring.
Quantity total_of(const Rules& rules, const Bodies& bodies);

/// Brings `now` and the scales of the ledger up to date: what residuals are relative to is the largest seen so far.
void close_ledger(const Rules& rules, State& s);

/// Thickness of the ice that crushes: the thinner floe's; platform and fixed bodies do not crush [m].
double crushed_thickness(const Bodies& bodies, const Touch& touch);

/// Velocity of B against A at a point [m/s].
Vec2 relative_velocity(const Bodies& bodies, const Touch& touch, const TouchPoint& point);

/// Impulse on B in world axes [N s].
Vec2 world_impulse(const Touch& touch, const TouchPoint& point);

/// Enters the work of the contacts, and what fixed bodies and a lock of the yaw gave. Velocities are those after the
/// contacts, positions those before the motion.
void book_touches(State& s, const std::vector<Touch>& touches);

/// How well each point obeys the laws of contact, and how deep it is.
void judge_touches(const Bodies& bodies, const std::vector<Touch>& touches, StepQuality& quality, StepLog& log);

/// Appends the events on the platform. Positions are those before the motion of the floes.
void log_platform_events(const Rules& rules, const State& s, const std::vector<Touch>& touches, StepLog& log);

/// What the platform felt in the time step, and where it is at its end.
PlatformStep platform_sample(const State& s, const std::vector<Touch>& touches);

}  // namespace gem::reference
