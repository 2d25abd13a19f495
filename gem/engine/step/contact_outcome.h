// What became of a contact once the events of its time step are done: how well each point obeys the laws, what its
// impulses did to the energy, how deep it was. Worked out for each contact alone; entered in the order of the contacts.
#pragma once

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/contact_quality.h"
#include "gem/engine/step/field_state.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

struct PointOutcome {
  PointQuality quality;
  SlotWork work;
  double depth = 0.0;  // of the overlap at the start of the time step; 0: none [m]
  double share = 0.0;  // the same over the size of the smaller body [-]
  bool acted = false;
  bool touched = false;  // at the start, or carried an impulse
};

struct ContactOutcome {
  std::int32_t a = 0, b = 0;
  std::int32_t count = 0;
  PointOutcome point[2];
};

/// Velocities must be those after the events.
void find_outcome(const FieldState& f, const Contact& contact, ContactOutcome& outcome);

/// Enters a resolved contact in the books of its body B and marks its bodies as struck: independent, if it acted;
/// coupled, if it has points within reach.
void book_contact(FieldState& f, const Contact& contact, const ContactOutcome& outcome);

/// How many points touched or were pressed, how deep they were, and how well they obey the laws of contact; counts the
/// overlaps in the log. Outcomes are those of one time step, ascending in (a, b).
void note_outcomes(const FieldState& f, std::span<const ContactOutcome> outcomes, StepQuality& quality, StepLog& log);

}  // namespace gem
