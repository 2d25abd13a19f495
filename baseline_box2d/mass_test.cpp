// Box2D's bodies against gem's: outline, area, centroid, mass and inertia; outlines with many corners are split.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "baseline_box2d/body_of.h"
#include "baseline_box2d/convex_pieces.h"
#include "gem/base/error.h"
#include "gem/geometry/polygon.h"

namespace gem::baseline {
namespace {

std::vector<Vec2> regular(int corners, double radius) {
  std::vector<Vec2> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

TEST(ConvexPieces, CoverTheOutlineExactly) {
  for (int corners = 3; corners <= 40; ++corners) {
    const std::vector<Vec2> outline = regular(corners, 50.0);
    const auto pieces = convex_pieces(outline, 8);
    EXPECT_EQ(pieces.size(), static_cast<std::size_t>(std::max(1, (corners + 3) / 6))) << corners;
    const PolygonMoments whole = polygon_moments(outline);
    double area = 0.0, second = 0.0;
    Vec2 first;
    for (const auto& piece : pieces) {
      EXPECT_GE(piece.size(), 3u);
      EXPECT_LE(piece.size(), 8u);
      EXPECT_EQ(first_non_convex_vertex(piece), -1) << corners;
      const PolygonMoments part = polygon_moments(piece);
      area += part.area;
      first += part.area * part.centroid;
      second += part.second_moment + part.area * dot(part.centroid, part.centroid);
    }
    // a few hundred roundings
    EXPECT_NEAR(area, whole.area, 1e-13 * whole.area) << corners;
    EXPECT_NEAR(length(first), 0.0, 1e-13 * whole.area * 50.0) << corners;
    EXPECT_NEAR(second, whole.second_moment, 1e-13 * whole.second_moment) << corners;
  }
}

TEST(ConvexPieces, ThePlatformIsThreeOctagons) {
  const auto pieces = convex_pieces(regular(20, 50.0), 8);
  ASSERT_EQ(pieces.size(), 3u);
  for (const auto& piece : pieces) EXPECT_EQ(piece.size(), 8u);
}

class MassOf : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Corners, MassOf, ::testing::Values(3, 4, 7, 8, 9, 13, 19, 20),
                         [](const auto& corners) { return std::to_string(corners.param) + "_corners"; });

TEST_P(MassOf, BodyIsThatOfTheField) {
  Bodies bodies;
  BodyDef def;
  def.outline = regular(GetParam(), 7.0);
  def.origin = {-31.0, 12.0};
  def.velocity = {0.5, -0.25};
  def.spin = 0.01;
  append(bodies, def);
  b2World world(b2Vec2_zero);
  const b2Body* body = add_body(world, bodies, 0, 0.0025);
  ASSERT_NE(body, nullptr);
  const double rounding = 2.0 * static_cast<double>(b2_epsilon);
  EXPECT_NEAR(static_cast<double>(body->GetMass()), bodies.mass[0], rounding * bodies.mass[0]);
  EXPECT_NEAR(static_cast<double>(body->GetInertia()), bodies.inertia[0], rounding * bodies.inertia[0]);
  EXPECT_NEAR(length(from_box2d(body->GetWorldCenter()) - bodies.position[0]), 0.0, rounding * 34.0);
  EXPECT_EQ(body->GetLinearVelocity(), b2Vec2(0.5f, -0.25f));

  // What Box2D would compute from the outlines of the fixtures.
  double area = 0.0, second = 0.0;
  Vec2 first;
  std::map<std::pair<float, float>, int> corners;
  for (const b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    const auto& shape = static_cast<const b2PolygonShape&>(*fixture->GetShape());
    b2MassData mass;
    shape.ComputeMass(&mass, 1.0f);
    area += static_cast<double>(mass.mass);
    first += static_cast<double>(mass.mass) * from_box2d(mass.center);
    second += static_cast<double>(mass.I);
    for (int k = 0; k < shape.m_count; ++k) ++corners[{shape.m_vertices[k].x, shape.m_vertices[k].y}];
    EXPECT_EQ(shape.m_radius, 0.0025f);
    EXPECT_EQ(fixture->GetRestitution(), 0.0f);
  }
  EXPECT_EQ(corners.size(), static_cast<std::size_t>(GetParam()));
  const double sums = 16.0 * static_cast<double>(b2_epsilon);  // a few dozen roundings in float
  EXPECT_NEAR(area, bodies.area[0], sums * bodies.area[0]);
  EXPECT_NEAR(length(first), 0.0, sums * bodies.area[0] * 7.0);
  EXPECT_NEAR(second, bodies.area[0] * bodies.inertia[0] / bodies.mass[0], sums * bodies.area[0] * 49.0);
}

TEST(BodyOf, FixedBodyAndLockedYaw) {
  Bodies bodies;
  BodyDef platform;
  platform.kind = BodyKind::platform;
  platform.outline = regular(20, 50.0);
  platform.mass = 1e8;
  platform.locked_yaw = true;
  append(bodies, platform);
  BodyDef wall;
  wall.kind = BodyKind::fixed;
  wall.outline = {{0.0, 100.0}, {1000.0, 100.0}, {1000.0, 120.0}, {0.0, 120.0}};
  append(bodies, wall);
  b2World world(b2Vec2_zero);
  const b2Body* locked = add_body(world, bodies, 0, 0.0025);
  EXPECT_EQ(locked->GetMass(), 1e8f);
  EXPECT_TRUE(locked->IsFixedRotation());
  EXPECT_EQ(add_body(world, bodies, 1, 0.0025)->GetType(), b2_staticBody);
}

TEST(BodyOf, OutlineThatBox2dWouldChangeIsRefused) {
  Bodies bodies;
  BodyDef def;
  def.outline = {{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {4.999, 5.001}, {0.0, 5.0}};  // an edge of 1.4 mm
  append(bodies, def);
  b2World world(b2Vec2_zero);
  EXPECT_THROW(add_body(world, bodies, 0, 0.0025), Error);
}

}  // namespace
}  // namespace gem::baseline
