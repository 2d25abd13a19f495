// Run files with changed bytes, on which the HDF5 library may crash: every command answers with a message.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "gem/base/sanitizers.h"
#include "gem/command/command_fixture.h"

namespace gem {
namespace {

class DamagedFile : public CommandTest {
 protected:
  void SetUp() override {
    if (is_sanitized) GTEST_SKIP() << "a sanitizer ends a crash with a report of its own";
    CommandTest::SetUp();
    ASSERT_EQ(shell("gem run swing.toml --until 5 -q --threads 1 --out whole.h5"), 0);
    std::ifstream file(path("whole.h5"), std::ios::binary);
    whole_.assign(std::istreambuf_iterator<char>(file), {});
  }

  /// Writes bad.h5: up to six bytes of the file are others.
  void damage(std::mt19937& random) const {
    std::string bytes = whole_;
    constexpr std::array<unsigned char, 5> likely = {0, 1, 127, 128, 255};
    for (std::size_t n = 1 + random() % 6; n > 0; --n)
      bytes[random() % bytes.size()] = static_cast<char>(random() % 2 ? likely[random() % likely.size()] : random());
    std::ofstream(path("bad.h5"), std::ios::binary) << bytes;
  }

  /// Whether the last command crashed while it read, and said so.
  bool crashed() const { return text_of("err").find("reading it crashed") != std::string::npos; }

  std::string whole_;
};

TEST_F(DamagedFile, IsReadOrRefusedWithAMessage) {
  std::mt19937 random(1);
  int crashes = 0;
  for (int turn = 0; turn < 40; ++turn) {
    damage(random);
    const int code = shell("gem info bad.h5");
    ASSERT_TRUE(code == 0 || code == 4) << turn << ": " << code << "\n" << text_of("err");
    EXPECT_EQ(code == 4, text_of("err").starts_with("gem: error: cannot read bad.h5 (")) << text_of("err");
    if (!crashed() || ++crashes > 1) continue;
    // the other commands once
    for (const char* line :
         {"gem report bad.h5 --allow-incomplete", "gem analyse bad.h5 --allow-incomplete",
          "gem compare bad.h5 whole.h5 --allow-incomplete", "gem repair bad.h5",
          "gem view bad.h5 --allow-incomplete --out page.html", "gem export bad.h5 out.csv --allow-incomplete",
          "gem run swing.toml --from bad.h5", "gem run --continue bad.h5"}) {
      EXPECT_EQ(shell(line), 4) << line << "\n" << text_of("err");
      EXPECT_TRUE(text_of("err").starts_with("gem: error: ")) << line << "\n" << text_of("err");
    }
  }
  RecordProperty("crashes", crashes);  // depends on the version of the library
}

TEST_F(DamagedFile, AChildHandsItsExitCodeAndItsOutputOn) {
  EXPECT_EQ(shell("gem info whole.h5"), 0);
  EXPECT_NE(text_of("out").find("stopped:until"), std::string::npos);
  EXPECT_EQ(shell("gem info missing.h5"), 4);
  EXPECT_EQ(shell("gem analyse whole.h5 --from 100"), 2) << text_of("err");
}

}  // namespace
}  // namespace gem
