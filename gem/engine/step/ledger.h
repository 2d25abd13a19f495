// The books of a run: momentum, angular momentum and energy by channel.
#pragma once

#include <array>
#include <cstddef>

#include "gem/base/vec2.h"

namespace gem {

/// Where momentum and energy come from or go to.
enum class Channel : std::size_t {
  impact,         ///< normal impulses of contacts
  friction,       ///< tangential impulses of contacts
  elastic,        ///< elastic static stress
  repair,         ///< position repair: moves bodies, adds no velocity
  drag,           ///< current on the floes
  mooring,        ///< mooring damping; the spring's energy is part of the total
  platform_drag,  ///< water on the platform
  retired,        ///< floes that left past the retire line
  count
};

const char* channel_name(Channel channel);

/// Momentum [N s], angular momentum about the world origin [N m s] and energy [J].
struct Quantity {
  Vec2 momentum;
  double angular_momentum = 0.0;
  double energy = 0.0;
};

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
