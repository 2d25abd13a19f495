// A platform of several pieces: the reference engine judges the cpu engine; threads, blocks and restarts keep its bits;
// the cuda engine has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"
#include "validation/agreement/comparison.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

using agreement::compare;
using agreement::floe;

/// A free platform with a notch, into which a current drives two floes; two more slide along its outside.
SceneDef notch_scene() {
  SceneDef s = agreement::still_scene();
  const SceneDef pieces = test::pieces_scene(1);
  s.platform.present = true;
  s.platform.outline = pieces.platform.outline;
  s.platform.piece = pieces.platform.piece;
  s.platform.mass_kg = 1e6;
  s.platform.anchor_m = s.platform.start_offset_m = s.platform.start_velocity_m_per_s = {};
  s.platform.start_yaw_rad = 0.1;
  s.mooring = {.stiffness_N_per_m = 1e5, .damping_ratio = 0.1};
  s.water.drag_law = DragLaw::quadratic;
  s.current.velocity_m_per_s = {0.6, 0.1};
  s.ice.friction_ice = s.ice.friction_structure = 0.2;
  s.floe = {floe(7.0, 6.0, {-13.0, 0.5}, {0.6, 0.0}, 0.3), floe(6.0, 5.0, {-21.0, -1.0}, {0.7, 0.0}, 0.9),
            floe(8.0, 5.0, {-10.0, 16.0}, {0.5, -0.3}, 0.2), floe(8.0, 5.0, {-16.0, -14.0}, {0.5, 0.2}, 0.5)};
  return s;
}

TEST(ReferenceJudgesPieces, IceInANotchAndAlongTheSides) {
  SceneDef s = notch_scene();
  s.contact.solver = ContactSolver::independent;
  // later a floe lies almost flat, where the 24 sweeps of its two points leave a rest
  compare({.scene = s, .steps = 350, .row = 4, .anew = true, .contacts = 200});
}

TEST(ReferenceJudgesPieces, IceInANotchTogether) {
  for (const Iteration iteration : {Iteration::gradient, Iteration::splitting}) {
    SceneDef s = notch_scene();
    s.contact.solver = ContactSolver::coupled;
    s.numerics.iteration = iteration;
    // after 11 s a floe lies in the notch with more points than its motion fixes; splitting then ends at 1e-8 of the
    // speed, above the tight tolerance of this comparison
    const int steps = iteration == Iteration::gradient ? 400 : 210;
    compare({.scene = s, .steps = steps, .row = 4, .contacts_of_a_body = 12, .anew = true, .contacts = 100});
  }
}

TEST(ReferenceJudgesPieces, FixedAndWithLockedYaw) {
  for (const bool fixed : {true, false}) {
    SceneDef s = notch_scene();
    s.platform.fixed = fixed;
    if (!fixed) s.platform.yaw = Yaw::locked;
    compare({.scene = s, .steps = 300, .row = 4, .contacts_of_a_body = 12, .anew = true, .contacts = 200});
  }
}

struct PieceWay {
  const char* name;
  ContactSolver solver;
  Iteration iteration;
};

constexpr PieceWay piece_ways[] = {{"independent", ContactSolver::independent, Iteration::splitting},
                                   {"gradient", ContactSolver::coupled, Iteration::gradient},
                                   {"splitting", ContactSolver::coupled, Iteration::splitting}};

struct NameOfWay {
  std::string operator()(const testing::TestParamInfo<PieceWay>& way) const { return way.param.name; }
};

SceneDef scene_of(const PieceWay& way) {
  SceneDef scene = test::iterated_by(test::pieces_scene(4), way.iteration);
  scene.contact.solver = way.solver;
  return scene;
}

class Pieces : public testing::TestWithParam<PieceWay> {
 protected:
  SceneDef scene() const { return scene_of(GetParam()); }

