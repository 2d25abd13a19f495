// What corners remember when floes split: the pieces go on where the floe was.
#include "gem/engine/breakup/corner_heirs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/engine/contact_key.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/field/field.h"

namespace gem {
namespace {

constexpr std::int32_t wall = 1, floe = 2, neighbour = 3, left = 4, right = 5;

FloeDef square(Vec2 position, double size) {
  FloeDef def;
  const double half = 0.5 * size;
  def.outline_m = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  def.position_m = position;
  def.thickness_m = 1.0;
  return def;
}

/// A floe of 20 m on a floor, and a smaller one on top, each `depth` deep [m].
SceneDef stack(double depth) {
  SceneDef scene;
  scene.contact.solver = ContactSolver::compliant;
  scene.platform.present = scene.boundary.present = false;
  scene.current.velocity_m_per_s = {};
  scene.water.drag_law = DragLaw::none;
  scene.floes.source = FloeSource::listed;
  scene.floes.count = 0;
  scene.breakup.maximum_pieces = 2;
  scene.fixed = {{{{-50.0, -10.0}, {50.0, -10.0}, {50.0, 0.0}, {-50.0, 0.0}}}};
  scene.floes.overlap = std::max(0.0, depth);
  scene.floe = {square({0.0, 10.0 - depth}, 20.0), square({4.0, 25.0 - 2.0 * depth}, 10.0)};
  return scene;
}

CornerMemory crushed_by(double depth) {
  CornerMemory memory;
  memory.crushed = depth;
  memory.normal = 1e5 * depth;
  return memory;
}

/// The state after the floe has split along `x` = 0.
struct SplitState {
  EngineState state;
  std::vector<FloeSplit> splits;

  explicit SplitState(const SceneDef& scene) {
    state.bodies = make_field(scene);
    // corners 0 and 1 of the floe in the floor; corners 0 and 1 of the neighbour in the floe
    const std::pair<std::uint64_t, CornerMemory> kept[] = {{corner_key(wall, floe, 0, true), crushed_by(0.1)},
                                                           {corner_key(wall, floe, 1, true), crushed_by(0.2)},
                                                           {corner_key(floe, neighbour, 0, true), crushed_by(0.3)},
                                                           {corner_key(floe, neighbour, 1, true), crushed_by(0.4)}};
    for (const auto& [key, value] : kept) {
      state.corner_key.push_back(key);
      state.corner_value.push_back(value);
    }
    splits = split_floes(state.bodies, scene, {{floe, {0.0, -10.0}, {0.0, 1.0}}});
  }
  const CornerMemory* memory_of(std::uint64_t key) const {
    const auto at = std::lower_bound(state.corner_key.begin(), state.corner_key.end(), key);
    if (at == state.corner_key.end() || *at != key) return nullptr;
    return &state.corner_value[static_cast<std::size_t>(at - state.corner_key.begin())];
  }
  /// The corner of a piece at a place in the world.
  std::int32_t corner_at(std::int32_t piece, Vec2 place) const {
    const Bodies& b = state.bodies;
    for (std::int32_t v = b.vertex_begin[piece]; v < b.vertex_begin[piece + 1]; ++v)
      if (length(b.position[piece] + rotate(b.rotation[piece], b.vertex[v]) - place) < 1e-9)
        return v - b.vertex_begin[piece];
    return -1;
  }
};

TEST(CornerHeirs, MemoryGoesToThePieceThatHasTheCorner) {
  SplitState s(stack(0.25));
  ASSERT_EQ(s.splits.at(0).result, FloeSplit::Result::split);
  ASSERT_EQ(s.splits[0].piece[0], left);
  hand_on_corners(s.state, s.splits);
  EXPECT_TRUE(std::is_sorted(s.state.corner_key.begin(), s.state.corner_key.end(), std::less_equal<>()));
  const std::int32_t at_left = s.corner_at(left, {-10.0, -0.25}), at_right = s.corner_at(right, {10.0, -0.25});
  const CornerMemory* of_left = s.memory_of(corner_key(wall, left, at_left, true));
  const CornerMemory* of_right = s.memory_of(corner_key(wall, right, at_right, true));
  ASSERT_TRUE(of_left && of_right);
  EXPECT_EQ(of_left->crushed, 0.1);
  EXPECT_EQ(of_right->crushed, 0.2);
  EXPECT_EQ(of_right->normal, 2e4);
}

TEST(CornerHeirs, ACornerInTheFloeIsInOnePiece) {
  SplitState s(stack(0.25));
  hand_on_corners(s.state, s.splits);
  // the neighbour is the first body of its pairs now; its corner at x = -1 is in the left piece
  const CornerMemory* in_left = s.memory_of(corner_key(neighbour, left, 0, false));
  const CornerMemory* in_right = s.memory_of(corner_key(neighbour, right, 1, false));
  ASSERT_TRUE(in_left && in_right);
  EXPECT_EQ(in_left->crushed, 0.3);
  EXPECT_EQ(in_right->crushed, 0.4);
  EXPECT_FALSE(s.memory_of(corner_key(neighbour, right, 0, false)));
}

TEST(CornerHeirs, BodiesThatDoNotTouchGetNoMemory) {
  SplitState s(stack(-0.25));
  s.state.corner_key.clear();
  s.state.corner_value.clear();
  hand_on_corners(s.state, s.splits);
  EXPECT_TRUE(s.state.corner_key.empty());
}

/// A floe of 20 m comes down on its tip, which crushes. Then a current presses it on the floor with less than crushes,
/// until it splits through the tip.
struct Press {
  SceneDef scene = stack(0.0);
  double force;  // of the current [N]
  std::unique_ptr<Engine> engine;

