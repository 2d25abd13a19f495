// The moving state of a host engine: the bodies, their outlines turned into world axes, and their books.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/step/ledger.h"
#include "gem/engine/step/step_constants.h"
#include "gem/field/bodies.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// Arrays of length bodies.count() unless said otherwise.
struct FieldState {
  Bodies bodies;
  StepConstants constants;

  std::vector<Vec2> corner;         // outlines in world axes about the centroid, as bodies.vertex
  std::vector<Vec2> normal;         // outward unit normals of the edges in world axes
  std::vector<Vec2> body_normal;    // the same in body axes
  std::vector<double> turn_travel;  // sum of the angles turned so far, either way [rad]

  std::vector<Vec2> path_correction;  // exact path of the drag minus velocity x dt [m]
  std::vector<double> angle_correction;
  std::vector<std::uint8_t> struck;  // leaves the path of its drag in this time step: see book_contact()
  std::vector<Vec2> repair_shift;    // position repair of this time step [m]
  std::vector<double> repair_turn;   // [rad]
  Vec2 platform_position;            // at the start of the time step [m]

  std::vector<float> momentum_coefficients;  // coupled: see carried_ahead()

  std::vector<Quantity> books;  // by channel, then by body: a contact's entries stand with its body B, the
                                // platform's own with body 0
  Quantity mooring_force;       // given by the mooring to the platform: no energy

  Quantity& book(Channel channel, std::size_t i) {
    return books[static_cast<std::size_t>(channel) * bodies.count() + i];
  }
  const Quantity& book(Channel channel, std::size_t i) const {
    return books[static_cast<std::size_t>(channel) * bodies.count() + i];
  }
  Outline outline(std::size_t i) const {
    const std::int32_t begin = bodies.vertex_begin[i];
    return {corner.data() + begin, normal.data() + begin, bodies.vertex_count(i)};
  }
};

/// State at t = 0 or at a restart.
FieldState make_field_state(Bodies bodies, const StepConstants& constants);

}  // namespace gem
