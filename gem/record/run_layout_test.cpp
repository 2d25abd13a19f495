// How many rows of a run wait in memory and would be lost in a kill.
#include "gem/record/run_layout.h"

#include <gtest/gtest.h>

#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/recorder.h"

namespace gem {
namespace {

TEST(ChunkShape, HoldsFewerFramesOfMoreFloes) {
  EXPECT_EQ(chunk_shape(0).frames, 16U);
  EXPECT_EQ(chunk_shape(4008).frames, 16U);
  EXPECT_EQ(chunk_shape(4008).floes, 2048U);
  EXPECT_EQ(chunk_shape(4008).rows, 1024U);
  EXPECT_EQ(chunk_shape(20000).frames, 3U);
  EXPECT_EQ(chunk_shape(1000000).frames, 1U);
  EXPECT_EQ(chunk_shape(1000000).floes, 32768U);
  EXPECT_EQ(chunk_shape(1000000).rows, 64U);
  EXPECT_EQ(chunk_shape(1000000).rows_of("events"), 64U);
}

/// Number of frames that wait after seven were added.
std::size_t frames_waiting(int floes) {
  const ScratchFolder folder("gem layout");
  SceneDef scene;
  scene.output.floes_interval_s = scene.numerics.time_step_s;
  FakeEngine engine(scene, fake_field(floes));
  RunLayout layout((folder.path() / "run.h5").string(), scene, engine.bodies(), {});
  Recorder recorder(scene, engine);
  for (int frame = 1; frame < 7; ++frame) {
    StepLog log;
    engine.advance(1, log);
    recorder.add(log, 100);
    recorder.add_frame(engine, 0.0);
  }
  layout.append(recorder.take());
  layout.close();
  return layout.waiting().floes.time.size();
}

TEST(RunLayout, OfALargeFieldNoFrameWaits) {
  EXPECT_EQ(frames_waiting(10), 7U);
  EXPECT_EQ(frames_waiting(20000), 1U);
  EXPECT_EQ(frames_waiting(70000), 0U);
}

}  // namespace
}  // namespace gem
