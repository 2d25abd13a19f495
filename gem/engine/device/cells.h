// Plain records that a device scene consists of: bodies, pairs, contacts, and what is recorded of them.
#pragma once

#include <cstdint>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/pair_event.h"
#include "gem/engine/step/step_constants.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// What the pairs of a body read of it, in one line of memory.
struct alignas(128) BodyCell {
  Vec2 position;  // at the start of the time step [m]
  Rotation rotation;
  double turn_travel = 0.0;  // sum of the absolute angles turned so far [rad]
  double radius = 0.0;       // [m]
  std::int32_t vertex_begin = 0;
  std::int16_t vertex_count = 0;
  BodyKind kind = BodyKind::floe;
  std::uint8_t active = 0;
  Vec2 velocity;                                                      // after the solo events of the time step [m/s]
  double spin = 0.0;                                                  // [rad/s]
  double inverse_mass = 0.0, inverse_inertia = 0.0, thickness = 0.0;  // [1/kg], [1/(kg m2)], [m]
};

/// What only the thread that moves a body reads.
struct alignas(128) BodyMotion {
  double mass = 0.0, inertia = 0.0;    // [kg], [kg m2]
  double drag = 0.0, spin_drag = 0.0;  // as in Bodies
  Vec2 path_correction;                // exact path under drag minus velocity x dt [m]
  double angle_correction = 0.0;       // the same for the angle [rad]
  // the row of the body: one entry for each near body, by ascending id
  std::int32_t row_begin = 0, row_count = 0;
  std::int32_t lower_count = 0;  // entries of bodies with a lower id
  // the straight path that the list assumes: state when the list was built
  Vec2 trajectory_position, trajectory_velocity;  // [m], [m/s]
  double trajectory_turned = 0.0;                 // BodyCell::turn_travel then [rad]
};

/// A body's motion after the pair events of the last time step.
struct BodyAfter {
  Vec2 velocity;      // [m/s]
  double spin = 0.0;  // [rad/s]
};

/// The state of the platform between the two halves of its time step.
struct PlatformCell {
  Vec2 mid_position;  // after the first half [m]
  Vec2 velocity;      // after the last half that was made [m/s]
  double spin = 0.0;  // the same [rad/s]; DeviceScene::after has the spin after the pair events
  Quantity mooring_force;
  Vec2 mooring_before, drag_before;  // impulses summed since the start of the run, at the start of the time step [N s]
  // the rows of its pieces, which stand one after another
  std::int32_t row_begin = 0, row_count = 0;
  LineSet broken = 0;  // lines of the mooring
};

/// A near pair; A has the lower id.
struct PairCell {
  std::int32_t a = 0, b = 0;
  std::int32_t row_a = 0, row_b = 0;  // indices of its entries in the rows of a and b
  SeparatingAxes axes;
  // at the last narrow phase of the pair
  Vec2 offset;
  double turned_a = 0.0, turned_b = 0.0;
};

/// The last narrow phase of a pair, kept while the next list is built.
struct PairAxes {
  SeparatingAxes axes;
  Vec2 offset;
  double turned_a = 0.0, turned_b = 0.0;
};

/// A range of entries in the array of rows.
struct RowPlace {
  std::int32_t begin = 0, count = 0;
};

/// A pair that the narrow phase has to check, with the data for that.
struct CandidatePair {
  std::int32_t pair = 0;
  std::int32_t vertex_a = 0, vertex_b = 0;
  std::int16_t count_a = 0, count_b = 0;
  Vec2 offset;
  Rotation rotation_a, rotation_b;
  double moved = 0.0;  // most that a point of one body moved against the other body since the last narrow phase [m]
};

/// A pair that touches, passed from the narrow phase to the contact events.
struct TouchingPair {
  std::int32_t pair = 0;
  std::int32_t first_point = 0;  // coupled: index of its first point among those of its block
  ContactGeometry geometry;
};

/// Stamps of the time step that last wrote `entry` and `work` of a row entry. Older stamps mark stale data.
struct RowStamp {
  std::int32_t entry = -1, work = -1;
};

/// What a contact does to one body, for each of its points.
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

/// A floe in a cell of the grid.
struct GridFloe {
  ListBox box;
  Vec2 velocity;
  std::int32_t body = 0;
};

/// Extremes over all floes as ordered integers, and counters. All are zero before a list is built.
struct ListCounters {
  std::uint64_t extreme[9];  // maxima of -x, -y, x, y, the same of the velocity, radius
  std::int32_t floes, rows, pairs, placed;
  std::int32_t complete;                    // 1: the list is complete
  std::int32_t points, taken_points;        // coupled: of this time step; taken: assigned to a block
  std::int32_t candidates, touching_count;  // of this time step; only on the phases route
  std::int32_t arrived;                     // blocks that have moved their bodies; only on the phases route
  std::uint32_t residual_bits[3];           // coupled: bits of the residual; three judged iterations use them in turn
  std::uint32_t halo_overflow;              // coupled: 1: the halo of a block does not fit in shared memory
};

/// What one contact point does to the platform, to be added in order.
struct PlatformTerm {
  double part[7];  // velocity x, y, spin; ice impulse x, y, yaw; twist
};

/// An event of the platform, with all data of its record.
struct PlatformEventRecord {
  std::int64_t step = 0;
  Contact contact;
  Vec2 position_b, platform_position;
  Rotation rotation_a, rotation_b;
};

/// Quality of one time step, as one block sees it.
struct BlockQuality {
  std::uint64_t overlap = 0, share = 0;  // bits of the deepest overlap [m] and of the largest share, numbers >= 0
  std::int32_t contacts = 0;
  std::int32_t iterations = 0;
  double residual = 0.0, energy_created = 0.0;
  std::uint64_t complementarity = 0, cone_excess = 0;  // bits
};

/// The state of a body between two calls.
struct BodyState {
  Vec2 position;
  Rotation rotation;
  Vec2 velocity;
  double spin = 0.0;
  std::int64_t active = 0;
};

}  // namespace gem
