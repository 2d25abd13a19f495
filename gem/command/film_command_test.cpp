// gem film with a program that stands for ffmpeg: pictures, names, refusals. With the real one where it is installed.
#include <gtest/gtest.h>

#include "gem/command/command_fixture.h"

namespace gem {
namespace {

class FilmTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::filesystem::create_directory(path("bin"));
    write_program("#!/bin/bash\nout=${@: -1}\nwc -c >\"${out#file:}\"\n");
    ASSERT_EQ(shell("gem run swing.toml -q"), 0) << text_of("err");
  }

  void write_program(const std::string& text) const {
    std::ofstream(path("bin/ffmpeg")) << text;
    std::filesystem::permissions(path("bin/ffmpeg"), std::filesystem::perms::owner_all);
  }

  int film(const std::string& arguments) { return shell("PATH=$PWD/bin:$PATH; gem film swing.h5 " + arguments); }
};

TEST_F(FilmTest, EveryPictureIsHandedOver) {
  ASSERT_EQ(film("a.mp4 --size 64x66 --speed 2 --fps 10"), 0) << text_of("err");
  EXPECT_EQ(std::stol(text_of("a.mp4")), 101L * 64 * 66 * 3);  // 20 s at twice the speed, with both ends
  EXPECT_NE(text_of("out").find("a.mp4: 101 pictures"), std::string::npos) << text_of("out");
  ASSERT_EQ(film("b.webm --size 64x64 --from 5 --to 6 --speed 1 --fps 10 --follow"), 0) << text_of("err");
  EXPECT_EQ(std::stol(text_of("b.webm")), 11L * 64 * 64 * 3);
}

TEST_F(FilmTest, TheFilmMayBeNamedAsInOtherCommands) {
  for (const char* out : {"--out c.mp4", "-o d.mp4"})
    EXPECT_EQ(film(std::string("--size 64x64 --fps 1 ") + out), 0) << text_of("err");
  EXPECT_TRUE(exists("c.mp4") && exists("d.mp4"));
  EXPECT_EQ(film("--size 64x64"), 2);
}

TEST_F(FilmTest, NamesAreNeverCommands) {
  for (const std::string name : {"-y.mp4", "a b'; touch owned;'.mp4", "http:x.mp4"}) {
    ASSERT_EQ(film("--size 64x64 --fps 1 -- \"" + name + "\""), 0) << text_of("err");
    EXPECT_TRUE(exists(name)) << name;
  }
  EXPECT_FALSE(exists("owned"));
}

TEST_F(FilmTest, NothingIsReplacedOrLeft) {
  std::ofstream(path("a.mp4")) << "mine";
  EXPECT_EQ(film("a.mp4"), 4);
  EXPECT_EQ(text_of("a.mp4"), "mine");
  EXPECT_EQ(film("a.mp4 --overwrite --size 64x64 --fps 1"), 0) << text_of("err");
  EXPECT_NE(text_of("a.mp4"), "mine");
  write_program("#!/bin/bash\nout=${@: -1}\necho begun >\"${out#file:}\"\necho 'no room left' >&2\nexit 1\n");
  EXPECT_EQ(film("b.mp4"), 4);
  EXPECT_NE(text_of("err").find("ffmpeg: no room left"), std::string::npos) << text_of("err");
  EXPECT_FALSE(exists("b.mp4") || exists(".b.new.mp4"));
  EXPECT_EQ(shell("PATH=/nowhere; gem film swing.h5 c.mp4"), 2);
  EXPECT_NE(text_of("err").find("the program ffmpeg was not found"), std::string::npos) << text_of("err");
  EXPECT_FALSE(exists("c.mp4"));
}

TEST_F(FilmTest, MistakesAreNamed) {
  const struct {
    const char* arguments;
    int code;
    const char* reason;
  } rows[] = {
      {"a.gif", 2, "allowed are .mp4 and .webm"},
      {"a.mp4 --size 65x64", 2, "two even numbers"},
      {"a.mp4 --size 64", 2, "two even numbers"},
      {"a.mp4 --from 30", 2, "would end before it begins"},
      {"a.mp4 --from soon", 2, "soon"},
      {"a.mp4 --speed 0.001 --fps 120", 2, "larger --speed"},
      {"nowhere/a.mp4", 4, "nowhere"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(film(row.arguments), row.code) << row.arguments;
    EXPECT_NE(text_of("err").find(row.reason), std::string::npos) << text_of("err");
  }
  EXPECT_FALSE(exists("a.mp4"));
}

TEST_F(FilmTest, TheRealProgramMakesAFilm) {
  if (shell("command -v ffmpeg") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  ASSERT_EQ(shell("gem film swing.h5 a.mp4 --size 128x72 --fps 5"), 0) << text_of("err");
  EXPECT_EQ(text_of("a.mp4").substr(4, 4), "ftyp");
}

}  // namespace
}  // namespace gem
