// Opens, closes and reads the books of a host engine's field.
#pragma once

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Momentum, angular momentum and energy (mooring spring included) of the active bodies.
Quantity total(const FieldState& f);

/// Goes on with the books of a saved ledger: its sums stand with body 0.
void open_books(FieldState& f, const Ledger& ledger);

/// The ledger with every body's own books summed in id order, and `now`. The scales are the largest seen so far, so
/// that a time step at which everything happens to stand still does not make rounding look large; `running` remembers
/// them, and the start.
Ledger closed_books(const FieldState& f, Ledger& running);

/// Throws Error(numerical_stop) naming the first body whose state is no number; `step` names the place.
void check_finite(const FieldState& f, std::int64_t step);

/// Retires all floes past the retire line.
void retire(FieldState& f);

/// The bodies of a platform event at its instant.
struct EventBodies {
  CollisionMass mass_a, mass_b;
  Vec2 position_b;  // [m]
  Vec2 offset;      // from the platform's position at the start of the time step to B's [m]
  Outline outline_a, outline_b;
  CrushingIce ice;
};

/// The platform event of one contact, seen at the impulse-weighted middle of its points.
ContactEvent event_of(const Contact& contact, const EventBodies& bodies, double time);

/// Appends the platform's events, before the floes move: one row for each contact and time step.
void log_events(const FieldState& f, Contacts contacts, std::int64_t step, double event_speed, StepLog& log);

/// What mooring and water have given the platform since t = 0 [N s].
struct PlatformImpulses {
  Vec2 mooring, drag;
};
PlatformImpulses platform_impulses(const FieldState& f);

/// Appends what the platform felt; `before` are its impulses up to the start of the time step.
void log_step(const FieldState& f, Contacts contacts, const PlatformImpulses& before, const StepQuality& quality,
              StepLog& log);

}  // namespace gem
