// What a device scene is made of: plain records of bodies, pairs, contacts and what is kept of them.
#pragma once

#include <cstdint>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/pair_event.h"
#include "gem/engine/step/step_constants.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// What the pairs of a body need of it: one line of memory.
struct alignas(128) BodyCell {
  Vec2 position;  // at the start of the time step [m]
  Rotation rotation;
  double turn_travel = 0.0;  // sum of the angles turned so far, either way [rad]
  double radius = 0.0;       // [m]
  std::int32_t vertex_begin = 0;
  std::int16_t vertex_count = 0;
  BodyKind kind = BodyKind::floe;
  std::uint8_t active = 0;
  Vec2 velocity;      // after the solo events of the time step [m/s]
  double spin = 0.0;  // [rad/s]
  double inverse_mass = 0.0, inverse_inertia = 0.0, thickness = 0.0;
};

/// What only the owner of a body needs.
struct alignas(128) BodyMotion {
  double mass = 0.0, inertia = 0.0, drag = 0.0, spin_drag = 0.0;
  Vec2 path_correction;
  double angle_correction = 0.0;
  // its row: one place for each near body, ascending
  std::int32_t row_begin = 0, row_count = 0;
  std::int32_t lower_count = 0;  // of them with a lower id
  // the course that the list was built on
  Vec2 trajectory_position, trajectory_velocity;
  double trajectory_turned = 0.0;
};

/// A body's motion after the pair events of the last time step.
struct BodyAfter {
  Vec2 velocity;      // [m/s]
  double spin = 0.0;  // [rad/s]
};

/// The platform between its two halves of a time step.
struct PlatformCell {
  Vec2 moved;     // position after the first half [m]
  Vec2 velocity;  // at the end of the last time step, or after the first half of the next [m/s]
  Quantity mooring_force;
  Vec2 mooring_before, drag_before;  // running impulses at the start of the time step [N s]
  std::int32_t row_begin = 0;        // as in its BodyMotion
};

/// A near pair; A is the lower id.
struct PairCell {
  std::int32_t a = 0, b = 0;
  std::int32_t row_a = 0, row_b = 0;  // its places in the rows of a and b
  SeparatingAxes axes;
  // as they were when the pair was last looked at
  Vec2 offset;
  double turned_a = 0.0, turned_b = 0.0;
};

/// A pair's last look, while the next list is built.
struct PairAxes {
  SeparatingAxes axes;
  Vec2 offset;
  double turned_a = 0.0, turned_b = 0.0;
};

/// A stretch of the rows.
struct RowPlace {
  std::int32_t begin = 0, count = 0;
};

/// A pair that has to be looked at, with what the look needs.
struct CandidatePair {
  std::int32_t pair = 0;
  std::int32_t vertex_a = 0, vertex_b = 0;
  std::int16_t count_a = 0, count_b = 0;
  Vec2 offset;
  Rotation rotation_a, rotation_b;
  double moved = 0.0;  // the most that any point moved against the other body since the last look [m]
};

/// A pair that touches, on its way from the look to the event.
struct TouchingPair {
  std::int32_t pair = 0;
  std::int32_t first_point = 0;  // coupled: its first point among those of its block
  ContactGeometry geometry;
};

/// Time steps in which a place of a row was last written: never equal to a time step that left it alone.
struct RowStamp {
  std::int32_t entry = -1, work = -1;
};

/// What a contact does to one body, point by point.
struct alignas(64) RowEntry {
  Vec2 velocity[2];    // [m/s]
  double spin[2];      // [rad/s]
  std::int32_t count;  // points
  std::int32_t acted;
};

/// Energy that the points of a contact took, for the books of its body B.
struct alignas(64) RowWork {
  SlotWork slot[2];
  std::int32_t count;
};

struct ListBox {
  Vec2 low, high;
};

/// A floe in its cell of the grid.
struct GridFloe {
  ListBox box;
  Vec2 velocity;
  std::int32_t body = 0;
};

/// Extremes over all floes as ordered whole numbers, and counters; all zero before a list is built.
struct ListCounters {
  std::uint64_t extreme[9];  // of -x, -y, x, y, those of velocities, radius
  std::int32_t floes, rows, pairs, placed;
  std::int32_t complete;                    // 1: the list is all there
  std::int32_t points, taken_points;        // coupled: of this time step, and those that blocks have taken to iterate
  std::int32_t candidates, touching_count;  // of this time step, of scenes that are moved phase by phase
  std::int32_t arrived;                     // the same: blocks that have moved their bodies
  std::uint32_t asked[3];                   // coupled: bits of the residuals of three judged iterations in turn
  std::uint32_t crowded;                    // coupled: 1: a block has no room for its halo
};

/// What the platform felt of one contact point, ready to be added in order.
struct PlatformTerm {
  double part[7];  // velocity x, y, spin; ice impulse x, y, yaw; twist
};

/// An event of the platform with all that its record is made of.
struct EventRecord {
  std::int64_t step = 0;
  Contact contact;
  Vec2 position_b, platform_position;
  Rotation rotation_a, rotation_b;
};

/// Quality of one time step as seen by one block.
struct BlockQuality {
  std::uint64_t overlap = 0, share = 0;  // bits of the deepest overlap and of the largest share, numbers >= 0
  std::int32_t contacts = 0;
  std::int32_t iterations = 0;
  double residual = 0.0, energy_created = 0.0;
  std::uint64_t complementarity = 0, cone_excess = 0;  // bits
};

/// A body at rest between two calls.
struct BodyState {
  Vec2 position;
  Rotation rotation;
  Vec2 velocity;
  double spin = 0.0;
  std::int64_t active = 0;
};

}  // namespace gem
