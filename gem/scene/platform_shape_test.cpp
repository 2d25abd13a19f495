// Outlines of platforms, their names of sides and their reach.
#include "gem/scene/platform_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/events/platform/heading.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_mooring.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

PlatformDef ship() {
  PlatformDef platform;
  platform.outline = PlatformOutline::ship;
  return platform;
}

TEST(PlatformShape, RegularKeepsItsFirstCornerOnTheAxis) {
  const std::vector<Vec2> outline = platform_outline(PlatformDef{});
  ASSERT_EQ(outline.size(), 20U);
  EXPECT_EQ(outline[0].x, 50.0);
  EXPECT_EQ(outline[0].y, 0.0);
  EXPECT_TRUE(platform_side_names(PlatformDef{}).empty());
}

TEST(PlatformShape, AShipHasItsBowUpstreamAndItsPortSideAtNegativeY) {
  const std::vector<Vec2> outline = platform_outline(ship());
  const std::vector<std::string> names = platform_side_names(ship());
  ASSERT_EQ(outline.size(), 11U);
  ASSERT_EQ(names.size(), outline.size());
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 middle = 0.5 * (outline[k] + outline[(k + 1) % outline.size()]);
    EXPECT_EQ(names[k].starts_with("port"), middle.y < -1.0) << names[k];
    EXPECT_EQ(names[k].starts_with("starboard"), middle.y > 1.0) << names[k];
    EXPECT_EQ(names[k].find("bow") != std::string::npos, middle.x < -54.0) << names[k];
  }
  EXPECT_EQ(names[5], "transom");
}

TEST(PlatformShape, EveryPartOfAShipMayBeLeftOut) {
  for (const double bow : {0.0, 50.0})
    for (const double stern : {0.0, 150.0, 200.0 - bow}) {
      PlatformDef platform = ship();
      platform.bow_length_m = bow;
      platform.stern_length_m = stern;
      const std::vector<Vec2> outline = platform_outline(platform);
      EXPECT_EQ(first_non_convex_vertex(outline), -1) << bow << ' ' << stern;
      EXPECT_EQ(platform_side_names(platform).size(), outline.size()) << bow << ' ' << stern;
    }
}

TEST(PlatformShape, RoundingLeavesNoSideBetweenBowAndStern) {
  PlatformDef platform = ship();
  platform.length_m = 180.1;
  platform.bow_length_m = 50.3;
  platform.stern_length_m = 180.1 - 50.3;
  EXPECT_EQ(platform_outline(platform).size(), 9U);
  EXPECT_EQ(platform_side_names(platform).size(), 9U);
}

TEST(PlatformShape, AListedOutlineIsCentredAndTurnedRound) {
  PlatformDef platform;
  platform.outline = PlatformOutline::listed;
  platform.outline_m = {{10.0, 10.0}, {10.0, 30.0}, {50.0, 30.0}, {50.0, 10.0}};  // clockwise
  const std::vector<Vec2> outline = platform_outline(platform);
  EXPECT_EQ(outline[0].x, -20.0);
  EXPECT_EQ(outline[0].y, -10.0);
  EXPECT_EQ(outline[1].x, 20.0);
  EXPECT_EQ(outline[1].y, -10.0);
  EXPECT_EQ(platform_area(platform), 800.0);
  EXPECT_EQ(platform_drag_width(platform), 20.0);
  EXPECT_EQ(platform_drag_length(platform), 40.0);
  EXPECT_DOUBLE_EQ(platform_radius(platform), std::hypot(20.0, 10.0));
}

TEST(PlatformShape, OnlyWhatCannotTurnMayLieAlongAChannel) {
  PlatformDef platform = ship();
  EXPECT_DOUBLE_EQ(platform_reach(platform).sideways, platform_radius(platform));
  platform.yaw = Yaw::locked;
  EXPECT_DOUBLE_EQ(platform_reach(platform).sideways, 20.0);
  EXPECT_NEAR(platform_reach(platform).upstream, 104.8756, 1e-4);
  platform.start_yaw_rad = 0.5 * M_PI;
  EXPECT_NEAR(platform_reach(platform).sideways, 104.8756, 1e-4);
  SceneDef scene;
  scene.platform = ship();
  scene.boundary.gap_m = 60.0;
  scene.floes.length_m = 1400.0;
  scene.floes.count = 3500;
  EXPECT_FALSE(check_scene(scene).empty());
  scene.platform.yaw = Yaw::locked;
  EXPECT_TRUE(check_scene(scene).empty());
}

