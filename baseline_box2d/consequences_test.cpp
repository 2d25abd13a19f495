// Measured consequences of Box2D's methods: float positions, slop and skin, merged corners, seams between fixtures, the
// limit on travel. MAPPING.md quotes these numbers; the bounds here keep them true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "baseline_box2d/body_of.h"
#include "baseline_box2d/box2d_options.h"
#include "baseline_box2d/register_box2d.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/geometry/polygon.h"

namespace gem::baseline {
namespace {

[[maybe_unused]] const bool box2d_registered = [] {
  if (baseline_names().empty()) register_box2d();
  return true;
}();

SceneDef bare_scene() {
  SceneDef scene;
  scene.contact.solver = ContactSolver::coupled;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = scene.platform.present = false;
  scene.output.retire_x_m = 1e9;
  return scene;
}

FloeDef square(Vec2 position, Vec2 velocity, double side = 10.0) {
  const double h = 0.5 * side;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, position, 0.0, velocity, 0.0, 0.5};
}

std::unique_ptr<Engine> box2d(const SceneDef& scene, double skin = Box2dOptions{}.skin_m) {
  EngineOptions options;
  options.name = "box2d";
  options.baseline_settings = {"skin_m=" + number_text(skin)};
  return make_engine(scene, make_field(scene), options);
}

/// Ratio of the distance that a floe without drag travels in 10 s to its velocity times 10 s.
double true_speed(double x, double speed, double dt) {
  SceneDef scene = bare_scene();
  scene.numerics.time_step_s = dt;
  scene.floe = {square({x, 0.0}, {speed, 0.0})};
  const auto engine = box2d(scene);
  const double from = engine->bodies().position[1].x;
  StepLog log;
  engine->advance(std::llround(10.0 / dt), log);
  return (engine->bodies().position[1].x - from) / (10.0 * speed);
}

TEST(Consequences, FloatPlacesChangeTheSpeed) {
  // A position in [1024, 2048) m is a multiple of 2^-13 m = 1.22e-4 m, and so is every displacement.
  const double grid = 0x1p-13;
  for (const double dt : {0.1, 0.05, 0.01, 0.001}) {
    const double path = 0.25 * dt;
    const double stepped = std::nearbyint(path / grid) * grid / path;
    EXPECT_NEAR(true_speed(-1400.0, 0.25, dt), stepped, 1e-6) << dt;
    RecordProperty("speed_ratio_at_1400_m_dt_" + std::to_string(dt), std::to_string(true_speed(-1400.0, 0.25, dt)));
    EXPECT_NEAR(true_speed(-3.0, 0.25, dt), 1.0, 1e-3) << dt;
  }
  EXPECT_EQ(true_speed(-1400.0, 0.06, 0.001), 0.0);  // less than half the spacing: it does not move
}

/// Gap left between a floe and the wall that it is pressed against [m].
double resting_gap(double skin) {
  SceneDef scene = bare_scene();
  scene.current.velocity_m_per_s = {0.0, -0.25};
  scene.water.drag_law = DragLaw::quadratic;
  scene.fixed = {{{{-64.0, -16.0}, {64.0, -16.0}, {64.0, 0.0}, {-64.0, 0.0}}}};
  scene.floe = {square({0.0, 5.1}, {0.0, -0.1})};
  const auto engine = box2d(scene, skin);
  StepLog log;
  engine->advance(2000, log);
  EXPECT_GT(log.quality.back().contacts, 0);
  return engine->bodies().position[2].y - 5.0;
}

TEST(Consequences, SkinAndSlopSetWhereBodiesRest) {
  // The gap lies between two skins and two skins less the slop of 5 mm.
  for (const double skin : {0.0, 0.0025, 0.01}) {
    const double gap = resting_gap(skin);
    RecordProperty("resting_gap_at_skin_" + std::to_string(skin), std::to_string(gap));
    EXPECT_LE(gap, 2.0 * skin + 1e-5) << skin;
    EXPECT_GE(gap, 2.0 * skin - 0.005 - 0.0125) << skin;
  }
}

TEST(Consequences, ShortEdgesAreRefusedAndShortEnoughOnesWouldBeJoined) {
  // Box2D merges corners closer than half its slop.
  const auto adds = [](double edge) {
    Bodies bodies;
    BodyDef def;
    def.outline = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0 - edge}, {5.0 - edge, 5.0}, {0.0, 5.0}};
    append(bodies, def);
    b2World world(b2Vec2_zero);
    try {
      add_body(world, bodies, 0, 0.0025);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  EXPECT_FALSE(adds(0.0017));  // 2.4 mm from corner to corner
  EXPECT_TRUE(adds(0.0019));   // 2.7 mm
}

/// What the face of a floe transfers to the platform when it hits the corner at this number of twentieths of a turn.
struct Hit {
  double impulse = 0.0, sideways = 0.0;
  std::size_t events = 0;
  std::int32_t points = 0;
};
Hit hit_corner(int corner) {
  const double turn = 2.0 * M_PI * corner / 20.0;
  const Vec2 out{std::cos(turn), std::sin(turn)};
  SceneDef scene = bare_scene();
  scene.platform.present = true;
  FloeDef floe = square((50.0 + 5.0 + 0.02) * out, -0.25 * out);
  floe.angle_rad = turn;
  scene.floe = {floe};
  const auto engine = box2d(scene);
  StepLog log;
  engine->advance(4, log);
  Hit hit;
  for (const PlatformStep& step : log.platform) {
    hit.impulse -= dot(step.ice_impulse, out);
    hit.sideways = std::max(hit.sideways, std::fabs(cross(step.ice_impulse, out)));
  }
  for (const StepQuality& quality : log.quality) hit.points = std::max(hit.points, quality.contacts);
  // the floe stays pressed; only the hit closes
  for (const ContactEvent& event : log.events) hit.events += event.closing_speed > 0.01;
  return hit;
}

TEST(Consequences, SeamsBetweenFixturesAreFeltOnceOnly) {
  // Corners at which two of the platform's three fixtures meet: 0, 7 and 14 in the order of the outline.
  const double alone = 45000.0 * 0.25 * (1e8 / (1e8 + 45000.0));
  for (int corner = 0; corner < 20; ++corner) {
    const Hit hit = hit_corner(corner);
    const bool seam = corner == 0 || corner == 7 || corner == 14;
    if (seam) {
      EXPECT_GE(hit.points, 2) << corner;  // both fixtures report it
    } else {
      EXPECT_EQ(hit.points, 1) << corner;
    }
    EXPECT_EQ(hit.events, 1u) << corner;
    EXPECT_NEAR(hit.impulse, alone, 1e-4 * alone) << corner;
    EXPECT_LT(hit.sideways, 1e-3 * alone) << corner;
  }
}

TEST(Consequences, NoBodyGoesFartherThanTwoMetresInAStep) {
  SceneDef scene = bare_scene();
  scene.numerics.time_step_s = 10.0;
  scene.floe = {square({}, {0.25, 0.0}, 30.0)};
  const auto engine = box2d(scene);
  StepLog log;
  engine->advance(1, log);
  EXPECT_NEAR(engine->bodies().position[1].x, 2.0, 1e-6);
  EXPECT_NEAR(engine->bodies().velocity[1].x, 0.2, 1e-7);  // and so is its velocity
}

}  // namespace
}  // namespace gem::baseline
