// A signal handler that only writes and ends.
#include "gem/run/crash_message.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iterator>

#include "gem/base/error.h"
#include "gem/base/sanitizers.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

constexpr int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};

// what the handler uses is made before: it may not ask for memory
std::array<char, 4096> text;
std::size_t text_length = 0;
std::array<struct sigaction, std::size(crashes)> former;

volatile sig_atomic_t runs_on = 0;

void end_with_message(int) {
  if (write(STDERR_FILENO, text.data(), text_length) < 0) _exit(1);
  _exit(static_cast<int>(ExitCode::resource_limit));
}

/// The library calls exit(-1) from some of its failures.
void end_before_the_end() {
  if (runs_on != 0) end_with_message(0);
}

}  // namespace

CrashMessage::CrashMessage(const std::string& run_file) {
  const std::string file = shown(run_file).substr(0, 2000);
  const std::string message =
      "gem: error: the run crashed (an allocation that failed inside the HDF5 library does this; else it is a fault of "
      "gem); free memory, mend " +
      file + " with `gem repair`, or go on with `gem run --continue`; report it if it comes again\n";
  text_length = std::min(message.size(), text.size());
  std::copy_n(message.begin(), text_length, text.begin());
  if (is_sanitized) return;
  static const bool is_registered = std::atexit(end_before_the_end) == 0;
  runs_on = is_registered;
  struct sigaction action {};
  action.sa_handler = end_with_message;
  action.sa_flags = SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(crashes); ++i) sigaction(crashes[i], &action, &former[i]);
}

CrashMessage::~CrashMessage() {
  if (is_sanitized) return;
  runs_on = 0;
  for (std::size_t i = 0; i < std::size(crashes); ++i) sigaction(crashes[i], &former[i], nullptr);
}

}  // namespace gem
