// Times one time step of the main case, whole and stage by stage, in three phases: drift, arrival at the platform,
// plug.
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

constexpr std::int64_t timed_steps = 20;  // after one time step that builds the pair list
constexpr std::int64_t iterations =
    10;  // fixed, because most of a benchmark iteration is set-up outside the measured time

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

/// With the iteration whose phases are timed.
SceneDef scene_of(ContactSolver solver) {
  SceneDef scene = read_scene(GEM_SOURCE_DIR "/cases/004_400_25.toml",
                              {"contact.solver=\"coupled\"", "numerics.iteration=\"gradient\""});
  scene.contact.solver = solver;
  if (solver == ContactSolver::independent) scene.contact.manifold = Manifold::chord_middle;
  return scene;
}

/// Field of the main case at t = 0; made once.
const Bodies& field() {
  static const Bodies bodies = make_field(scene_of(ContactSolver::coupled));
  return bodies;
}

/// State of the solver's own run at a phase. Each run continues from the phase before, once per process.
const EngineState& state_at(ContactSolver solver, std::size_t phase) {
  static std::map<std::pair<ContactSolver, std::size_t>, EngineState> states;
  const auto known = states.find({solver, phase});
  if (known != states.end()) return known->second;
  const SceneDef scene = scene_of(solver);
  const auto engine = make_engine(scene, field(), {"cpu", 1});
  if (phase > 0) engine->restore(state_at(solver, phase - 1));
  StepLog log;
  engine->advance(std::llround(phases[phase].time / scene.numerics.time_step_s) - engine->step(), log);
  return states[{solver, phase}] = engine->save();
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

/// Mean time of a time step over a few steps that always start from the same state.
void whole_step(benchmark::State& state, ContactSolver solver, std::size_t phase, int threads) {
  const SceneDef scene = scene_of(solver);
  const EngineState& start = state_at(solver, phase);
  const auto engine = make_engine(scene, field(), {"cpu", threads});
  StepLog log;
  double seconds = 0.0;
  for (auto _ : state) {
    engine->restore(start);
    engine->advance(1, log);
    log.clear();
    const auto begin = Clock::now();
    engine->advance(timed_steps, log);
    const double step = std::chrono::duration<double>(Clock::now() - begin).count() / double(timed_steps);
    state.SetIterationTime(step);
    seconds += step;
  }
  double contacts = 0.0, sweeps = 0.0;
  for (const StepQuality& quality : log.quality) {
    contacts += quality.contacts / double(timed_steps);
    sweeps += quality.iterations / double(timed_steps);
  }
  const double step = seconds / double(state.iterations());
  state.counters["x_real_time"] = scene.numerics.time_step_s / step;
  state.counters["contacts"] = contacts;
  state.counters["sweeps"] = sweeps;
  state.counters["ns_per_floe"] = 1e9 * step / active_floes(start.bodies);
  state.SetLabel(hex(engine->state_hash()));
}

enum Stage : std::size_t { list_build, find, kick, resolve, book, drift, stage_count };
constexpr std::array<const char*, stage_count> stage_names = {"list_build", "find", "kick", "resolve", "book", "drift"};

/// A coupled time step on one thread, stage by stage as in the engine, with the time of each stage.
class StagedStep {
 public:
  StagedStep(const SceneDef& scene, const EngineState& start)
      : field_(make_field_state(start.bodies, step_constants(scene, field()))), step_(start.step) {
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
    StepQuality quality;
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
    check_finite(field_, ++step_);
    retire(field_);
  }

  FieldState field_;
  std::int64_t step_;
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
  const SceneDef scene = scene_of(ContactSolver::coupled);
  const EngineState& start = state_at(ContactSolver::coupled, phase);
  const auto engine = make_engine(scene, field(), {"cpu", 1});
  engine->restore(start);
  StepLog log;
  engine->advance(timed_steps + 1, log);
  double seconds = 0.0, pairs = 0.0;
  for (auto _ : state) {
    StagedStep step(scene, start);
    for (std::int64_t i = 0; i < timed_steps; ++i) step.go();
    if (!same(step.bodies(), engine->bodies())) {
      state.SkipWithError("the stages no longer do what the engine does");
      break;
    }
    const double runs = stage == list_build ? 1.0 : stage == find ? timed_steps : timed_steps + 1;
    state.SetIterationTime(step.seconds(stage) / runs);
    seconds += step.seconds(stage) / runs;
    pairs = step.pairs();
  }
  state.counters["held_pairs"] = pairs;
  state.counters["ns_per_floe"] = 1e9 * seconds / double(state.iterations()) / active_floes(start.bodies);
  state.SetLabel(hex(engine->state_hash()));
}

[[maybe_unused]] const bool registered = [] {
  for (const auto& [solver, name] :
       {std::pair{ContactSolver::coupled, "coupled"}, {ContactSolver::independent, "independent"}})
    for (std::size_t phase = 0; phase < phases.size(); ++phase)
      for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(
            (std::string("moment/") + phases[phase].name + "/" + name + "/threads:" + std::to_string(threads)).c_str(),
            whole_step, solver, phase, threads)
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
