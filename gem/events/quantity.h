// What the ledger counts: momentum, angular momentum and energy, by channel.
#pragma once

#include <cstddef>

#include "gem/base/vec2.h"

namespace gem {

/// Channel from which momentum and energy come.
enum class Channel : std::size_t {
  impact,         ///< normal impulses of contacts
  friction,       ///< tangential impulses of contacts
  elastic,        ///< elastic static stress
  repair,         ///< position repair: shifts bodies without changing velocities
  drag,           ///< current on the floes
  mooring,        ///< mooring damping; the energy of the spring is part of the total
  platform_drag,  ///< water on the platform
  retired,        ///< floes past the retire line
  count
};

/// Name of the channel in run files.
constexpr const char* channel_name(Channel channel) {
  constexpr const char* names[] = {"impact", "friction", "elastic",       "repair",
                                   "drag",   "mooring",  "platform_drag", "retired"};
  static_assert(sizeof names / sizeof names[0] == static_cast<std::size_t>(Channel::count));
  return names[static_cast<std::size_t>(channel)];
}

/// Momentum [N s], angular momentum about the world origin [N m s] and energy [J].
struct Quantity {
  Vec2 momentum;
  double angular_momentum = 0.0;
  double energy = 0.0;
};

/// Kinetic energy [J].
GEM_HD inline double kinetic_energy(double mass, double inertia, Vec2 velocity, double spin) {
  return 0.5 * mass * dot(velocity, velocity) + 0.5 * inertia * spin * spin;
}

/// Momentum, angular momentum and energy of one body.
GEM_HD inline Quantity quantity_of(double mass, double inertia, Vec2 position, Vec2 velocity, double spin) {
  const Vec2 momentum = mass * velocity;
  return {momentum, cross(position, momentum) + inertia * spin, kinetic_energy(mass, inertia, velocity, spin)};
}

/// Books what leaves with a body that is removed from the field.
GEM_HD inline void book_gone(Quantity& book, const Quantity& gone) {
  book.momentum -= gone.momentum;
  book.angular_momentum -= gone.angular_momentum;
  book.energy -= gone.energy;
}

}  // namespace gem
