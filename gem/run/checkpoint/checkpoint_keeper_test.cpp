// When checkpoints are due, what their files tell, and what happens when one cannot be written.
#include "gem/run/checkpoint/checkpoint_keeper.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

class CheckpointKeeperTest : public testing::Test {
 protected:
  std::string run_file(const std::string& name = "run.h5") const { return (scratch_.path() / name).string(); }
  /// One checkpoint from its state to its file.
  void leave(CheckpointKeeper& keeper, const std::string& file) {
    keeper.start(taken_);
    keeper.write(file, taken_);
  }
  static bool becomes_due(const CheckpointKeeper& keeper) {
    using namespace std::chrono_literals;
    for (int i = 0; i < 2000 && !keeper.is_due(); ++i) std::this_thread::sleep_for(5ms);
    return keeper.is_due();
  }

  ScratchFolder scratch_{"gem-keeper"};
  TakenCheckpoint taken_;
};

TEST_F(CheckpointKeeperTest, NoIntervalMeansNoCheckpoint) {
  CheckpointKeeper keeper(0.0);
  keeper.begin(0);
  EXPECT_FALSE(keeper.on());
  EXPECT_FALSE(keeper.is_due());
}

TEST_F(CheckpointKeeperTest, TheNextOneWaitsForTheLast) {
  CheckpointKeeper keeper(1e-9);
  keeper.begin(0);
  ASSERT_TRUE(becomes_due(keeper));
  keeper.start(taken_);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_FALSE(keeper.is_due());
  keeper.write(run_file(), taken_);
  EXPECT_TRUE(becomes_due(keeper));
}

TEST_F(CheckpointKeeperTest, TheFirstOneComesWithinSecondsHoweverLongTheInterval) {
  CheckpointKeeper keeper(1e9);
  keeper.begin(0);
  EXPECT_FALSE(keeper.is_due());
  EXPECT_TRUE(becomes_due(keeper));
  leave(keeper, run_file());
  EXPECT_FALSE(keeper.is_due());
}

TEST_F(CheckpointKeeperTest, CheckpointsTakeOneHundredthOfTheTime) {
  CheckpointKeeper keeper(1e-9);
  keeper.begin(0);
  taken_.cost = 1e6;
  leave(keeper, run_file());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(keeper.is_due());
}

TEST_F(CheckpointKeeperTest, AFileHasTheTimeAtWhichItsStateWasTaken) {
  CheckpointKeeper keeper(1.0);
  keeper.begin(0);
  keeper.start(taken_);
  taken_.time.tv_sec -= 1000;
  keeper.write(run_file(), taken_);
  struct stat found {};
  ASSERT_EQ(stat((run_file() + ".checkpoint-a").c_str(), &found), 0);
  EXPECT_EQ(found.st_mtim.tv_sec, taken_.time.tv_sec);
}

TEST_F(CheckpointKeeperTest, AFaultIsToldOnceAndTheNextOneTakesItsPlace) {
  CheckpointKeeper keeper(1.0);
  keeper.begin(0);
  leave(keeper, run_file("no_folder/run.h5"));
  EXPECT_NE(keeper.take_fault().find("the run goes on"), std::string::npos);
  leave(keeper, run_file("no_folder/run.h5"));
  EXPECT_EQ(keeper.take_fault(), "");
  leave(keeper, run_file());
  EXPECT_TRUE(std::filesystem::exists(run_file() + ".checkpoint-a"));
}

}  // namespace
}  // namespace gem
