// One scene as it lies in the memory of a device: plain arrays, no owner. CudaScene allocates and fills them.
//
// Who writes what (a moment has two phases, a barrier after each):
//
// | array              | pairs phase, owner of the pair   | bodies phase, owner of the body          |
// | body, motion       |                                  | position, velocity, rotation, course     |
// | outlines           |                                  | corners and normals in world axes        |
// | pair               | axes and offset of its last look |                                          |
// | contact            | the contact, resolved            |                                          |
// | entry, work, stamp | both rows of the pair            |                                          |
// | books              |                                  | the body's own                           |
#pragma once

#include <cstdint>

#include "gem/engine/contact.h"
#include "gem/engine/engine.h"
#include "gem/engine/moment_constants.h"
#include "gem/engine/pair_event.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// What the pairs of a body need of it: one line of memory.
struct alignas(128) BodyCell {
  Vec2 position;             // at the start of the moment [m]
  double turn_travel = 0.0;  // sum of the angles turned so far, either way [rad]
  double radius = 0.0;       // [m]
  std::int32_t vertex_begin = 0, vertex_count = 0;
  BodyKind kind = BodyKind::floe;
  std::uint8_t active = 0;
  std::int32_t row_begin = 0;  // its row: one place for each near body, ascending
  Vec2 velocity;               // after the solo events of the moment [m/s]
  double spin = 0.0;           // [rad/s]
  double inverse_mass = 0.0, inverse_inertia = 0.0, thickness = 0.0;
  Vec2 velocity_after;      // after the pair events of the last moment [m/s]
  double spin_after = 0.0;  // [rad/s]
};

/// What only the owner of a body needs.
struct alignas(64) BodyMotion {
  Rotation rotation;
  double mass = 0.0, inertia = 0.0, drag = 0.0, spin_drag = 0.0;
  Vec2 path_correction;
  double angle_correction = 0.0;
  std::int32_t row_count = 0;
  std::int32_t lower_count = 0;  // of them with a lower id
  std::int32_t turned = 0;       // in the last moment: its outline has to follow
  // the course that the list was built on
  Vec2 course_position, course_velocity;
  double course_turned = 0.0;
};

/// The platform between its two halves of a moment.
struct PlatformCell {
  Vec2 moved;     // position after the first half [m]
  Vec2 velocity;  // at the end of the last moment, or after the first half of the next [m/s]
  Quantity mooring_force;
  Vec2 mooring_before, drag_before;  // running impulses at the start of the moment [N s]
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

/// A pair that touches, on its way from the look to the event.
struct Touch {
  std::int32_t pair = 0;
  Separation axis;
  ChordSum sum;
};

/// Moments in which a place of a row was last written: never equal to a moment that left it alone.
struct RowStamp {
  std::int32_t entry = -1, work = -1;
};

/// What a contact does to one body.
struct RowEntry {
  std::int32_t count = 0;  // steps
  std::int32_t acted = 0;
  MotionStep step[2];
};

/// Energy that the points of a contact took, for the books of its body B.
struct RowWork {
  std::int32_t count = 0;
  SlotWork slot[2];
};

struct ListBox {
  Vec2 low, high;
};

/// Extremes over all floes as ordered whole numbers, and counters; all zero before a list is built.
struct ListCounters {
  std::uint64_t position_low[2], position_high[2];  // low ones are kept as the highest of the opposite
  std::uint64_t velocity_low[2], velocity_high[2];
  std::uint64_t radius;
  std::int32_t floes, rows, pairs, placed;
};

/// What the platform felt of one contact point, ready to be added in order.
struct PlatformTerm {
  double part[7];  // velocity x, y, spin; ice impulse x, y, yaw; twist
};

/// An event of the platform with all that its record is made of.
struct EventRecord {
  std::int64_t moment = 0;
  Contact contact;
  Vec2 position_b, platform_position;
  Rotation rotation_a, rotation_b;
};

/// Quality of one moment as seen by one block.
struct BlockQuality {
  std::uint64_t overlap = 0;  // bits of the deepest overlap, a number >= 0
  std::int32_t contacts = 0;
  std::int32_t unused = 0;
};

/// A body at rest between two calls.
struct BodyState {
  Vec2 position;
  Rotation rotation;
  Vec2 velocity;
  double spin = 0.0;
  std::int64_t active = 0;
};

/// Why a call came back.
enum class DeviceStop : std::int32_t { done, list_full, ring_full, not_finite };

struct DeviceStatus {
  std::int64_t moment = 0;
  std::int64_t list_moment = 0;  // at whose start the list was built
  std::int64_t builds = 0;
  std::int32_t list_valid = 0;
  std::int32_t half_way = 0;                          // the solo events of the next moment are done
  std::int32_t samples = 0;                           // in the ring since the call began
  std::int32_t events = 0;                            // the same
  std::int32_t rows_needed = 0, platform_needed = 0;  // places in all rows, in the platform's
  DeviceStop stop = DeviceStop::done;
};

struct DeviceScene {
  MomentConstants constants;
  double event_speed = 0.0;
  std::int64_t horizon = 1;  // longest life of a list [moments]
  std::int32_t bodies = 0, large_bodies = 0, rows_capacity = 0, platform_capacity = 0, grid_capacity = 0;
  std::int32_t events_capacity = 0;
  std::int32_t wants_events = 0, wants_samples = 0;

  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  Quantity* books = nullptr;  // by channel, then by body
  PlatformCell* platform = nullptr;
  Vec2 *corner = nullptr, *normal = nullptr;             // world axes, about the centroid
  const Vec2 *vertex = nullptr, *body_normal = nullptr;  // body axes
  const std::int32_t* vertex_body = nullptr;             // whose corner it is

  std::int32_t *row_other = nullptr, *row_pair = nullptr;
  RowStamp* stamp = nullptr;
  RowEntry* entry = nullptr;
  RowWork* work = nullptr;
  PairCell* pair = nullptr;
  Contact* contact = nullptr;                        // by pair
  std::int32_t *look = nullptr, *touched = nullptr;  // pairs, in each block's own stretch
  Touch* touch = nullptr;                            // the same

  ListBox* box = nullptr;
  std::int32_t *grid_cell = nullptr, *grid_count = nullptr, *grid_begin = nullptr, *grid_body = nullptr;
  std::uint32_t* near_large = nullptr;  // for each large body: a bit for each body near it
  ListCounters* counters = nullptr;

  PlatformTerm* term = nullptr;      // two for each place in the platform's row
  EventRecord* row_event = nullptr;  // one for each place in the platform's row
  std::int64_t* row_event_moment = nullptr;
  PlatformMoment* sample = nullptr;  // ring
  BlockQuality* quality = nullptr;   // ring: by moment, then by block
  EventRecord* event = nullptr;      // ring
  BodyState* state = nullptr;
  DeviceStatus* status = nullptr;

  GEM_HD Outline outline(const BodyCell& cell) const {
    return {corner + cell.vertex_begin, normal + cell.vertex_begin, cell.vertex_count};
  }
  GEM_HD Quantity& book(Channel channel, std::int32_t i) const {
    return books[static_cast<std::int64_t>(channel) * bodies + i];
  }
};

}  // namespace gem
