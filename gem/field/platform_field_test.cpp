// Fields with a platform whose outline is no regular polygon.
#include <gtest/gtest.h>

#include "gem/base/error.h"
#include "gem/field/field.h"
#include "gem/scene/platform_shape.h"

namespace gem {
namespace {

SceneDef ship_scene() {
  SceneDef scene;
  scene.boundary.present = false;
  scene.floes.source = FloeSource::listed;
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.anchor_m = {20.0, -5.0};
  scene.platform.start_offset_m = {1.0, 2.0};
  return scene;
}

std::string refusal(const SceneDef& scene) {
  try {
    make_field(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    return error.what();
  }
  return "accepted";
}

FloeDef floe_at(Vec2 place) { return {{{-5.0, -5.0}, {5.0, -5.0}, {5.0, 5.0}, {-5.0, 5.0}}, place, 0.0, {}, 0.0, 0.5}; }

TEST(PlatformField, TheCentroidStandsAtAnchorAndOffset) {
  const Bodies bodies = make_field(ship_scene());
  EXPECT_NEAR(bodies.position[0].x, 21.0, 1e-13);
  EXPECT_NEAR(bodies.position[0].y, -3.0, 1e-13);
  EXPECT_EQ(bodies.vertex_count(0), 11);
}

TEST(PlatformField, FloesMayLieBesideAShipButNotInIt) {
  SceneDef scene = ship_scene();
  scene.floe = {floe_at({21.0, 22.5})};  // within the circle through its ends
  EXPECT_EQ(refusal(scene), "accepted");
  scene.floe = {floe_at({21.0, 21.5})};
  EXPECT_NE(refusal(scene).find("platform and floe 0 by 0.5 m"), std::string::npos) << refusal(scene);
}

TEST(PlatformField, GeneratedFloesEndUpstreamOfTheBow) {
  SceneDef scene = ship_scene();
  scene.floes.source = FloeSource::generated;
  scene.floes.count = 100;
  scene.floes.length_m = 100.0;
  scene.floes.width_m = 100.0;
  scene.floes.start_x_m = 21.0 - 104.9 - 100.0;  // to a few centimetres before the stem
  EXPECT_EQ(refusal(scene), "accepted");
}

TEST(PlatformField, AConcaveOutlineIsRefusedWithItsCorner) {
  SceneDef scene = ship_scene();
  scene.platform.outline = PlatformOutline::listed;
  scene.platform.outline_m = {{0.0, 0.0}, {40.0, 0.0}, {10.0, 10.0}, {0.0, 40.0}};
  const std::string message = refusal(scene);
  EXPECT_NE(message.find("platform.outline_m: vertex 2 (counted from 0) turns inwards"), std::string::npos) << message;
  EXPECT_EQ(message.find("floes"), std::string::npos) << message;
}

TEST(PlatformField, AListedOutlineMayHaveMoreCornersThanAFloe) {
  SceneDef scene = ship_scene();
  PlatformDef round;
  round.sides = 64;
  scene.platform.outline_m = platform_outline(round);
  scene.platform.outline = PlatformOutline::listed;
  EXPECT_EQ(make_field(scene).vertex_count(0), 64);
}

TEST(PlatformField, AFixedPlatformKeepsItsMassButDoesNotMove) {
  SceneDef scene = ship_scene();
  scene.platform.fixed = true;
  const Bodies bodies = make_field(scene);
  EXPECT_EQ(bodies.mass[0], scene.platform.mass_kg);
  EXPECT_EQ(bodies.inverse_mass[0], 0.0);
  EXPECT_EQ(bodies.inverse_inertia[0], 0.0);
}

SceneDef pieces_scene() {
  SceneDef scene = ship_scene();
  scene.platform.outline = PlatformOutline::pieces;
  scene.platform.piece = {{{{0.0, 0.0}, {20.0, 0.0}, {20.0, 10.0}, {0.0, 10.0}}},
                          {{{10.0, 10.0}, {0.0, 10.0}, {0.0, 20.0}, {10.0, 20.0}}}};
  return scene;
}

TEST(PlatformField, PiecesAreBodiesAboutTheCommonCentroid) {
  SceneDef scene = pieces_scene();
  scene.floe = {floe_at({40.0, 0.0})};
  const Bodies bodies = make_field(scene);
  ASSERT_EQ(platform_bodies(bodies), 2);
  ASSERT_EQ(bodies.count(), 3U);
  EXPECT_NEAR(bodies.position[1].x, 21.0, 1e-13);
  EXPECT_NEAR(bodies.vertex[4].x, 10.0 - 25.0 / 3.0, 1e-13) << "the first corner of a clockwise piece stays";
  EXPECT_NEAR(bodies.vertex[5].y, 20.0 - 25.0 / 3.0, 1e-13) << "the others are turned round";
  EXPECT_EQ(bodies.mass[1], 0.0);
  EXPECT_EQ(bodies.inertia[1], 0.0);
  EXPECT_EQ(bodies.inverse_inertia[1], bodies.inverse_inertia[0]);
  EXPECT_EQ(bodies.area[1], bodies.area[0]);
  EXPECT_EQ(bodies.radius[1], bodies.radius[0]);
}

TEST(PlatformField, OnePieceIsTheListedOutline) {
  SceneDef pieces = pieces_scene(), listed = pieces_scene();
  pieces.platform.piece.resize(1);
  listed.platform.outline = PlatformOutline::listed;
  listed.platform.outline_m = pieces.platform.piece[0].outline_m;
  const Bodies a = make_field(pieces), b = make_field(listed);
  EXPECT_EQ(a.inertia[0], b.inertia[0]);
  EXPECT_EQ(a.radius[0], b.radius[0]);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_EQ(a.vertex[v].x, b.vertex[v].x);
    EXPECT_EQ(a.vertex[v].y, b.vertex[v].y);
  }
}

TEST(PlatformField, FloesMayLieInANotchButNotInAPiece) {
  SceneDef scene = pieces_scene();
  const Vec2 inner = Vec2{21.0, -3.0} + Vec2{10.0 - 25.0 / 3.0, 10.0 - 25.0 / 3.0};  // the inner corner of the L
  scene.floe = {floe_at(inner + Vec2{5.0, 5.0})};
  EXPECT_EQ(refusal(scene), "accepted");
  scene.floe = {floe_at(inner + Vec2{5.0, 4.5})};
  EXPECT_NE(refusal(scene).find("platform piece 0 and floe 0 by 0.5 m"), std::string::npos) << refusal(scene);
}

TEST(PlatformField, GeneratedFloesKeepClearOfEveryPiece) {
  SceneDef scene = pieces_scene();
  scene.floes.source = FloeSource::generated;
  scene.floes.count = 60;
  scene.floes.length_m = 80.0;
  scene.floes.width_m = 80.0;
  scene.floes.start_x_m = -20.0;
  scene.output.retire_x_m = 100.0;
  EXPECT_EQ(refusal(scene), "accepted");
}

TEST(PlatformField, BadPiecesAreRefusedByName) {
  SceneDef scene = pieces_scene();
  for (Vec2& corner : scene.platform.piece[1].outline_m) corner.y -= 0.25;
  EXPECT_NE(refusal(scene).find("platform.piece[1]: overlaps platform.piece[0] (by 0.25 m"), std::string::npos)
      << refusal(scene);
  scene = pieces_scene();
  for (Vec2& corner : scene.platform.piece[1].outline_m) corner.y += 3.0;
  EXPECT_EQ(refusal(scene), "accepted") << "pieces may stand apart";
  scene.platform.piece[1].outline_m[1] = {8.0, 16.0};
  EXPECT_NE(refusal(scene).find("platform.piece[1].outline_m: vertex 1"), std::string::npos) << refusal(scene);
}

}  // namespace
}  // namespace gem
