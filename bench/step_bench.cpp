// Times one moment of the main case, whole and stage by stage, in three phases: drift, arrival at the platform, plug.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "gem/engine/cpu/pair_list.h"
#include "gem/engine/engine.h"
#include "gem/engine/solver/coupled_solver.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_outcome.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"
#include "gem_version.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t timed_moments = 20;  // after one moment that builds the list of neighbours
constexpr std::int64_t iterations = 10;     // fixed: most of an iteration is set-up outside the measured time

[[maybe_unused]] const bool context = [] {
  benchmark::AddCustomContext("commit", GEM_COMMIT);
  benchmark::AddCustomContext("compiler", GEM_COMPILER);
  benchmark::AddCustomContext("flags", GEM_BENCH_FLAGS);
  return true;
}();

struct Phase {
  const char* name;
  double time;  // [s]
};
constexpr std::array<Phase, 3> phases = {{{"drift", 60.0}, {"arrival", 300.0}, {"plug", 900.0}}};

SceneDef scene_of(Resolution resolution) {
  SceneDef scene = read_scene(GEM_SOURCE_DIR "/cases/004_400_25.toml");
  scene.contact.resolution = resolution;
  if (resolution == Resolution::independent) scene.contact.manifold = Manifold::chord_middle;
  return scene;
}

/// Field of the main case before anything moves; made once.
const Bodies& field() {
  static const Bodies bodies = make_field(scene_of(Resolution::coupled));
  return bodies;
}

/// State of the resolution's own run at a phase; each run goes on from the phase before, once per process.
const EngineState& state_at(Resolution resolution, std::size_t phase) {
  static std::map<std::pair<Resolution, std::size_t>, EngineState> states;
  const auto known = states.find({resolution, phase});
  if (known != states.end()) return known->second;
  const SceneDef scene = scene_of(resolution);
  const auto engine = make_engine(scene, field(), {"cpu", 1});
  if (phase > 0) engine->restore(state_at(resolution, phase - 1));
  MomentLog log;
  engine->advance(std::llround(phases[phase].time / scene.numerics.moment_s) - engine->moment(), log);
  return states[{resolution, phase}] = engine->save();
}

double active_floes(const Bodies& bodies) {
  double count = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) count += bodies.kind[i] == BodyKind::floe && bodies.active[i];
  return count;
}

std::string hex(std::uint64_t value) {
  char text[16];
  return {text, std::to_chars(text, text + sizeof text, value, 16).ptr};
}

/// Mean time of a moment over a short stretch that always starts from the same state.
void whole_moment(benchmark::State& state, Resolution resolution, std::size_t phase, int threads) {
  const SceneDef scene = scene_of(resolution);
  const EngineState& start = state_at(resolution, phase);
  const auto engine = make_engine(scene, field(), {"cpu", threads});
  MomentLog log;
  double seconds = 0.0;
  for (auto _ : state) {
    engine->restore(start);
    engine->advance(1, log);
    log.clear();
    const auto begin = Clock::now();
    engine->advance(timed_moments, log);
    const double moment = std::chrono::duration<double>(Clock::now() - begin).count() / double(timed_moments);
    state.SetIterationTime(moment);
    seconds += moment;
  }
  double contacts = 0.0, sweeps = 0.0;
  for (const MomentQuality& quality : log.quality) {
    contacts += quality.contacts / double(timed_moments);
    sweeps += quality.iterations / double(timed_moments);
  }
  const double moment = seconds / double(state.iterations());
  state.counters["x_real_time"] = scene.numerics.moment_s / moment;
  state.counters["contacts"] = contacts;
  state.counters["sweeps"] = sweeps;
  state.counters["ns_per_floe"] = 1e9 * moment / active_floes(start.bodies);
  state.SetLabel(hex(engine->state_hash()));
}

enum Stage : std::size_t { list_build, find, kick, resolve, book, drift, stage_count };
constexpr std::array<const char*, stage_count> stage_names = {"list_build", "find", "kick", "resolve", "book", "drift"};

/// A coupled moment on one thread, stage by stage as the engine does it, with the time that each stage took.
class StagedMoment {
 public:
  StagedMoment(const SceneDef& scene, const EngineState& start)
      : field_(make_field_state(start.bodies, moment_constants(scene, field()))), moment_(start.moment) {
    solver_.restore(start.impulse_key, start.impulse_value);
    lap();
    team_.run([&](int rank) { pairs_.find(field_, team_, rank); });
    lap(list_build);
    after_find();
  }

