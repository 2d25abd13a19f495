// One scene in the memory of a device: plain arrays without an owner. CudaScene allocates and fills them.
//
// Who writes what in a time step of the resident route (a barrier follows each group of stages):
//
// | array               | pair stages, owner of the pair          | body stages, owner of the body            |
// |---------------------|-----------------------------------------|-------------------------------------------|
// | body, motion, after |                                         | position, velocity, rotation, corrections |
// | pair                | axes and offset of its narrow phase     |                                           |
// | contact             | the contact, resolved                   |                                           |
// | entry, work, stamp  | the entries of the pair in both rows    |                                           |
// | books               |                                         | those of the body                         |
//
// A coupled time step iterates between the two groups; device_solver.h says who writes what there.
#pragma once

#include <cstdint>

#include "gem/engine/device/cells.h"
#include "gem/engine/solver/device/device_points_cells.h"
#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/solver/solver_workspace.h"
#include "gem/engine/solver/splitting/island_memory.h"
#include "gem/engine/step/overlap_count.h"
#include "gem/geometry/piece_joints.h"

namespace gem {

/// Bins along the field by which bodies are sorted.
constexpr std::int32_t sort_bins = 512;

/// Near bodies of one body that the counting pass stores. A body that has more needs a second search.
constexpr std::int32_t kept_near = 24;

/// Most corners of an outline that is turned in the workspace. Longer ones are turned in the scene's memory.
constexpr int workspace_vertices = 12;

/// Threads of a block that makes one stage of a scene (a body for each), and threads that share one pair.
constexpr int phase_threads = 128, phase_lanes = 4;
/// Blocks per multiprocessor that build lists; threads that plan, one for each scene.
constexpr int list_blocks = 4, plan_threads = 512;
/// On the phases route, one cluster of blocks iterates a coupled scene. Largest number of its blocks, threads of a
/// block, and shared memory of a block, which is most of a multiprocessor's [bytes].
constexpr int largest_cluster = 16, solve_threads = 512;
constexpr std::size_t solve_shared_bytes = 200 * 1024;
/// Largest scene with the iteration "gradient", in bodies, for the phases route: the threads of the largest cluster.
/// Larger ones are moved by resident blocks, all of which iterate.
constexpr std::int32_t most_cluster_bodies = largest_cluster * solve_threads;

/// What a scene does in the planned time step on the phases route; see plan.h.
enum class PhaseStep : std::int32_t { ended, begins, moves, moves_on_new_list };

/// Why a call ended.
enum class DeviceStop : std::int32_t { done, list_full, ring_full, not_finite, solver_full };

/// Of which time steps of a call the forces between bodies are recorded.
enum class ForcesWanted : std::int32_t { none, last, all };

struct DeviceStatus {
  std::int64_t step = 0;
  std::int64_t list_step = 0;  // time step at whose start the list was built
  std::int64_t horizon = 1;    // planned life of the list in time steps; without a valid list: of the next one
  std::int64_t builds = 0;
  std::int32_t list_valid = 0;
  std::int32_t solo_events_done = 0;                  // the solo events of the next time step are done
  std::int32_t samples = 0;                           // time steps in the ring of this call
  std::int32_t events = 0;                            // platform events in the ring of this call
  std::int32_t forces = 0;                            // forces in the ring of this call
  std::int32_t carried = 0;                           // contacts in DeviceScene::carried
  std::int32_t barriers = 0;                          // grid barriers in this call
  std::int32_t rows_needed = 0, platform_needed = 0;  // entries of all rows, of those of the platform
  DeviceStop stop = DeviceStop::done;
  // the following only on the phases route
  std::int32_t wanted = 0;   // time steps of the call
  std::int32_t touched = 0;  // contacts of the last time step whose work is not in the books
  std::int64_t visits = 0;   // coupled: sum of points times iterations in this call
  // bound on how far two bodies have moved against each other since the list was built, valid at clock_step [m]
  double clock = 0.0;
  std::int64_t clock_step = -1;
  std::uint64_t farthest = 0;  // bits of the farthest way_of() of a body in the last time step [m]
  Vec2 drift;                  // a velocity near that of most bodies [m/s]
  PhaseStep phase_step = PhaseStep::ended;
};

struct DeviceScene {
  StepConstants constants;
  std::int64_t horizon = 1;  // longest life of a list [time steps]
  std::int32_t bodies = 0, non_floes = 0, rows_capacity = 0, platform_capacity = 0, grid_capacity = 0;
  std::int32_t events_capacity = 0, forces_capacity = 0;
  std::int32_t wants_events = 0, wants_samples = 0;
  ForcesWanted wants_forces = ForcesWanted::none;
  std::int32_t phase_blocks = 0;  // that share a stage, on the phases route

  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  BodyAfter* after = nullptr;
  Quantity* books = nullptr;  // by channel, then by body
  PlatformCell* platform = nullptr;
  Vec2 *corner = nullptr, *normal = nullptr;  // world axes, about the centroid; only outlines too long for a workspace
  const Vec2 *vertex = nullptr, *body_normal = nullptr;  // body axes
  const PieceCorner* piece_corner = nullptr;  // of the pieces of the platform, as `vertex`; null: it is one piece

