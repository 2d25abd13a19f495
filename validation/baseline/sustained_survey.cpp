// Sustained contact, V30 to V38, on gem's engines and on Box2D with default settings. Prints one CSV row per number and
// setting, beside the closed form. A survey: it judges nothing.
//
// V37 is left out: its support must retreat, and fixed bodies do not move here.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "validation/verification/baselines.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

constexpr double k_form = 0.05;  // [1/m]
constexpr double k_skin = 1025.0 * 0.005 / (2.0 * 900.0 * 0.5);

/// This program's coefficient for the drag rate k on a floe 0.5 m thick.
double coefficient_for(double k) { return k * 900.0 * 0.5 / 1025.0; }

/// A scene with default contacts and numerics, in a current.
SceneDef pressed_scene(Vec2 current, double k) {
  SceneDef scene = quiet_scene();
  scene.numerics = NumericsDef{};
  scene.contact = ContactDef{};
  scene.current.velocity_m_per_s = current;
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = coefficient_for(k);
  scene.water.spin_drag = false;
  return scene;
}

class Survey {
 public:
  explicit Survey(Setting setting) : setting_(std::move(setting)) {}

  void row(const std::string& key, double computed) const {
    const Expected& line = expected(key);
    row(key, line.value, computed, line.unit);
  }
  void row(const std::string& key, double wanted, double computed, const std::string& unit) const {
    std::cout << key.substr(0, 3) << ',' << key << ',' << setting_.engine << ',' << setting_.where().solver << ','
              << number_text(wanted, 12) << ',' << number_text(computed, 12) << ','
              << number_text(std::fabs(computed - wanted), 3) << ",," << unit << ",surveyed\n";
  }

  Simulation begin(SceneDef scene) const {
    // independent: the paper's contacts
    if (!setting_.coupled()) scene.contact.manifold = Manifold::chord_middle;
    Simulation run = start(std::move(scene), setting_);
    run.log.wants_events = false;
    return run;
  }

 private:
  Setting setting_;
};

/// Mean force of fixed bodies over the next `seconds`, by channel [N].
struct MeanForce {
  Vec2 normal, friction;
};
MeanForce force_over(Simulation& run, double seconds, double dt) {
  const Ledger before = run.engine->ledger();
  run.log.clear();
  run.advance(std::llround(seconds / dt));
  const Ledger after = run.engine->ledger();
  std::int64_t contacts = 0;
  for (const StepQuality& quality : run.log.quality) contacts += quality.contacts;
  EXPECT_GT(contacts, 0) << "nothing touched";
  const auto mean = [&](Channel channel) {
    return (1.0 / seconds) * (after[channel].momentum - before[channel].momentum);
  };
  return {mean(Channel::impact) + mean(Channel::elastic), mean(Channel::friction)};
}

void v30_held_or_sliding(const Survey& survey) {
  for (const double mu : {0.8, 0.2, 0.5}) {
    SceneDef scene = pressed_scene({0.3, -0.4}, k_skin);
    scene.ice.friction_ice = mu;
    scene.fixed = {{{{-20.0, -16.0}, {2000.0, -16.0}, {2000.0, 0.0}, {-20.0, 0.0}}}};
    scene.floe = {square({0.0, 5.0})};
    Simulation run = survey.begin(scene);
    run.advance(60000);  // eight times the slowest time constant
    const Vec2 from = run.bodies().position[2];
    const MeanForce force = force_over(run, 200.0, scene.numerics.time_step_s);
    const double speed = (run.bodies().position[2].x - from.x) / 200.0;
    const double total = std::sqrt(dot(force.normal + force.friction, force.normal + force.friction));
    if (mu == 0.8) {
      survey.row("V30.N_rest", force.normal.y);
      survey.row("V30.T_rest", -force.friction.x);
      survey.row("V30.creep", 0.0, speed, "m/s");
    } else {
      const std::string key = mu == 0.2 ? "V30.mu02" : "V30.mu05";
      survey.row(key + ".v", speed);
      survey.row(key + ".N", total / std::sqrt(1.0 + mu * mu));
    }
  }
}

