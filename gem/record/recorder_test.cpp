// Sampling: rates, interval forces, trailing mean, unwrapped yaw.
#include "gem/record/recorder.h"

#include <gtest/gtest.h>

#include "gem/record/fake_engine.h"

namespace gem {
namespace {

SceneDef short_scene() {
  SceneDef scene;
  scene.run.duration_s = 10.0;
  scene.output.platform_interval_s = 0.5;
  scene.output.floes_interval_s = 2.0;
  scene.output.force_window_s = 1.0;
  scene.output.hit_release_s = 0.0;
  return scene;
}

TEST(Cadence, RecordsEveryIntervalAndNoTimeStepTwice) {
  EXPECT_EQ(Cadence(0.1, 0.05).next_after(0), 2);
  EXPECT_EQ(Cadence(0.1, 0.05).next_after(2), 4);
  EXPECT_EQ(Cadence(0.01, 0.05).next_after(7), 8);
  const Cadence uneven(0.12, 0.05);  // 0.12, 0.24, 0.36 s -> time steps 2, 5, 7
  EXPECT_EQ(uneven.next_after(0), 2);
  EXPECT_EQ(uneven.next_after(2), 5);
  EXPECT_EQ(uneven.next_after(5), 7);
}

TEST(Recorder, ForcesAreImpulsesOverTheInterval) {
  const SceneDef scene = short_scene();
  FakeEngine engine(scene, fake_field(3));
  Recorder recorder(scene, engine);
  StepLog log;
  engine.advance(30, log);
  recorder.add(log, 200);
  const Slab slab = recorder.take();
  ASSERT_EQ(slab.platform.size(), 4U);                     // 0, 0.5, 1, 1.5 s
  EXPECT_DOUBLE_EQ(slab.platform[1].ice_impulse.x, 55.0);  // 1 + ... + 10
  EXPECT_DOUBLE_EQ(slab.platform[1].ice_force.x, 110.0);
  EXPECT_DOUBLE_EQ(slab.platform[1].ice_force_mean.x, 110.0);  // the window is not full yet
  EXPECT_DOUBLE_EQ(slab.platform[3].ice_impulse.x, 255.0);     // 21 + ... + 30
  EXPECT_DOUBLE_EQ(slab.platform[3].ice_force_mean.x, 410.0);  // 11 + ... + 30 over 1 s
  EXPECT_EQ(slab.platform[2].contacts, 2.0);
  EXPECT_EQ(slab.events.size(), 3U);
}

TEST(Recorder, RowsWaitUntilTheyAreTaken) {
  const SceneDef scene = short_scene();
  FakeEngine engine(scene, fake_field(3));
  Recorder recorder(scene, engine);
  StepLog log;
  engine.advance(30, log);
  recorder.add(log, 200);
  EXPECT_EQ(recorder.rows_waiting(), 4U + 3U);  // samples of the platform, and hits
  recorder.take();
  EXPECT_EQ(recorder.rows_waiting(), 0U);
}

TEST(Recorder, YawCountsOnOverFullTurns) {
  SceneDef scene = short_scene();
  scene.output.platform_interval_s = 0.05;
  FakeEngine engine(scene, fake_field(0));
  Recorder recorder(scene, engine);
  StepLog log;
  engine.advance(100, log);
  recorder.add(log, 200);
  EXPECT_NEAR(recorder.take().platform.back().yaw, 30.0, 1e-9);
}

TEST(Recorder, LastTimeStepIsSampledOffTheCadence) {
  const SceneDef scene = short_scene();
  FakeEngine engine(scene, fake_field(1));
  Recorder recorder(scene, engine);
  StepLog log;
  engine.advance(13, log);
  recorder.add(log, 13);
  EXPECT_DOUBLE_EQ(recorder.take().platform.back().time, 13 * 0.05);
}

TEST(Recorder, FrameHoldsFloesAndWorstQuality) {
  const SceneDef scene = short_scene();
  FakeEngine engine(scene, fake_field(3));
  Recorder recorder(scene, engine);
  EXPECT_EQ(recorder.next_frame(), 40);
  StepLog log;
  engine.advance(40, log);
  recorder.add(log, 200);
  const StatsRow row = recorder.add_frame(engine, 0.5);
  EXPECT_EQ(row.contacts, 7.0);
  EXPECT_EQ(row.maximum_overlap, 1e-3);
  EXPECT_EQ(row.maximum_depth, 2e-2);
  EXPECT_EQ(row.maximum_share, 2e-4);
  EXPECT_EQ(row.complementarity, 3e-6);
  EXPECT_EQ(row.cone_excess, 4e-9);
  EXPECT_EQ(row.energy_created, 5e-2);
  EXPECT_EQ(row.overlap.total(), 40);
  EXPECT_EQ(row.overlap_share.total(), 0);
  EXPECT_EQ(row.active_floes, 3.0);
  EXPECT_DOUBLE_EQ(row.sim_rate, 4.0);
  EXPECT_EQ(recorder.next_frame(), 80);
  const Slab slab = recorder.take();
  ASSERT_EQ(slab.floes.time.size(), 2U);
  ASSERT_EQ(slab.floes.x.size(), 6U);
  EXPECT_FLOAT_EQ(slab.floes.x[3], 12.0F);
}

}  // namespace
}  // namespace gem