  std::uint64_t hash_of(int threads, int block, bool restarts) const {
    auto engine = test::busy_engine(scene(), "cpu", threads);
    StepLog log;
    for (int done = 0; done < 400; done += block) {
      engine->advance(block, log);
      if (!restarts) continue;
      const EngineState state = engine->save();
      engine = test::busy_engine(scene(), "cpu", threads);
      engine->restore(state);
    }
    EXPECT_GT(test::contacts_in(log), 1000);
    EXPECT_GT(test::ice_impulse_in(log), 0.0);
    const Bodies& b = engine->bodies();
    for (std::int32_t i = 1; i < platform_bodies(b); ++i) {
      EXPECT_EQ(b.position[i].x, b.position[0].x);
      EXPECT_EQ(b.rotation[i].sine, b.rotation[0].sine);
      EXPECT_EQ(b.spin[i], b.spin[0]);
    }
    return engine->state_hash();
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, Pieces, testing::ValuesIn(piece_ways), NameOfWay());

TEST_P(Pieces, ThreadsBlocksAndRestartsChangeNoBit) {
  const std::uint64_t whole = hash_of(1, 400, false);
  EXPECT_EQ(hash_of(3, 400, false), whole) << "threads";
  EXPECT_EQ(hash_of(1, 25, false), whole) << "blocks";
  EXPECT_EQ(hash_of(2, 50, true), whole) << "restarts";
}

TEST_P(Pieces, TheBooksClose) {
  auto engine = test::busy_engine(scene(), "cpu", 1);
  StepLog log;
  engine->advance(400, log);
  const LedgerResidual left = residual(engine->ledger());
  EXPECT_LT(left.momentum, 1e-12);
  EXPECT_LT(left.angular_momentum, 1e-12);
  EXPECT_LT(left.energy, 1e-12);
}

/// A scene with pieces on both routes of the GPU, in batches beside scenes with a platform of one piece.
class PiecesOnGpu : public OnGpu, public testing::WithParamInterface<PieceWay> {
 protected:
  void expect_bits_of_cpu(const SceneDef& scene, Route route) const {
    SceneDef other = test::busy_scene(9);
    other.contact.solver = scene.contact.solver;
    other.numerics = scene.numerics;
    const auto cpu = test::busy_engine(scene, "cpu"), beside = test::busy_engine(other, "cpu");
    CudaBatch batch(
        {{other, test::busy_field(other)}, {scene, test::busy_field(scene)}, {scene, test::busy_field(scene)}},
        {.route = route});
    StepLog expected, ignored;
    std::vector<StepLog> logs(3);
    for (const std::int64_t steps : {1, 7, 592, 40}) {
      cpu->advance(steps, expected);
      beside->advance(steps, ignored);
      batch.advance(steps, &logs);
      EXPECT_EQ(batch.state_hash(0), beside->state_hash()) << "one piece";
      for (const std::size_t k : {1, 2}) {
        test::expect_same_bodies(batch.bodies(k), cpu->bodies());
        EXPECT_EQ(batch.state_hash(k), cpu->state_hash());
        test::expect_same_log(logs[k], expected);
        if (scene.contact.solver == ContactSolver::coupled) test::expect_same_judgement(logs[k], expected);
        test::expect_same_books(batch.ledger(k), cpu->ledger());
        test::expect_same_memory(batch.save(k), cpu->save());
      }
      if (HasFailure()) return;
    }
    for (std::int32_t piece = 0; piece < 3; ++piece)
      EXPECT_TRUE(std::any_of(expected.events.begin(), expected.events.end(),
                              [&](const ContactEvent& e) { return e.body_a == piece; }))
          << "no ice at piece " << piece;
    const EngineState half = batch.save(1);
    cpu->restore(half);
    batch.restore(1, half);
    cpu->advance(20, expected);
    batch.advance(20, &logs);
    EXPECT_EQ(batch.state_hash(1), cpu->state_hash()) << "after a restart";
  }
};

TEST_P(PiecesOnGpu, GiveTheBitsOfTheCpu) {
  const SceneDef scene = scene_of(GetParam());
  expect_bits_of_cpu(scene, Route::phases);
  if (scene.contact.solver == ContactSolver::independent || scene.numerics.iteration == Iteration::gradient)
    expect_bits_of_cpu(scene, Route::resident);
}

INSTANTIATE_TEST_SUITE_P(Ways, PiecesOnGpu, testing::ValuesIn(piece_ways), NameOfWay());

class FloeBetweenPiecesOnGpu : public OnGpu {};

TEST_F(FloeBetweenPiecesOnGpu, HasTheBitsOfTheCpu) {
  const SceneDef scene = test::iterated_by(test::column_between_pieces(), Iteration::splitting);
  const auto cpu = test::busy_engine(scene, "cpu");
  CudaBatch batch({{scene, test::busy_field(scene)}}, {.route = Route::phases});
  StepLog expected;
  std::vector<StepLog> logs(1);
  int on_two_pieces = 0;
  constexpr int single_steps = 40;
  for (int call = 0; call <= single_steps; ++call) {
    const std::int64_t steps = call < single_steps ? 1 : 360;
    cpu->advance(steps, expected);
    batch.advance(steps, &logs);
    on_two_pieces += test::has_floe_on_two_pieces(cpu->contact_forces());
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash()) << "after " << steps << " more time steps";
    test::expect_same_log(logs[0], expected);
  }
  EXPECT_GT(test::contacts_in(expected), 1000);
  EXPECT_GT(on_two_pieces, 5);
}

}  // namespace
}  // namespace gem
