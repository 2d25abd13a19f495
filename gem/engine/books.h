// Opens, closes and reads the books of a host engine's field.
#pragma once

#include "gem/engine/contact.h"
#include "gem/engine/engine.h"
#include "gem/engine/field_state.h"

namespace gem {

/// Momentum, angular momentum and energy (mooring spring included) of the active bodies.
Quantity total(const FieldState& f);

/// The ledger with every body's own books summed in id order, and `now`. The scales are the largest seen so far, so
/// that a moment at which everything happens to stand still does not make rounding look large; `running` remembers
/// them.
Ledger closed_books(const FieldState& f, Ledger& running);

/// Throws Error(numerical_stop) naming the first body whose state is no number; `moment` names the place.
void check_finite(const FieldState& f, std::int64_t moment);

/// Retires the floes past the retire line and enters what they take along.
void retire(FieldState& f, Ledger& ledger);

/// How many points touched or were pressed, how deep they were at the start of the moment, and how well they obey the
/// laws of contact now that the events are done; counts the overlaps in the log. The velocities must still be those
/// after the events.
void note_contacts(const FieldState& f, Contacts contacts, MomentQuality& quality, MomentLog& log);

/// Appends the platform's events, before the floes move: one row for each contact and moment.
void log_events(const FieldState& f, Contacts contacts, std::int64_t moment, double event_speed, MomentLog& log);

/// Appends what the platform felt. `before` and `after` are the running ledgers around the moment.
void log_moment(const FieldState& f, Contacts contacts, const Ledger& before, const Ledger& after,
                const MomentQuality& quality, MomentLog& log);

}  // namespace gem
