// Bodies against closed forms: the pentagon, the 20-gon platform, drag coefficients of a square.
#include "gem/field/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/field/drag_coefficients.h"
#include "gem/field/field.h"

namespace gem {
namespace {

const std::vector<Vec2> pentagon = {{0, 0}, {8, -1}, {11, 4}, {6, 9}, {-1, 5}};
const std::vector<Vec2> square10 = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};

SceneDef empty_scene() {
  SceneDef scene;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  return scene;
}

TEST(Bodies, PentagonMomentsAlsoFarAwayAndClockwise) {
  for (const bool clockwise : {false, true}) {
    for (const Vec2 shift : {Vec2{0, 0}, Vec2{1400, 300}}) {
      SceneDef scene = empty_scene();
      FloeDef floe;
      for (const Vec2 p : pentagon) floe.outline_m.push_back(p + shift);
      if (clockwise) std::reverse(floe.outline_m.begin(), floe.outline_m.end());
      scene.floe.push_back(floe);
      const Bodies b = make_field(scene);
      ASSERT_EQ(b.count(), 2U);
      EXPECT_NEAR(b.area[1], 78.5, 78.5e-12);
      EXPECT_NEAR(b.position[1].x, 2287.0 / 471.0 + shift.x, 1e-12 * 1400);
      EXPECT_NEAR(b.position[1].y, 550.0 / 157.0 + shift.y, 1e-12 * 1400);
      EXPECT_NEAR(b.mass[1], 35325.0, 35325e-12);
      EXPECT_NEAR(b.inertia[1], 450.0 * 2902739.0 / 2826.0, 1e-12 * 462219.6);
      EXPECT_EQ(b.inverse_mass[1], 1.0 / b.mass[1]);
    }
  }
}

TEST(Bodies, PlatformIsThe20Gon) {
  SceneDef scene = empty_scene();
  scene.platform.present = true;
  const Bodies b = make_field(scene);
  ASSERT_EQ(b.count(), 1U);
  EXPECT_EQ(b.vertex_count(0), 20);
  EXPECT_NEAR(b.area[0], 7725.42485937, 1e-8);
  EXPECT_NEAR(b.inertia[0], 122960688179.0, 1.0);
  EXPECT_EQ(b.mass[0], 1e8);
  EXPECT_NEAR(b.radius[0], 50.0, 1e-12);
  EXPECT_NEAR(b.vertex[0].x, 50.0, 1e-12);
  EXPECT_NEAR(length(b.vertex[1] - b.vertex[0]), 15.643446504, 1e-9);
  EXPECT_NEAR(length(0.5 * (b.vertex[1] + b.vertex[0])), 49.3844170298, 1e-9);
  EXPECT_EQ(b.drag[0], 0.0);
}

TEST(Bodies, LockedYawKeepsInertiaButCannotTurn) {
  SceneDef scene = empty_scene();
  scene.platform.present = true;
  scene.platform.yaw = Yaw::locked;
  const Bodies b = make_field(scene);
  EXPECT_EQ(b.inverse_inertia[0], 0.0);
  EXPECT_GT(b.inertia[0], 0.0);
}

TEST(Bodies, EmptySceneHasOneInactiveBody) {
  const SceneDef scene = empty_scene();
  const Bodies b = make_field(scene);
  ASSERT_EQ(b.count(), 1U);
  EXPECT_EQ(b.active[0], 0);
  EXPECT_EQ(b.inverse_mass[0], 0.0);
  EXPECT_EQ(b.vertex_begin, (std::vector<std::int32_t>{0, 0}));
  const FieldSummary summary = summarise(scene, b);
  EXPECT_EQ(summary.floe_count, 0);
  EXPECT_TRUE(std::isinf(summary.smallest_gap));
}

TEST(Bodies, WorldOutlineUndoesTheRecentring) {
  Bodies b;
  BodyDef def;
  def.outline = pentagon;
  def.origin = {100.0, -20.0};
  def.rotation = {0.6, 0.8};
  append(b, def);
  const auto outline = world_outline(b, 0);
  for (std::size_t i = 0; i < pentagon.size(); ++i)
    EXPECT_LT(length(outline[i] - (def.origin + rotate(def.rotation, pentagon[i]))), 1e-12);
}

TEST(DragCoefficients, IntegralOfR3OfASquare) { EXPECT_NEAR(integral_r3(square10), 7839.75981104, 1e-8); }

TEST(DragCoefficients, EdgeIntegralOfASquare) {
  // Each edge from -5 to 5: 2 x 5^4 / 4; half the sum over four edges.
  EXPECT_NEAR(edge_integral_s3(square10), 625.0, 1e-10);
}

TEST(DragCoefficients, SquareSpinDownCoefficient) {
  SceneDef scene = empty_scene();
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = 0.0025;
  FloeDef floe;
  floe.outline_m = square10;
  scene.floe.push_back(floe);
  const Bodies b = make_field(scene);
  EXPECT_NEAR(b.spin_drag[1], 0.0267858460211, 1e-12);
  EXPECT_NEAR(b.drag[1], 1025.0 * 0.0025 * 100.0 / 45000.0, 1e-15);
}

TEST(DragCoefficients, FormDragAndLawsAndSwitches) {
  SceneDef scene = empty_scene();
  FloeDef floe;
  floe.outline_m = square10;
  scene.floe.push_back(floe);
  const double draft = 0.5 * 900.0 / 1025.0;
  Bodies b = make_field(scene);
  EXPECT_NEAR(b.drag[1], 1025.0 * (0.5 * 10.0 * draft + 5e-3 * 100.0) / 45000.0, 1e-15);
  EXPECT_NEAR(b.spin_drag[1], 1025.0 * (5e-3 * 7839.75981104 + 0.5 * draft * 625.0) / 750000.0, 1e-12);
  scene.water.spin_drag = false;
  set_drag(b, scene);
  EXPECT_EQ(b.spin_drag[1], 0.0);
  EXPECT_GT(b.drag[1], 0.0);
  scene.water.spin_drag = true;
  scene.water.drag_law = DragLaw::linear;
  set_drag(b, scene);
  EXPECT_EQ(b.drag[1], 0.01);
  EXPECT_EQ(b.spin_drag[1], 0.01);
  scene.water.drag_law = DragLaw::none;
  set_drag(b, scene);
  EXPECT_EQ(b.drag[1], 0.0);
  EXPECT_EQ(b.spin_drag[1], 0.0);
}

}  // namespace
}  // namespace gem
