// The platform on its mooring, free and damped, against closed form: V39 to V45.
#include <algorithm>
#include <cmath>
#include <vector>

#include "gem/events/events.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Platform : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Platform, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double mass = 1e8, stiffness = 5e5;
const double omega = std::sqrt(stiffness / mass);

/// A single platform, 100 m wide, moored with 5e5 N/m.
SceneDef platform_alone(Vec2 offset, double dt) {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  scene.platform.start_offset_m = offset;
  scene.numerics.time_step_s = dt;
  return scene;
}

/// The flow is exact. Its coefficients, products, sums and the sum with the anchor are rounded to 1.1e-16 each, twice
/// per time step: 8.9e-16 of the largest value per time step. The outline's corners at 50 m are rounded to 7e-15 m, and
/// so is the centroid that the position refers to, by up to three roundings.
double exact_flow(double steps) { return 8.9e-16 * steps; }
constexpr double placed = 2e-14;

Vec2 place(Simulation& run) { return run.bodies().position[0]; }
Vec2 speed(Simulation& run) { return run.bodies().velocity[0]; }

/// Period of the undamped flow over `duration` seconds. sin(angle) keeps all digits of a small angle.
double period_of(double k, double m, double duration) {
  const MooringFlow flow = mooring_flow(k, m, 0.0, duration);
  const double sine = std::sqrt(-flow.xv * flow.vx);
  return 2.0 * M_PI * duration / std::atan2(sine, 0.5 * (flow.xx + flow.vv));
}

TEST(PlatformLaw, V39_period) {
  check("V39.T", period_of(stiffness, mass, 0.025), rounding);
  check("V39.omega", 2.0 * M_PI / period_of(stiffness, mass, 0.025), rounding);
  check("V39.T50k", period_of(5e4, mass, 0.025), rounding);
  // The stiffness or mass that would give a period of 72 s.
  check_value("V39.k72", 72.0, period_of(value_of("V39.k72"), mass, 0.025), 72.0 * rounding, "s");
  check_value("V39.M72", 72.0, period_of(stiffness, value_of("V39.M72"), 0.025), 72.0 * rounding, "s");
}

TEST_P(Platform, V39_free_swing) {
  const double dt = 0.05;
  Simulation run = start(platform_alone({1.0, 0.0}, dt), setting());
  run.advance(2000);
  check_absolute("V39.x100", place(run).x, placed + exact_flow(2000), where());
  check_absolute("V39.v100", speed(run).x, omega * (placed + exact_flow(2000)), where());
  run.advance(142000);
  check_absolute("V39.x7200", place(run).x, placed + exact_flow(144000), where());
  check_absolute("V39.v7200", speed(run).x, omega * (placed + exact_flow(144000)), where());
}

TEST_P(Platform, V39_period_over_many_swings) {
  const double dt = 0.05;
  Simulation run = start(platform_alone({1.0, 0.0}, dt), setting());
  // Times of every second zero crossing, from the phase of the time step after it.
  std::vector<double> crossings;
  double last = 1.0;
  while (crossings.size() < 101 && run.engine->step() < 400000) {
    run.log.clear();
    run.advance(1);
    const double x = place(run).x;
    if (last > 0.0 && x <= 0.0)
      crossings.push_back(static_cast<double>(run.engine->step()) * dt - std::atan2(-x, -speed(run).x / omega) / omega);
    last = x;
  }
  ASSERT_EQ(crossings.size(), 101u);
  // The stated tolerance. The phase itself drifts by 4.4e-16 per time step of 3.5e-3 rad: 1.3e-13.
  check("V39.T", (crossings.back() - crossings.front()) / 100.0, 1e-9 / value_of("V39.T"), where());
}

/// Relative change of the energy over `hours` at dt = 0.05 s.
void check_energy(double hours, const Setting& setting) {
  const double dt = 0.05;
  Simulation run = start(platform_alone({1.0, 0.0}, dt), setting);
  run.log.wants_events = false;
  const double first = run.first.now.energy;
  const std::int64_t blocks = static_cast<std::int64_t>(hours * 20.0);
  double largest = 0.0;
  for (std::int64_t i = 0; i < blocks; ++i) {
    run.log.clear();
    run.advance(3600);
    largest = std::max(largest, std::fabs(run.engine->ledger().now.energy / first - 1.0));
  }
  check_value("V39.energy_drift_" + std::to_string(static_cast<int>(hours)) + "h", 0.0, largest,
              2.0 * exact_flow(static_cast<double>(blocks) * 3600.0), "-", setting.where());
}

