// The thread team: every index once, every barrier complete, exceptions passed to the caller.
#include "gem/engine/cpu/thread_team.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>

#include "gem/base/error.h"

namespace gem {
namespace {

class ThreadTeamTest : public testing::TestWithParam<int> {};

TEST_P(ThreadTeamTest, EveryIndexIsVisitedOnce) {
  ThreadTeam team(GetParam());
  for (const std::int64_t count : {0, 1, 2, 7, 1000}) {
    std::vector<int> visits(count, 0);
    team.run([&](int rank) { team.for_each(rank, count, [&](std::int64_t i) { ++visits[i]; }); });
    for (const int v : visits) ASSERT_EQ(v, 1);
  }
  EXPECT_EQ(team.begin_of(0, 1000), 0);
  EXPECT_EQ(team.begin_of(team.size(), 1000), 1000);
}

TEST_P(ThreadTeamTest, WhatWasWrittenBeforeABarrierIsSeenAfterIt) {
  ThreadTeam team(GetParam());
  const int size = team.size();
  constexpr int rounds = 300;
  std::vector<int> value(size, 0), wrong(size, 0);
  team.run([&](int rank) {
    for (int round = 1; round <= rounds; ++round) {
      value[rank] = round;
      team.barrier();
      for (int other = 0; other < size; ++other) wrong[rank] += value[other] != round;
      team.barrier();
    }
  });
  EXPECT_EQ(std::accumulate(wrong.begin(), wrong.end(), 0), 0);
}

TEST_P(ThreadTeamTest, SingleRunsOnceAndOthersWait) {
  ThreadTeam team(GetParam());
  int runs = 0;
  std::vector<int> seen(team.size(), 0);
  team.run([&](int rank) {
    for (int round = 0; round < 100; ++round) {
      team.single(rank, [&] { ++runs; });
      seen[rank] += runs == round + 1;
      team.barrier();
    }
  });
  EXPECT_EQ(runs, 100);
  for (const int s : seen) EXPECT_EQ(s, 100);
}

TEST_P(ThreadTeamTest, WhatIsHandedOutIsVisitedOnceWhileTheFirstIsBusy) {
  ThreadTeam team(GetParam());
  for (const std::int64_t count : {0, 1, 255, 256, 5000}) {
    std::vector<int> visits(count, 0);
    int first = 0;
    constexpr int rounds = 20;
    team.run([&](int rank) {
      for (int round = 0; round < rounds; ++round) {
        team.on_rank_zero(rank, [&] { ++first; });
        team.for_each_range(count, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i < end; ++i) ++visits[i];
        });
        team.barrier();
      }
    });
    EXPECT_EQ(first, rounds);
    for (const int v : visits) ASSERT_EQ(v, rounds);
  }
}

TEST_P(ThreadTeamTest, ExceptionInSingleIsThrownAgain) {
  ThreadTeam team(GetParam());
  std::vector<int> behind(team.size(), 0);
  const auto faulty = [&](int rank) {
    team.single(rank, [] { throw std::runtime_error("no ice"); });
    behind[rank] = 1;
  };
  EXPECT_THROW(team.run(faulty), std::runtime_error);
  for (const int b : behind) EXPECT_EQ(b, 0) << "went on without what single() prepares";
  // the team can be used again
  int runs = 0;
  EXPECT_NO_THROW(team.run([&](int rank) { team.single(rank, [&] { ++runs; }); }));
  EXPECT_EQ(runs, 1);
}

/// Steps of several stages, as an engine runs them. Any stage of any step may throw on any thread, also the first one
/// while other threads are still waking.
TEST_P(ThreadTeamTest, AnExceptionInAnyStageEndsTheRun) {
  ThreadTeam team(GetParam());
  constexpr int steps = 3, stages = 4;
  for (int faulty = 0; faulty < team.size(); ++faulty) {
    for (int round = 0; round < 20 * steps * stages; ++round) {
      const int when = round % (steps * stages);
      const auto task = [&](int rank) {
        for (int at = 0; at < steps * stages; at += stages) {
          const auto may_throw = [&](int stage) {
            if (rank == faulty && at + stage == when) throw when;
          };
          team.single(rank, [&] { may_throw(0); });
          if (rank != 0) may_throw(0);
          team.for_each(rank, 7, [&](std::int64_t) { may_throw(1); });
          may_throw(1);
          team.on_rank_zero(rank, [&] { may_throw(2); });
          team.for_each_range(600, [&](std::int64_t, std::int64_t) { may_throw(2); });
          may_throw(2);
          team.barrier();
          may_throw(3);
        }
      };
      EXPECT_THROW(team.run(task), int) << "rank " << faulty << ", stage " << when;
    }
  }
}

TEST_P(ThreadTeamTest, AnExceptionOfAnyThreadReachesTheCaller) {
  ThreadTeam team(GetParam());
  for (int faulty = 0; faulty < team.size(); ++faulty) {
    std::vector<int> behind(team.size(), 0);
    const auto task = [&](int rank) {
      team.barrier();
      if (rank == faulty) throw std::runtime_error("no room for rank " + std::to_string(rank));
      team.barrier();
      behind[rank] = 1;
    };
    try {
      team.run(task);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "no room for rank " + std::to_string(faulty));
    }
    for (const int b : behind) EXPECT_EQ(b, 0) << "went on without the one that left";
    // the team can be used again
    std::vector<int> visits(1000, 0);
    team.run([&](int rank) { team.for_each(rank, 1000, [&](std::int64_t i) { ++visits[i]; }); });
    for (const int v : visits) ASSERT_EQ(v, 1);
  }
}

TEST_P(ThreadTeamTest, OfManyExceptionsOneReachesTheCaller) {
  ThreadTeam team(GetParam());
  for (int round = 0; round < 50; ++round) {
    EXPECT_THROW(team.run([&](int rank) { throw rank; }), int);
    EXPECT_THROW(team.run([&](int rank) {
      team.single(rank, [] { throw std::runtime_error("the cause"); });
      throw rank;  // a consequence
    }),
                 std::runtime_error);
  }
}

TEST_P(ThreadTeamTest, ManyShortRuns) {
  ThreadTeam team(GetParam());
  std::vector<int> calls(team.size(), 0);
  for (int i = 0; i < 300; ++i) team.run([&](int rank) { ++calls[rank]; });
  for (const int c : calls) EXPECT_EQ(c, 300);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ThreadTeamTest, testing::Values(1, 2, 3, 5, 8),
                         [](const auto& threads) { return std::to_string(threads.param) + "_threads"; });

/// Asks for more threads than the address space allows. Exits with 0 if the error is reported and no thread is left.
[[noreturn]] void start_too_many() {
  const rlimit limit{1UL << 30, 1UL << 30};  // 8 MB of stack per thread: some threads start
  setrlimit(RLIMIT_AS, &limit);
  try {
    ThreadTeam team(1000);
  } catch (const Error& error) {
    const bool told = std::string(error.what()).find("cannot start 1000 threads") == 0;
    std::_Exit(error.code() == ExitCode::resource_limit && told ? 0 : 1);
  }
  std::_Exit(2);
}

TEST(ThreadTeamDeathTest, TooManyThreadsAreAnError) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer needs the addresses that the test takes away";
#endif
  EXPECT_EXIT(start_too_many(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace gem
