// One scene as it lies in the memory of a device: plain arrays, no owner. CudaScene allocates and fills them.
//
// Who writes what (a time step has two phases, a barrier after each):
//
// | array              | pairs phase, owner of the pair   | bodies phase, owner of the body          |
// | body, motion, after|                                  | position, velocity, rotation, course     |
// | pair               | axes and offset of its last look |                                          |
// | contact            | the contact, resolved            |                                          |
// | entry, work, stamp | both rows of the pair            |                                          |
// | books              |                                  | the body's own                           |
//
// A coupled time step has its iterations between the two phases; device_solver.h says who writes what there.
#pragma once

#include <cstdint>

#include "gem/engine/device/cells.h"
#include "gem/engine/solver/device_points_cells.h"
#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/solver/solver_workspace.h"
#include "gem/engine/step/overlap_count.h"

namespace gem {

/// Stretches along the field by which bodies are put in order.
constexpr std::int32_t sort_bins = 512;

/// Near bodies that are kept from the count to the row; a body with more is looked at twice.
constexpr std::int32_t kept_near = 24;

/// Outlines up to this length are turned where they are looked at.
constexpr int workspace_vertices = 12;

/// Threads of a block that makes one phase of a scene, a body for each, and how many of them look at one pair.
constexpr int phase_threads = 128, phase_lanes = 4;
/// Blocks that build lists, on one multiprocessor; threads that plan, one for a scene.
constexpr int list_blocks = 4, plan_threads = 512;
/// By phases a coupled scene is iterated by one cluster, of this size or smaller. Threads of its blocks, and the fast
/// memory that each takes: most of a multiprocessor's [bytes].
constexpr int largest_cluster = 16, solve_threads = 512;
constexpr std::size_t solve_shared_bytes = 200 * 1024;
/// As many as it has threads. Coupled scenes of more bodies are moved by whole time steps, which all blocks iterate.
constexpr std::int32_t most_cluster_bodies = largest_cluster * solve_threads;

/// What a scene that is moved phase by phase does in the time step that is planned; see device_phases.h.
enum class PhaseStep : std::int32_t { ended, begins, moves, moves_on_new_list };

/// Why a call came back.
enum class DeviceStop : std::int32_t { done, list_full, ring_full, not_finite };

struct DeviceStatus {
  std::int64_t step = 0;
  std::int64_t list_step = 0;  // at whose start the list was built
  std::int64_t horizon = 1;    // time steps that it was built for, or that the next one is
  std::int64_t builds = 0;
  std::int32_t list_valid = 0;
  std::int32_t half_way = 0;                          // the solo events of the next time step are done
  std::int32_t samples = 0;                           // in the ring since the call began
  std::int32_t events = 0;                            // the same
  std::int32_t carried = 0;                           // contacts in DeviceScene::carried
  std::int32_t barriers = 0;                          // between blocks, in the call
  std::int32_t rows_needed = 0, platform_needed = 0;  // places in all rows, in the platform's
  DeviceStop stop = DeviceStop::done;
  // of a scene that is moved phase by phase
  std::int32_t wanted = 0;   // time steps of the call
  std::int32_t touched = 0;  // contacts of the last time step whose work is not in the books
  std::int64_t visits = 0;   // coupled: of points by iterations, since the call began
  // how far any two bodies can have gone, one relative to the other, since the list was built [m], up to which time
  // step
  double clock = 0.0;
  std::int64_t clock_step = -1;
  std::uint64_t farthest = 0;  // bits of how far a body or its rim went in the last time step, against the drift [m]
  Vec2 drift;                  // a velocity near those of most bodies [m/s]
  PhaseStep phase_step = PhaseStep::ended;
};

struct DeviceScene {
  StepConstants constants;
  double event_speed = 0.0;
  std::int64_t horizon = 1;  // longest life of a list [time steps]
  std::int32_t bodies = 0, large_bodies = 0, rows_capacity = 0, platform_capacity = 0, grid_capacity = 0;
  std::int32_t events_capacity = 0;
  std::int32_t wants_events = 0, wants_samples = 0;
  std::int32_t phase_blocks = 0;  // that share a phase where a launch makes one

  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  BodyAfter* after = nullptr;
  Quantity* books = nullptr;  // by channel, then by body
  PlatformCell* platform = nullptr;
  Vec2 *corner = nullptr, *normal = nullptr;  // world axes, about the centroid; of outlines too long for a workspace
  const Vec2 *vertex = nullptr, *body_normal = nullptr;  // body axes

