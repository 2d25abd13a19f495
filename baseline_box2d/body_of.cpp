#include "baseline_box2d/body_of.h"

#include <cmath>
#include <string>
#include <vector>

#include "baseline_box2d/convex_pieces.h"
#include "gem/base/error.h"

namespace gem::baseline {
namespace {

constexpr std::size_t corners_maximum = b2_maxPolygonVertices;

b2PolygonShape shape_of(const std::vector<Vec2>& piece, std::size_t i, double skin) {
  std::vector<b2Vec2> corners;
  for (const Vec2 p : piece) corners.push_back(to_box2d(p));
  b2PolygonShape shape;
  shape.Set(corners.data(), static_cast<int32>(corners.size()));
  if (shape.m_count != static_cast<int32>(piece.size()))
    throw Error(ExitCode::scene_rejected,
                "body " + std::to_string(i) +
                    " would lose corners in Box2D (it joins corners closer than 2.5 mm and drops those that hardly "
                    "stick out); use an outline without them or the engine cpu");
  shape.m_radius = static_cast<float>(skin);
  return shape;
}

void add_fixtures(b2Body& body, const Bodies& bodies, std::size_t i, double skin) {
  const auto begin = bodies.vertex.begin() + bodies.vertex_begin[i],
             end = bodies.vertex.begin() + bodies.vertex_begin[i + 1];
  for (const auto& piece : convex_pieces({begin, end}, corners_maximum)) {
    const b2PolygonShape shape = shape_of(piece, i, skin);
    b2FixtureDef def;
    def.shape = &shape;
    def.density = 0.0f;   // mass and inertia are given for the whole body
    def.friction = 0.0f;  // set for each pair when two bodies touch
    def.restitution = 0.0f;
    def.restitutionThreshold = 0.0f;
    body.CreateFixture(&def);
  }
}

}  // namespace

b2Body* add_body(b2World& world, const Bodies& bodies, std::size_t i, double skin, bool bullet) {
  if (!bodies.active[i]) return nullptr;
  b2BodyDef def;
  def.type = bodies.inverse_mass[i] == 0.0 ? b2_staticBody : b2_dynamicBody;
  def.position = to_box2d(bodies.position[i]);
  def.angle = static_cast<float>(std::atan2(bodies.rotation[i].sine, bodies.rotation[i].cosine));
  def.linearVelocity = to_box2d(bodies.velocity[i]);
  def.angularVelocity = static_cast<float>(bodies.spin[i]);
  def.linearDamping = 0.0f;
  def.angularDamping = 0.0f;
  def.gravityScale = 0.0f;
  def.allowSleep = false;
  def.bullet = bullet && bodies.kind[i] == BodyKind::floe;
  def.fixedRotation = bodies.inverse_inertia[i] == 0.0;
  def.userData.pointer = i;
  b2Body* body = world.CreateBody(&def);
  add_fixtures(*body, bodies, i, skin);
  if (def.type == b2_dynamicBody) {
    const b2MassData mass{static_cast<float>(bodies.mass[i]), b2Vec2_zero, static_cast<float>(bodies.inertia[i])};
    body->SetMassData(&mass);
  }
  return body;
}

}  // namespace gem::baseline
