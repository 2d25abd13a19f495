// Single hits against closed forms: a corner that crushes, a face that springs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/events/crushing.h"
#include "validation/contact/scenes.h"

namespace gem::hits {
namespace {

double degrees(double angle) { return angle * M_PI / 180.0; }

/// A rhombus that hits the wall with one corner, head on.
struct CornerHit {
  double side = 10.0, angle = 90.0;  // [m], [degrees]
  double speed = 0.5;                // [m/s]
  double gap = 0.02;                 // [m]
};

SceneDef scene_of(const CornerHit& hit) {
  SceneDef scene = open_scene();
  add_wall(scene);
  const double reach = hit.side * std::cos(0.5 * degrees(hit.angle));
  scene.floe = {floe_of(rhombus(hit.side, degrees(hit.angle)), {-reach - hit.gap, 0.0}, {hit.speed, 0.0})};
  return scene;
}

double growth_of(const CornerHit& hit) { return 2.0 * std::tan(0.5 * degrees(hit.angle)); }

CrushingPeak closed_form(const SceneDef& scene, const CornerHit& hit) {
  const double mass = 900.0 * hit.side * hit.side * std::sin(degrees(hit.angle));
  const CrushingIce ice{scene.ice.crushing_pressure_Pa, scene.ice.pressure_area_exponent, 1.0};
  return crushing_peak(ice, growth_of(hit), 2.0 * hit.side * std::sin(0.5 * degrees(hit.angle)),
                       0.5 * mass * hit.speed * hit.speed);
}

/// Time from touch to rest [s].
double duration_of(const CornerHit& hit) {
  const SceneDef scene = scene_of(hit);
  return crushing_duration(closed_form(scene, hit).depth, hit.speed, 2.0 + scene.ice.pressure_area_exponent);
}

/// Largest miss of force and depth over several start phases, relative to the closed form.
Peak worst_miss(CornerHit hit, double h, std::int64_t substeps) {
  constexpr int phases = 8;
  Peak worst;
  for (int k = 0; k < phases; ++k) {
    hit.gap = 0.02 + hit.speed * h * (k + 0.37) / phases;
    SceneDef scene = scene_of(hit);
    step_by(scene, h, substeps);
    const CrushingPeak right = closed_form(scene, hit);
    Trial run(scene);
    run.advance_for(scene, hit.gap / hit.speed + 2.0 * duration_of(hit) + 2.0 * h * static_cast<double>(substeps));
    const Peak peak = peak_of(run.log);
    worst.force = std::max(worst.force, std::fabs(peak.force / right.force - 1.0));
    worst.depth = std::max(worst.depth, std::fabs(peak.depth / right.depth - 1.0));
  }
  return worst;
}

TEST(ContactCrush, right_angle_on_a_wall) {
  SceneDef scene = scene_of({});
  Trial run(scene);
  run.advance(10);
  const Peak peak = peak_of(run.log);
  EXPECT_NEAR(peak.force, 363.9e3, 0.005 * 363.9e3);
  EXPECT_NEAR(peak.depth, 58.7e-3, 0.005 * 58.7e-3);
}

TEST(ContactCrush, twelve_substeps_a_hit_are_right_to_2_percent_and_six_to_5) {
  for (const double side : {2.0, 7.0, 20.0})
    for (const double angle : {60.0, 90.0, 150.0}) {
      const CornerHit hit{side, angle};
      for (const auto& [count, bar] : {std::pair{12.0, 0.02}, {6.0, 0.05}}) {
        const Peak miss = worst_miss(hit, duration_of(hit) / count, 4);
        EXPECT_LT(miss.force, bar) << side << " m, " << angle << " degrees, " << count << " substeps";
        EXPECT_LT(miss.depth, bar) << side << " m, " << angle << " degrees, " << count << " substeps";
      }
    }
}

TEST(ContactCrush, long_time_steps_are_no_worse_than_short_ones) {
  for (const double side : {2.0, 7.0, 20.0}) {
    const CornerHit hit{side, 90.0};
    constexpr double h = 0.1 / 64;
    const Peak lengthy = worst_miss(hit, h, 64), brief = worst_miss(hit, h, 8);
    EXPECT_LT(lengthy.force, brief.force + 1e-3) << side;
    EXPECT_LT(lengthy.depth, brief.depth + 1e-3) << side;
  }
}

/// A square of 92 t that hits the wall with a face. Returns the largest force over v sqrt(K m), and the rebound.
Peak face_hit(double h, double gap) {
  constexpr double speed = 0.2, mass = 92e3;
  SceneDef scene = open_scene();
  add_wall(scene);
  const double side = std::sqrt(mass / 900.0);
  scene.floe = {floe_of(rectangle(side, side), {-0.5 * side - gap, 0.0}, {speed, 0.0})};
  step_by(scene, h, 50);
  Trial run(scene);
  run.advance_for(scene, gap / speed + 0.2);
  const double rebound = -run.bodies().velocity[first_floe(run.bodies())].x / speed;
  return {peak_of(run.log).force / (speed * std::sqrt(scene.contact.face_stiffness_Pa * mass)), rebound};
}

TEST(ContactCrush, face_on_a_wall_springs) {
  for (int k = 0; k < 8; ++k) {
    const Peak hit = face_hit(1e-3, 0.01 + 2e-4 * (k + 0.37) / 8.0);
    EXPECT_NEAR(hit.force, 1.0, 0.15) << k;
    EXPECT_NEAR(hit.depth, 0.30, 0.03) << k;
  }
}

}  // namespace
}  // namespace gem::hits