  Press() {
    scene.floe.resize(1);
    const double half = 10.0 * std::sqrt(2.0);
    scene.floe[0].outline_m = {{0.0, -half}, {half, 0.0}, {0.0, half}, {-half, 0.0}};
    scene.floe[0].position_m = {0.0, half + 0.01};
    scene.floe[0].velocity_m_per_s = {0.0, -0.5};
    scene.water.drag_law = DragLaw::linear;
    scene.water.linear_time_s = 10.0;
    scene.current.velocity_m_per_s = {0.0, -4.0};
    scene.numerics.time_step_s = 0.01;
    scene.breakup.load_time_s = 4.0;
    scene.breakup.minimum_size_m = 1.0;
    scene.breakup.fracture_toughness_Pa_sqrt_m = 5e4;
    force = scene.ice.density_kg_per_m3 * 400.0 * 4.0 / scene.water.linear_time_s;
    engine = make_engine(scene, make_field(scene), {.name = "cpu", .threads = 1});
  }
  /// Force of the floor in the last time step [N].
  double force_of_floor() const {
    double sum = 0.0;
    for (const ContactForce& one : engine->contact_forces())
      if (one.a == wall) sum += one.force.y;
    return sum;
  }
};

TEST(CornerHeirs, ASplitMakesNoForceAndNoEnergy) {
  Press press;
  StepLog log;
  double hit = 0.0, before = 0.0;
  while (log.splits.empty() && log.quality.size() < 1000) {
    press.engine->advance(1, log);
    before = press.force_of_floor();
    hit = std::max(hit, before);
  }
  ASSERT_EQ(test::splits_in(log), 1);
  EXPECT_GT(press.engine->save().corner_value.at(0).crushed, 0.1);
  EXPECT_NEAR(before, press.force, 0.01 * press.force);
  EXPECT_GT(hit, 2.0 * before) << "it could not be more";
  const double unexplained = press.engine->ledger().contact.left();
  press.engine->advance(1, log);
  EXPECT_LT(press.force_of_floor(), 1.01 * before) << "fresh ice in front of the tip gives as much as the hit";
  for (int k = 0; k < 10; ++k) {  // the pieces fall over the tip
    press.engine->advance(1, log);
    EXPECT_LT(press.force_of_floor(), 1.3 * before) << k;
  }
  const Ledger ledger = press.engine->ledger();
  EXPECT_LT(ledger.contact.left() - unexplained, 1e-3 * ledger.contact.crushed);
  EXPECT_LT(residual(ledger).momentum, 1e-12);
  EXPECT_LT(residual(ledger).angular_momentum, 1e-12);
  EXPECT_LT(residual(ledger).energy, 1e-12);
}

TEST(CornerHeirs, ARunThatGoesOnAfterASplitHasTheSameBits) {
  Press whole, parts;
  StepLog log_of_whole, log_of_parts;
  whole.engine->advance(700, log_of_whole);
  ASSERT_EQ(test::splits_in(log_of_whole), 1);
  const auto splits_at = std::llround(log_of_whole.splits[0].time / whole.scene.numerics.time_step_s);
  parts.engine->advance(splits_at, log_of_parts);
  const EngineState state = parts.engine->save();
  Press later;
  later.engine->restore(state);
  EXPECT_EQ(later.engine->state_hash(), parts.engine->state_hash());
  later.engine->advance(700 - splits_at, log_of_parts);
  test::expect_same_bodies(whole.engine->bodies(), later.engine->bodies());
  test::expect_same_memory(whole.engine->save(), later.engine->save());
  EXPECT_EQ(whole.engine->state_hash(), later.engine->state_hash());
}

}  // namespace
}  // namespace gem