  void go() {
    lap();
    team_.run([&](int rank) { pairs_.find(field_, team_, rank); });
    lap(find);
    after_find();
  }

  double seconds(Stage stage) const { return seconds_[stage]; }
  double pairs() const { return double(pairs_.contacts().size()); }
  const Bodies& bodies() const { return field_.bodies; }

 private:
  void lap() { begin_ = Clock::now(); }
  void lap(Stage stage) {
    const auto now = Clock::now();
    seconds_[stage] += std::chrono::duration<double>(now - std::exchange(begin_, now)).count();
  }

  template <class Visit>
  void each_floe(Visit&& visit) {
    for (std::size_t i = 0; i < field_.bodies.count(); ++i)
      if (field_.bodies.kind[i] == BodyKind::floe) visit(field_, i);
  }

  void after_find() {
    lap();
    each_floe(kick_floe);
    lap(kick);
    platform_first_half(field_);
    MomentQuality quality;
    lap();
    solver_.lay_out(field_, pairs_.contacts(), team_.size());
    team_.run([&](int rank) { solver_.resolve(field_, pairs_.contacts(), team_, rank, quality); });
    lap(resolve);
    for (const Contact* contact : pairs_.contacts()) {
      ContactOutcome outcome;
      find_outcome(field_, *contact, outcome);
      book_contact(field_, *contact, outcome);
    }
    lap(book);
    each_floe(drift_floe);
    lap(drift);
    platform_second_half(field_);
    check_finite(field_, ++moment_);
    retire(field_);
  }

  FieldState field_;
  std::int64_t moment_;
  ThreadTeam team_{1};
  PairList pairs_;
  CoupledSolver solver_;
  std::array<double, stage_count> seconds_{};
  Clock::time_point begin_;
};

/// Whether two states have the same velocities to the last bit.
bool same(const Bodies& a, const Bodies& b) {
  const auto equal = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  return a.spin == b.spin && std::equal(a.velocity.begin(), a.velocity.end(), b.velocity.begin(), equal);
}

void one_stage(benchmark::State& state, std::size_t phase, Stage stage) {
  const SceneDef scene = scene_of(Resolution::coupled);
  const EngineState& start = state_at(Resolution::coupled, phase);
  const auto engine = make_engine(scene, field(), {"cpu", 1});
  engine->restore(start);
  MomentLog log;
  engine->advance(timed_moments + 1, log);
  double seconds = 0.0, pairs = 0.0;
  for (auto _ : state) {
    StagedMoment moment(scene, start);
    for (std::int64_t i = 0; i < timed_moments; ++i) moment.go();
    if (!same(moment.bodies(), engine->bodies())) {
      state.SkipWithError("the stages no longer do what the engine does");
      break;
    }
    const double runs = stage == list_build ? 1.0 : stage == find ? timed_moments : timed_moments + 1;
    state.SetIterationTime(moment.seconds(stage) / runs);
    seconds += moment.seconds(stage) / runs;
    pairs = moment.pairs();
  }
  state.counters["held_pairs"] = pairs;
  state.counters["ns_per_floe"] = 1e9 * seconds / double(state.iterations()) / active_floes(start.bodies);
  state.SetLabel(hex(engine->state_hash()));
}

[[maybe_unused]] const bool registered = [] {
  for (const auto& [resolution, name] :
       {std::pair{Resolution::coupled, "coupled"}, {Resolution::independent, "independent"}})
    for (std::size_t phase = 0; phase < phases.size(); ++phase)
      for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(
            (std::string("moment/") + phases[phase].name + "/" + name + "/threads:" + std::to_string(threads)).c_str(),
            whole_moment, resolution, phase, threads)
            ->Iterations(iterations)
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
  for (std::size_t phase = 0; phase < phases.size(); ++phase)
    for (std::size_t stage = 0; stage < stage_count; ++stage)
      benchmark::RegisterBenchmark((std::string("stage/") + phases[phase].name + "/" + stage_names[stage]).c_str(),
                                   one_stage, phase, Stage(stage))
          ->Iterations(iterations)
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace gem
