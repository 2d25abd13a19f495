// The interface of every engine: it advances a field in time and reports the loads on the platform.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/engine/contact_key.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/step/ledger.h"
#include "gem/engine/step/overlap_count.h"
#include "gem/events/compliant_contact.h"
#include "gem/field/bodies.h"
#include "gem/field/split_floes.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Loads on the platform in one time step, and its state at the end of the step. Impulses act on the platform.
struct PlatformStep {
  Vec2 position;  // [m]
  Rotation rotation;
  Vec2 velocity;                 // [m/s]
  double spin = 0.0;             // [rad/s]
  Vec2 ice_impulse;              // [N s]
  double ice_yaw_impulse = 0.0;  // about the platform's centre [N m s]
  Vec2 mooring_impulse;          // [N s]
  Vec2 drag_impulse;             // [N s]
  std::int32_t contacts = 0;     // contacts of the platform that carried an impulse
  LineSet broken = 0;            // lines of the mooring
};

/// One event on the platform. The normal points from the platform into the ice; the impulse acts on the ice.
struct ContactEvent {
  double time = 0.0;        // start of the time step [s]
  std::int32_t body_a = 0;  // the platform
  std::int32_t body_b = 0;
  Vec2 point;  // in world axes [m]
  Vec2 normal;
  double closing_speed = 0.0;       // before the event, impulse-weighted mean of the points [m/s]
  double impulse_normal = 0.0;      // [N s]
  double impulse_tangential = 0.0;  // along the normal turned left [N s]
  double effective_mass = 0.0;      // [kg]
  double peak_force = 0.0;          // crushing peak (Popov, closed form) for the closing speed [N]
  double largest_force = 0.0;       // compliant: largest normal force within the time step [N]
  double width = 0.0;               // chord; 0 for a corner contact without overlap [m]
  double growth = 0.0;              // chord growth with depth; 0: a flat contact [-]
  double depth = 0.0;               // overlap depth [m]
};

/// Force between two bodies that touch, mean over one time step. It acts on `b`; `a`, with the lower id, gets the
/// opposite.
struct ContactForce {
  std::int32_t a = 0, b = 0;
  Vec2 point;  // mean of the contact points, weighted by their normal impulses, at the end of the step [m]
  Vec2 force;  // in world axes [N]
};

/// A force of one time step, and its point as the two bodies see it at the end of that step.
struct StepForce {
  std::int64_t step = 0;  // time steps done before this one
  ContactForce force;
  Vec2 arm_a, arm_b;  // the point in the axes of a and b, from their centroids [m]
};

/// A floe that split at the end of a time step, or would have if there were room for its pieces.
struct SplitEvent {
  double time = 0.0;  // [s]
  FloeSplit split;
  Vec2 point, along;             // where the crack begins and its direction, in world axes
  double force = 0.0;            // of the contact along the crack, mean over breakup.load_time_s [N]
  double splitting_force = 0.0;  // that the floe bears [N]
  double energy = 0.0;           // of the crack [J]
};

/// Impulses of a contact since the start of a half load time (contact_loads.h).
struct ContactLoad {
  std::int32_t a = 0, b = 0;
  Vec2 impulse;         // on b, in world axes [N s]
  double weight = 0.0;  // sum of the magnitudes [N s]
  Vec2 arm_a, arm_b;    // contact points in the axes of a and b, times their weights [m N s]
};

/// The contacts of the last half and of the one that runs, each ascending in (a, b); and what splitting left since
/// t = 0.
struct LoadSums {
  std::vector<ContactLoad> before, now;
  double crack_energy = 0.0;  // of all cracks [J]
  std::int64_t full = 0;      // 1: a floe found no room for its pieces; no floe splits any more
};

