// Closed-form crushing of an impact, and what must not be called a peak load: V48, V49 and V54.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/number_text.h"
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
  // A second, independent way: m z'' = -F(z) in small steps of an exact energy balance.
  const CrushingIce ice{1e6, -0.1, 0.5};
  double depth = 0.0, v = speed, time = 0.0;
  const double dt = 1e-6;
  while (v > 0.0) {
    depth += 0.5 * dt * v;
    v -= dt * crushing_force(ice, corner_growth * depth) / mass;
    depth += 0.5 * dt * v;
    time += dt;
  }
  // Leap-frog: the last step may pass the turning point by dt, where the speed is below F dt / m.
  check_absolute("V48.t", time, 2.0 * dt);
  check("V48.delta", depth, 1e-9);
  check("V48.Fmax", crushing_force(ice, corner_growth * depth), 1e-9);
}

class CrushingEvents : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, CrushingEvents, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(CrushingEvents, V49_peak_is_not_impulse_over_step) {
  double first_peak = 0.0;
  for (const double dt : {1e-4, 1e-3, 1e-2, 1e-1}) {
    SceneDef scene = quiet_scene();
    scene.numerics.time_step_s = dt;
    scene.ice.crushing_pressure_Pa = 1e6;
    scene.platform.present = true;
    scene.platform.mass_kg = 1e12;  // practically a wall
    scene.mooring.stiffness_N_per_m = 0.0;
    // The face of the floe hits the first corner of the platform.
    scene.floe = {square({55.0 - touch, 0.0}, {-speed, 0.0})};
    scene.output.event_speed_m_per_s = 0.0;
    Simulation run = start(scene, setting());
    run.advance(1);
    ASSERT_EQ(run.log.events.size(), 1u);
    const ContactEvent& event = run.log.events[0];
    // The platform's corner is the wedge: each side stands 9 degrees from the floe's face, so the growth is cot + cot.
    const double growth = 2.0 / std::tan(degrees(9.0));
    check_value("V49.growth", growth, event.growth, rounding * growth, "-", where());
    const double energy = 0.5 * event.effective_mass * event.closing_speed * event.closing_speed;
    const CrushingPeak peak = crushing_peak({1e6, -0.1, 0.5}, growth, 10.0, energy);
    check_value("V49.peak", peak.force, event.peak_force, 10.0 * rounding * peak.force, "N", where());
    // J / dt of this event ranges from 2e5 to 2e8 N; the peak does not depend on dt.
    if (first_peak == 0.0) first_peak = event.peak_force;
    check_value("V49.peak_over_dt", 1.0, event.peak_force / first_peak, rounding, "-", where());
    const double impulse_rate = event.impulse_normal / dt;
    check_value("V49.J_over_dt", mass * speed / dt, impulse_rate, 1e-6 * impulse_rate, "N", where());
    EXPECT_GT(std::fabs(std::log(event.peak_force / impulse_rate)), 0.1) << "a peak load that is J / dt";
  }
}

class CrushingCap : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, CrushingCap, ::testing::ValuesIn(coupled_settings()), setting_name);

TEST_P(CrushingCap, V54_a_face_crushes_with_its_force_from_the_first_step) {
  for (const double face : {3.5, 12.0, 24.0}) {  // crushed area [m2]
    const std::string key = "V54.face_" + number_text(face);
    const double width = 10.0, thick = face / width, hit_mass = 900.0 * width * face;
    SceneDef scene = quiet_scene();
    scene.contact.crushing_limit = true;
    scene.ice.crushing_pressure_Pa = 1e6;
    scene.ice.pressure_area_exponent = -0.1;
    scene.fixed = {floor_wall()};
    FloeDef floe = on_floor(square({}, {0.0, -speed}));
    floe.thickness_m = thick;
    scene.floe = {floe};
    const double force = crushing_force({1e6, -0.1, thick}, width), time = hit_mass * speed / force;
    const double depth = 0.5 * hit_mass * speed * speed / force;
    for (const double steps : {12.5, 100.5, 800.5}) {  // until the floe stands
      scene.numerics.time_step_s = time / steps;
      Simulation run = start(scene, setting());
      const double before = run.bodies().position.back().y;
      double last = -speed;
      double weakest = 1e300, strongest = 0.0;
      for (int k = 0; k < static_cast<int>(steps); ++k) {
        run.advance(1);
        const double now = run.bodies().velocity.back().y;
        const double impulse = hit_mass * (now - last);
        weakest = std::min(weakest, impulse), strongest = std::max(strongest, impulse);
        last = now;
      }
      const std::string id = key + ".steps_" + number_text(steps);
      const double whole = force * scene.numerics.time_step_s;
      // a difference of speeds of 0.5 m/s, of which a step takes the share 1 / steps
      check_value(id + ".weakest", 1.0, weakest / whole, rounding * steps, "-", where());
      check_value(id + ".strongest", 1.0, strongest / whole, rounding * steps, "-", where());
      run.advance(2);
      check_value(id + ".speed", 0.0, run.bodies().velocity.back().y, rounding, "m/s", where());
      // each time step moves with the speed at its end
      const double sunk = before - run.bodies().position.back().y;
      check_value(id + ".depth", 1.0, sunk / depth, 1.1 / steps, "-", where());
      expect_closed_books(run);
    }
  }
}