void v31_braked_to_rest(const Survey& survey) {
  SceneDef scene = pressed_scene({0.0, -0.4}, k_form);
  scene.water.drag_law = DragLaw::linear;
  scene.water.linear_time_s = 100.0;
  scene.ice.friction_ice = 0.3;
  scene.fixed = {{{{-20.0, -16.0}, {100.0, -16.0}, {100.0, 0.0}, {-20.0, 0.0}}}};
  scene.floe = {square({0.0, 5.0}, {0.5, 0.0})};
  Simulation run = survey.begin(scene);
  run.advance(1000);
  survey.row("V31.v50", run.bodies().velocity[2].x);
  const double dt = scene.numerics.time_step_s;
  while (run.bodies().velocity[2].x > 1e-6 && run.engine->step() < 6000) run.advance(1);
  survey.row("V31.t", static_cast<double>(run.engine->step()) * dt);
  survey.row("V31.x", run.bodies().position[2].x);
  const Vec2 stopped = run.bodies().position[2];
  run.advance(20000);
  survey.row("V31.creep_1000s", 0.0, run.bodies().position[2].x - stopped.x, "m");
}

void v32_along_a_barrier(const Survey& survey, double angle, double mu, const std::string& key) {
  const Vec2 along{std::cos(angle), std::sin(angle)}, out{-std::sin(angle), std::cos(angle)};
  SceneDef scene = pressed_scene({0.25, 0.0}, k_form);
  scene.ice.friction_ice = mu;
  scene.fixed = {{{-20.0 * along - 16.0 * out, 500.0 * along - 16.0 * out, 500.0 * along, -20.0 * along}}};
  scene.floe = {square(5.0 * out, 0.25 * along, angle)};
  Simulation run = survey.begin(scene);
  run.advance(26000);  // 1300 s, eight times 1 / (k U sin(angle)) at 30 degrees; at the small angle it starts in the
                       // steady state
  const Vec2 from = run.bodies().position[2];
  const MeanForce force = force_over(run, 200.0, scene.numerics.time_step_s);
  const Vec2 total = force.normal + force.friction;
  survey.row(key + ".v", dot(along, run.bodies().position[2] - from) / 200.0);
  survey.row(key + ".N", dot(out, total));
}

void v33_column(const Survey& survey, int count) {
  SceneDef scene = pressed_scene({0.5, 0.0}, k_form);
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({5.0 + 10.0 * i, 0.0}));
  const double end = 10.0 * count;
  scene.fixed = {{{{end, -20.0}, {end + 16.0, -20.0}, {end + 16.0, 20.0}, {end, 20.0}}}};
  Simulation run = survey.begin(scene);
  run.advance(1000);
  const MeanForce force = force_over(run, 10.0, scene.numerics.time_step_s);
  const std::string n = std::to_string(count);
  survey.row("V33.F" + n, -force.normal.x);
  double deepest = 0.0;
  for (const StepQuality& quality : run.log.quality) deepest = std::max(deepest, quality.maximum_overlap);
  survey.row("V33.overlap" + n, 0.0, deepest, "m");
}

void v34_column_on_the_platform(const Survey& survey) {
  const double turn = degrees(9.0), apothem = 50.0 * std::cos(turn);  // face on
  const Vec2 along{std::cos(turn), std::sin(turn)};
  SceneDef scene = pressed_scene(0.5 * along, k_form);
  scene.platform.present = true;
  scene.mooring.damping_ratio = 0.5;
  for (int i = 0; i < 10; ++i) scene.floe.push_back(square(-(apothem + 5.0 + 10.0 * i) * along, {}, turn));
  Simulation run = survey.begin(scene);
  run.advance(8000);
  run.log.clear();
  run.advance(2000);
  double mean = 0.0;
  for (const PlatformStep& step : run.log.platform) mean += dot(along, step.position) / 2000.0;
  survey.row("V34.offset", mean);
}