/// How well the contacts of one time step were resolved.
struct StepQuality {
  std::int32_t contacts = 0;    // points that overlap at the start of the step or carry an impulse
  std::int32_t iterations = 0;  // of the coupled solver
  double residual = 0.0;  // largest velocity correction still due at a contact point after the last iteration [m/s]
  double maximum_overlap =
      0.0;                     // deepest overlap depth at the start of the time step; compliant: beyond crushed ice [m]
  double maximum_depth = 0.0;  // compliant: deepest overlap, with crushed ice [m]
  double maximum_share = 0.0;  // largest overlap depth over the size (root of the area) of the smaller body [-]
  // After the events, see contact_quality.h. NaN where not measured: `independent` time steps of the cuda engine.
  double complementarity = 0.0;  // largest violation of the normal contact law, as a speed [m/s]
  double cone_excess = 0.0;      // largest friction impulse beyond Coulomb's bound [N s]
  double energy_created = 0.0;   // net work of all contacts if > 0, else 0; a gain at one contact can hide in it [J]

  /// Keeps the worse value of each member.
  void worsen(const StepQuality& other) {
    contacts = std::max(contacts, other.contacts);
    iterations = std::max(iterations, other.iterations);
    residual = std::max(residual, other.residual);
    maximum_overlap = std::max(maximum_overlap, other.maximum_overlap);
    maximum_depth = std::max(maximum_depth, other.maximum_depth);
    maximum_share = std::max(maximum_share, other.maximum_share);
    complementarity = worse(complementarity, other.complementarity);
    cone_excess = worse(cone_excess, other.cone_excess);
    energy_created = worse(energy_created, other.energy_created);
  }

 private:
  /// The larger value; NaN if either is NaN.
  static double worse(double a, double b) { return a < b || b != b ? b : a; }
};

/// Filled by advance(): one entry of `platform` and `quality` per time step; an event for each floe that presses on the
/// platform in a time step, in order of time and body id.
struct StepLog {
  bool wants_events = true;
  bool wants_forces = false;
  std::vector<PlatformStep> platform;
  std::vector<StepQuality> quality;
  std::vector<ContactEvent> events;
  std::vector<DpState> dp;  // as `platform`, only with dynamic positioning
  std::vector<SplitEvent> splits;
  std::vector<StepForce> forces;  // if wanted, of engines that tell contact_forces(); ascending in (step, a, b)
  OverlapCount overlap;           // depth of every overlap at the start of every time step [m]
  OverlapCount overlap_share;     // overlap depth over the size (root of the area) of the smaller body [-]
  void clear() {
    platform.clear();
    quality.clear();
    events.clear();
    dp.clear();
    splits.clear();
    forces.clear();
    overlap = {};
    overlap_share = {};
  }
};

/// All state that a run needs to continue with the same bits.
struct EngineState {
  std::int64_t step = 0;
  Bodies bodies;
  Ledger ledger;                // its scales are those of the last call of ledger()
  std::vector<Quantity> books;  // by channel, then by body, as FieldState::books; empty: only their sums are known
  std::vector<std::uint64_t> impulse_key;  // points of `coupled`: contact_key(), ascending by pair
  std::vector<PointMemory> impulse_value;
  LineSet broken = 0;                          // lines of the mooring
  DpState dp;                                  // dynamic positioning
  std::vector<std::uint64_t> corner_key = {};  // compliant: corners that overlap: contact_key(), ascending
  std::vector<CornerMemory> corner_value = {};
  std::int64_t substeps = 0;  // compliant: of a time step
  LoadSums loads = {};        // of floes that may split
};

