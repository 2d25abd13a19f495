// The last words of a run whose process crashes.
#pragma once

#include <string>

#include "gem/base/fault_stack.h"

namespace gem {

/// While it lives, a crash of the process ends with a message that names the run file, and with exit code 7, and
/// writes nothing more: the HDF5 library does not bear a failed allocation. A stack that is used up is a crash too, in
/// this thread and in others that have a FaultStack. Not in builds with sanitizers, which say
/// more themselves. One at a time.
class CrashMessage {
 public:
  explicit CrashMessage(const std::string& run_file);
  ~CrashMessage();
  CrashMessage(const CrashMessage&) = delete;
  CrashMessage& operator=(const CrashMessage&) = delete;

 private:
  FaultStack stack_;
};

}  // namespace gem
