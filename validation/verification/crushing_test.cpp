// Closed-form crushing of an impact, and what may not be called a peak load: V48 and V49.
#include <cmath>
#include <limits>

#include "gem/events/crushing.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

constexpr double mass = 45000.0, speed = 0.5;
constexpr double corner_growth = 2.0;  // 90 degrees: cot 45 + cot 45

TEST(Crushing, V48_corner_and_face) {
  const double energy = 0.5 * mass * speed * speed;
  check("V48.E", energy, rounding);
  const auto corner = [&](const std::string& key, double exponent) {
    const CrushingPeak peak = crushing_corner({1e6, exponent, 0.5}, corner_growth, energy);
    check(key + ".delta", peak.depth, rounding);
    check(key + ".Fmax", peak.force, rounding);
    const double duration = crushing_duration(peak.depth, speed, 2.0 + exponent);
    check(key + ".t", duration, rounding);
    return duration;
  };
  const double duration = corner("V48", -0.1);
  check("V48.Fmean", mass * speed / duration, rounding);
  corner("V48b", 0.0);

  const CrushingPeak face = crushing_flat({1e6, 0.0, 0.5}, 10.0, energy);
  check("V48c.delta", face.depth, rounding);
  check("V48c.F", face.force, rounding);
  check("V48c.t", crushing_duration(face.depth, speed, 1.0), rounding);
}

TEST(Crushing, V48_event_followed_in_time) {
  // the second, independent way: m z'' = -F(z) by small steps of an exact energy balance
  const CrushingIce ice{1e6, -0.1, 0.5};
  double depth = 0.0, v = speed, time = 0.0;
  const double dt = 1e-6;
  while (v > 0.0) {
    depth += 0.5 * dt * v;
    v -= dt * crushing_force(ice, corner_growth * depth) / mass;
    depth += 0.5 * dt * v;
    time += dt;
  }
  // leap-frog: the last step may pass the turn by dt, where the speed is below F dt / m
  check_absolute("V48.t", time, 2.0 * dt);
  check("V48.delta", depth, 1e-9);
  check("V48.Fmax", crushing_force(ice, corner_growth * depth), 1e-9);
}

class CrushingEvents : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, CrushingEvents, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(CrushingEvents, V49_peak_is_not_impulse_over_moment) {
  double first_peak = 0.0;
  for (const double dt : {1e-4, 1e-3, 1e-2, 1e-1}) {
    SceneDef scene = quiet_scene();
    scene.numerics.moment_s = dt;
    scene.ice.crushing_pressure_Pa = 1e6;
    scene.platform.present = true;
    scene.platform.mass_kg = 1e12;  // as good as a wall
    scene.mooring.stiffness_N_per_m = 0.0;
    // the floe's face meets the platform's first corner
    scene.floe = {square({55.0 - touch, 0.0}, {-speed, 0.0})};
    scene.output.event_speed_m_per_s = 0.0;
    Simulation run = start(scene, setting());
    run.advance(1);
    ASSERT_EQ(run.log.events.size(), 1u);
    const ContactEvent& event = run.log.events[0];
    // the platform's corner is the wedge: its sides stand 9 degrees off the floe's face, cot + cot
    const double growth = 2.0 / std::tan(degrees(9.0));
    check_value("V49.growth", growth, event.growth, rounding * growth, "-", where());
    const double energy = 0.5 * event.effective_mass * event.closing_speed * event.closing_speed;
    const CrushingPeak peak = crushing_peak({1e6, -0.1, 0.5}, growth, 10.0, energy);
    check_value("V49.peak", peak.force, event.peak_force, 10.0 * rounding * peak.force, "N", where());
    // J / dt of the same event runs from 2e5 to 2e8 N; the peak does not follow it
    if (first_peak == 0.0) first_peak = event.peak_force;
    check_value("V49.peak_over_dt", 1.0, event.peak_force / first_peak, rounding, "-", where());
    const double impulse_rate = event.impulse_normal / dt;
    check_value("V49.J_over_dt", mass * speed / dt, impulse_rate, 1e-6 * impulse_rate, "N", where());
    EXPECT_GT(std::fabs(std::log(event.peak_force / impulse_rate)), 0.1) << "a peak load that is J / dt";
  }
}

}  // namespace
}  // namespace gem::verification
