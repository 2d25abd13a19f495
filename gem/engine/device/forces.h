// Records the forces between bodies after they moved, in any order: the host sorts them.
#pragma once

#include "gem/engine/device/workspace.h"
#include "gem/engine/step/step_force.h"

namespace gem {

/// Most contacts of one time step.
GEM_HD inline std::int32_t contacts_capacity(std::int32_t rows) { return rows / 2 + 1; }

/// Whether the call has to end before the ring of forces is too small. A time step is recorded in the next one, so two
/// more may come. Asked while the bodies move: nothing is recorded then.
GEM_DEVICE inline bool forces_fill_up(const DeviceScene& s) {
  return s.wants_forces == ForcesWanted::all &&
         s.forces_capacity - s.status->forces < 2 * contacts_capacity(s.rows_capacity);
}

/// Whether the time step before the present state is recorded. `last`: the call ends.
GEM_DEVICE inline bool records_forces(const DeviceScene& s, bool last) {
  return s.wants_forces == ForcesWanted::all || (last && s.wants_forces == ForcesWanted::last);
}

/// Records what a contact of time step `step` pressed with.
template <class Group>
GEM_DEVICE inline void note_force(const DeviceScene& s, Group& group, const Contact& contact, std::int64_t step) {
  const BodyCell &a = s.body[contact.a], &b = s.body[contact.b];
  if (!a.active || !b.active) return;
  ContactForce force;
  if (!force_of(contact, b.position, s.constants.dt, force)) return;
  const std::int32_t at = group.add(&s.status->forces, 1);
  if (at >= s.forces_capacity) return;  // see forces_fill_up(); the host would notice
  StepForce& record = s.force[at];
  record.step = step;
  record.force = force;
  record.arm_a = in_axes(a.position, a.rotation, force.point);
  record.arm_b = in_axes(b.position, b.rotation, force.point);
}

/// Records the contacts of the block in time step `step`.
template <class Group>
GEM_DEVICE inline void note_forces(const DeviceScene& s, Group& group, const Workspace& workspace, std::int64_t step) {
  for (std::int32_t k = group.thread(); k < group.shared().touched; k += group.threads())
    note_force(s, group, s.contact[s.touched[workspace.pairs.begin + k]], step);
}

}  // namespace gem
