// The energy that contacts gave, over what they took plus the largest kinetic energy of the run [-]. Both sums are over
// time steps by the sign of the net work of all contacts.
// With compliant contacts, which store energy and give it back, it is the largest energy that their books do not
// explain at any floe frame (ContactEnergy::left()), over what they took plus that kinetic energy.
//
// Fully inelastic contacts give nothing. The elastic stress of `independent` gives back part of what it took, a few
// parts in ten thousand. Doubtful above 0.01, bad above 0.1: speeds go with the root of the energy, so they are off by
// half a per cent and by five per cent in the mean, and by far more at the bodies that got it.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_energy(const RunMeasures& run) {
  const Criterion criterion = {
      "created_energy",
      0.01,
      0.1,
      percent_text,
      run.compliant
          ? "raise numerics.substeps, or shorten numerics.time_step_s"
          : "shorten numerics.time_step_s; use contact.solver = \"coupled\" and contact.friction_law = \"one_step\"",
      "the engine does not measure it with this solver"};
  const double all = run.energy_lost + run.energy_largest;
  const Occurred share = {all > 0.0 ? run.energy_created / all : run.energy_created};
  return judge(criterion, share,
               (run.compliant ? "the books of the contacts leave " : "contacts gave ") +
                   number_text(run.energy_created, 3) + " J" + (run.compliant ? " unexplained, " : ", ") +
                   percent_text(share.value) + " of what they took and the bodies had");
}

}  // namespace gem
