// A time step that runs out of memory at any point, on any thread: the error reaches the caller and no thread hangs.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>

#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/test_scenes.h"

namespace {

constexpr std::int64_t none_fails = std::numeric_limits<std::int64_t>::max();
/// Allocations of the whole program until one fails.
std::atomic<std::int64_t> allocations_left{none_fails};
bool one_has_failed() { return allocations_left < 0; }

#ifdef __SANITIZE_ADDRESS__
constexpr bool can_fail = false;  // the sanitizer has a memory of its own
#else
constexpr bool can_fail = true;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (allocations_left.load(std::memory_order_relaxed) != none_fails && allocations_left.fetch_sub(1) == 0)
    throw std::bad_alloc();
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
#endif

}  // namespace

#ifndef __SANITIZE_ADDRESS__

// The memory of this test program. The other forms of new and delete call these. If they were inlined, the compiler
// would warn about free() of what new gave.
void* operator new(std::size_t bytes) { return allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
#endif

namespace gem {
namespace {

class FailedAllocation : public testing::TestWithParam<ContactSolver> {};

TEST_P(FailedAllocation, EndsTheCallCleanly) {
  if (!can_fail) GTEST_SKIP() << "an allocation cannot be made to fail under the address sanitizer";
  SceneDef scene = test::busy_scene(4);
  scene.contact.solver = GetParam();
  const Bodies bodies = test::busy_field(scene);
  constexpr std::int64_t steps = 3;
  const auto make = [&](int threads) {
    EngineOptions options{"cpu", threads};
    options.contacts_worth_a_thread = 1;
    return make_engine(scene, bodies, options);
  };
  const auto sound = make(1);
  const EngineState start = sound->save();
  StepLog sound_log;
  sound->advance(steps, sound_log);
  ASSERT_GT(test::contacts_in(sound_log), 0);
  for (const int threads : {1, 3}) {
    std::int64_t failed = 0;
    for (bool again = true; again; ++failed) {
      const auto engine = make(threads);
      StepLog log;
      bool thrown = false;
      allocations_left = failed;
      try {
        engine->advance(steps, log);
      } catch (const std::bad_alloc&) {
        thrown = true;
      }
      // A thread that starts does without the memory that it cannot get. So not every failure is thrown.
      again = one_has_failed();
      allocations_left = none_fails;
      // the engine can be used again
      if (thrown) {
        engine->restore(start);
        engine->advance(steps, log);
      }
      ASSERT_EQ(engine->state_hash(), sound->state_hash()) << "allocation " << failed << ", " << threads << " threads";
    }
    EXPECT_GT(failed, 20) << "few allocations were tried";
  }
}

// The threads start while the memory runs out: in the program that makes them, and in themselves.
TEST_P(FailedAllocation, WhileAnEngineIsMadeEndsCleanly) {
  if (!can_fail) GTEST_SKIP() << "an allocation cannot be made to fail under the address sanitizer";
  SceneDef scene = test::busy_scene(4);
  scene.contact.solver = GetParam();
  const Bodies bodies = test::busy_field(scene);
  std::int64_t failed = 0;
  for (bool again = true; again; ++failed) {
    allocations_left = failed;
    try {
      make_engine(scene, bodies, EngineOptions{"cpu", 4});
    } catch (const std::bad_alloc&) {
      EXPECT_TRUE(one_has_failed());
    }
    again = one_has_failed();
    allocations_left = none_fails;
  }
  EXPECT_GT(failed, 20) << "few allocations were tried";
}

INSTANTIATE_TEST_SUITE_P(Solvers, FailedAllocation, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

}  // namespace
}  // namespace gem
