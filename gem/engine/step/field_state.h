// The moving state of a host engine: bodies, outlines in world axes, and books.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/step/ledger.h"
#include "gem/engine/step/step_constants.h"
#include "gem/field/bodies.h"
#include "gem/geometry/convex_contact.h"
#include "gem/geometry/piece_joints.h"

namespace gem {

/// Arrays have length bodies.count() unless stated otherwise.
struct FieldState {
  Bodies bodies;
  StepConstants constants;
  Drive drive;  // of the time step that begins or is being made; its engine sets it

  std::vector<Vec2> corner;  // outline corners in world axes relative to the centroid, indexed as bodies.vertex [m]
  std::vector<Vec2> normal;  // outward unit normals of the edges in world axes
  std::vector<Vec2> body_normal;          // outward unit normals of the edges in body axes
  std::vector<PieceCorner> piece_corner;  // of the pieces of the platform, indexed as bodies.vertex; of one piece: none
  std::vector<double> turn_travel;        // sum of the absolute angles turned so far [rad]

  std::vector<Vec2> path_correction;     // exact path under drag minus velocity x dt [m]
  std::vector<double> angle_correction;  // the same for the angle [rad]
  std::vector<std::uint8_t> struck;      // does not follow the exact drag path in this time step: see book_contact()
  std::vector<Vec2> repair_shift;        // position repair of this time step [m]
  std::vector<double> repair_turn;       // [rad]
  Vec2 platform_position;                // at the start of the time step [m]
  PlatformSpeed before_contacts;         // of the platform
  std::vector<CrushingPowers> crushing;  // coupled: of the bodies

  std::vector<float> momentum_coefficients;  // coupled: see momentum_coefficients()

  std::vector<Quantity>
      books;  // by channel, then by body; a contact's entries stand with body B, the platform's with body 0
  Quantity mooring_force;  // momentum from the mooring to the platform; its energy is not used
  Vec2 held_impulse;       // of this time step, from the ground to a fixed platform [N s]
  LineSet broken = 0;      // lines of the mooring
  DpState dp;              // dynamic positioning

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

/// Initial state of a run, or the state at a restart.
FieldState make_field_state(Bodies bodies, const StepConstants& constants);

}  // namespace gem
