// Threads that help with a large island.
#include "gem/engine/solver/splitting/island_crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gem {
namespace {

/// Helpers that serve a crew until its leader releases them.
class Helpers {
 public:
  Helpers(IslandCrew& crew, int helpers) : crew_(crew) {
    for (int k = 0; k < helpers; ++k) thread_.emplace_back([this] { crew_.serve(); });
  }
  ~Helpers() {
    crew_.release();
    for (std::thread& thread : thread_) thread.join();
  }
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

 private:
  IslandCrew& crew_;
  std::vector<std::thread> thread_;
};

void expect_each_part_once(IslandCrew& crew, int calls) {
  for (int call = 0; call < calls; ++call) {
    std::vector<int> times(crew.parts(), 0);
    crew.share([&](int part) { ++times[part]; });
    EXPECT_EQ(times, std::vector<int>(crew.parts(), 1)) << "call " << call;
  }
}

TEST(IslandCrew, DoesEachPartOnce) {
  IslandCrew crew;
  crew.begin(4);
  const Helpers helpers(crew, 3);
  expect_each_part_once(crew, 2000);
}

TEST(IslandCrew, WaitsForNoHelper) {
  IslandCrew crew;
  crew.begin(3);
  expect_each_part_once(crew, 10);
}

TEST(IslandCrew, RethrowsWhatAPartThrowsAndGoesOn) {
  IslandCrew crew;
  crew.begin(2);
  const Helpers helpers(crew, 1);
  for (const int bad : {0, 1}) {
    std::atomic<int> done{0};
    EXPECT_THROW(crew.share([&](int part) {
      ++done;
      if (part == bad) throw std::runtime_error("part");
    }),
                 std::runtime_error);
    EXPECT_EQ(done.load(), 2) << "the other part is done too";
  }
  expect_each_part_once(crew, 10);
}

}  // namespace
}  // namespace gem
