// Errors of small scenes against their closed forms, and their cost, over the time step. Velocities jump at impacts, so
// errors are means over time (the L1 norm over the duration), not maxima.
//
// Usage: closed_form_errors SETTINGS TIME_STEP_S,... OUT.csv
//   SETTINGS  see bench/setting.h; contacts and numerics are taken from there, the scenes are those below
//
// V06: a corner hits a wall. V17: with friction and slip. V26: a floe drifts onto a wall. V33: a column of ten floes is
// pressed to a wall. V10: a floe hits the moored platform. V42 (a train of given impulses on the mooring) has no
// contacts: every engine has the exact path of the mooring at every time step, so it is left out.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

struct Motion {
  Vec2 place;     // [m]
  Vec2 velocity;  // [m/s]
};

struct ClosedForm {
  std::string name;
  SceneDef scene;
  double duration = 0.0;                                    // [s]
  std::function<Motion(double time, std::size_t body)> at;  // of the bodies named by `first` and `count`
  std::size_t first = 0, count = 1;
};

std::vector<Vec2> block(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// The square floe 10 m x 10 m x 0.5 m of 45 t.
FloeDef square(Vec2 position, Vec2 velocity, double angle = 0.0) {
  return {block(-5.0, -5.0, 5.0, 5.0), position, angle, velocity, 0.0, 0.5};
}

constexpr double mass = 45000.0, inertia = 750000.0, drag_rate = 0.05;  // [kg], [kg m2], [1/m]

SceneDef still_scene() {
  SceneDef scene;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = scene.platform.present = false;
  scene.output.retire_x_m = 1e9;
  return scene;
}

SceneDef current_scene(double speed) {
  SceneDef scene = still_scene();
  scene.current.velocity_m_per_s = {speed, 0.0};
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = drag_rate * 900.0 * 0.5 / 1025.0;
  scene.water.spin_drag = false;
  return scene;
}

/// A square turned by 30 degrees hits the wall y = 0 with its lowest corner, plastically; with friction it slips.
ClosedForm corner_on_wall(const std::string& name, double along, double friction, double delay) {
  const double angle = std::numbers::pi / 6.0, gap = 0.1 + 0.5 * delay;
  const Vec2 arm{-5.0 * std::cos(angle) + 5.0 * std::sin(angle), -5.0 * std::sin(angle) - 5.0 * std::cos(angle)};
  const Vec2 before{along, -0.5}, from{0.0, gap - arm.y};
  // Compliances of the corner: normal (y) by the normal impulse, and by the friction against the slip (+x).
  const double nn = 1.0 / mass + arm.x * arm.x / inertia, nt = -arm.x * arm.y / inertia;
  const double normal = -before.y / (nn + friction * nt);
  const Vec2 after = before + (1.0 / mass) * Vec2{friction * normal, normal};
  const double hit = gap / 0.5;
  ClosedForm form{name, still_scene(), 4.0, {}};
  form.scene.ice.friction_ice = friction;
  form.scene.fixed = {{block(-100.0, -20.0, 100.0, 0.0)}};
  form.scene.floe = {square(from, before, angle)};
  form.first = 2;
  form.at = [=](double time, std::size_t) -> Motion {
    if (time < hit) return {from + time * before, before};
    return {from + hit * before + (time - hit) * after, after};
  };
  return form;
}

ClosedForm stop_at_wall(double delay) {
  const double current = 0.25, distance = 20.0 + 0.17 * delay;  // it arrives with 0.17 m/s
  const auto free = [=](double time) -> Motion {
    const double q = drag_rate * current * time;
    return {{current * time - std::log1p(q) / drag_rate, 0.0}, {current * q / (1.0 + q), 0.0}};
  };
  double low = 0.0, high = 1000.0;  // bounds of the arrival time, halved in turn
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (free(middle).place.x < distance ? low : high) = middle;
  }
  ClosedForm form{"V26", current_scene(current), 200.0, {}};
  form.scene.fixed = {{block(distance + 5.0, -50.0, distance + 25.0, 50.0)}};
  form.scene.floe = {square({}, {})};
  form.first = 2;
  form.at = [=](double time, std::size_t) -> Motion { return time < low ? free(time) : Motion{{distance, 0.0}, {}}; };
  return form;
}

ClosedForm column_on_wall(int count) {
  ClosedForm form{"V33", current_scene(0.5), 20.0, {}};
  for (int i = 0; i < count; ++i) form.scene.floe.push_back(square({5.0 + 10.0 * i, 0.0}, {}));
  form.scene.fixed = {{block(10.0 * count, -50.0, 10.0 * count + 20.0, 50.0)}};
  form.first = 2;
  form.count = static_cast<std::size_t>(count);
  form.at = [](double, std::size_t body) -> Motion { return {{5.0 + 10.0 * static_cast<double>(body), 0.0}, {}}; };
  return form;
}

ClosedForm floe_on_platform(double delay) {
  const double speed = 0.25, gap = 0.05 + speed * delay, platform = 1e8, stiffness = 5e5, hit = gap / speed;
  const double joint = std::sqrt(stiffness / (platform + mass)), alone = std::sqrt(stiffness / platform);
  const double velocity = mass * speed / (platform + mass), parted = std::numbers::pi / joint;
  ClosedForm form{"V10", still_scene(), 80.0, {}};
  form.scene.platform.present = true;
  form.scene.floe = {square({-55.0 - gap, 0.0}, {speed, 0.0})};
  form.at = [=](double time, std::size_t) -> Motion {
    if (time < hit) return {};
    const double t = time - hit, late = t - parted;
    if (late < 0.0) return {{velocity / joint * std::sin(joint * t), 0.0}, {velocity * std::cos(joint * t), 0.0}};
    return {{-velocity / alone * std::sin(alone * late), 0.0}, {-velocity * std::cos(alone * late), 0.0}};
  };
  return form;
}

