// A platform of several pieces on a device gives the bits, the books and the log of the cpu engine, and what points
// remember: on both routes, whole and from a state in which ice lies in its notch.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "gem/engine/testing/device_and_cpu.h"
#include "gem/engine/testing/law_names.h"

namespace gem {
namespace {

using test::HostScene;

/// Time steps after which all pieces of the scene have ice, that with seed 4, also in the notch.
constexpr std::int64_t steps_to_the_notch = 700;

SceneDef notched(ContactSolver solver) {
  SceneDef scene = test::pieces_scene(4);
  scene.contact.solver = solver;
  scene.output.contact_forces = true;
  return scene;
}

/// The pieces with the outer sides of one made of 16: an outline too long for a workspace.
SceneDef with_a_round_piece(SceneDef scene) {
  std::vector<Vec2> outline{{0.0, 6.0}, {0.0, 12.0}};
  for (int k = 0; k <= 16; ++k) {
    const double angle = 0.5 * 3.14159265358979 * (1.0 + k / 16.0);
    outline.push_back({-6.0 + 6.0 * std::cos(angle), 6.0 + 6.0 * std::sin(angle)});
  }
  scene.platform.piece[1].outline_m = outline;
  return scene;
}

/// Few floes around the same platform, so that its pieces belong to several blocks. It drifts against a wall.
SceneDef sparse_scene(ContactSolver solver) {
  SceneDef scene = notched(solver);
  scene.floes.count = 9;
  scene.floes.length_m = 24.0;
  scene.floes.width_m = 24.0;
  scene.floes.start_x_m = -45.0;
  scene.platform.start_yaw_rad = 0.0;
  scene.fixed.push_back({{{-20.0, 11.85}, {0.0, 11.85}, {0.0, 13.0}, {-20.0, 13.0}}});
  return scene;
}

/// Number of hits on each piece.
std::array<int, 3> hits_in(const StepLog& log) {
  std::array<int, 3> hits{};
  for (const ContactEvent& event : log.events) ++hits.at(static_cast<std::size_t>(event.body_a));
  return hits;
}

/// A scene on the cpu engine and in host memory, at a state that the cpu engine has reached.
struct PiecesBesideCpu {
  std::unique_ptr<Engine> cpu;
  HostScene device;
  StepLog expected, log;
  bool coupled;

  PiecesBesideCpu(const SceneDef& scene, bool phases, std::int64_t before, int blocks, int threads)
      : cpu(test::busy_engine(scene, "cpu", 2)),
        device(scene, test::busy_field(scene), blocks, threads, 0, bodies_shared_bytes),
        coupled(scene.contact.solver == ContactSolver::coupled) {
    if (phases) device.use_phases();
    if (before == 0) return;
    StepLog ignored;
    cpu->advance(before, ignored);
    cpu->restore(cpu->save());  // so that both continue with the same sums in the books
    device.restore(cpu->save());
  }

