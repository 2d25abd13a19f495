// Phases run one by one give the bits, the books and the log of the cpu engine.
#include "gem/engine/device/phases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

using test::HostScene;
using Choice = std::tuple<Resolution, Manifold, Yaw, FrictionLaw, DragLaw>;

SceneDef scene_of(Resolution resolution) {
  SceneDef scene = test::busy_scene(7);
  scene.contact.resolution = resolution;
  return scene;
}

HostScene phase_scene(const SceneDef& scene, const Bodies& field, int blocks, int threads, std::int32_t rows = 0,
                      std::size_t solver_room = 1 << 20) {
  HostScene device(scene, field, blocks, threads, rows, bodies_room);
  device.by_phases(solver_room);
  return device;
}

class DevicePhases : public testing::TestWithParam<Choice> {};

TEST_P(DevicePhases, GiveTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(7);
  std::tie(scene.contact.resolution, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  MomentLog expected, log;
  for (int call = 0; call < 3; ++call) {
    cpu->advance(40, expected);
    device.advance(40, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (HasFailure()) return;
  }
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  if (scene.contact.resolution == Resolution::coupled) {
    test::expect_same_coupled(device, log, *cpu, expected);
  }
  EXPECT_GT(test::contacts_in(expected), 1000);
  EXPECT_GT(device.status().builds, 2);
  EXPECT_GT(device.asleep(), 0) << "no pair ever slept";
}

INSTANTIATE_TEST_SUITE_P(Coupled, DevicePhases,
                         testing::Combine(testing::Values(Resolution::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic)));

INSTANTIATE_TEST_SUITE_P(Independent, DevicePhases,
                         testing::Combine(testing::Values(Resolution::independent),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic)));

class DevicePhase : public testing::TestWithParam<Resolution> {};

TEST_P(DevicePhase, BlocksAndThreadsChangeNothing) {
  constexpr std::int64_t moments = 30;
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  MomentLog expected;
  cpu->advance(moments, expected);
  EXPECT_GT(test::contacts_in(expected), 50);
  for (const auto& [blocks, threads] : {std::pair{1, 8}, {2, 4}, {3, 8}}) {
    HostScene device = phase_scene(scene, test::busy_field(scene), blocks, threads);
    MomentLog log;
    device.advance(moments, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_GT(device.status().builds, 1);
    EXPECT_GT(device.asleep(), 0);
  }
}

TEST_P(DevicePhase, TakesTurnsWithWholeMoments) {
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  MomentLog expected, log;
  int survived = 0;  // lists in which pairs slept when whole moments began, and that outlived these
  const int calls = GetParam() == Resolution::coupled ? 24 : 60;
  for (int call = 0; call < calls; ++call) {
    const bool phases = call % 2 == 0;
    const std::int64_t moments = phases ? 2 : 8;  // time enough for those that slept to meet
    cpu->advance(moments, expected);
    const auto builds = device.status().builds;
    const bool slept = call > 0 && device.asleep() > 0;
    if (phases)
      device.by_phases();
    else
      device.by_moments();
    device.advance(moments, log);
    if (!phases && slept && device.status().builds == builds) ++survived;
  }
  EXPECT_GT(survived, 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 500);
}

TEST_P(DevicePhase, OfAListTooSmallGrowsItAndLosesNothing) {
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp, 40);
  MomentLog expected, log;
  cpu->advance(60, expected);
  device.advance(60, log);
  EXPECT_GT(device.growths(), 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
}

TEST_P(DevicePhase, StopsAtAStateThatIsNoNumber) {
  const SceneDef scene = scene_of(GetParam());
  Bodies field = test::busy_field(scene);
  field.position[20].x = 1e308;
  field.velocity[20].x = -1e308;
  HostScene device = phase_scene(scene, field, 1, test::team_warp);
  MomentLog log;
  device.advance(10, log);
  EXPECT_EQ(device.status().stop, DeviceStop::not_finite);
  EXPECT_LT(device.status().samples, 10);
}

/// What the fast memory of a block holds of all that iterates.
enum class Holds { all, records, some_records, nothing };

TEST(DevicePhaseRoom, ForLittleThatIteratesChangesNothing) {
  constexpr std::int64_t moments = 60;
  const SceneDef scene = scene_of(Resolution::coupled);
  const auto cpu = test::busy_engine(scene, "cpu");
  MomentLog expected;
  cpu->advance(moments, expected);
  for (const auto& [room, holds] : {std::pair<std::size_t, Holds>{1 << 20, Holds::all},
                                    {10 * 1024, Holds::records},
                                    {4 * 1024, Holds::some_records},
                                    {256, Holds::nothing}}) {
    HostScene device = phase_scene(scene, test::busy_field(scene), 2, test::team_warp, 0, room);
    MomentLog log;
    device.advance(moments, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_judgement(log, expected);
    const SolverDesk& desk = device.solver_desk(0);
    const std::size_t records = static_cast<std::size_t>(desk.records) * sizeof(PushRecord) +
                                static_cast<std::size_t>(desk.own.count()) * sizeof(SolverEntry);
    const std::size_t points = static_cast<std::size_t>(desk.points.count()) * held_bytes;
    const Holds seen = !desk.fits                ? Holds::nothing
                       : records > room          ? Holds::some_records
                       : records + points > room ? Holds::records
                                                 : Holds::all;
    EXPECT_EQ(seen, holds) << room << " bytes; " << records << " of records, " << points << " of points";
  }
}

TEST(DevicePhaseRounds, OfATightResidualAreMadeToTheirEnd) {
  SceneDef scene = scene_of(Resolution::coupled);
  scene.numerics.residual_tolerance = 1e-9;
  scene.numerics.iterations_maximum = 200;
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  MomentLog expected, log;
  cpu->advance(12, expected);
  device.advance(12, log);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_judgement(log, expected);
  const auto most = std::max_element(log.quality.begin(), log.quality.end(),
                                     [](const auto& a, const auto& b) { return a.iterations < b.iterations; });
  EXPECT_GT(most->iterations, 64) << "no moment took three rounds";
}

INSTANTIATE_TEST_SUITE_P(Of, DevicePhase, testing::Values(Resolution::independent, Resolution::coupled),
                         [](const testing::TestParamInfo<Resolution>& resolution) {
                           return std::string(resolution.param == Resolution::coupled ? "coupled" : "independent");
                         });

}  // namespace
}  // namespace gem
