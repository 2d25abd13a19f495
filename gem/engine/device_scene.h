// One scene as it lies in the memory of a device: plain arrays, no owner. CudaScene allocates and fills them.
//
// Who writes what (a moment has two phases, a barrier after each):
//
// | array              | pairs phase, owner of the pair   | bodies phase, owner of the body          |
// | body, motion, after|                                  | position, velocity, rotation, course     |
// | pair               | axes and offset of its last look |                                          |
// | contact            | the contact, resolved            |                                          |
// | entry, work, stamp | both rows of the pair            |                                          |
// | books              |                                  | the body's own                           |
//
// A coupled moment has its iterations between the two phases; device_solver.h says who writes what there.
#pragma once

#include <cstdint>

#include "gem/engine/contact.h"
#include "gem/engine/coupled_point.h"
#include "gem/engine/engine.h"
#include "gem/engine/moment_constants.h"
#include "gem/engine/overlap_count.h"
#include "gem/engine/pair_event.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// What the pairs of a body need of it: one line of memory.
struct alignas(128) BodyCell {
  Vec2 position;  // at the start of the moment [m]
  Rotation rotation;
  double turn_travel = 0.0;  // sum of the angles turned so far, either way [rad]
  double radius = 0.0;       // [m]
  std::int32_t vertex_begin = 0;
  std::int16_t vertex_count = 0;
  BodyKind kind = BodyKind::floe;
  std::uint8_t active = 0;
  Vec2 velocity;      // after the solo events of the moment [m/s]
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
  Vec2 course_position, course_velocity;
  double course_turned = 0.0;
};

/// A body's motion after the pair events of the last moment.
struct BodyAfter {
  Vec2 velocity;      // [m/s]
  double spin = 0.0;  // [rad/s]
};

/// The platform between its two halves of a moment.
struct PlatformCell {
  Vec2 moved;           // position after the first half [m]
  Vec2 start_velocity;  // before the first half [m/s]
  Vec2 velocity;        // at the end of the last moment, or after the first half of the next [m/s]
  Quantity mooring_force;
  Vec2 mooring_before, drag_before;  // running impulses at the start of the moment [N s]
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

/// A pair that has to be looked at, with what the look needs.
struct LookItem {
  std::int32_t pair = 0;
  std::int32_t vertex_a = 0, vertex_b = 0;
  std::int16_t count_a = 0, count_b = 0;
  Vec2 offset;
  Rotation rotation_a, rotation_b;
  double moved = 0.0;  // the most that any point moved against the other body since the last look [m]
};

/// A pair that touches, on its way from the look to the event.
struct Touch {
  std::int32_t pair = 0;
  std::int32_t first_point = 0;  // coupled: its first point among those of its block
  ContactGeometry geometry;
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

/// Coupled: the points of a contact, as a place of a row sees them.
struct RowPoints {
  std::int32_t first = 0, count = 0;
};

/// Coupled: what the points of a pair carried at the end of a moment.
struct PairMemory {
  std::int32_t moment = -1;
  std::int32_t unused = 0;
  std::int32_t feature[2] = {-1, -1};
  PointImpulse<double> impulse[2] = {};
};

/// The same on its way to another list or to the host.
struct CarriedMemory {
  std::int32_t a = 0, b = 0;
  std::int32_t feature[2] = {-1, -1};
  PointImpulse<double> impulse[2] = {};
};

/// Coupled: where a contact point belongs.
struct alignas(16) PointCell {
  std::int32_t pair = 0, slot = 0;
  std::int32_t a = 0, b = 0;                  // bodies
  std::int32_t place_a = -1, place_b = -1;    // its places among the records of its bodies; -1: a fixed body has none
  std::int32_t room_a = -1, room_b = -1;      // the same in the fast memory of a block; -1: they do not stand there
  std::int32_t motion_a = -1, motion_b = -1;  // and where the motions of its bodies stand there
};

/// What a point gives to one body in a round: x, y, shift x, y, twist, turn.
struct alignas(32) PushRecord {
  float part[8];
};

/// The same by the base's impulses; part 6 is 1 where they are not all zero.
struct alignas(64) PushBase {
  double part[8];
};

/// What the additions of a round move a body by: x, y, shift x, y, spin, turn.
struct alignas(32) AddedMotion {
  float part[8];
};

/// Velocities and shifts of a body under the base's impulses, in the order of PushBase; part 6: points that acted.
struct alignas(64) SolvedMotion {
  double part[8];
};

/// Points of a body, good for one moment.
struct BodyPoints {
  std::int32_t moment = -1, count = 0;
};

/// A moving body with points; its records stand in a row, those of the points that have it as B first.
struct SolverEntry {
  std::int32_t body = 0;
  std::int32_t place = 0;            // of its first record
  std::int32_t room = -1;            // the same in the block's fast memory; -1: it does not stand there
  std::int32_t as_b = 0, count = 0;  // records
  float inverse_mass = 0.0F, inverse_inertia = 0.0F;
  std::int32_t rank = 0;  // among those bodies, by id
};

/// Coupled: geometry of all points and what the base has of them, number by number so that neighbouring threads read
/// neighbouring memory.
class PointTable {
 public:
  static constexpr int columns = 16;