  void advance(std::int64_t steps) {
    cpu->advance(steps, expected);
    device.advance(steps, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (coupled) test::expect_same_judgement(log, expected);
    test::expect_same_forces(device.contact_forces(), cpu->contact_forces());
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  }

  void expect_same_memory() {
    EngineState state;
    save_memory(device.memory(), state);
    test::expect_same_memory(state, cpu->save());
  }
};

class DevicePieces : public testing::TestWithParam<ContactSolver> {
 protected:
  /// Expects that all pieces are hit, the first of them in the notch.
  static void expect_hits(const StepLog& log) {
    const std::array<int, 3> hits = hits_in(log);
    for (const int on_piece : hits) EXPECT_GT(on_piece, 0);
    EXPECT_GT(std::count_if(log.events.begin(), log.events.end(),
                            [](const ContactEvent& e) { return e.body_a == 0 && e.normal.x < -0.5; }),
              0);
  }
  static void expect_same(const SceneDef& scene, bool phases) {
    PiecesBesideCpu both(scene, phases, steps_to_the_notch, 1, phases ? test::team_warp : 1);
    for (const std::int64_t steps : {1, 39}) both.advance(steps);
    if (HasFailure()) return;
    both.expect_same_memory();
    both.device.restore(both.cpu->save());
    both.advance(10);
    expect_hits(both.expected);
  }
};

TEST_P(DevicePieces, GiveTheBitsOfTheCpuEngine) {
  for (const bool phases : {false, true}) expect_same(notched(GetParam()), phases);
}

TEST_P(DevicePieces, OfAFixedPlatformAndOfOneWithLockedYaw) {
  SceneDef fixed = notched(GetParam()), locked = fixed;
  fixed.platform.fixed = true;
  fixed.platform.start_velocity_m_per_s = {};
  locked.platform.yaw = Yaw::locked;
  for (const bool phases : {false, true})
    for (const SceneDef& scene : {fixed, locked}) expect_same(scene, phases);
}

TEST_P(DevicePieces, OfTheOtherManifold) {
  SceneDef scene = notched(GetParam());
  scene.contact.manifold = Manifold::chord_middle;
  for (const bool phases : {false, true}) expect_same(scene, phases);
}

TEST_P(DevicePieces, OfManyCorners) {
  for (const bool phases : {false, true}) expect_same(with_a_round_piece(notched(GetParam())), phases);
}

TEST_P(DevicePieces, BlocksAndThreadsChangeNothing) {
  for (const bool phases : {false, true})
    for (const auto& [blocks, threads] : {std::pair{1, 8}, {3, 4}}) {
      PiecesBesideCpu both(notched(GetParam()), phases, steps_to_the_notch, blocks, threads);
      both.advance(12);
      expect_hits(both.expected);
    }
}

TEST_P(DevicePieces, BelongToSeveralBlocksAndTouchAWall) {
  constexpr int blocks = 6;
  for (const bool phases : {false, true}) {
    PiecesBesideCpu both(sparse_scene(GetParam()), phases, steps_to_the_notch, blocks, test::team_warp);
    ASSERT_LT(both.cpu->bodies().count(), 3U * blocks) << "the first block has all pieces";
    const std::int32_t wall = platform_bodies(both.cpu->bodies()) + 2;
    bool touched = false;
    for (int call = 0; call < 4; ++call) {
      both.advance(15);
      for (const ContactForce& force : both.cpu->contact_forces())
        touched = touched || (force.a < 3 && force.b == wall);
    }
    EXPECT_TRUE(touched);
    for (const int on_piece : hits_in(both.expected)) EXPECT_GT(on_piece, 0);
  }
}

TEST_P(DevicePieces, OfAListTooSmallGrowItAndLoseNothing) {
  for (const bool phases : {false, true}) {
    const SceneDef scene = notched(GetParam());
    const auto cpu = test::busy_engine(scene, "cpu");
    HostScene device(scene, test::busy_field(scene), 1, phases ? test::team_warp : 1, 40, bodies_shared_bytes);
    if (phases) device.use_phases();
    StepLog expected, log;
    cpu->advance(40, expected);
    device.advance(40, log);
    EXPECT_GT(device.growths(), 0);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
  }
}

/// Points of a floe with two pieces have one block of the matrix: in small islands, and in large ones by one block of
/// threads or three.
TEST(DevicePiecesOfIslands, AFloeBetweenTwoPiecesHasTheBitsOfTheCpuEngine) {
  SceneDef scene = test::iterated_by(test::column_between_pieces(), Iteration::splitting);
  scene.output.contact_forces = true;
  for (const auto& [small, large, blocks] : {std::array{16, 1000, 1}, {1, 2, 1}, {1, 2, 3}}) {
    PiecesBesideCpu both(scene, true, 0, blocks, test::team_warp);
    both.device.divide_islands(small, large);
    int on_two_pieces = 0;
    for (int step = 0; step < 40 && !HasFailure(); ++step) {
      both.advance(1);
      on_two_pieces += test::has_floe_on_two_pieces(both.cpu->contact_forces());
    }
    EXPECT_GT(on_two_pieces, 5);
  }
}

/// Islands of all sizes, by blocks and by the whole group.
TEST(DevicePiecesOfIslands, GiveTheBitsOfTheCpuEngine) {
  PiecesBesideCpu both(test::iterated_by(notched(ContactSolver::coupled), Iteration::splitting), true,
                       steps_to_the_notch, 2, test::team_warp);
  both.device.divide_islands(16, 128);
  both.advance(2);
  both.expect_same_memory();
  for (const int on_piece : hits_in(both.expected)) EXPECT_GT(on_piece, 0);
}

INSTANTIATE_TEST_SUITE_P(Solvers, DevicePieces, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

}  // namespace
}  // namespace gem
