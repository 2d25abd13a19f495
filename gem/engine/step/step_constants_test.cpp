// Constants of a run: the contact reach follows the fastest point of any body, spin included.
#include "gem/engine/step/step_constants.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gem/engine/engine.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"
#include "gem/scene/check_scene.h"

namespace gem {
namespace {

std::vector<Vec2> rectangle(double length_x, double length_y) {
  const double x = 0.5 * length_x, y = 0.5 * length_y;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// A floe of 2 x 12 m turns its end into the side of another floe; nothing else moves.
SceneDef turning_floe(double dt, double spin = 0.5) {
  SceneDef scene;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.boundary.present = false;
  scene.platform.present = false;
  scene.floes.source = FloeSource::listed;
  scene.floe = {{rectangle(2.0, 12.0), {0.0, 0.0}, 0.0, {}, spin, 0.5},
                {rectangle(10.0, 10.0), {8.0, 0.0}, 0.0, {}, 0.0, 0.5}};
  scene.numerics.time_step_s = dt;
  scene.contact.solver = ContactSolver::coupled;
  return scene;
}

StepConstants constants_of(const SceneDef& scene) { return step_constants(scene, make_field(scene)); }

TEST(StepConstants, ReachFollowsTheRim) {
  const SceneDef still = turning_floe(0.1, 0.0), turning = turning_floe(0.1);
  const double slowest = 1e-3, rim = 0.5 * std::sqrt(37.0);
  EXPECT_DOUBLE_EQ(constants_of(still).contact_margin, still.numerics.contact_reach * slowest * 0.1);
  EXPECT_DOUBLE_EQ(constants_of(turning).contact_margin, turning.numerics.contact_reach * rim * 0.1);
  EXPECT_DOUBLE_EQ(constants_of(turning).residual_speed, turning.numerics.residual_tolerance * rim);
  EXPECT_DOUBLE_EQ(constants_of(turning).repair_reach, (turning.numerics.contact_reach - 1.0) * rim * 0.1);
}

TEST(StepConstants, ReachFollowsThePlatformsSwing) {
  SceneDef scene = turning_floe(0.1, 0.0);
  scene.platform.present = true;
  scene.platform.anchor_m = {100.0, 0.0};
  scene.platform.start_velocity_m_per_s = {0.3, 0.0};
  scene.platform.start_offset_m = {4.0, 0.0};
  scene.mooring.stiffness_N_per_m = 0.01 * scene.platform.mass_kg;
  EXPECT_DOUBLE_EQ(constants_of(scene).contact_margin, scene.numerics.contact_reach * 0.5 * 0.1);
}

TEST(StepConstants, AnEndThatTurnsIsSeenBeforeItIsIn) {
  for (const double dt : {0.2, 0.1, 0.05}) {
    const SceneDef scene = turning_floe(dt);
    const auto engine = make_engine(scene, make_field(scene), {"cpu", 1});
    StepLog log;
    engine->advance(static_cast<std::int64_t>(6.0 / dt), log);
    double deepest = 0.0, residual = 0.0;
    int touched = 0;
    for (const StepQuality& quality : log.quality) {
      deepest = std::max(deepest, quality.maximum_overlap);
      residual = std::max(residual, quality.residual);
      touched += quality.contacts > 0;
    }
    EXPECT_GT(touched, 0) << "the floes never met";
    // A contact is found in the time step before it closes. The path of the end then deviates by r (omega dt)^2 / 2
    // from the straight path that the events stop, for both floes. The iterations leave their residual.
    EXPECT_LT(deepest, 2.0 * 0.5 * std::sqrt(50.0) * 0.25 * dt * dt + residual * dt) << "dt " << dt;
  }
}

// The list chooses which pairs are looked at, and never what is found. Corners that point at each other need the most
// room.
TEST(StepConstants, TheListMarginDoesNotChangeBits) {
  SceneDef scene = test::busy_scene(1);
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.contact_reach = 10.0;
  std::vector<std::uint64_t> hashes;
  for (const double margin : {0.0, 0.01, 0.1, 2.5, 20.0}) {
    scene.numerics.list_margin_m = margin;
    const auto engine = make_engine(scene, make_field(scene), {"cpu", 1});
    StepLog log;
    engine->advance(400, log);
    ASSERT_GT(test::contacts_in(log), 1000) << "margin " << margin;
    hashes.push_back(engine->state_hash());
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.back());
}

TEST(StepConstants, ATimeStepTooLongForASpinIsRefused) {
  const auto refused = [](double dt, double spin) {
    const std::vector<SceneProblem> problems = check_scene(turning_floe(dt, spin));
    return std::any_of(problems.begin(), problems.end(),
                       [](const SceneProblem& p) { return p.key == "numerics.time_step_s"; });
  };
  // a fifth of 2 m at 3.04 m/s: 0.1316 s
  EXPECT_TRUE(refused(0.132, 0.5));
  EXPECT_FALSE(refused(0.131, 0.5));
  EXPECT_TRUE(refused(0.132, -0.5));
  EXPECT_FALSE(refused(0.2, 0.0));
}

}  // namespace
}  // namespace gem
