// The result of one contact after the events of its time step: how well each point obeys the laws, the work of its
// impulses, its overlap depth. Each contact is computed independently; the books are kept in the order of the contacts.
#pragma once

#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/contact_quality.h"
#include "gem/engine/step/field_state.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

struct PointOutcome {
  PointQuality quality;
  SlotWork work;
  double depth = 0.0;  // overlap depth at the start of the time step; 0: none [m]
  double share = 0.0;  // depth over the size (root of the area) of the smaller body [-]
  bool acted = false;
  bool touched = false;  // overlapped at the start of the step, or carried an impulse
};

struct ContactOutcome {
  std::int32_t a = 0, b = 0;
  std::int32_t count = 0;
  PointOutcome point[2];
};

/// Fills `outcome` for one contact. Velocities are those after the events.
void find_outcome(const FieldState& f, const Contact& contact, ContactOutcome& outcome);

/// Adds a resolved contact to the books of its body B and marks both bodies as struck. Independent: if it carried an
/// impulse. Coupled: if it has points within reach.
void book_contact(FieldState& f, const Contact& contact, const ContactOutcome& outcome);

/// Adds to `quality` the number of contact points, the largest overlaps and the largest violations of the contact laws;
/// counts the overlaps in `log`. The outcomes are those of one time step, ascending in (a, b). `work` is scratch
/// memory.
void note_outcomes(const FieldState& f, std::span<const ContactOutcome> outcomes, std::vector<double>& work,
                   StepQuality& quality, StepLog& log);

}  // namespace gem
