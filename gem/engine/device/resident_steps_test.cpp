// The resident time steps of the device, run by host threads, give the bits, the books and the log of the cpu engine.
#include "gem/engine/device/resident_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <tuple>

#include "gem/base/error.h"
#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

using test::HostScene;

using Choice = std::tuple<ContactSolver, Manifold, Yaw, FrictionLaw, DragLaw>;

class DeviceTimeStepsTest : public testing::TestWithParam<Choice> {};

TEST_P(DeviceTimeStepsTest, GivesTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.solver, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene));
  StepLog expected, log;
  for (int block = 0; block < 8; ++block) {
    cpu->advance(50, expected);
    device.advance(50, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (HasFailure()) return;
  }
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  if (scene.contact.solver == ContactSolver::coupled) {
    test::expect_same_coupled(device, log, *cpu, expected);
  } else {
    StepQuality worst;
    for (const StepQuality& quality : log.quality) worst.worsen(quality);
    // what is not measured must not read as zero
    EXPECT_TRUE(std::isnan(worst.complementarity) && std::isnan(worst.cone_excess) && std::isnan(worst.energy_created));
    EXPECT_GT(worst.maximum_overlap, 0.0);
  }
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
  EXPECT_GT(device.status().builds, 3);
}

INSTANTIATE_TEST_SUITE_P(Combinations, DeviceTimeStepsTest,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)),
                         test::LawNames());

class DeviceSolvers : public testing::TestWithParam<ContactSolver> {};

TEST(PairMemory, OfAPairThatIsNewHoldsNothingInAnyTimeStep) {
  PairMemory memory;
  memory.feature[0] = 3;  // what an earlier list left there
  memory.point[0] = {{1.0, 2.0, 3.0}, 4.0};
  for (const std::int32_t step : {0, 1, 1000}) EXPECT_EQ(memory_of(memory, 3, step).impulse.normal, 0.0) << step;
  memory.step = 999;
  EXPECT_EQ(memory_of(memory, 3, 1000).impulse.normal, 1.0);
  EXPECT_EQ(memory_of(memory, 3, 1000).rise, 4.0);
}

