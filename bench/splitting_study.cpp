// Operator splitting beside the iterations of `coupled` in one window of a run: loads, places and processor time.
//
// Usage: splitting_study CASE START_S WINDOW_S REFERENCE SETTING...
//   CASE       case file; a member of a sweep as FILE#INDEX
//   REFERENCE, SETTING
//              gradient:ITERATIONS:FACTOR   the cpu engine, to a residual of 1e-6 if ITERATIONS is above 100
//              splitting:ITERATIONS:TOLERANCE:FACTOR   numerics.iteration = "splitting", tolerance in m/s
//              FACTOR times the time step of the case
// The run goes to START_S with the numerics of the case; its last 20 time steps have 500 iterations. Each setting then
// starts from there, with one thread. Rows are compared with the reference at the end of the window.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "gem/base/error.h"
#include "gem/engine/cpu/cpu_engine.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

struct Outcome {
  std::vector<Vec2> position;
  double force = 0.0;                   // mean of the ice on the platform, x [N]
  double per_step = 0.0;                // processor time of a time step [s]
  double iterations = 0.0;              // mean
  double overlap = 0.0, closing = 0.0;  // deepest [m]; largest speed that a point still asks for [m/s]
  std::uint64_t hash = 0;
};

struct Setting {
  bool splits = false;
  int iterations = 0;
  double tolerance = 0.0, factor = 1.0;
};

Setting parsed(const std::string& text) {
  std::vector<std::string> part;
  std::istringstream in(text);
  for (std::string one; std::getline(in, one, ':');) part.push_back(one);
  const bool splits = !part.empty() && part[0] == "splitting";
  if (part.size() != (splits ? 4u : 3u) || (!splits && part[0] != "gradient"))
    throw Error(ExitCode::usage, "'" + text + "' is no setting (see the head of the source); correct it");
  return {splits, static_cast<int>(number_of(part[1], "ITERATIONS")), splits ? number_of(part[2], "TOLERANCE") : 0.0,
          number_of(part.back(), "FACTOR")};
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Outcome outcome_of(const Setting& setting, SceneDef scene, EngineState start, const Bodies& field, double window) {
  scene.numerics.time_step_s *= setting.factor;
  start.step = std::llround(static_cast<double>(start.step) / setting.factor);
  for (PointMemory& point : start.impulse_value) {
    const PointImpulse<double>& p = point.impulse;
    point = {{p.normal * setting.factor, p.tangential * setting.factor, p.repair * setting.factor},
             point.rise * setting.factor};
  }
  scene.numerics.iterations_maximum = setting.iterations;
  if (setting.splits) {
    scene.numerics.iteration = Iteration::splitting;
    scene.numerics.residual_tolerance = setting.tolerance / length(scene.current.velocity_m_per_s);
  } else {
    scene.numerics.iteration = Iteration::gradient;
    scene.numerics.residual_tolerance =
        setting.iterations > 100 ? 1e-6 : default_end(Iteration::gradient).residual_tolerance;
  }
  const auto engine = std::make_unique<CpuEngine>(scene, field, 1, 256);
  engine->restore(start);
  StepLog log;
  log.wants_events = false;
  const auto steps = static_cast<std::int64_t>(std::llround(window / scene.numerics.time_step_s));
  const double before = processor_seconds();
  engine->advance(steps, log);
  Outcome o;
  o.per_step = (processor_seconds() - before) / static_cast<double>(steps);
  o.position = engine->bodies().position;
  o.hash = engine->state_hash();
  for (const PlatformStep& step : log.platform) o.force += step.ice_impulse.x / window;
  for (const StepQuality& quality : log.quality) {
    o.iterations += quality.iterations / static_cast<double>(steps);
    o.overlap = std::max(o.overlap, quality.maximum_overlap);
    o.closing = std::max(o.closing, quality.complementarity);
  }
  return o;
}

void row(const std::string& setting, const Outcome& o, const Outcome& reference, const Bodies& bodies, double dt) {
  double squares = 0.0;
  int floes = 0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.kind[i] != BodyKind::floe || !bodies.active[i]) continue;
    const Vec2 off = o.position[i] - reference.position[i];
    squares += dot(off, off);
    ++floes;
  }
  const double platform = length(o.position[0] - reference.position[0]);
  std::printf("%s,%.1f,%.2f,%.1f,%.1f,%.2f,%.3f,%.3f,%.3f,%.2e,%016llx,%s\n", setting.c_str(), o.iterations,
              1e3 * o.per_step, 1e3 * o.per_step / dt, o.force / 1e3, 100.0 * (o.force / reference.force - 1.0),
              1e3 * std::sqrt(squares / floes), 1e3 * platform, 1e3 * o.overlap, o.closing,
              static_cast<unsigned long long>(o.hash), GEM_COMMIT);
  std::fflush(stdout);
}

int run(const std::vector<std::string>& a) {
  if (a.size() < 5) throw Error(ExitCode::usage, "five arguments are needed (see the head of the source)");
  SceneDef scene = read_case(case_named(a[0]));
  scene.contact.solver = ContactSolver::coupled;
  const double start = number_of(a[1], "START_S"), window = number_of(a[2], "WINDOW_S");
  const Bodies field = make_field(scene);
  constexpr std::int64_t settling = 20;
  const std::int64_t steps = std::llround(start / scene.numerics.time_step_s);
  if (steps <= settling) throw Error(ExitCode::usage, "START_S is too small (20 time steps are needed); give more");
  StepLog log;
  log.wants_events = false;
  CpuEngine coarse(scene, field, 2, 256);
  coarse.advance(steps - settling, log);
  SceneDef fine = scene;
  fine.numerics.iterations_maximum = 500;
  CpuEngine settled(fine, field, 2, 256);
  settled.restore(coarse.save());
  settled.advance(settling, log);
  const EngineState state = settled.save();
  std::puts(
      "setting,iterations,ms_per_step,ms_per_s,force_kN,force_off_percent,places_mm,"
      "platform_mm,overlap_mm,closing_m_per_s,state_hash,commit");
  Outcome reference;
  for (std::size_t k = 3; k < a.size(); ++k) {
    const Setting setting = parsed(a[k]);
    const Outcome o = outcome_of(setting, scene, state, field, window);
    if (k == 3) reference = o;
    row(a[k], o, reference, state.bodies, scene.numerics.time_step_s * setting.factor);
  }
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) { return gem::bench::run_program("splitting_study", gem::bench::run, argc, argv); }
