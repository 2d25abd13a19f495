#include "gem/base/fault_stack.h"

#include <cstddef>

#include "gem/base/sanitizers.h"

namespace gem {

/// Enough for the registers that the kernel saves (under 12 kB with the widest vectors) and a handler that only writes.
constexpr std::size_t bytes = 65536;

FaultStack::FaultStack() {
  if (is_sanitized) return;  // a sanitizer has a stack and handlers of its own
  memory_ = std::make_unique<char[]>(bytes);
  stack_t stack{};
  stack.ss_sp = memory_.get();
  stack.ss_size = bytes;
  if (sigaltstack(&stack, &former_) != 0) memory_.reset();
}

FaultStack::~FaultStack() {
  if (memory_) sigaltstack(&former_, nullptr);
}

}  // namespace gem
