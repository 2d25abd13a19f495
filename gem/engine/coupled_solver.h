// The coupled resolution on the host: all events of one moment together, swept by colour to a stated residual.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/contact.h"
#include "gem/engine/engine.h"
#include "gem/engine/field_state.h"

namespace gem {

/// Keeps what lasts from moment to moment: the impulses of the last one.
class CoupledSolver {
 public:
  /// Resolves the prepared contacts (ascending in a, b); changes velocities, impulses and repair shifts.
  void resolve(FieldState& f, std::vector<Contact>& contacts, int threads, MomentQuality& quality);

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  const std::vector<Vec2>& impulses() const { return impulses_; }
  void restore(std::vector<std::uint64_t> keys, std::vector<Vec2> impulses);

 private:
  void warm_start(std::vector<Contact>& contacts) const;
  void keep(const std::vector<Contact>& contacts);
  void colour(const FieldState& f, const std::vector<Contact>& contacts);

  std::vector<std::uint64_t> keys_;
  std::vector<Vec2> impulses_;              // normal, tangential
  std::vector<std::uint64_t> used_;         // per body: colours taken
  std::vector<std::int32_t> order_;         // contact indices, colour by colour
  std::vector<std::int32_t> colour_begin_;  // into order_
  std::vector<std::uint8_t> colour_of_;
};

}  // namespace gem
