// How large an island is, what kind that makes it, and which tolerance it has to meet.
#pragma once

#include <cstdint>

#include "gem/base/macros.h"

namespace gem {

/// Moving bodies, contact points and contacts of an island. A contact has up to two points.
struct IslandSize {
  std::int32_t bodies = 0, points = 0, contacts = 0;

  GEM_HD bool is_small() const { return bodies < fewest_of_a_chain; }
  /// Hardly more contacts than bodies: few loops. A row at a wall has one contact a body, a plug ahead of a
  /// platform 1.1 to 1.5, a jam two. Points say less: two bodies that meet with their faces have two.
  GEM_HD bool is_chain() const { return !is_small() && !has_loops(); }
  GEM_HD bool is_jam() const { return !is_small() && has_loops(); }
  /// Whether a floe may be locked among the others of a small island.
  GEM_HD bool may_lock() const { return is_small() && points > 2 * bodies + bodies / 4; }

  /// Tolerance of the velocities [m/s] from that of the case. Along a chain errors add up, and a few iterations more
  /// end a small island: both meet a fraction of it. In a jam that fraction would take five times the time, and change
  /// loads and places less than the time step does (bench/notebook.md, "Plugs are no chains").
  GEM_HD double tolerance(double of_case) const { return is_jam() ? of_case : of_case / 32.0; }

 private:
  static constexpr std::int32_t fewest_of_a_chain = 16;
  GEM_HD bool has_loops() const { return contacts > bodies + bodies / 16; }
};

}  // namespace gem
