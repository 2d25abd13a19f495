// How large an island is, what kind that makes it, and which tolerance it has to meet.
#pragma once

#include <cstdint>

#include "gem/base/macros.h"

namespace gem {

/// Moving bodies, contact points and contacts of an island. A contact has up to two points.
struct IslandSize {
  std::int32_t bodies = 0, points = 0, contacts = 0;

  GEM_HD bool is_small() const { return bodies < fewest_of_a_chain; }
  /// Hardly more contacts than bodies: few loops. A row at a wall has one contact a body, a plug ahead of a platform
  /// 1.1 to 1.5, a field that is pressed together two. Points would mislead: face on face, one contact has two.
  GEM_HD bool is_chain() const { return !is_small() && !has_loops(); }
  GEM_HD bool is_jam() const { return !is_small() && has_loops(); }
  /// Whether a floe may be locked among the others of a small island.
  GEM_HD bool may_lock() const { return is_small() && points > 2 * bodies + bodies / 4; }

  /// Tolerance of the velocities [m/s] from that of the case. Errors add up along a chain, and a small island is cheap:
  /// both must meet a thirty-second. In a jam that would cost far more, and change places and loads less than the time
  /// step does (bench/notebook.md, "Plugs are no chains"). A chain of more than 128 bodies has more, up to an eighth
  /// from 512 on: the force at its end has grown with its length, and single precision cannot meet less.
  GEM_HD double tolerance(double of_case) const {
    if (is_jam()) return of_case;
    const std::int32_t share = bodies < shortest_long_chain       ? shortest_long_chain
                               : bodies < 4 * shortest_long_chain ? bodies
                                                                  : 4 * shortest_long_chain;
    return of_case * share / (32.0 * shortest_long_chain);
  }

 private:
  static constexpr std::int32_t shortest_long_chain = 128;
  static constexpr std::int32_t fewest_of_a_chain = 16;
  GEM_HD bool has_loops() const { return contacts > bodies + bodies / 16; }
};

}  // namespace gem
