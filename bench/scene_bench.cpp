// Times one time step of whole scenes, with and without each feature, and over the number of floes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gem/base/strict_math.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/scene/toml/scene_file.h"
#include "growth_field.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;

/// Least mean time of a time step over `steps` time steps that always start from `start`. The first time step builds
/// the lists and is left out.
double time_steps(benchmark::State& state, Engine& engine, const EngineState& start, std::int64_t steps, StepLog& log) {
  double least = 1e300;
  for (auto _ : state) {
    engine.restore(start);
    engine.advance(1, log);
    log.clear();
    const auto begin = Clock::now();
    engine.advance(steps, log);
    const double step = std::chrono::duration<double>(Clock::now() - begin).count() / double(steps);
    state.SetIterationTime(step);
    least = std::min(least, step);
  }
  double contacts = 0.0;
  for (const StepQuality& quality : log.quality) contacts += quality.contacts / double(steps);
  state.counters["contacts"] = contacts;
  state.SetLabel(hash_text(engine.state_hash()));
  state.counters["least_us"] = 1e6 * least;
  return least;
}

/// A feature and how to remove it from the scene (or to add it), and from the bodies if it is stored there too.
struct Feature {
  const char* name;
  std::function<void(SceneDef&)> leave_out;
  std::function<void(Bodies&)> leave_out_of_bodies = [](Bodies&) {};
  bool events = true;
};

const std::vector<Feature> features = {
    {"everything", [](SceneDef&) {}},
    {"without_friction", [](SceneDef& s) { s.ice.friction_ice = s.ice.friction_structure = 0.0; }},
    {"without_drag", [](SceneDef& s) { s.water.drag_law = DragLaw::none; }},
    {"without_spin_drag", [](SceneDef&) {}, [](Bodies& b) { b.spin_drag.assign(b.count(), 0.0); }},
    {"without_yaw", [](SceneDef&) {}, [](Bodies& b) { b.inverse_inertia[0] = b.spin[0] = 0.0; }},
    {"without_boundary", [](SceneDef&) {},
     [](Bodies& b) {
       for (std::size_t i = 0; i < b.count(); ++i)
         if (b.kind[i] == BodyKind::fixed) b.active[i] = 0;
     }},
    {"without_mooring", [](SceneDef& s) { s.mooring.stiffness_N_per_m = s.mooring.damping_ratio = 0.0; }},
    {"with_mooring_table",
     [](SceneDef& s) {
       s.mooring = {.damping_ratio = 0.0, .law = MooringLaw::table, .yaw_stiffness_N_m_per_rad = 1e9};
       s.mooring_design.force = {{0.5, 0.0}, {5.0, 2e6}, {20.0, 2e7}};
     }},
    {"with_lines",
     [](SceneDef& s) {
       s.mooring = {.damping_ratio = 0.0, .law = MooringLaw::catenary};
       s.mooring_design.line_height_m = 40.0;
       for (int k = 0; k < 8; ++k) {
         const Rotation q = strict::rotation_of_turns((k + 0.5) / 8.0);
         s.mooring_design.lines.push_back(
             {641.0 * q.cosine, 641.0 * q.sine, 40.0 * q.cosine, 40.0 * q.sine, 610.0, 1400.0, 7e8, 1e8});
       }
     }},
    {"with_heading",
     [](SceneDef& s) {
       s.heading = {1e8, 1e10};
     }},
    {"with_fixed_platform", [](SceneDef& s) { s.platform.fixed = true; },
     [](Bodies& b) {
       b.inverse_mass[0] = b.inverse_inertia[0] = b.spin[0] = 0.0;
       b.velocity[0] = {};
     }},
    {"without_crushing_limit", [](SceneDef& s) { s.contact.crushing_limit = false; }},
    {"without_repair", [](SceneDef& s) { s.numerics.repair_share = 0.0; }},
    {"without_events", [](SceneDef&) {}, [](Bodies&) {}, false},
};

/// With the iteration of the recorded results.
SceneDef main_case() {
  return read_scene(GEM_SOURCE_DIR "/cases/004_400_25.toml",
                    {"contact.solver=\"coupled\"", "numerics.iteration=\"gradient\""});
}

/// The main case when the ice has just reached the platform; made once.
const EngineState& arrival() {
  static const EngineState state = [] {
    const SceneDef scene = main_case();
    const auto engine = make_engine(scene, make_field(scene), {"cpu", 1});
    StepLog log;
    log.wants_events = false;
    engine->advance(std::llround(300.0 / scene.numerics.time_step_s), log);
    return engine->save();
  }();
  return state;
}

void one_feature(benchmark::State& state, const Feature& feature) {
  SceneDef scene = main_case();
  feature.leave_out(scene);
  EngineState start = arrival();
  feature.leave_out_of_bodies(start.bodies);
  const auto engine = make_engine(scene, start.bodies, {"cpu", 1});
  StepLog log;
  log.wants_events = feature.events;
  time_steps(state, *engine, start, 40, log);
}

void growth(benchmark::State& state) {
  const std::int64_t count = state.range(0);
  const auto [scene, bodies] = growth_field(count);
  const auto engine = make_engine(scene, bodies, {"cpu", 1});
  StepLog log;
  log.wants_events = false;
  engine->advance(100, log);
  log.clear();
  const EngineState start = engine->save();
  const double step = time_steps(state, *engine, start, 20, log);
  state.counters["ns_per_floe"] = 1e9 * step / double(count);
}

[[maybe_unused]] const bool registered = [] {
  for (const Feature& feature : features)
    benchmark::RegisterBenchmark((std::string("feature/") + feature.name).c_str(), one_feature, feature)
        ->Iterations(30)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("growth", growth)
      ->RangeMultiplier(4)
      ->Range(1000, 1000000)
      ->Iterations(10)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace gem
