// Gives the calling thread a second stack, by sigaltstack.
#include "gem/base/fault_stack.h"

#include <cstddef>
#include <new>

#include "gem/base/sanitizers.h"

namespace gem {
namespace {

/// Size of the stack on which a handler runs. Enough for the registers that the kernel saves (under 12 kB with the
/// widest vectors) and a handler that only writes.
constexpr std::size_t handler_stack_bytes = 65536;

}  // namespace

FaultStack::FaultStack() {
  if (is_sanitized) return;  // a sanitizer has a stack and handlers of its own
  // Without memory for it the thread runs all the same: a stack that is never used up needs no second one.
  memory_.reset(new (std::nothrow) char[handler_stack_bytes]);
  if (!memory_) return;
  stack_t stack{};
  stack.ss_sp = memory_.get();
  stack.ss_size = handler_stack_bytes;
  if (sigaltstack(&stack, &former_) != 0) memory_.reset();
}

FaultStack::~FaultStack() {
  if (memory_) sigaltstack(&former_, nullptr);
}

}  // namespace gem
