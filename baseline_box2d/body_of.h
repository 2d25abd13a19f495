// Makes one body of the field in Box2D: fixtures with the same outline, mass and inertia.
#pragma once

#include <box2d/box2d.h>

#include <cstddef>

#include "gem/field/bodies.h"

namespace gem::baseline {

/// Adds body i to the world with its position and velocity. Returns nullptr if the body takes no part: it has no
/// outline, or it was retired before the world was made. `skin` is the radius around Box2D's outlines [m]. In a
/// continuous world a bullet is stopped at its first contact within a step. Throws Error(scene_rejected) if Box2D would
/// change the outline.
b2Body* add_body(b2World& world, const Bodies& bodies, std::size_t i, double skin, bool bullet = false);

inline std::size_t index_of(const b2Fixture& fixture) {
  return static_cast<std::size_t>(const_cast<b2Fixture&>(fixture).GetBody()->GetUserData().pointer);
}

inline b2Vec2 to_box2d(Vec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }
inline Vec2 from_box2d(b2Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

}  // namespace gem::baseline
