// Error of each law over the time step: small scenes against the closed form, or against a time step 64 times shorter.
// The error is the mean over all bodies and over time of the distance in position and in velocity. Contacts are solved
// to rounding, so that only the time step counts. Prints CSV.
//
// Usage: law_study FOLDER_OF_CASES
#include <cmath>
#include <functional>
#include <iostream>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

/// Position and velocity along x of floe `n` at a time.
using Exact = std::function<Vec2(std::size_t n, double time)>;

struct Law {
  std::string name;
  SceneDef scene;
  double coarsest;  // time step [s]; not a simple fraction of the scene's own times
  int samples;      // one per coarsest time step
  Exact exact;      // empty: compared with a shorter time step
};

constexpr double drag_rate = 0.05;  // [1/m]

SceneDef still() {
  SceneDef scene;
  scene.current.velocity_m_per_s = {};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  return scene;
}

FloeDef square(Vec2 position, Vec2 velocity) {
  FloeDef floe;
  floe.outline_m = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  floe.position_m = position;
  floe.velocity_m_per_s = velocity;
  return floe;
}

/// One floe starts from rest in a current and feels the drag on its area.
SceneDef drifting() {
  SceneDef scene = still();
  scene.current.velocity_m_per_s = {0.25, 0.0};
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = drag_rate * 900.0 * 0.5 / 1025.0;
  scene.floe = {square({}, {})};
  return scene;
}

Vec2 drifted(double time) {
  const double u = 0.25, grown = 1.0 + drag_rate * u * time;
  return {u * time - std::log(grown) / drag_rate, u - u / grown};
}

std::vector<Law> laws(const std::string& cases) {
  std::vector<Law> all;
  all.push_back({"drag (V22)", drifting(), 1.6, 60, [](std::size_t, double time) { return drifted(time); }});
  const SceneDef swing = read_scene(cases + "/analytic/V39_free_swing.toml");
  const double omega = std::sqrt(swing.mooring.stiffness_N_per_m / swing.platform.mass_kg);
  all.push_back({"mooring (V39)", swing, 1.6, 60, [omega](std::size_t, double time) {
                   return Vec2{std::cos(omega * time), -omega * std::sin(omega * time)};
                 }});
  SceneDef damped = swing;
  damped.platform_drag.present = true;
  all.push_back({"platform drag (V43)", damped, 1.6, 60, {}});

  SceneDef meeting = still();
  meeting.floe = {square({}, {0.25, 0.0}), square({11.0, 3.0}, {})};
  all.push_back({"impact (V06)", meeting, 0.7, 20, {}});
  SceneDef wall = drifting();
  wall.fixed = {{{{9.0, -16.0}, {20.0, -16.0}, {20.0, 16.0}, {9.0, 16.0}}}};
  all.push_back({"drift onto a wall (V26)", wall, 0.7, 120, [](std::size_t, double time) {
                   const Vec2 free = drifted(time);
                   return free.x < 4.0 ? free : Vec2{4.0, 0.0};
                 }});
  all.push_back({"moored impact (V10)", read_scene(cases + "/analytic/V10_floe_on_moored_platform.toml"), 0.7, 80, {}});
  all.push_back(
      {"column (V33)", read_scene(cases + "/analytic/V33_column_on_wall.toml"), 0.7, 30, [](std::size_t n, double) {
         return Vec2{5.0 + 10.0 * static_cast<double>(n), 0.0};
       }});
  all.push_back({"jamming row (V38)", read_scene(cases + "/analytic/V38_one_dimensional_jam.toml"), 0.7, 900,
                 [](std::size_t n, double time) {
                   const double stop = 60.0 * static_cast<double>(n + 1), start = -20.0 - 25.0 * static_cast<double>(n);
                   return time < stop ? Vec2{start + 0.25 * time, 0.25} : Vec2{start + 0.25 * stop, 0.0};
                 }});
  return all;
}

struct Sample {
  std::vector<Vec2> position, velocity;
};

/// The moving bodies at every sample.
std::vector<Sample> followed(const Law& law, ContactSolver solver, int divided_by) {
  SceneDef scene = law.scene;
  scene.contact.solver = solver;
  scene.contact.manifold = solver == ContactSolver::coupled ? Manifold::chord_ends : Manifold::chord_middle;
  scene.numerics.time_step_s = law.coarsest / divided_by;
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.iteration = Iteration::gradient;
  scene.numerics.residual_tolerance = 1e-10;
  scene.numerics.iterations_maximum = 5000;
  const auto engine = make_engine(scene, make_field(scene), {.name = "cpu", .threads = 1});
  StepLog log;
  log.wants_events = false;
  std::vector<Sample> samples;
  for (int k = 0; k < law.samples; ++k) {
    log.clear();
    engine->advance(divided_by, log);
    const Bodies& b = engine->bodies();
    Sample sample;
    for (std::size_t i = 0; i < b.count(); ++i) {
      if (!b.active[i] || !(b.inverse_mass[i] > 0.0)) continue;
      sample.position.push_back(b.position[i]);
      sample.velocity.push_back(b.velocity[i]);
    }
    samples.push_back(sample);
  }
  return samples;
}

std::vector<Sample> exactly(const Law& law, std::size_t bodies) {
  std::vector<Sample> samples;
  for (int k = 1; k <= law.samples; ++k) {
    Sample sample;
    for (std::size_t n = 0; n < bodies; ++n) {
      const Vec2 now = law.exact(n, k * law.coarsest);
      sample.position.push_back({now.x, 0.0});
      sample.velocity.push_back({now.y, 0.0});
    }
    samples.push_back(sample);
  }
  return samples;
}

void study(const Law& law, ContactSolver solver) {
  const std::vector<int> divisions = {1, 2, 4, 8};
  std::vector<Sample> judge;
  if (!law.exact) judge = followed(law, solver, 64 * divisions.back());
  for (const int divided_by : divisions) {
    const std::vector<Sample> run = followed(law, solver, divided_by);
    if (law.exact) judge = exactly(law, run[0].position.size());
    double place = 0.0, speed = 0.0;
    for (std::size_t k = 0; k < run.size(); ++k)
      for (std::size_t i = 0; i < run[k].position.size(); ++i) {
        place += length(run[k].position[i] - judge[k].position[i]);
        speed += length(run[k].velocity[i] - judge[k].velocity[i]);
      }
    const double count = static_cast<double>(run.size() * run[0].position.size());
    std::cout << law.name << ',' << solver_name(solver) << ',' << (law.exact ? "closed form" : "1/64") << ','
              << number_text(law.coarsest / divided_by, 6) << ',' << number_text(place / count, 6) << ','
              << number_text(speed / count, 6) << ',' << GEM_COMMIT << '\n';
  }
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw gem::Error(gem::ExitCode::usage, "the folder of the cases is needed (one argument); give it");
    std::cout << "law,resolution,judge,moment_s,place_m,velocity_m_per_s,commit\n";
    for (const gem::bench::Law& law : gem::bench::laws(argv[1]))
      for (const auto solver : {gem::ContactSolver::coupled, gem::ContactSolver::independent})
        gem::bench::study(law, solver);
    return 0;
  } catch (const gem::Error& error) {
    std::cerr << "law_study: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