TEST_P(Platform, V39_no_energy_drift_in_2_hours) { check_energy(2.0, setting()); }
TEST_P(Platform, V39_no_energy_drift_in_72_hours) { check_energy(72.0, setting()); }

TEST_P(Platform, V40_damped_swing) {
  const double tau = 10.0;
  const MooringFlow flow = mooring_flow(stiffness, mass, 0.05, tau);
  const double determinant = flow.xx * flow.vv - flow.xv * flow.vx;
  const double rate = -0.5 * std::log(determinant) / tau;
  const double angle = std::acos(0.5 * (flow.xx + flow.vv) / std::sqrt(determinant));
  const double damped_period = 2.0 * M_PI * tau / angle;
  check("V40.c", 2.0 * mass * rate, rounding, where());
  check("V40.Td", damped_period, rounding, where());
  check("V40.delta", rate * damped_period, rounding, where());

  SceneDef scene = platform_alone({1.0, 0.0}, 0.05);
  scene.mooring.damping_ratio = 0.05;
  Simulation run = start(scene, setting());
  run.advance(2000);
  check_absolute("V40.x100", place(run).x, placed + exact_flow(2000), where());
  scene.numerics.time_step_s = damped_period / 2000.0;
  Simulation cycles = start(scene, setting());
  cycles.advance(20000);
  check_absolute("V40.ratio10", place(cycles).x, placed + exact_flow(20000), where());
  expect_closed_books(cycles, 1e-10, mass * omega);
}

TEST_P(Platform, V41_step_of_force) {
  // A constant force F is an anchor shifted by F / k: the platform starts at x = 0.
  const double shift = 1e4 / stiffness, dt = 0.05;
  check("V41.static", shift, rounding, where());
  for (const double ratio : {0.0, 0.05}) {
    SceneDef scene = platform_alone({-shift, 0.0}, dt);
    scene.platform.anchor_m = {shift, 0.0};
    scene.mooring.damping_ratio = ratio;
    Simulation run = start(scene, setting());
    double peak = 0.0;
    for (int i = 0; i < 1000; ++i) {
      run.advance(1);
      peak = std::max(peak, place(run).x);
      if (i + 1 == 600 && ratio == 0.0)
        check_absolute("V41.x30", place(run).x, placed + 2.0 * shift * exact_flow(600), where());
    }
    // The peak between two samples is missed by at most (omega dt / 2)^2 / 2 of the amplitude.
    const double missed = shift * 0.125 * omega * omega * dt * dt;
    check_absolute(ratio == 0.0 ? "V41.peak" : "V41.peak_z05", peak, missed, where());
  }
}

/// Adds velocity to the platform through the engine's state.
void kick(Simulation& run, double change) {
  EngineState state = run.engine->save();
  state.bodies.velocity[0].x += change;
  run.engine->restore(state);
}

TEST_P(Platform, V42_impulses) {
  const double impulse = 11250.0, change = impulse / mass;
  const double period = value_of("V39.T"), dt = period / 2000.0;
  // One impulse, then one more per period: the amplitude grows by equal amounts.
  Simulation grow = start(platform_alone({}, dt), setting());
  double last = 0.0;
  for (int i = 0; i < 4; ++i) {
    kick(grow, change);
    grow.advance(500);
    check_value("V42.one", value_of("V42.one"), place(grow).x - last,
                placed + value_of("V42.one") * exact_flow(8000) + expected("V42.one").last_digit, "m", where());
    last = place(grow).x;
    grow.advance(1500);
  }
  // A train of impulses: after one interval the state repeats.
  for (const auto& [key, interval] : {std::pair{"V42.T20", 20.0}, std::pair{"V42.T60", 60.0}}) {
    const std::string name = key;
    const double time_step = 0.02;
    SceneDef scene = platform_alone({value_of(name + ".x0"), 0.0}, time_step);
    scene.platform.start_velocity_m_per_s = {value_of(name + ".v0"), 0.0};
    Simulation run = start(scene, setting());
    const int steps = static_cast<int>(interval / time_step);
    double most = 0.0, sum = 0.5 * place(run).x;
    for (int i = 0; i < steps; ++i) {
      run.advance(1);
      most = std::max(most, place(run).x);
      sum += i + 1 < steps ? place(run).x : 0.5 * place(run).x;
    }
    kick(run, change);
    const double scale = value_of("V42.one"), walked = placed + scale * exact_flow(steps);
    check_absolute(name + ".x0", place(run).x, walked, where());
    check_absolute(name + ".v0", speed(run).x, omega * walked, where());
    // Between two samples: (omega dt)^2 / 8 of the amplitude. Trapezium rule: (omega dt)^2 / 12.
    const double sampled = scale * omega * omega * time_step * time_step / 8.0;
    check_absolute(name + ".max", most, sampled, where());
    check_absolute(name + ".mean", sum / steps, sampled, where());
  }
}

