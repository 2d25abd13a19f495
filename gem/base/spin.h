// A wait for another thread that spins for a short time and then yields the processor, so that other programs on the
// machine are not slowed down.
#pragma once

#include <thread>

namespace gem {

class Spin {
 public:
  void wait() {
    if (turns_++ < most_turns) {
#ifdef __x86_64__
      __builtin_ia32_pause();
#endif
    } else {
      std::this_thread::yield();
    }
  }

 private:
  /// About 20 microseconds. Chosen by hand; affects only speed.
  static constexpr int most_turns = 2000;

  int turns_ = 0;
};

}  // namespace gem