  std::int32_t *row_other = nullptr, *row_pair = nullptr;
  RowStamp* stamp = nullptr;
  RowEntry* entry = nullptr;
  RowWork* work = nullptr;
  PairCell* pair = nullptr;
  Contact* contact = nullptr;        // by pair
  std::int32_t* touched = nullptr;   // pairs; each block has its own range; phases route: all share one
  TouchingPair* touching = nullptr;  // as `touched`
  // only on the phases route, by pair
  CandidatePair* candidate = nullptr;
  float* wake = nullptr;  // the pair sleeps while the clock is below [m]

  const double* area = nullptr;  // of each body [m2]
  // of the mooring; constants.events.moored.view shows them
  const MooringBranch* mooring_branch = nullptr;
  const CurveKnot* mooring_knot = nullptr;
  const DpLaw* dp_law = nullptr;  // constants.events.dp shows it
  DpState* dp = nullptr;          // null: no dynamic positioning
  DpState* dp_sample = nullptr;   // ring
  // of each time step of a call, and the one after it; null: the steady drive of the scene
  const Drive* drive = nullptr;

  // the following only for coupled contacts
  const float* momentum_coefficients = nullptr;  // see iteration_control.h
  const CrushingPowers* crushing = nullptr;      // of each body
  RowPoints* row_points = nullptr;
  PairMemory* memory = nullptr;      // by pair
  CarriedMemory* carried = nullptr;  // contacts of the time step before a list or call ended, in no order
  PointCell* point = nullptr;
  double* point_numbers = nullptr;
  PointTable points;            // over point_numbers
  FloatQuad* loaded = nullptr;  // points between launches, and those that do not fit in shared memory: see LoadedTable
  PushRecord* push = nullptr;
  PushBase* push_base = nullptr;   // as many; a round with halos keeps twice as many NumberedPush here
  AddedMotion* added = nullptr;    // by body; zeros for fixed bodies
  SolvedMotion* solved = nullptr;  // as `added`
  BodyPoints* body_points = nullptr;
  // order of bodies along the field when the list was built: the bodies of a block are neighbours
  std::int32_t *sorted_place = nullptr, *body_at = nullptr;  // place of a body in this order, and the body at a place
  std::int32_t *bin_count = nullptr, *bin_begin = nullptr;   // by bin along the field
  std::uint32_t *touched_bodies = nullptr, *touched_sorted = nullptr;  // a bit for each moving body with points
  SolverWorkspace* solver_workspace = nullptr;                         // of each block, from launch to launch
  RoundsMade* progress = nullptr;                                      // of the scene, from launch to launch
  SolverEntry* solver_entry = nullptr;  // of the moving bodies with points, by sorted place
  // of each block: the number of bits set before each word of touched_bodies and touched_sorted
  std::int32_t *bodies_before = nullptr, *sorted_before = nullptr;
  PointCell* taken_point = nullptr;      // in the order in which blocks iterate them; `points` has the same order
  std::int32_t* taken = nullptr;         // index in `point` of each, in the order of taken_point
  std::int32_t* taken_in_row = nullptr;  // index in `point`, by row; a body's begin at the place of its records
  TakenPoints* taken_of = nullptr;       // by index of solver_entry
  std::int32_t points_capacity = 0;
  std::int32_t push_capacity = 0;                                // records
  double *linear_energy = nullptr, *quadratic_energy = nullptr;  // by SolverEntry::rank [J]
  double* work_created = nullptr;  // by body: of its contacts as B, or as A with a fixed B [J]
  double* partial_sum = nullptr;   // of each block
  IslandMemory island;             // only with operator splitting

  RowPlace* last_row = nullptr;  // row of each body in the last list
  std::int32_t *last_other = nullptr, *last_pair = nullptr;
  PairAxes* last_axes = nullptr;  // by pair of the last list

  ListBox* box = nullptr;
  std::int32_t *grid_cell = nullptr, *grid_count = nullptr, *grid_begin = nullptr;
  GridFloe* grid_floe = nullptr;
  std::int32_t* near_first = nullptr;      // for each body: the first kept_near near bodies
  std::uint32_t* near_non_floe = nullptr;  // for each non-floe: a bit for each body near it
  ListCounters* counters = nullptr;

  // two for each entry of the rows of the platform; used where shared memory is too small
  PlatformTerm* term = nullptr;
  PlatformEventRecord* row_event = nullptr;  // one for each entry of the rows of the platform
  std::int64_t* row_event_step = nullptr;
  PlatformStep* sample = nullptr;         // ring
  std::int32_t* overlap_count = nullptr;  // of the call: depths by class, then shares by class
  BlockQuality* quality = nullptr;        // ring: by time step, then by block
  PlatformEventRecord* event = nullptr;   // ring
  StepForce* force = nullptr;             // ring, in no order
  BodyState* state = nullptr;
  DeviceStatus* status = nullptr;

  /// What drives the bodies in a time step, counted from the begin of the call.
  GEM_HD Drive drive_of(std::int32_t step) const { return drive ? drive[step] : steady_drive(constants.events); }

  /// Entries of the row of a body; of body 0: of the rows of all pieces of the platform.
  GEM_HD std::int32_t row_length(std::int32_t i, const BodyMotion& of_body) const {
    return i == 0 && constants.pieces > 1 ? platform->row_count : of_body.row_count;
  }

  GEM_HD Quantity& book(Channel channel, std::int32_t i) const {
    return books[static_cast<std::int64_t>(channel) * bodies + i];
  }
};

}  // namespace gem
