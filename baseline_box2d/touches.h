// What touches in one Box2D step: all pairs, and the contacts that the books need in full.
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <vector>

#include "gem/engine/field_state.h"

namespace gem::baseline {

/// Two bodies whose fixtures touch; a < b.
struct TouchingPair {
  std::int32_t a = 0, b = 0;
};

/// One touching pair of fixtures; a < b, normal from a to b, impulses on b.
struct Touch {
  b2Contact* contact = nullptr;
  std::int32_t a = 0, b = 0;
  Vec2 normal;
  int count = 0;
  Vec2 point[2];                   // world [m]
  double normal_impulse[2] = {};   // [N s]
  double tangent_impulse[2] = {};  // along the normal turned left [N s]

  Vec2 impulse(int k) const { return normal_impulse[k] * normal + tangent_impulse[k] * turned_left(normal); }
};

/// Listens to Box2D before it solves a step: gives each pair its friction and notes what touches.
class Touches : public b2ContactListener {
 public:
  /// Keeps the contacts of the platform and of fixed bodies in full, with `all` those between floes too.
  Touches(const FieldState& field, bool all) : field_(field), all_(all) {}

  void clear();
  void PreSolve(b2Contact* contact, const b2Manifold* old_manifold) override;

  /// After the step: reads the impulses and puts the touches in the order of their bodies.
  void read_impulses();

  const std::vector<TouchingPair>& pairs() const { return pairs_; }  // one entry for each touching pair of fixtures
  const std::vector<Touch>& touches() const { return touches_; }
  std::int32_t points() const { return points_; }

 private:
  const FieldState& field_;
  const bool all_;
  std::vector<TouchingPair> pairs_;
  std::vector<Touch> touches_;
  std::int32_t points_ = 0;
};

}  // namespace gem::baseline
