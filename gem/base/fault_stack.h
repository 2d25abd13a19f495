// Room for a signal handler where a thread has no stack left.
#pragma once

#include <signal.h>

#include <memory>

namespace gem {

/// While it lives, handlers with SA_ONSTACK that the calling thread enters have a stack of their own. Without it a
/// thread that has used up its stack is killed without a word. Each thread needs its own, made and destroyed by itself.
class FaultStack {
 public:
  FaultStack();
  ~FaultStack();
  FaultStack(const FaultStack&) = delete;
  FaultStack& operator=(const FaultStack&) = delete;

 private:
  std::unique_ptr<char[]> memory_;
  stack_t former_{};
};

}  // namespace gem