struct Errors {
  double place = 0.0, velocity = 0.0;  // means over time and bodies [m], [m/s]
  std::int64_t contacts = 0;
};

std::unique_ptr<Engine> engine_for_case(const ClosedForm& form, const EngineSetting& setting, double step) {
  SceneDef scene = form.scene;
  scene.contact = setting.scene.contact;
  scene.numerics = setting.scene.numerics;
  scene.numerics.time_step_s = step;
  return make_engine(scene, make_field(scene), setting.engine);
}

Errors errors_of(const ClosedForm& form, const EngineSetting& setting, double step) {
  const auto engine = engine_for_case(form, setting, step);
  const std::int64_t steps = std::llround(form.duration / step);
  Errors errors;
  // Positions and velocities are interpolated at four instants in a time step, so that an impact within it is not
  // missed.
  constexpr int looks = 4;
  const double each = 1.0 / (static_cast<double>(looks * steps) * static_cast<double>(form.count));
  Bodies before = engine->bodies();
  for (std::int64_t m = 1; m <= steps; ++m) {
    StepLog log;
    engine->advance(1, log);
    errors.contacts += log.quality.back().contacts;
    const Bodies& now = engine->bodies();
    for (std::size_t k = 0; k < form.count; ++k)
      for (int look = 0; look < looks; ++look) {
        const std::size_t i = form.first + k;
        const double part = (look + 0.5) / looks;
        const Motion truth = form.at((static_cast<double>(m - 1) + part) * step, k);
        const auto between = [part](Vec2 a, Vec2 b) { return a + part * (b - a); };
        errors.place += each * length(between(before.position[i], now.position[i]) - truth.place);
        errors.velocity += each * length(between(before.velocity[i], now.velocity[i]) - truth.velocity);
      }
    before = now;
  }
  if (errors.contacts == 0)
    throw Error(ExitCode::numerical_stop, form.name + ": nothing touched with " + setting.label +
                                              " (the scene is wrong) its errors would say nothing");
  return errors;
}

/// The cases, with impacts that come `delay` later [s].
std::vector<ClosedForm> closed_forms(double delay) {
  return {corner_on_wall("V06", 0.0, 0.0, delay), corner_on_wall("V17", -0.4, 0.1, delay), stop_at_wall(delay),
          column_on_wall(10), floe_on_platform(delay)};
}

/// The phase of an impact within a time step is arbitrary: the mean over impacts spread evenly over one time step.
Errors mean_errors(std::size_t which, const EngineSetting& setting, double step) {
  constexpr int phases = 8;
  Errors mean;
  for (int k = 0; k < phases; ++k) {
    const Errors errors = errors_of(closed_forms(step * k / phases)[which], setting, step);
    mean.place += errors.place / phases;
    mean.velocity += errors.velocity / phases;
    mean.contacts += errors.contacts;
  }
  return mean;
}

/// Median of user time over simulated time of whole runs. Short runs are repeated until the clock resolves them.
double cost_of(const ClosedForm& form, const EngineSetting& setting, double step) {
  std::vector<double> costs;
  for (int repetition = 0; repetition < 5; ++repetition) {
    Spent spent;
    int runs = 0;
    while (spent.user < 0.02) {
      const auto engine = engine_for_case(form, setting, step);
      StepLog log;
      const Spent before = spent_so_far();
      engine->advance(std::llround(form.duration / step), log);
      spent += spent_so_far() - before;
      ++runs;
    }
    costs.push_back(spent.user / runs / form.duration);
  }
  return median(costs);
}

int run(const std::vector<std::string>& a) {
  if (a.size() != 3) throw Error(ExitCode::usage, "three arguments are needed (see the head of the source)");
  const std::vector<EngineSetting> settings = read_settings(a[0], {});
  const std::vector<ClosedForm> forms = closed_forms(0.0);
  std::ofstream out(a[2]);
  if (!out) throw Error(ExitCode::file_system, "cannot write " + a[2] + " (it does not open); name another file");
  out << "case,setting,engine,moment_s,place_L1_m,velocity_L1_m_per_s,contacts,user_s_per_s,commit\n";
  std::string list = a[1] + ",";
  for (std::size_t comma; (comma = list.find(',')) != std::string::npos; list.erase(0, comma + 1)) {
    const double step = number_of(list.substr(0, comma), "MOMENT_S");
    if (!(step > 0.0)) throw Error(ExitCode::usage, "a moment of " + list + " s (it must be above 0); correct it");
    for (std::size_t k = 0; k < forms.size(); ++k)
      for (const EngineSetting& setting : settings) {
        const ClosedForm& form = forms[k];
        const Errors errors = mean_errors(k, setting, step);
        out << form.name << ',' << setting.label << ',' << setting.engine.name << ',' << number_text(step) << ','
            << number_text(errors.place, 6) << ',' << number_text(errors.velocity, 6) << ',' << errors.contacts << ','
            << number_text(cost_of(form, setting, step), 6) << ',' << GEM_COMMIT << std::endl;
      }
  }
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) { return gem::bench::run_program("closed_form_errors", gem::bench::run, argc, argv); }
