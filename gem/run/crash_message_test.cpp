// A process that crashes while a run is written, in a child of the test.
#include "gem/run/crash_message.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

#include "gem/base/sanitizers.h"
#include "gem/engine/cpu/thread_team.h"

namespace gem {
namespace {

/// Calls itself until the stack is used up.
[[gnu::noinline]] int without_end(int depth) {
  static volatile int end = -1;  // never reached, which the compiler does not know
  volatile char room[1000] = {};
  if (depth == end) return 0;
  room[0] = static_cast<char>(depth);
  return room[0] + without_end(depth + 1) + room[999];
}

class CrashMessageTest : public testing::Test {
 protected:
  void SetUp() override {
    if (is_sanitized) GTEST_SKIP() << "a sanitizer ends a crash with a report of its own";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

TEST_F(CrashMessageTest, ACrashNamesTheFileAndEndsWithItsCode) {
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE})
    EXPECT_EXIT(
        {
          const CrashMessage message("a\n.h5");
          raise(signal_number);
        },
        testing::ExitedWithCode(7), "the run crashed .* mend .?a.x0a.h5.? with `gem repair`");
}

TEST_F(CrashMessageTest, AStackThatIsUsedUpIsACrash) {
  EXPECT_EXIT(
      {
        const CrashMessage message("run.h5");
        without_end(0);
      },
      testing::ExitedWithCode(7), "the run crashed");
  EXPECT_EXIT(
      {
        const CrashMessage message("run.h5");
        ThreadTeam(2).run([](int rank) {
          if (rank == 1) without_end(0);
        });
      },
      testing::ExitedWithCode(7), "the run crashed");
}

TEST_F(CrashMessageTest, ALibraryThatEndsTheProcessIsACrash) {
  EXPECT_EXIT(
      {
        const CrashMessage message("run.h5");
        std::exit(-1);
      },
      testing::ExitedWithCode(7), "the run crashed");
}

TEST_F(CrashMessageTest, NothingIsSaidAfterTheRun) {
  EXPECT_EXIT(
      {
        { const CrashMessage message("run.h5"); }
        std::exit(3);
      },
      testing::ExitedWithCode(3), "^$");
  EXPECT_EXIT(
      {
        { const CrashMessage message("run.h5"); }
        raise(SIGSEGV);
      },
      testing::KilledBySignal(SIGSEGV), "");
}

}  // namespace
}  // namespace gem
