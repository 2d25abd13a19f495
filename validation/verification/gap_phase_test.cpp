// V53: the hits of V16 to V19, and random ones, over an open gap. Wherever in a time step the gap closes, the limit for
// dt -> 0 is the impulse of the whole hit.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gem/base/number_text.h"
#include "gem/base/random.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class GapPhase : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, GapPhase, ::testing::ValuesIn(all_settings()), setting_name);

/// A hit on the floor (V16, V17, V19), on another floe (V18), or on a platform (V17 turned).
struct Hit {
  std::string name, key;  // key: of its closed form; ".Pn" and ".Pt" follow
  SceneDef scene;         // in which the bodies touch
  Vec2 normal;            // towards the last floe; opens the gap
  double closing;         // speed at which the point that hits closes [m/s]
  Vec2 tangent;           // along which the closed form counts P_t
};

/// The hit of a floe on the floor, turned to the middle of the platform's first face.
Hit hit_on_platform(const std::string& key, FloeDef floe, double friction) {
  const double facing = degrees(9.0);
  const Rotation turn{std::sin(facing), -std::cos(facing)};  // by 9 - 90 degrees
  const Vec2 normal = rotate(turn, {0.0, 1.0});
  floe = on_floor(floe);
  floe.position_m = 50.0 * std::cos(facing) * normal + rotate(turn, floe.position_m);
  floe.velocity_m_per_s = rotate(turn, floe.velocity_m_per_s);
  floe.angle_rad += facing - degrees(90.0);
  SceneDef scene = quiet_scene();
  scene.ice.friction_structure = friction;
  scene.platform.present = true;
  scene.platform.mass_kg = 1e12;  // practically a wall
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.floe = {floe};
  return {"platform_" + key, key, scene, normal, 0.5, rotate(turn, {1.0, 0.0})};
}

std::vector<Hit> hits() {
  const FloeDef below = square({}, {0.6, -0.5}, degrees(45.0)), leaning = square({}, {-0.4, -0.5}, degrees(30.0));
  const FloeDef reversing = rod({}, {0.05, -0.5}, degrees(45.0));
  SceneDef fixed = over_floor(reversing, 0.2);
  fixed.contact.friction_law = FrictionLaw::fixed_direction;
  const Vec2 up{0.0, 1.0}, along{1.0, 0.0};
  const double face_closing = -value_of("V09.un");
  return {{"V16.slip", "V16.slip", over_floor(below, 0.1), up, 0.5, along},
          {"V16.stick", "V16.stick", over_floor(below, 0.4), up, 0.5, along},
          {"V17.slip", "V17.slip", over_floor(leaning, 0.1), up, 0.5, along},
          {"V17.stick", "V17.stick", over_floor(leaning, 0.6), up, 0.5, along},
          {"V18.mu005", "V18.mu005", corner_on_face(0.05), along, face_closing, up},
          {"V18.mu030", "V18.mu030", corner_on_face(0.3), along, face_closing, up},
          {"V19.moreau", "V19.moreau", over_floor(reversing, 0.2), up, 0.5, along},
          {"V19.fixed", "V19.fixed", fixed, up, 0.5, along},
          hit_on_platform("V17.slip", leaning, 0.1),
          hit_on_platform("V17.stick", leaning, 0.6)};
}

/// Impulse on the last floe of a hit whose gap closes after `phase` time steps [N s].
Vec2 impulse_over_gap(const Hit& hit, double phase, double dt, const Setting& setting) {
  SceneDef scene = hit.scene;
  scene.numerics.time_step_s = dt;
  scene.floe.back().position_m += (touch + phase * hit.closing * dt) * hit.normal;
  Simulation run = start(scene, setting);
  const Vec2 before = run.bodies().velocity.back();
  run.advance(4);  // the hit takes two; each may begin one time step later by rounding
  int touched = 0;
  for (const StepQuality& quality : run.log.quality) touched += quality.contacts > 0;
  EXPECT_GT(touched, 0) << hit.name << ": the bodies never met";
  EXPECT_LE(residual(run.engine->ledger()).energy, 1e-12) << hit.name;
  return run.bodies().mass.back() * (run.bodies().velocity.back() - before);
}

/// Slope of log(error) over log(dt), by least squares.
double order_of(const std::vector<double>& steps, const std::vector<double>& errors) {
  const auto n = static_cast<double>(steps.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double a = std::log(steps[k]), b = std::log(errors[k]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

TEST_P(GapPhase, V53_limit_of_a_frictional_hit) {
  const std::vector<double> steps = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  for (const Hit& hit : hits()) {
    // V16 tells only P_t; P_n stops 45 t that turn about a point below their centre
    const double normal = hit.key.starts_with("V16") ? 45000.0 * 0.5 : value_of(hit.key + ".Pn");
    const Vec2 expected = normal * hit.normal + value_of(hit.key + ".Pt") * hit.tangent;
    std::vector<double> errors;  // of the worst phase, as share of the impulse
    for (const double dt : steps) {
      double worst = 0.0;
      for (const double phase : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98})
        worst = std::max(worst, length(impulse_over_gap(hit, phase, dt, setting()) - expected) / length(expected));
      errors.push_back(worst);
    }
    // The bodies turn by less than 0.07 rad/s x dt while they hit. That changes levers and compliance, by as much
    // again.
    const double turn = 0.14;
    for (std::size_t k = 0; k < steps.size(); ++k)
      check_value("V53." + hit.name + ".error_" + number_text(steps[k]), 0.0, errors[k], turn * steps[k], "-", where());
    // independent: the slipping V16 hits in one time step, from an overlap, and no lever matters
    if (errors.back() < rounding) continue;
    check_value("V53." + hit.name + ".order", 1.0, order_of(steps, errors), 0.2, "-", where());
  }
}

/// A rectangle over the floor with random size, motion and friction.
Hit random_hit(RandomSequence& random) {
  for (;;) {
    const double size = random.uniform(4.0, 20.0), width = size * random.uniform(0.05, 1.0);
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi), spin = random.uniform(-0.02, 0.02);
    const Vec2 velocity{random.uniform(-0.5, 0.5), random.uniform(-0.5, -0.1)};
    const FloeDef floe{rectangle(size, width), {}, turn, velocity, spin, 0.5};
    const double closing = -(velocity.y + spin * lowest_corner(floe).x);
    if (closing < 0.05) continue;
    return {"random", "", over_floor(floe, random.uniform(0.05, 0.5)), {0.0, 1.0}, closing, {1.0, 0.0}};
  }
}

TEST_P(GapPhase, V53_random_hits_do_not_depend_on_the_phase) {
  const double dt = 1e-3;
  RandomSequence random(Random(5, 5));
  double worst = 0.0;  // difference of two phases, as share of the impulse
  for (int k = 0; k < 100; ++k) {
    const Hit hit = random_hit(random);
    const Vec2 early = impulse_over_gap(hit, 0.02, dt, setting());
    for (const double phase : {0.1, 0.3, 0.5, 0.7, 0.9, 0.98})
      worst = std::max(worst, length(impulse_over_gap(hit, phase, dt, setting()) - early) / length(early));
  }
  // The bodies turn at up to 0.2 rad/s after such hits. For both phases that changes levers and compliance.
  check_value("V53.random_spread", 0.0, worst, 2.0 * 2.0 * 0.2 * dt, "-", where());
}

}  // namespace
}  // namespace gem::verification