constexpr double side = 8.0, thickness = 0.5;  // of the tilted floe [m]
const CrushingIce ice_of_scene{2.5e6, -0.1, thickness};

/// A floe at 0.25 m/s whose face touches the middle of the platform's first face, tilted against it by `tilt` [rad].
SceneDef tilted_scene(double tilt, double dt, double contact_reach) {
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = dt;
  scene.numerics.contact_reach = contact_reach;
  scene.ice.crushing_pressure_Pa = ice_of_scene.pressure;
  scene.platform.present = true;
  scene.platform.mass_kg = 1e12;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.output.event_speed_m_per_s = 0.0;
  const double facing = degrees(9.0), face = 50.0 * std::cos(facing);
  const Vec2 outward{std::cos(facing), std::sin(facing)};
  const double reach = 0.5 * side * (std::cos(tilt) + std::sin(tilt));
  scene.floe = {
      {rectangle(side, side), (face + reach - touch) * outward, facing + tilt, -0.25 * outward, 0.0, thickness}};
  return scene;
}

TEST_P(CrushingEvents, V49_peak_of_tilted_faces) {
  for (const double tilt : {0.0, 1e-6, 1e-3, 3e-3, 1e-2}) {
    const std::string key = "V49.tilt_" + number_text(tilt);
    const double growth = tilt > 0.0 ? 1.0 / std::tan(tilt) + std::tan(tilt) : 0.0;
    const auto law = [&](double energy) { return crushing_peak(ice_of_scene, growth, side, energy).force; };
    double worst = 1.0, smallest = 1e300, largest = 0.0;
    for (const double dt : {0.4, 0.2, 0.1, 0.05, 0.02})
      for (const double contact_reach : {1.0, 1.5, 10.0}) {
        Simulation run = start(tilted_scene(tilt, dt, contact_reach), setting());
        run.advance(1);
        ASSERT_EQ(run.log.events.size(), 1u) << key << " dt " << dt;
        const ContactEvent& event = run.log.events[0];
        const double ratio =
            event.peak_force / law(0.5 * event.effective_mass * event.closing_speed * event.closing_speed);
        if (std::fabs(ratio - 1.0) > std::fabs(worst - 1.0)) worst = ratio;
        smallest = std::min(smallest, event.peak_force);
        largest = std::max(largest, event.peak_force);
      }
    // Positions 50 m from the origin are rounded to 7e-15 m. The separations of the two ends contain about ten such
    // errors and differ by side x tilt. With a small margin the longest chord may be side (cos + sin) instead of side
    // cos.
    const double tolerance = rounding + (tilt > 0.0 ? 7e-14 / (side * tilt) + tilt : tilt);
    check_value(key, 1.0, worst, tolerance, "-", where());
    // Whether the second end closes in the same time step depends on the time step. If it does, the event has up to all
    // of the floe's energy, not only what the corner stops. All peaks must lie between these two.
    const double whole = 0.5 * 900.0 * thickness * side * side * 0.25 * 0.25;
    const double lever = 0.5 * side * (std::cos(tilt) - std::sin(tilt));
    const double corner = whole / (1.0 + 6.0 * lever * lever / (side * side));
    const double slack = 1.0 + tolerance;
    EXPECT_GE(smallest * slack, law(corner)) << key;
    EXPECT_LE(largest, law(whole) * slack) << key;
    check_value(key + ".spread", 1.0, largest / smallest, slack * law(whole) / law(corner) - 1.0, "-", where());
  }
}

}  // namespace
}  // namespace gem::verification
