// A folder, a small scene and its run file, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/run/run_scene.h"

namespace gem {

class RunFileTest : public testing::Test {
 protected:
  void SetUp() override {
    scene_.run.duration_s = 10.0;
    scene_.output.floes_interval_s = 2.0;
    scene_.output.hit_release_s = 0.0;
    options_.output = (folder_ / "a run.h5").string();
    options_.log.quiet = true;
  }

  RunSummary run(int floes = 3, bool platform = true) {
    scene_.platform.present = platform;
    FakeEngine engine(scene_, fake_field(floes, platform));
    return run_scene(scene_, engine, options_);
  }
  std::size_t files() const { return std::size_t(std::distance(std::filesystem::directory_iterator(folder_), {})); }

  /// Runs `body`, which must throw Error with this code and with this text in its message.
  template <class Body>
  void expect_error(ExitCode code, const std::string& text, Body body) {
    try {
      body();
      ADD_FAILURE() << "no error, expected: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }

  ScratchFolder scratch_{"gem run file \xc3\xa9"};
  const std::filesystem::path& folder_ = scratch_.path();
  SceneDef scene_;
  RunOptions options_;
};

}  // namespace gem