  PointTable() = default;
  PointTable(double* data, std::int32_t capacity) : data_(data), capacity_(capacity) {}

  GEM_DEVICE GEM_INLINE PointGeometry<double> geometry(std::int32_t i) const {
    return {at(0, i), at(1, i), at(2, i), at(3, i),  at(4, i),  at(5, i), at(6, i),
            at(7, i), at(8, i), at(9, i), at(10, i), at(11, i), at(12, i)};
  }
  GEM_DEVICE GEM_INLINE PointImpulse<double> impulse(std::int32_t i) const { return {at(13, i), at(14, i), at(15, i)}; }
  GEM_DEVICE GEM_INLINE void set(std::int32_t i, const PointGeometry<double>& g) const {
    at(0, i) = g.normal_x, at(1, i) = g.normal_y;
    at(2, i) = g.lever_a_n, at(3, i) = g.lever_a_t, at(4, i) = g.lever_b_n, at(5, i) = g.lever_b_t;
    at(6, i) = g.nn, at(7, i) = g.tt, at(8, i) = g.nt;
    at(9, i) = g.target, at(10, i) = g.friction, at(11, i) = g.cap, at(12, i) = g.repair_target;
  }
  GEM_DEVICE GEM_INLINE void set(std::int32_t i, const PointImpulse<double>& p) const {
    at(13, i) = p.normal, at(14, i) = p.tangential, at(15, i) = p.repair;
  }

 private:
  GEM_DEVICE GEM_INLINE double& at(int column, std::int32_t i) const {
    return data_[static_cast<std::int64_t>(column) * capacity_ + i];
  }

  double* data_ = nullptr;
  std::int64_t capacity_ = 0;
};

struct HeldPoint;

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
  std::uint64_t position_low[2], position_high[2];  // low ones are kept as the highest of the opposite
  std::uint64_t velocity_low[2], velocity_high[2];
  std::uint64_t radius;
  std::int32_t floes, rows, pairs, placed;
  std::int32_t points, taken_points;  // coupled: of this moment, and those that blocks have taken to iterate
  std::uint32_t asked[2];             // coupled: bits of the residuals of two judged iterations in turn
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

/// Stretches along the field by which bodies are put in order.
constexpr std::int32_t spot_stretches = 512;

/// Near bodies that are kept from the count to the row; a body with more is looked at twice.
constexpr std::int32_t kept_near = 24;

/// Outlines up to this length are turned where they are looked at.
constexpr int desk_vertices = 12;

/// What the clock is read for: work, and in each phase the wait that ends it.
enum DeviceStage {
  stage_choose,
  stage_look,
  stage_resolve,
  stage_pairs_wait,
  stage_rows,
  stage_points,
  stage_frames,
  stage_iterations,
  stage_base,
  stage_shares,
  stage_solver_wait,
  stage_bodies,
  stage_bodies_wait,
  stage_list,
  stage_count
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
  std::int32_t carried = 0;                           // contacts in DeviceScene::carried
  std::int64_t stage_clocks[stage_count] = {};        // of the first thread, by DeviceStage
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
  BodyAfter* after = nullptr;
  Quantity* books = nullptr;  // by channel, then by body
  PlatformCell* platform = nullptr;
  Vec2 *corner = nullptr, *normal = nullptr;  // world axes, about the centroid; of outlines too long for a desk
  const Vec2 *vertex = nullptr, *body_normal = nullptr;  // body axes

