// A complete file that was never closed is closed; a file in use, an unmarked one and other files stay as they are.
#include "gem/record/run_file/killed_end.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/recorder.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_layout.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class KilledEndTest : public testing::Test {
 protected:
  void SetUp() override {
    SceneDef scene;
    FakeEngine engine(scene, fake_field(3));
    const std::string written = (folder_.path() / "written.h5").string();
    RunLayout layout(written, scene, engine.bodies(), {});
    Recorder recorder(scene, engine);
    layout.append(recorder.take());
    layout.flush([] {});
    layout.set_end("complete", 7, {});
    fs::copy_file(written, path_);  // as after a kill
    layout.close();
    fs::rename(written, closed_);
  }

  /// As other programs do it.
  static bool opens(const std::string& path) {
    hdf5::quiet_errors();
    return hdf5::Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose).valid();
  }
  static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ScratchFolder folder_{"gem-killed-end"};
  std::string path_ = (folder_.path() / "killed.h5").string();
  std::string closed_ = (folder_.path() / "closed.h5").string();
};

TEST_F(KilledEndTest, TheFileOpensLikeAnyOtherAfterwards) {
  ASSERT_FALSE(opens(path_));
  EXPECT_TRUE(close_killed_end(path_));
  EXPECT_TRUE(opens(path_));
  EXPECT_EQ(RunFile(path_).status(), "complete");
  EXPECT_FALSE(close_killed_end(path_));
}

TEST_F(KilledEndTest, AFileInUseStaysAsItIs) {
  const std::string before = bytes_of(path_);
  const int writer = open(path_.c_str(), O_RDONLY);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  EXPECT_FALSE(close_killed_end(path_));
  close(writer);
  EXPECT_EQ(bytes_of(path_), before);
}

TEST_F(KilledEndTest, WhatHasNoMarkIsNotTouched) {
  const std::string other = (folder_.path() / "other.txt").string();
  std::ofstream(other) << "not an HDF5 file";
  for (const std::string& path : {closed_, other}) {
    const std::string before = bytes_of(path);
    EXPECT_FALSE(close_killed_end(path)) << path;
    EXPECT_EQ(bytes_of(path), before) << path;
  }
  EXPECT_FALSE(close_killed_end((folder_.path() / "absent.h5").string()));
}

}  // namespace
}  // namespace gem
