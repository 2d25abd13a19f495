// Scenes of the compliant contacts, and what is read of their runs.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/scene/scene_def.h"

namespace gem::hits {

/// Still water without drag, no friction, no platform, floes and walls as listed; time steps of 0.1 s.
SceneDef open_scene();

/// Rectangle about the origin [m].
std::vector<Vec2> rectangle(double length, double width);
/// Rhombus about the origin with corners of `angle` [rad] on the x axis and sides of `side` [m].
std::vector<Vec2> rhombus(double side, double angle);
/// Regular outline with `sides` sides and its corners at `radius` [m].
std::vector<Vec2> regular(int sides, double radius);
std::vector<Vec2> turned_by(std::vector<Vec2> outline, double angle);

/// Ice of 1 m.
FloeDef floe_of(std::vector<Vec2> outline, Vec2 position, Vec2 velocity = {}, double spin = 0.0);

/// Makes a fixed platform of the scene: its face is the line x = 0, it reaches from y = -reach to y = reach [m].
void add_wall(SceneDef& scene, double reach = 200.0);
/// A fixed body with the face x = 0.
FixedDef wall_body();

/// Sets a time step of `substeps` substeps of `h` [s].
void step_by(SceneDef& scene, double h, std::int64_t substeps);

/// A running scene.
struct Trial {
  std::unique_ptr<Engine> engine;
  StepLog log;

  explicit Trial(const SceneDef& scene, int threads = 1);
  void advance(std::int64_t steps = 1);
  void advance_for(const SceneDef& scene, double time);
  const Bodies& bodies() { return engine->bodies(); }
};

/// Largest normal force on the platform [N] and depth [m] so far.
struct Peak {
  double force = 0.0, depth = 0.0;
};
Peak peak_of(const StepLog& log);

/// Force of the ice on the platform in each time step along x [N].
std::vector<double> push_of(const StepLog& log, double dt);

/// Kinetic energy of all bodies [J].
double kinetic(const Bodies& bodies);

/// Force of the current on a floe that is held [N].
double drag_of(const Bodies& bodies, std::size_t floe, double speed);

/// Index of the first floe.
std::size_t first_floe(const Bodies& bodies);

/// Whether the state of the floe has the same bits.
bool same_bits(const Bodies& a, std::size_t i, const Bodies& b, std::size_t j);

}  // namespace gem::hits