TEST_P(DeviceSolvers, BlocksAndThreadsChangeNothing) {
  constexpr std::int64_t steps = 12;  // threads that outnumber the processors wait long at every barrier
  SceneDef scene = test::busy_scene(7);
  scene.contact.solver = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  EXPECT_GT(test::contacts_in(expected), 50);
  const std::size_t none = workspace_minimum(8, test::team_lanes), bodies = none + 160 * 256, all = 1 << 20;
  for (const auto& [blocks, threads, shared_memory] :
       {std::tuple{1, 8, none}, {2, 4, bodies}, {3, 4, all}, {5, 4, all}}) {
    HostScene device(scene, test::busy_field(scene), blocks, threads, 0, shared_memory);
    StepLog log;
    device.advance(steps, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_GT(device.status().builds, 0);
  }
}

/// The bodies of a scene some seconds after its start, when floes meet the platform.
Bodies crowd_of(const SceneDef& scene) {
  const auto engine = test::busy_engine(scene, "cpu");
  StepLog log;
  engine->advance(300, log);
  return engine->bodies();
}

/// The last time steps that 32 bits can count: event times, stamps and lists as in the cpu engine, by both routes.
TEST_P(DeviceSolvers, CountsToItsLastTimeStep) {
  constexpr std::int64_t steps = 100, begin = device_steps_maximum - steps;
  SceneDef scene = test::busy_scene(8);
  scene.contact.solver = GetParam();
  const Bodies crowd = crowd_of(scene);
  const auto cpu = make_engine(scene, crowd, {"cpu", 1});
  EngineState state = cpu->save();
  state.step = begin;
  cpu->restore(state);
  StepLog expected;
  cpu->advance(steps, expected);
  ASSERT_GT(expected.events.size(), 0u);
  for (const bool by_phases : {false, true}) {
    HostScene device(scene, crowd, 1, by_phases ? test::team_warp : 1);
    device.begin_at(begin);
    if (by_phases) device.use_phases();
    StepLog log;
    device.advance(steps, log);
    EXPECT_EQ(device.status().step, device_steps_maximum);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  }
}

/// A run that changes from engine to engine is the run of one engine: state, log, books and what points remember.
TEST_P(DeviceSolvers, GoesOnWithTheStateOfTheCpuEngineAndBack) {
  SceneDef scene = test::busy_scene(8);
  scene.contact.solver = GetParam();
  for (const bool by_phases : {false, true}) {
    const auto whole = test::busy_engine(scene, "cpu"), first = test::busy_engine(scene, "cpu"),
               last = test::busy_engine(scene, "cpu");
    StepLog expected, log;
    whole->advance(300, expected);
    first->advance(300, log);
    expected.clear();
    log.clear();
    HostScene device(scene, test::busy_field(scene), 1, by_phases ? test::team_warp : 1);
    if (by_phases) device.use_phases();
    device.restore(first->save());
    const std::int64_t steps = by_phases ? 6 : 70;  // phases by host threads are slow
    device.advance(steps, log);
    last->restore(device.save());
    last->advance(50, log);
    whole->advance(steps + 50, expected);
    ASSERT_GT(expected.events.size(), 0u);
    EXPECT_EQ(last->state_hash(), whole->state_hash());
    test::expect_same_bodies(last->bodies(), whole->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_memory(last->save(), whole->save());
    test::expect_same_books(last->ledger(), whole->ledger());
    const Ledger a = last->ledger(), b = whole->ledger();
    EXPECT_EQ(a.momentum_scale, b.momentum_scale);
    EXPECT_EQ(a.angular_scale, b.angular_scale);
    EXPECT_EQ(a.energy_scale, b.energy_scale);
  }
}

/// A log without samples holds nothing that was not measured.
TEST_P(DeviceSolvers, WithoutSamplesTheLogHasEventsOnly) {
  SceneDef scene = test::busy_scene(8);
  scene.contact.solver = GetParam();
  for (const bool by_phases : {false, true}) {
    HostScene device(scene, crowd_of(scene), 1, by_phases ? test::team_warp : 1);
    device.without_samples();
    if (by_phases) device.use_phases();
    StepLog log;
    device.advance(100, log);
    EXPECT_GT(log.events.size(), 0u);
    EXPECT_TRUE(log.platform.empty() && log.quality.empty());
    EXPECT_EQ(log.overlap.count, OverlapCount{}.count);
    EXPECT_EQ(log.overlap_share.count, OverlapCount{}.count);
  }
}

TEST(DeviceSteps, ALongerRunIsRefused) {
  EXPECT_NO_THROW(check_device_steps(device_steps_maximum));
  try {
    check_device_steps(device_steps_maximum + 1);
    FAIL() << "a run was taken that the device cannot count";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("(2147483646 time steps, allowed at most 2147483645)"), std::string::npos);
  }
}

/// A coupled scene on two blocks.
struct TwoBlocks {
  HostScene device;
  StepLog log;
  TwoBlocks(const SceneDef& scene, std::size_t shared_memory)
      : device(scene, test::busy_field(scene), 2, 4, 0, shared_memory) {}
  /// Makes a time step. Returns its grid barriers.
  int advance() {
    device.advance(1, log);
    return device.status().barriers;
  }
};
constexpr std::size_t ample = 1 << 20;
const std::size_t scarce = workspace_minimum(4, test::team_lanes);

/// Barriers that halos spare in time step `step`. Without halos: two in each iteration but the first, which moves
/// nothing. With halos: one in each judged iteration and one at the end.
int spared_by_halos(const StepLog& log, int step) {
  const int iterations = log.quality[std::size_t(step)].iterations;
  const int judged = iterations / 4 + std::min(iterations, 2), without = 2 * iterations - 1, halos = judged + 1;
  return without - halos;
}

TEST(DeviceHalo, SparesTheBarriersOfIterationsInTimeStepsThatHaveMemoryAndChangesNothing) {
  constexpr int steps = 16;
  SceneDef scene = test::busy_scene(9);
  scene.contact.solver = ContactSolver::coupled;
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  TwoBlocks with(scene, ample), at_times(scene, ample);
  int crowded = 0;
  ASSERT_EQ(scene.numerics.iterations_maximum % 4, 0) << "the last iteration must be a judged one";
  for (int m = 0; m < steps; ++m) {
    at_times.device.give_space(m % 2 == 0 ? scarce : ample);
    const int spared = at_times.advance() - with.advance();
    if (m % 2 == 1)
      EXPECT_EQ(spared, 0) << "halos again in time step " << m;
    else
      EXPECT_TRUE(spared == 0 || spared == spared_by_halos(expected, m)) << spared << " in time step " << m;
    if (spared > 0) ++crowded;
  }
  EXPECT_GT(crowded, 0);
  for (const TwoBlocks* one : {&with, &at_times}) {
    test::expect_same_bodies(one->device.bodies(), cpu->bodies());
    test::expect_same_coupled(one->device, one->log, *cpu, expected);
  }
}

TEST(DeviceHalo, RoundsThatFollowChangeNothing) {
  constexpr int steps = 8;
  SceneDef scene = test::busy_scene(9);
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.residual_tolerance = 1e-9;
  scene.numerics.iterations_maximum = 200;
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  TwoBlocks device(scene, ample);
  int most = 0, all = 0, barriers = 0;
  for (int m = 0; m < steps; ++m) barriers += device.advance();
  for (const StepQuality& quality : expected.quality) {
    most = std::max(most, int(quality.iterations));
    all += int(quality.iterations);
  }
  EXPECT_GT(most, 40) << "more than one round";
  EXPECT_LT(barriers, all) << "without halos there are two in an iteration";
  test::expect_same_bodies(device.device.bodies(), cpu->bodies());
  test::expect_same_coupled(device.device, device.log, *cpu, expected);
}

TEST(DeviceHalo, IsNoneWhereverTheMemoryEndsAndChangesNothing) {
  constexpr int first = 12, rungs = 48, steps = first + rungs;  // before the first there are few points
  constexpr std::size_t line = 128;                             // the unit of allocation
  SceneDef scene = test::busy_scene(9);
  scene.contact.solver = ContactSolver::coupled;
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  TwoBlocks device(scene, ample), with(scene, ample);
  int crowded = 0, with_halos = 0;
  for (int m = 0; m < steps; ++m) {
    if (m >= first) device.device.give_space(scarce + std::size_t(m - first) * line);
    const int spared = device.advance() - with.advance();
    if (m < first) continue;
    EXPECT_TRUE(spared == 0 || spared == spared_by_halos(expected, m)) << spared << " in time step " << m;
    ++(spared > 0 ? crowded : with_halos);
  }
  EXPECT_GT(crowded, rungs / 4);
  EXPECT_GT(with_halos, rungs / 4);
  test::expect_same_bodies(device.device.bodies(), cpu->bodies());
  test::expect_same_coupled(device.device, device.log, *cpu, expected);
}

/// Floes at the platform, and rows longer than RowChanges::stretch and kept_near.
TEST_P(DeviceSolvers, LongRowsAndThePlatformByManyThreadsChangeNothing) {
  constexpr std::int64_t steps = 6;
  SceneDef scene = test::busy_scene(8);
  scene.contact.solver = GetParam();
  scene.numerics.list_margin_m = 60.0;
  const auto before = test::busy_engine(scene, "cpu");
  const auto at_platform = [](const StepLog& log) {
    std::int64_t floes = 0;
    for (const PlatformStep& sample : log.platform) floes += sample.contacts;
    return floes;
  };
  for (StepLog skipped; at_platform(skipped) < 5 && before->step() < 3000;) {
    skipped.clear();
    before->advance(5, skipped);
  }
  const Bodies field = before->bodies();
  const auto cpu = make_engine(scene, field, {"cpu", 1});
  StepLog expected;
  cpu->advance(steps, expected);
  EXPECT_GT(at_platform(expected), 5);
  const std::size_t all = 1 << 20;
  HostScene device(scene, field, 2, 8, 0, all);
  StepLog log;
  device.advance(steps, log);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(device.longest_lower_row(), RowChanges::stretch);
}

TEST_P(DeviceSolvers, AHorizonFollowsTheLifeOfListsInShortCallsToo) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.solver = GetParam();
  HostScene device(scene, test::busy_field(scene));
  const std::int64_t longest = device.status().horizon;
  StepLog log;
  std::int64_t least = longest;
  for (int call = 0; call < 400; ++call) {
    device.advance(1, log);
    least = std::min(least, device.status().horizon);
  }
  EXPECT_GE(least, 4);
  EXPECT_LT(least, longest);
}

TEST_P(DeviceSolvers, AListTooSmallGrowsAndLosesNothing) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.solver = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene), 1, 1, 64);
  StepLog expected, log;
  cpu->advance(200, expected);
  device.advance(200, log);
  EXPECT_GT(device.growths(), 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  EXPECT_GT(test::contacts_in(expected), 2000);
}

TEST_P(DeviceSolvers, WaitingForOtherScenesChangesNothing) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.solver = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene));
  StepLog expected, log;
  for (int block = 0; block < 4; ++block) {
    cpu->advance(40, expected);
    device.advance(40, log);
    device.wait();
  }
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 1000);
}

INSTANTIATE_TEST_SUITE_P(Solvers, DeviceSolvers, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

}  // namespace
}  // namespace gem
