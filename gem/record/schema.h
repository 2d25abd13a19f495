// All datasets of a run file in one table: group, name, shape, type, unit and meaning.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/step/ledger.h"
#include "gem/field/bodies.h"
#include "gem/record/hits.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Version of the layout; attribute gem_schema.
inline constexpr const char* schema_version = "1";

/// Storage type of a dataset: IEEE 64 and 32 bit, signed 32 bit, unsigned 8 bit.
enum class Stored { f8, f4, i4, u1 };

/// One dataset. `dimensions` are names separated by blanks; `time` and `event` grow.
struct Column {
  std::string group;
  std::string name;
  std::string dimensions;
  Stored stored = Stored::f8;
  std::string units;
  std::string long_name;
  std::string flag_meanings;  // for u1: one word per value 0, 1, ...
};

/// Path of a column in the file.
inline std::string path_of(const Column& column) { return "/" + column.group + "/" + column.name; }

/// One sample of the platform. Forces and impulses act on the platform. SI units.
struct PlatformRow {
  double time = 0.0;
  Vec2 position;
  double yaw = 0.0;
  Vec2 velocity;
  double spin = 0.0;
  Vec2 ice_impulse;     // since the last sample [N s]
  Vec2 ice_force;       // ice_impulse over the sample interval [N]
  Vec2 ice_force_mean;  // trailing mean over output.force_window_s [N]
  Vec2 mooring_force;
  Vec2 drag_force;
  double ice_yaw_moment = 0.0;
  double contacts = 0.0;
};

/// Books and quality of the run at a floe frame. Maxima are over the interval since the last frame.
struct StatsRow {
  double time = 0.0;
  Ledger ledger;
  LedgerResidual residual;
  double kinetic_energy = 0.0;
  double contacts = 0.0;
  double iterations = 0.0;
  double closing_residual = 0.0;
  double maximum_overlap = 0.0;
  double maximum_depth = 0.0;
  double maximum_share = 0.0;
  double complementarity = 0.0;
  double cone_excess = 0.0;
  double energy_created = 0.0;
  OverlapCount overlap, overlap_share;  // of all time steps since the last row
  double active_floes = 0.0;
  double wall_time = 0.0;
  double sim_rate = 0.0;
  double steps = 0.0;
};

/// A force between two bodies at a floe frame. SI units.
struct ContactRow {
  double time = 0.0;
  ContactForce contact;
};

/// Floe frames in sequence: the value of floe i in frame n is at [n * floe_count + i].
struct FloeFrames {
  std::vector<double> time;
  std::vector<float> x, y, theta, vx, vy, omega;
  std::vector<float> active;
};

template <class Row>
struct RowColumn {
  Column column;
  std::function<double(const Row&)> value;
};

struct FloeColumn {
  Column column;
  std::vector<float> FloeFrames::*values;
};

/// A column of overlap counts by size class, for one interval.
struct CountColumn {
  Column column;
  OverlapCount StatsRow::*counts;
};

struct Slab;

/// A column of impulses on the sides of the platform.
struct SideColumn {
  Column column;
  std::vector<float> Slab::*values;
};

/// A column of the platform that only some runs have: with a value for each mooring line or thruster, or one value.
struct PartColumn {
  Column column;
  std::vector<double> Slab::*values;
};

/// A dataset that is known before the first time step.
struct ShapeColumn {
  Column column;
  std::function<std::vector<double>(const Bodies&)> values;
};

const std::vector<RowColumn<PlatformRow>>& platform_columns();
const std::vector<SideColumn>& side_columns();
/// Those that runs of this scene have.
std::vector<PartColumn> line_columns(const SceneDef& scene);
std::vector<PartColumn> thruster_columns(const SceneDef& scene);
/// Both.
std::vector<PartColumn> part_columns(const SceneDef& scene);
const std::vector<RowColumn<Hit>>& event_columns();
/// Of compliant contacts alone.
const std::vector<RowColumn<Hit>>& compliant_event_columns();
const std::vector<RowColumn<ContactRow>>& contact_columns();
/// Of floes that split.
const std::vector<RowColumn<SplitEvent>>& split_columns();
const std::vector<RowColumn<StatsRow>>& stats_columns();
/// The books' entry of runs whose floes may split.
const std::vector<RowColumn<StatsRow>>& crack_columns();
/// The books' entries of compliant contacts.
const std::vector<RowColumn<StatsRow>>& compliant_stats_columns();
const std::vector<CountColumn>& count_columns();
const std::vector<FloeColumn>& floe_columns();
std::vector<ShapeColumn> shape_columns(const SceneDef& scene);

/// All datasets of a run file of this scene, for documentation and checks.
std::vector<Column> schema(const SceneDef& scene);

/// Whether floes may split in this scene.
inline bool records_splits(const SceneDef& scene) { return scene.breakup.maximum_pieces > 0; }

/// Whether the contacts of this scene spring and crush in substeps.
inline bool is_compliant(const SceneDef& scene) { return scene.contact.solver == ContactSolver::compliant; }

/// Whether the platform of this scene is given as pieces.
inline bool has_pieces(const SceneDef& scene) {
  return scene.platform.present && scene.platform.outline == PlatformOutline::pieces;
}

/// Number of a body in files, where all pieces of the platform are body 0; negative numbers stay.
std::int32_t recorded_body(const Bodies& bodies, std::int32_t body);

/// First body of a kind. The order is: the platform or its pieces, fixed bodies, floes.
std::size_t first_fixed(const Bodies& bodies);
std::size_t first_floe(const Bodies& bodies);

}  // namespace gem
