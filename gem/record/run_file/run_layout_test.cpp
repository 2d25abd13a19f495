// What readers see of a run file while it is written, and after a cut.
#include "gem/record/run_file/run_layout.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/recorder.h"
#include "gem/record/run_file/run_file.h"

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

class RunLayoutTest : public testing::Test {
 protected:
  void SetUp() override { scene_.output.floes_interval_s = scene_.numerics.time_step_s; }

  /// Opens a file for `floes` floes, with `frames` frames in its first slab.
  void begin(int floes, int frames) {
    engine_.emplace(scene_, fake_field(floes));
    layout_.emplace(path_, scene_, engine_->bodies(), Provenance{});
    recorder_.emplace(scene_, *engine_);
    add(frames - 1);
  }

  void add(int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      StepLog log;
      engine_->advance(1, log);
      recorder_->add(log, 100);
      recorder_->add_frame(*engine_, 0.0);
    }
    layout_->append(recorder_->take());
  }

  /// The file as another program would see it now.
  std::string copy() const {
    std::filesystem::copy_file(path_, path_ + ".copy", std::filesystem::copy_options::overwrite_existing);
    return path_ + ".copy";
  }

  ScratchFolder folder_{"gem layout"};
  std::string path_ = (folder_.path() / "run.h5").string();
  SceneDef scene_;
  std::optional<FakeEngine> engine_;
  std::optional<Recorder> recorder_;
  std::optional<RunLayout> layout_;
};

TEST_F(RunLayoutTest, AFlushShowsAllRowsAndNoneBefore) {
  for (const int floes : {0, 10, 20000, 70000}) {
    begin(floes, 7);
    EXPECT_EQ(RunFile(copy(), true).frame_count(), 0U) << floes << " floes";
    layout_->flush([] {});
    EXPECT_EQ(layout_->visible().frames, 7U);
    const std::string seen = copy();
    const RunFile file(seen, true);
    EXPECT_EQ(file.frame_count(), 7U) << floes << " floes";
    EXPECT_EQ(file.column("floes/x").size(), std::size_t(7 * floes));
    EXPECT_EQ(file.status(), "running");
    layout_->close();
  }
}

TEST_F(RunLayoutTest, RowsThatWereFlushedInPartsAreThoseOfOneSlab) {
  const auto values = [&](int flushes) {
    begin(2100, 7);
    for (int n = 0; n < flushes; ++n) {
      layout_->flush([] {});
      add(9);
    }
    if (flushes == 0) add(36);
    layout_->append_rest();
    layout_->flush([] {});
    layout_->close();
    const RunFile file(path_, true);
    EXPECT_EQ(file.frame_count(), 43U);
    auto all = file.column("floes/x");
    for (const char* name : {"floes/active", "platform/x", "stats/steps", "stats/overlap_count", "events/impulse"})
      for (const double value : file.column(name)) all.push_back(value);
    return all;
  };
  EXPECT_EQ(values(0), values(4));
}

TEST_F(RunLayoutTest, AFileCutBehindItsFlushHoldsTheRowsThatAreThere) {
  begin(2100, 7);
  layout_->flush([] {});
  const auto flushed = std::filesystem::file_size(path_);
  add(60);
  layout_->flush([] {});
  const std::string seen = copy();
  std::filesystem::resize_file(seen, (flushed + 4095) / 4096 * 4096);
  const RunFile file(seen, true);
  for (const double time : file.column("stats/time")) EXPECT_LE(time, file.column("stats/time").back());
  EXPECT_LT(file.frame_count(), 67U);
  layout_->close();
}

TEST_F(RunLayoutTest, RoomCountsWholeChunksOfEveryColumn) {
  begin(10, 1);
  Slab one;
  one.events.resize(1);
  one.platform.resize(1);
  // 1024 rows of 14 columns of events and of 16 of the platform have 4 or 8 bytes
  EXPECT_GT(layout_->room_for(one), 1024U * (14U * 4U + 16U * 4U));
  Slab many = one;
  many.events.resize(1025);
  EXPECT_GT(layout_->room_for(many), layout_->room_for(one) + 1024U * 14U * 4U - 1U);
  layout_->close();
}

}  // namespace
}  // namespace gem
