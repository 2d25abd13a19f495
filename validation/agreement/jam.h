// A jam of 1,234 floes before a platform in a narrow channel: the state on which engines must agree bit for bit.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "gem/engine/engine.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"

namespace gem::agreement {

/// A comparison counts only if every time step has at least this many contact points.
constexpr std::int32_t contacts_wanted = 500;

/// A channel that narrows from 200 m to 60 m around a platform of 40 m, cover about 0.72, current 0.5 m/s.
inline SceneDef jam_scene(ContactSolver solver) {
  SceneDef scene;
  test::use_gradient(scene);
  scene.run.seed = 1234;
  scene.current.velocity_m_per_s = {0.5, 0.0};
  scene.floes.count = 1234;
  scene.floes.width_m = 190.0;
  scene.floes.length_m = 570.0;
  scene.floes.start_x_m = -630.0;
  scene.floes.classes = {{"thick", 1.2, 1.8}, {"thin", 0.5, 5.4}};
  scene.boundary.inlet_x_m = -640.0;
  scene.boundary.inlet_width_m = 200.0;
  scene.boundary.taper_start_x_m = -60.0;
  scene.boundary.gap_m = 60.0;
  scene.platform.diameter_m = 40.0;
  scene.platform.mass_kg = 1.6e7;
  scene.platform_drag.present = true;
  scene.contact.solver = solver;
  return scene;
}

/// Options of an engine.
inline EngineOptions on(const std::string& name, int threads = 1) {
  EngineOptions options;
  options.name = name;
  options.threads = threads;
  return options;
}

/// The field of the scene, with every floe moving with the current.
inline Bodies drifting_field(const SceneDef& scene) {
  Bodies bodies = make_field(scene);
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.kind[i] == BodyKind::floe) bodies.velocity[i] = scene.current.velocity_m_per_s;
  return bodies;
}

/// The jam, reached with the cpu engine: more than 1,000 contact points. Throws std::runtime_error if no jam forms.
inline EngineState jam(const SceneDef& scene, const Bodies& bodies) {
  const auto engine = make_engine(scene, bodies, on("cpu"));
  StepLog log;
  do {
    log.clear();
    engine->advance(20, log);
    if (engine->step() >= 4000) throw std::runtime_error("no jam after 4000 time steps");
  } while (log.quality.back().contacts <= 1000);
  return engine->save();
}

}  // namespace gem::agreement
