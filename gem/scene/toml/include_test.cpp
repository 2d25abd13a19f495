// Files that include others.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gem/base/error.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("gem_scene_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_ / "parts");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(SceneFiles, LaterIncludesWinAndPathsFollowTheirFile) {
  write("parts/a.toml", "[platform]\nmass_kg = 2e8\nsides = 12\n[floes]\nsource = \"file\"\npath = \"floes.csv\"\n");
  write("b.toml", "[platform]\nmass_kg = 3e8\n");
  const std::string main =
      write("main.toml", "include = [\"parts/a.toml\", \"b.toml\"]\n[platform]\ndiameter_m = 80\n");
  const SceneDef scene = read_scene(main, {"platform.diameter_m=90"});
  EXPECT_EQ(scene.platform.mass_kg, 3e8);
  EXPECT_EQ(scene.platform.sides, 12);
  EXPECT_EQ(scene.platform.diameter_m, 90.0);
  EXPECT_EQ(scene.floes.path, (folder_ / "parts/floes.csv").string());
}

TEST_F(SceneFiles, IncludeCycleIsRefused) {
  write("b.toml", "include = [\"a.toml\"]\n");
  const std::string a = write("a.toml", "include = [\"./b.toml\"]\n");
  try {
    read_scene(a);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    EXPECT_NE(std::string(error.what()).find("b.toml:1:12: include: the file includes itself"), std::string::npos)
        << error.what();
  }
}

// Each file includes the next one twice, so that the number of files doubles with the depth.
TEST_F(SceneFiles, IncludesDoNotMultiply) {
  for (int i = 0; i < 15; ++i) {
    const std::string next = "\"f" + std::to_string(i + 1) + ".toml\"";
    write("f" + std::to_string(i) + ".toml", "include = [" + next + ", " + next + "]\n");
  }
  write("f15.toml", "[run]\nseed = 2\n");
  try {
    read_scene((folder_ / "f0.toml").string());
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("include: too many files (allowed 256)"), std::string::npos)
        << error.what();
  }
}

TEST_F(SceneFiles, UnreadableFilesAreFaultsOfTheFileSystem) {
  const std::string main = write("main.toml", "include = [\"missing.toml\"]\n");
  for (const std::string& path : {main, folder_.string(), (folder_ / "none.toml").string()}) {
    try {
      read_scene(path);
      FAIL() << "accepted " << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::file_system) << error.what();
    }
  }
}

}  // namespace
}  // namespace gem
