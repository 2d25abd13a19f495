// Parts of scenes for the closed-form cases, and the settings that run every scene.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/scene/scene_def.h"
#include "validation/verification/check.h"

namespace gem::verification {

/// Overlap of touching bodies at the start [m]. A power of two, so that a long row of floes stays exact. The contact
/// point is shifted by half of it, which changes no closed form by more than 1e-13 relative.
constexpr double touch = 0x1p-40;

/// One engine with one solver.
struct Setting {
  std::string engine;  // as make_engine knows it
  ContactSolver solver = ContactSolver::coupled;
  Iteration iteration = Iteration::splitting;

  bool coupled() const { return solver == ContactSolver::coupled; }
  bool gradient() const { return coupled() && iteration == Iteration::gradient; }
  Where where() const { return {engine, gradient() ? "gradient" : coupled() ? "coupled" : "independent"}; }
  /// What the scene leaves at the defaults of its iteration gets those of this one.
  void apply_to(SceneDef& scene) const {
    NumericsDef& n = scene.numerics;
    const IterationEnd before = default_end(n.iteration), now = default_end(iteration);
    scene.contact.solver = solver;
    n.iteration = iteration;
    if (n.residual_tolerance == before.residual_tolerance) n.residual_tolerance = now.residual_tolerance;
    if (n.iterations_maximum == before.iterations_maximum) n.iterations_maximum = now.iterations_maximum;
  }
};

/// Every engine with both solvers, cpu also with the iteration "gradient"; with GEM_MORE_ENGINES=cuda also that engine.
std::vector<Setting> all_settings();
/// Every engine with the coupled solver.
std::vector<Setting> coupled_settings();
std::string setting_name(const ::testing::TestParamInfo<Setting>& info);

/// How a failing test names its setting.
void PrintTo(const Setting& setting, std::ostream* out);

class OnEngines : public ::testing::TestWithParam<Setting> {
 protected:
  const Setting& setting() const { return GetParam(); }
  Where where() const { return GetParam().where(); }
};

/// Only contacts: still water without drag, no platform, no sides, no friction, solved to rounding.
SceneDef quiet_scene();

/// Rectangle about the origin, counter-clockwise [m].
std::vector<Vec2> rectangle(double length, double width);

/// The square floe 10 m x 10 m x 0.5 m of 45 t at `position`.
FloeDef square(Vec2 position, Vec2 velocity = {}, double angle = 0.0, double spin = 0.0);

/// The rod 20 m x 1 m x 0.5 m of 9 t.
FloeDef rod(Vec2 position, Vec2 velocity = {}, double angle = 0.0, double spin = 0.0);

double degrees(double angle);

/// Fixed body below y = 0.
FixedDef floor_wall();

/// Lowest corner of a floe relative to its outline's origin, in world axes.
Vec2 lowest_corner(const FloeDef& floe);

/// Moves a floe so that its lowest corner touches the line y = 0.
FloeDef on_floor(FloeDef floe);

/// A floe that hits the floor in its lowest corner.
SceneDef over_floor(const FloeDef& floe, double friction = 0.0);

/// A corner of a rectangle that hits the face of a square (V09, V18).
SceneDef corner_on_face(double friction);

/// A row of `count` touching square floes along x, the first moving with `speed`.
SceneDef row_of_squares(int count, double speed);

/// A running engine with its log.
struct Simulation {
  std::unique_ptr<Engine> engine;
  StepLog log;
  Ledger first;  // the books at t = 0

  void advance(std::int64_t steps) { engine->advance(steps, log); }
  const Bodies& bodies() { return engine->bodies(); }
};

/// Makes the field and the engine of a scene, with the solver of the setting.
Simulation start(SceneDef scene, const Setting& setting);

/// Angular momentum of all bodies about the world origin [N m s].
double angular_momentum(const Bodies& b);

/// Checks that the books close. `momentum_seen` [N s] is for runs whose largest momentum lies between two readings of
/// the ledger.
void expect_closed_books(Simulation& run, double tolerance = 1e-13, double momentum_seen = 0.0);

/// One side (1 or -1) of a notch that opens upwards. Its face lies on a line through the origin, `angle` [rad] from the
/// vertical.
FixedDef notch_side(double angle, double side);

/// One time step of a scene whose bodies touch at the start. Fails unless there are contacts and the books close.
struct Impact {
  Bodies before, after;
  Ledger ledger;
  EngineState state;
  StepQuality quality;
  std::size_t first_floe = 0;

  Vec2 velocity(std::size_t floe) const { return after.velocity[first_floe + floe]; }
  double spin(std::size_t floe) const { return after.spin[first_floe + floe]; }
  /// Impulse on a floe [N s].
  Vec2 impulse(std::size_t floe) const;
  /// Kinetic energy lost in the time step [J].
  double energy_lost() const;
};
Impact one_impact(const SceneDef& scene, const Setting& setting);

}  // namespace gem::verification