/// What corners of compliant contacts remember, as EngineState::corner_key and corner_value. Empty without them.
struct KeptCorners {
  std::span<const std::uint64_t> key;
  std::span<const CornerMemory> value;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual std::string name() const = 0;
  /// How contacts are resolved, for the record. Empty: as contact.solver of the scene says.
  virtual std::string method() const { return {}; }
  /// The residual at which the iterations of `coupled` end [m/s]; NaN: it does not iterate to one.
  virtual double asked_residual() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// The accelerator it runs on, for the run file. Empty: none.
  virtual std::string device() const { return {}; }
  /// Advances the field by `steps` time steps and appends to `log`. Throws Error(numerical_stop) if the state is not
  /// finite. After any exception the engine needs restore() before it can advance again.
  virtual void advance(std::int64_t steps, StepLog& log) = 0;
  /// Time steps done since t = 0; the time is step() * numerics.time_step_s.
  virtual std::int64_t step() const = 0;
  /// State after the last time step.
  virtual const Bodies& bodies() = 0;
  /// The ledger since t = 0.
  virtual Ledger ledger() = 0;
  /// Lines of the mooring that have broken.
  virtual LineSet broken_lines() const { return 0; }
  /// Dynamic positioning after the last time step; null without it.
  virtual const DpState* dp_state() const { return nullptr; }
  /// What the corners of compliant contacts remember after the last time step.
  virtual KeptCorners kept_corners() const { return {}; }
  /// Whether contact_forces() is known.
  virtual bool has_contact_forces() const { return false; }
  /// The contacts that carried an impulse in the last time step, ascending in (a, b), without retired bodies. Empty
  /// before the first time step and after restore().
  virtual std::vector<ContactForce> contact_forces() { return {}; }
  /// Changes nothing: a run that is saved has the same bits, books included, as one that is not.
  virtual EngineState save() = 0;
  virtual void restore(const EngineState& state) = 0;
  /// Hash of the moving state, see hash_of().
  std::uint64_t state_hash();
};

/// Hash of positions, rotations, velocities, active flags, the step number, and broken lines, the state of dynamic
/// positioning and what corners remember, if there are any: the same bits give the same hash.
std::uint64_t hash_of(std::int64_t step, const Bodies& bodies, LineSet broken, const DpState* dp = nullptr,
                      const KeptCorners& corners = {});

struct EngineOptions {
  std::string name = "cpu";                   // reference | cpu | cuda
  int threads = 0;                            // 0: all threads of the machine
  std::size_t contacts_worth_a_thread = 256;  // coupled: with fewer per thread, one thread iterates (chosen by hand)
  int device = -1;                            // cuda: index of the GPU; -1: the first that can be used
  std::vector<std::string> baseline_settings = {};  // KEY=VALUE, for a registered baseline to read
};

/// Throws Error(usage) if `solver` is none of those that the engine knows. Every engine calls it in its constructor: a
/// solver that an engine lacks must not run as another one.
void check_solver(ContactSolver solver, std::initializer_list<ContactSolver> known, const std::string& engine);

/// Throws Error(usage) if the platform has several pieces. An engine that knows only body 0 as the platform calls it in
/// its constructor.
void check_one_piece(const Bodies& bodies, const std::string& engine);

/// Throws Error(usage): the engine does not tell the contact forces by which floes split.
[[noreturn]] void refuse_breakup(const std::string& engine);

/// Makes the named engine for a scene and its field. Throws Error(usage) for an unknown name, or for a contact solver
/// that the engine does not have.
std::unique_ptr<Engine> make_engine(const SceneDef& scene, Bodies bodies, const EngineOptions& options);

/// Engines that run on every machine, for messages and tests. make_engine() also knows cuda.
std::vector<std::string> engine_names();

/// Makes an engine that is built outside gem/engine.
using BaselineMaker = std::function<std::unique_ptr<Engine>(const SceneDef&, Bodies, const EngineOptions&)>;

/// A setting of a baseline that the command line offers.
struct BaselineSetting {
  std::string key;      // as in baseline_settings
  std::string flag;     // its command line option; empty: --experiment KEY=VALUE
  std::string preset;   // default value
  std::string meaning;  // one line for --help
};

/// Makes a baseline (the physics of another program) known to make_engine(). Not thread-safe.
void register_baseline(const std::string& name, BaselineMaker make, std::vector<BaselineSetting> settings = {});

/// Names of the registered baselines. They are not in engine_names(), since their results differ from gem's engines.
std::vector<std::string> baseline_names();

/// The settings of all registered baselines.
std::vector<BaselineSetting> baseline_settings();

/// Whether `engine` is one of baseline_names().
bool is_baseline(const std::string& engine);

}  // namespace gem
