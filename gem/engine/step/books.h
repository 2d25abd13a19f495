// Opens, closes and reads the books of a host engine.
#pragma once

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Total momentum, angular momentum and energy (mooring spring included) of the active bodies.
Quantity total(const FieldState& f);

/// Continues saved books. If only their sums are known, these are stored with body 0.
void open_books(FieldState& f, const EngineState& state);

/// Returns the ledger: the books of all bodies summed in id order, and the current total `now`. The scales are the
/// largest seen so far, so that rounding does not look large in a step where all bodies are nearly at rest. `running`
/// keeps the scales and the start.
Ledger closed_books(const FieldState& f, Ledger& running);

/// The same for EngineState: the scales stay those of `running`.
Ledger saved_books(const FieldState& f, const Ledger& running);

/// Throws Error(numerical_stop) naming the first body whose state is not finite; `step` is for the message.
void check_finite(const FieldState& f, std::int64_t step);

/// Retires all floes past the retire line.
void retire(FieldState& f);

/// Properties of the bodies of a platform event at the time of the event.
struct EventBodies {
  CollisionMass mass_a, mass_b;
  Vec2 position_b;  // [m]
  Vec2 offset;      // from the platform's position at the start of the time step to the position of B [m]
  Outline outline_a, outline_b;
  CrushingIce ice;
};

/// The platform event of one contact. Its point is the impulse-weighted mean of the contact points; `time` in [s].
ContactEvent event_of(const Contact& contact, const EventBodies& bodies, double time);

/// Appends the floes that press on the platform to `log`, before they move: one row per contact.
void log_events(const FieldState& f, Contacts contacts, std::int64_t step, StepLog& log);

/// Impulses of mooring and water drag on the platform since t = 0 [N s].
struct PlatformImpulses {
  Vec2 mooring, drag;
};
PlatformImpulses platform_impulses(const FieldState& f);

/// Appends the platform's loads and the quality of the time step to `log`; `before` are the impulses up to the start of
/// the step.
void log_step(const FieldState& f, Contacts contacts, const PlatformImpulses& before, const StepQuality& quality,
              StepLog& log);

}  // namespace gem
