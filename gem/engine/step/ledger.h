// The ledger of a run: momentum, angular momentum and energy by channel.
#pragma once

#include <array>
#include <cstddef>

#include "gem/events/quantity.h"

namespace gem {

/// What compliant contacts took and hold, each integrated by its own law; losses are > 0. `left` is what these do not
/// explain of the exact work of the contact forces: it falls with the substep.
struct ContactEnergy {
  double work = 0.0;      // of all contact forces on all bodies [J]
  double stored = 0.0;    // in springs, at present [J]
  double crushed = 0.0;   // [J]
  double damped = 0.0;    // below crushing [J]
  double friction = 0.0;  // [J]
  double load = 0.0;      // impulse through all contacts [N s]
  double softened = 0.0;  // part of it through corners with less than half the stiffness of their ice [N s]

  double left() const { return work + stored + crushed + damped + friction; }
};

/// Totals since t = 0. Contact channels hold the momentum that fixed bodies gave and the energy of the contacts
/// (negative: lost).
struct Ledger {
  Quantity start;  // total at t = 0: kinetic energy plus mooring spring
  Quantity now;    // total of the active bodies at the current time
  std::array<Quantity, static_cast<std::size_t>(Channel::count)> channel;
  Quantity mooring_force;       // momentum and angular momentum from the mooring spring
  double momentum_scale = 0.0;  // largest sum of mass x speed so far; residuals are relative to it [N s]
  double angular_scale = 0.0;   // scale of the angular momentum [N m s]
  double energy_scale = 0.0;    // largest energy term [J]
  ContactEnergy contact;        // compliant contacts
  double crack_energy = 0.0;  // of floes that split, 0 or less; the entry `impact` is what the contacts took beside [J]

  Quantity& operator[](Channel c) { return channel[static_cast<std::size_t>(c)]; }
  const Quantity& operator[](Channel c) const { return channel[static_cast<std::size_t>(c)]; }
};

/// Unexplained part of the ledger relative to its scales [-].
struct LedgerResidual {
  double momentum = 0.0;
  double angular_momentum = 0.0;
  double energy = 0.0;
};

LedgerResidual residual(const Ledger& ledger);

}  // namespace gem
