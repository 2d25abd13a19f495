// The books of a run: momentum, angular momentum and energy by channel.
#pragma once

#include <array>
#include <cstddef>

#include "gem/events/quantity.h"

namespace gem {

/// Since t = 0. Contact channels hold what fixed bodies gave to momentum and what contacts took from energy (negative:
/// lost).
struct Ledger {
  Quantity start;  // total at t = 0: kinetic energy plus mooring spring
  Quantity now;    // total of the active bodies now
  std::array<Quantity, static_cast<std::size_t>(Channel::count)> channel;
  Quantity mooring_force;       // momentum and angular momentum given by the mooring spring
  double momentum_scale = 0.0;  // largest sum of mass x speed seen: what residuals are relative to [N s]
  double angular_scale = 0.0;   // the same for angular momentum [N m s]
  double energy_scale = 0.0;    // largest energy term [J]

  Quantity& operator[](Channel c) { return channel[static_cast<std::size_t>(c)]; }
  const Quantity& operator[](Channel c) const { return channel[static_cast<std::size_t>(c)]; }
};

/// What the books leave unexplained, relative to their scales.
struct LedgerResidual {
  double momentum = 0.0;
  double angular_momentum = 0.0;
  double energy = 0.0;
};

LedgerResidual residual(const Ledger& ledger);

}  // namespace gem