void v35_notch(const Survey& survey) {
  const double angle = degrees(35.0);
  SceneDef scene = pressed_scene({0.0, -0.5}, k_form);
  scene.fixed = {notch_side(angle, 1.0), notch_side(angle, -1.0)};
  scene.floe = {square({0.0, 5.0 + 5.0 / std::tan(angle)})};
  Simulation run = survey.begin(scene);
  run.advance(1000);
  const MeanForce force = force_over(run, 10.0, scene.numerics.time_step_s);
  survey.row("V35.mu0", force.normal.y / (2.0 * std::sin(angle)));
}

void v36_two_pegs(const Survey& survey) {
  SceneDef scene = pressed_scene({0.0, -0.5}, k_form);
  for (const double x : {-3.0, 5.0}) scene.fixed.push_back({{{x, 0.0}, {x - 1.0, -2.0}, {x + 1.0, -2.0}}});
  scene.floe = {{rectangle(20.0, 5.0), {0.0, 2.5}, 0.0, {}, 0.0, 0.5}};
  Simulation run = survey.begin(scene);
  run.advance(1000);
  const Ledger before = run.engine->ledger();
  const MeanForce force = force_over(run, 10.0, scene.numerics.time_step_s);
  const Ledger after = run.engine->ledger();
  double twist = 0.0;
  for (const Channel channel : {Channel::impact, Channel::elastic})
    twist += (after[channel].angular_momentum - before[channel].angular_momentum) / 10.0;
  survey.row("V36.N1", (5.0 * force.normal.y - twist) / 8.0);
  survey.row("V36.N2", (3.0 * force.normal.y + twist) / 8.0);
}

void v38_jam_of_a_row(const Survey& survey) {
  SceneDef scene = pressed_scene({0.0, 0.0}, k_form);
  scene.water.drag_law = DragLaw::none;
  const int count = 10;
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({-20.0 - 25.0 * i, 0.0}, {0.25, 0.0}));
  scene.fixed = {{{{0.0, -20.0}, {16.0, -20.0}, {16.0, 20.0}, {0.0, 20.0}}}};
  Simulation run = survey.begin(scene);
  const std::size_t last = 1 + count;
  while (run.bodies().velocity[last].x > 0.125 && run.engine->step() < 20000) run.advance(1);
  const double stopped = static_cast<double>(run.engine->step()) * scene.numerics.time_step_s;
  survey.row("V38.front", 10.0 * count / stopped);
  run.advance(400);  // independent spreads an impact along the row over several time steps
  survey.row("V38.Fmean",
             -(run.engine->ledger()[Channel::impact].momentum.x + run.engine->ledger()[Channel::elastic].momentum.x) /
                 (60.0 * count));
  double fastest = 0.0;
  for (std::size_t i = 2; i <= last; ++i) fastest = std::max(fastest, length(run.bodies().velocity[i]));
  survey.row("V38.speed_left", 0.0, fastest, "m/s");
}

void survey_all(const Setting& setting) {
  const Survey survey(setting);
  v30_held_or_sliding(survey);
  v31_braked_to_rest(survey);
  v32_along_a_barrier(survey, degrees(30.0), 0.0, "V32.b30.mu0");
  v32_along_a_barrier(survey, degrees(30.0), 0.3, "V32.b30.mu03");
  v32_along_a_barrier(survey, degrees(value_of("V32.seed.angle")), 0.0, "V32.seed.mu0");
  v33_column(survey, 10);
  v33_column(survey, 100);
  v34_column_on_the_platform(survey);
  v35_notch(survey);
  v36_two_pegs(survey);
  v38_jam_of_a_row(survey);
}

}  // namespace
}  // namespace gem::verification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  using namespace gem::verification;
  survey_all({"cpu", gem::ContactSolver::coupled});
  survey_all({"cpu", gem::ContactSolver::independent});
  for (const Setting& setting : surveyed_baselines()) survey_all(setting);
  return testing::Test::HasFailure() ? 1 : 0;
}
