// Moving fields: a state of a case is moved on for some seconds with each way of resolving contacts, at equal numbers
// of passes over the points in a time step, and judged by overlap, force, energy and rebound. Prints CSV.
//
// Usage: moving_study LABEL CASE START_S DURATION_S     (CASE: FILE, or FILE#NAME of a sweep)
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bench/solver_study/moving.h"
#include "bench/solver_study/scenes.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

constexpr int passes = 24;

std::vector<Stepper> steppers(const SceneDef& scene) {
  const Candidate ours = gathering("accelerated", {});
  const Candidate plain_repair = gathering("", {.anticipates = false});
  const auto moving = [](const std::string& name, const Candidate& candidate, const WarmOptions& warm = {}) {
    return passes_of(name, candidate, passes, warm);
  };
  return {production(1000),
          production(96),
          production(48),
          production(passes),
          production(12),
          moving("accelerated", ours),
          moving("accelerated cold", ours, {.impulses = false}),
          moving("accelerated theta 1", gathering("", {.begin = 1.0})),
          moving("accelerated 0.7 shares", gathering("", {.share = 0.7})),
          moving("accelerated repair cold", ours, {.repair = 0.0}),
          moving("accelerated repair memory 1", ours, {.repair = 1.0}),
          moving("accelerated no anticipation", plain_repair),
          moving("accelerated neither", plain_repair, {.repair = 0.0}),
          moving("Jacobi shared masses", gathering("", {.begin = 0.0})),
          moving("Gauss-Seidel", gauss_seidel()),
          moving("Gauss-Seidel cold", gauss_seidel(), {.impulses = false}),
          moving("conjugate gradient", conjugate_gradient()),
          moving("block descent", block_descent("", 1.0, 1.0)),
          small_steps(scene, passes),
          soft_steps(scene, passes / 2)};
}

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

void move(const std::string& label, const SceneDef& scene, const EngineState& state, double duration,
          const Stepper& stepper) {
  MovingField field(scene, state);
  const double before = user_seconds(), dt = scene.numerics.time_step_s;
  const std::int64_t steps = std::llround(duration / dt);
  bool finite = true;
  for (std::int64_t i = 0; i < steps && finite; ++i) {
    stepper.step(field);
    for (const Vec2 velocity : field.f.bodies.velocity) finite = finite && length(velocity) < 1e3;
  }
  const MovingScore& s = field.score;
  const double time = static_cast<double>(s.steps) * dt,
               points = static_cast<double>(std::max<std::int64_t>(1, s.points));
  std::string row = label + "," + stepper.name + "," + std::to_string(s.steps) + "," + (finite ? "yes" : "no");
  for (const double value :
       {points / static_cast<double>(s.steps), s.deepest, s.depth.quantile(0.999), s.depth.quantile(0.99),
        s.depth_sum / points, s.platform_impulse.x / time, s.fixed_impulse.x / time, s.created, s.lost, s.fastest_back,
        field.f.bodies.velocity[0].x, user_seconds() - before})
    row += "," + number_text(value, 6);
  std::cout << row << ',' << GEM_COMMIT << std::endl;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 4)
    throw Error(ExitCode::usage, "LABEL CASE START_S DURATION_S are needed (see the head of the source)");
  const SceneDef scene = scene_named(arguments[1]);
  const auto start = parse_number(arguments[2]), duration = parse_number(arguments[3]);
  if (!start || !duration) throw Error(ExitCode::usage, "start and duration are no numbers (seconds) give both");
  const auto leader = make_engine(scene, make_field(scene), {.name = "cpu", .threads = 1});
  const EngineState state = state_at(*leader, scene.numerics.time_step_s, *start);
  std::cout << "scene,method,moments,finite,points,overlap_maximum_m,overlap_999_m,overlap_99_m,overlap_mean_m,"
               "platform_force_x_N,fixed_force_x_N,created_J,lost_J,platform_back_m_per_s,platform_end_m_per_s,user_s,"
               "commit\n";
  for (const Stepper& stepper : steppers(scene)) move(arguments[0], scene, state, *duration, stepper);
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) {
  try {
    return gem::bench::run({argv + 1, argv + argc});
  } catch (const gem::Error& error) {
    std::cerr << "moving_study: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