  std::int32_t *row_other = nullptr, *row_pair = nullptr;
  RowStamp* stamp = nullptr;
  RowEntry* entry = nullptr;
  RowWork* work = nullptr;
  PairCell* pair = nullptr;
  Contact* contact = nullptr;       // by pair
  std::int32_t* touched = nullptr;  // pairs, in each block's own stretch
  Touch* touch = nullptr;           // the same

  const double* area = nullptr;  // of each body [m2]

  // coupled
  RowPoints* row_points = nullptr;
  PairMemory* memory = nullptr;      // by pair
  CarriedMemory* carried = nullptr;  // contacts of the moment before a list or a call ended, in no order
  PointCell* point = nullptr;
  double* point_numbers = nullptr;
  PointTable points;          // over point_numbers
  HeldPoint* held = nullptr;  // points that find no place in a thread's registers
  PushRecord* push = nullptr;
  PushBase* push_base = nullptr;
  AddedMotion* added = nullptr;    // by body; fixed bodies keep zeros
  SolvedMotion* solved = nullptr;  // the same
  BodyPoints* body_points = nullptr;
  // bodies as they stand along the field when a list is built, so that a block's bodies are each other's neighbours
  std::int32_t *spot = nullptr, *body_at = nullptr;                   // of a body, and back
  std::int32_t *spot_count = nullptr, *spot_begin = nullptr;          // of stretches along the field
  std::uint32_t *touched_bodies = nullptr, *touched_spots = nullptr;  // a bit for each moving body with points
  SolverEntry* solver_entry = nullptr;                                // of those bodies, by spot
  std::int32_t *bodies_before = nullptr, *spots_before = nullptr;     // each block's own: bits before each word of them
  PointCell* taken_point = nullptr;    // as the blocks have taken them; the numbers of points stand in this order
  std::int32_t* taken_list = nullptr;  // each block's own: points that it takes
  std::int32_t points_capacity = 0;
  double *given = nullptr, *answered = nullptr;  // by place among those bodies [J]
  double* work_created = nullptr;                // by body: of its contacts as B, or as A with a fixed B [J]
  double* partial_sum = nullptr;                 // each block's own

  ListBox* box = nullptr;
  std::int32_t *grid_cell = nullptr, *grid_count = nullptr, *grid_begin = nullptr;
  GridFloe* grid_floe = nullptr;
  std::int32_t* near_first = nullptr;   // for each body: the first near bodies found, sorted
  std::uint32_t* near_large = nullptr;  // for each large body: a bit for each body near it
  ListCounters* counters = nullptr;

  PlatformTerm* term = nullptr;      // two for each place in the platform's row
  EventRecord* row_event = nullptr;  // one for each place in the platform's row
  std::int64_t* row_event_moment = nullptr;
  PlatformMoment* sample = nullptr;       // ring
  std::int32_t* overlap_count = nullptr;  // of the call: by class, those of the shares after those of the depths
  BlockQuality* quality = nullptr;        // ring: by moment, then by block
  EventRecord* event = nullptr;           // ring
  BodyState* state = nullptr;
  DeviceStatus* status = nullptr;

  GEM_HD Quantity& book(Channel channel, std::int32_t i) const {
    return books[static_cast<std::int64_t>(channel) * bodies + i];
  }
};

}  // namespace gem
