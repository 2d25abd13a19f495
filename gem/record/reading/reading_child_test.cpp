// A child process that reads may crash, hang or be ended; its parent says so.
#include "gem/record/reading/reading_child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/base/sanitizers.h"
#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

const ReadInChild reading{{"a.h5", "b.h5"}};

/// The message and the code of the error; an empty text without one.
std::pair<std::string, int> answer(const std::function<void()>& work, long seconds = 0) {
  try {
    tried_in_child(reading, work, seconds);
  } catch (const Error& error) {
    return {error.what(), static_cast<int>(error.code())};
  }
  return {"", 0};
}

void crash(int signal_number) {
  signal(signal_number, SIG_DFL);  // sanitizers have handlers
  raise(signal_number);
}

TEST(ReadingChild, ACrashIsAnError) {
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    const auto [text, code] = answer([&] { crash(signal_number); });
    EXPECT_EQ(code, 4) << signal_number;
    EXPECT_NE(text.find("cannot read a.h5 or b.h5 (reading it crashed: "), std::string::npos) << text;
  }
}

TEST(ReadingChild, WorkThatNeverEndsIsEnded) {
  const auto [text, code] = answer(
      [] {
        for (volatile unsigned turn = 0;;) turn = turn + 1;
      },
      1);
  EXPECT_EQ(code, 4);
  EXPECT_NE(text.find("more than 1 s of processor time"), std::string::npos) << text;
}

TEST(ReadingChild, WhoIsKilledHadNoMemory) {
  const auto [text, code] = answer([] { raise(SIGKILL); });
  EXPECT_EQ(code, 7);
  EXPECT_NE(text.find("probably for its memory"), std::string::npos) << text;
}

TEST(ReadingChild, MoreMemoryThanTheMachineHasIsRefused) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer reserves more memory than there is";
  const std::size_t all = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE));
  // not touched: without a limit the system would give it
  const auto [text, code] = answer([&] {
    try {
      std::vector<char> too_much;
      too_much.reserve(all);
    } catch (const std::bad_alloc&) {
      raise(SIGSEGV);
    }
  });
  EXPECT_EQ(code, 4) << "the allocation did not fail";
}

TEST(ReadingChild, ErrorsAndOutputAreLeftToTheCaller) {
  testing::internal::CaptureStderr();
  const auto [text, code] = answer([] {
    std::fputs("said", stderr);
    throw Error(ExitCode::usage, "refused");
  });
  EXPECT_EQ(code, 0) << text;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ReadingChild, TheTimeFollowsTheSizesOfTheFiles) {
  const ScratchFolder folder("gem_reading_child");
  const std::string path = folder.write("a", "");
  EXPECT_EQ(processor_seconds({{path}}), 120);
  std::filesystem::resize_file(path, 3'000'000'000);  // a hole
  EXPECT_EQ(processor_seconds({{path, path}}), 120 + 6000);
  EXPECT_EQ(processor_seconds({{path}, false}), 0);
  EXPECT_EQ(processor_seconds({{folder.path().string()}}), 0) << "a folder has no size";
}

}  // namespace
}  // namespace gem
