// The contacts of one Box2D step: all pairs, and the contacts that the books need with their impulses.
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "baseline_box2d/box2d_options.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

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

/// Called by Box2D before it solves a step: sets the friction of each pair and records what touches. A continuous world
/// solves the contacts found within a step again, one by one, and reports their impulses only at that time.
class Touches : public b2ContactListener {
 public:
  /// Keeps contacts of the platform and fixed bodies with impulses. If quality is measured, also contacts between
  /// floes.
  Touches(const FieldState& field, const Box2dOptions& options) : field_(field), options_(options) {}

  void clear();
  void PreSolve(b2Contact* contact, const b2Manifold* old_manifold) override;
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

  /// Call after each Box2D step: reads the impulses of the touches that the step added.
  void read_impulses();
  /// Sorts the touches by their bodies.
  void sort();

  const std::vector<TouchingPair>& pairs() const { return pairs_; }  // one entry for each touching pair of fixtures
  const std::vector<Touch>& touches() const { return touches_; }
  std::int32_t points() const { return points_; }

 private:
  const FieldState& field_;
  const Box2dOptions& options_;
  std::vector<TouchingPair> pairs_;
  std::vector<Touch> touches_;
  std::size_t read_ = 0;                                    // touches whose impulses have been read
  std::unordered_map<const b2Contact*, std::size_t> last_;  // the touch of each contact, in a continuous world
  std::int32_t points_ = 0;
};

}  // namespace gem::baseline