  std::int32_t *row_other = nullptr, *row_pair = nullptr;
  RowStamp* stamp = nullptr;
  RowEntry* entry = nullptr;
  RowWork* work = nullptr;
  PairCell* pair = nullptr;
  Contact* contact = nullptr;        // by pair
  std::int32_t* touched = nullptr;   // pairs, in each block's own stretch; by phases those of all blocks together
  TouchingPair* touching = nullptr;  // the same
  // of scenes that are moved phase by phase, by pair
  CandidatePair* candidate = nullptr;
  float* wake = nullptr;  // the pair sleeps while the clock is below [m]

  const double* area = nullptr;  // of each body [m2]

  // coupled
  const float* momentum_coefficients = nullptr;  // see carried_ahead()
  RowPoints* row_points = nullptr;
  PairMemory* memory = nullptr;      // by pair
  CarriedMemory* carried = nullptr;  // contacts of the time step before a list or a call ended, in no order
  PointCell* point = nullptr;
  double* point_numbers = nullptr;
  PointTable points;            // over point_numbers
  FloatQuad* loaded = nullptr;  // points between launches, and those that find no place in shared memory: see HeldTable
  PushRecord* push = nullptr;
  PushBase* push_base = nullptr;   // as many; in a round with halos twice as many NumberedPush stand there
  AddedMotion* added = nullptr;    // by body; fixed bodies keep zeros
  SolvedMotion* solved = nullptr;  // the same
  BodyPoints* body_points = nullptr;
  // bodies as they stand along the field when a list is built, so that a block's bodies are each other's neighbours
  std::int32_t *sorted_place = nullptr, *body_at = nullptr;            // of a body, and back
  std::int32_t *bin_count = nullptr, *bin_begin = nullptr;             // of stretches along the field
  std::uint32_t *touched_bodies = nullptr, *touched_sorted = nullptr;  // a bit for each moving body with points
  SolverWorkspace* solver_workspace = nullptr;                         // of each block, from launch to launch
  RoundsMade* progress = nullptr;                                      // of the scene, from launch to launch
  SolverEntry* solver_entry = nullptr;                                 // of those bodies, by sorted place
  std::int32_t *bodies_before = nullptr, *sorted_before = nullptr;  // each block's own: bits before each word of them
  PointCell* taken_point = nullptr;      // as the blocks have taken them; the numbers of points stand in this order
  std::int32_t* taken = nullptr;         // points as the blocks have taken them
  std::int32_t* taken_in_row = nullptr;  // the same by row, a body's from the place of its records on
  TakenPoints* taken_of = nullptr;       // by place among the moving bodies with points
  std::int32_t points_capacity = 0;
  std::int32_t push_capacity = 0;                // records of points
  double *given = nullptr, *answered = nullptr;  // by place among those bodies [J]
  double* work_created = nullptr;                // by body: of its contacts as B, or as A with a fixed B [J]
  double* partial_sum = nullptr;                 // each block's own

  RowPlace* last_row = nullptr;  // of each body, in the list before
  std::int32_t *last_other = nullptr, *last_pair = nullptr;
  PairAxes* last_axes = nullptr;  // by pair of the list before

  ListBox* box = nullptr;
  std::int32_t *grid_cell = nullptr, *grid_count = nullptr, *grid_begin = nullptr;
  GridFloe* grid_floe = nullptr;
  std::int32_t* near_first = nullptr;   // for each body: the first near bodies found
  std::uint32_t* near_large = nullptr;  // for each large body: a bit for each body near it
  ListCounters* counters = nullptr;

  PlatformTerm* term = nullptr;      // two for each place in the platform's row; where shared memory does not hold them
  EventRecord* row_event = nullptr;  // one for each place in the platform's row
  std::int64_t* row_event_step = nullptr;
  PlatformStep* sample = nullptr;         // ring
  std::int32_t* overlap_count = nullptr;  // of the call: by class, those of the shares after those of the depths
  BlockQuality* quality = nullptr;        // ring: by time step, then by block
  EventRecord* event = nullptr;           // ring
  BodyState* state = nullptr;
  DeviceStatus* status = nullptr;

  GEM_HD Quantity& book(Channel channel, std::int32_t i) const {
    return books[static_cast<std::int64_t>(channel) * bodies + i];
  }
};

}  // namespace gem
