// For tests: the number of threads that GEM_THREADS asks for.
#pragma once

#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

#include "gem/base/error.h"

namespace gem::test {

/// The number of threads that `text` names, `otherwise` if it is null. Throws Error(usage) for anything but a whole
/// number above 0.
inline int threads_in(const char* text, int otherwise) {
  if (text == nullptr) return otherwise;
  const std::string word = text;
  int threads = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), threads);
  if (fault != std::errc{} || end != word.data() + word.size() || threads < 1)
    throw Error(ExitCode::usage, "GEM_THREADS is no number of threads (value '" + word + "'); name a number above 0");
  return threads;
}

/// The number of threads that GEM_THREADS asks for, `otherwise` if it is not set.
inline int threads_asked(int otherwise) { return threads_in(std::getenv("GEM_THREADS"), otherwise); }

}  // namespace gem::test