/// A platform with quadratic drag of rate 0.006 1/m in still water, released 5 m from its anchor.
SceneDef platform_with_drag(double dt) {
  SceneDef scene = platform_alone({5.0, 0.0}, dt);
  scene.platform_drag.present = true;
  scene.platform_drag.water = DampingWater::still;
  scene.platform_drag.draft_m = 10.0;
  scene.platform_drag.coefficient = 0.006 * 2.0 * mass / (1025.0 * 100.0 * 10.0);
  return scene;
}

/// Its amplitudes at the turning points.
std::vector<double> turns(double dt, const Setting& setting) {
  Simulation run = start(platform_with_drag(dt), setting);
  std::vector<double> amplitude;
  double before = 0.0;
  while (amplitude.size() < 7 && run.engine->step() < 200000) {
    run.advance(1);
    const double v = speed(run).x;
    // Within dt of the turning point the work of the drag is of order b (omega^2 A dt)^3 dt, which is negligible.
    if (before * v < 0.0) amplitude.push_back(std::hypot(place(run).x, v / omega));
    before = v;
  }
  expect_closed_books(run, 1e-10);
  return amplitude;
}

TEST_P(Platform, V43_quadratic_drag) {
  const double dt = 0.05;
  const std::vector<double> fine = turns(dt, setting());
  ASSERT_EQ(fine.size(), 7u);
  // A symmetric split changes the damping by (omega dt)^2 relative.
  const double share = omega * omega * dt * dt;
  check_absolute("V43.A1", fine[0], share * (5.0 - fine[0]), where());
  check_absolute("V43.A2", fine[1], share * (5.0 - fine[1]), where());
  check_absolute("V43.A6", fine[5], share * (5.0 - fine[5]), where());
  // Second order: half the time step gives a quarter of the difference. Reversals of speed within a time step blur it
  // by a few percent.
  const auto after_100_s = [&](double step) {
    Simulation run = start(platform_with_drag(step), setting());
    run.advance(static_cast<std::int64_t>(100.0 / step));
    return place(run).x;
  };
  const double coarse = after_100_s(1.0), middle = after_100_s(0.5), close = after_100_s(0.25);
  check_value("V43.order", 4.0, (coarse - middle) / (middle - close), 0.2, "-", where());
}

TEST_P(Platform, V44_ellipse) {
  SceneDef scene = platform_alone({1.0, 0.0}, 0.05);
  scene.platform.start_velocity_m_per_s = {0.0, 0.05};
  Simulation run = start(scene, setting());
  double widest = 0.0, moved = 0.0;
  for (int i = 0; i < 20000; ++i) {
    run.advance(1);
    const double momentum = mass * cross(place(run), speed(run));
    widest = std::max(widest, place(run).y);
    moved = std::max(moved, std::fabs(momentum - value_of("V44.Lz")));
  }
  check_value("V44.Lz", value_of("V44.Lz"), value_of("V44.Lz") + moved, value_of("V44.Lz") * exact_flow(20000), "N m s",
              where());
  check_absolute("V44.b", widest, 0.125 * omega * omega * 0.05 * 0.05, where());
  check_absolute("V44.x1000", place(run).x, placed + exact_flow(20000), where());
  check_absolute("V44.y1000", place(run).y, placed + exact_flow(20000), where());
}

TEST(PlatformLaw, V45_no_period_error_of_its_own) {
  const double period = value_of("V39.T");
  for (const auto& [name, dt] :
       {std::pair{"dt0p001", 1e-3}, std::pair{"dt0p01", 1e-2}, std::pair{"dt0p1", 1e-1}, std::pair{"dt1", 1.0}}) {
    // Where kick-drift has an error of (omega dt)^2 / 24 and explicit Euler grows, the exact flow has only rounding.
    check_value("V45.relT_exact_flow_" + std::string(name), 0.0, period_of(stiffness, mass, 0.5 * dt) / period - 1.0,
                rounding, "-");
    const MooringFlow flow = mooring_flow(stiffness, mass, 0.0, 0.5 * dt);
    check_value("V45.growth_exact_flow_" + std::string(name), 1.0, flow.xx * flow.vv - flow.xv * flow.vx, 1e-15, "-");
    for (const char* what : {"T_sympl_", "relT_", "explicit_growth_"})
      not_offered("V45." + std::string(what) + std::string(name));
  }
  not_offered("V45.x72000_kickdrift_dt0p1");
}

}  // namespace
}  // namespace gem::verification