TEST(PlatformShape, AFixedPlatformNeedsNoMooring) {
  SceneDef scene;
  scene.platform.start_offset_m = {5.0, 0.0};
  EXPECT_GT(platform_speed_bound(scene), 0.0);
  scene.platform.fixed = true;
  EXPECT_EQ(platform_speed_bound(scene), 0.0);
  EXPECT_EQ(mooring_stiffness_at_rest(scene), 0.0);
  scene.mooring.stiffness_N_per_m = 1e15;  // would need a short time step
  EXPECT_TRUE(check_scene(scene).empty());
}

/// Fastest rim of a platform under heading control in a current that turns back at 600 s [m/s].
double fastest_rim(const SceneDef& scene) {
  constexpr double dt = 0.05;
  const double inertia = platform_inertia(scene.platform);
  double yaw = 1e-3, rate = 0.0, fastest = 0.0;
  for (double time = 0.0; time < 1800.0; time += dt) {
    const Vec2 water{time < 600.0 ? 0.25 : -0.25, 0.0};
    const double moment = heading_moment(scene.heading.moment_N_m, strict::rotation_of_angle(yaw), water);
    rate += dt * (moment - scene.heading.damping_N_m_s * rate) / inertia;
    yaw += dt * rate;
    fastest = std::max(fastest, std::abs(rate));
  }
  return platform_radius(scene.platform) * fastest;
}

TEST(PlatformShape, ACurrentThatTurnsBackSwingsAShipNoFasterThanItsBound) {
  for (const double damping : {0.0, 6e9, 6e10}) {
    SceneDef scene;
    scene.platform = ship();
    scene.heading = {8e7, damping};
    const double slow = platform_speed_bound(scene);
    scene.drive.current_velocity = {{0.0, 0.25, 0.0}, {599.0, 0.25, 0.0}, {600.0, -0.25, 0.0}};
    const double rim = fastest_rim(scene), bound = platform_speed_bound(scene);
    EXPECT_GT(rim, slow) << damping;
    EXPECT_LT(rim, 1.001 * bound) << damping;  // 0.1 %: the time step of fastest_rim()
    EXPECT_LT(bound, 1.6 * rim) << damping;
    scene.drive.current_velocity.clear();
    scene.drive.tide = {{44714.0, 0.5, 0.0, 0.0, 0.0}};
    EXPECT_EQ(platform_speed_bound(scene), bound) << damping;
  }
}

TEST(PlatformShape, ASlowTurnOfTheCurrentIsFollowedSlowly) {
  SceneDef scene;
  scene.platform = ship();
  scene.heading = {8e7, 6e9};
  const double still = platform_speed_bound(scene);
  scene.drive.current_direction = {{0.0, 0.25, 0.0}, {3600.0, 0.25, 1.6}};
  EXPECT_NEAR(platform_speed_bound(scene) - still, platform_radius(scene.platform) * 1.6 / 3600.0, 1e-12);
}

TEST(PlatformShape, CasesWithoutTheKeysKeepTheirText) {
  const std::string plain = resolved_toml(SceneDef{});
  for (const char* word : {"outline", "beam", "stern", "inertia", "fixed =", "side_loads"})
    EXPECT_EQ(plain.find(word), std::string::npos) << word;
}

TEST(PlatformShape, KeysOfAnotherOutlineGetAWarning) {
  const auto warned = [](const SceneDef& scene, const std::string& key) {
    const std::vector<std::string> warnings = scene_warnings(scene);
    return std::any_of(warnings.begin(), warnings.end(), [&](const auto& w) { return w.starts_with(key); });
  };
  SceneDef scene;
  EXPECT_FALSE(warned(scene, "platform."));
  scene.platform.beam_m = 30.0;
  EXPECT_TRUE(warned(scene, "platform.beam_m: has no effect"));
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.diameter_m = 80.0;
  EXPECT_FALSE(warned(scene, "platform.beam_m"));
  EXPECT_TRUE(warned(scene, "platform.diameter_m: has no effect"));
  scene.platform.inertia_kg_m2 = 1e15;
  EXPECT_TRUE(warned(scene, "platform.inertia_kg_m2: unlikely"));
  scene.platform.fixed = true;
  EXPECT_TRUE(warned(scene, "platform.inertia_kg_m2: has no effect"));
}

}  // namespace
}  // namespace gem
