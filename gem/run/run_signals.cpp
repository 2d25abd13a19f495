// Signal handlers that only set a flag.
#include "gem/run/run_signals.h"

#include <signal.h>
#include <unistd.h>

namespace gem {

namespace {

volatile sig_atomic_t received_signal = 0;
struct sigaction former_interrupt;
struct sigaction former_terminate;
struct sigaction former_hangup;

void note_signal(int signal_number) {
  if (received_signal != 0) _exit(128 + signal_number);
  received_signal = signal_number;
}

}  // namespace

StopSignals::StopSignals() {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &former_interrupt);
  sigaction(SIGTERM, &action, &former_terminate);
  sigaction(SIGHUP, &action, &former_hangup);
  if (former_hangup.sa_handler == SIG_IGN) sigaction(SIGHUP, &former_hangup, nullptr);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &former_interrupt, nullptr);
  sigaction(SIGTERM, &former_terminate, nullptr);
  sigaction(SIGHUP, &former_hangup, nullptr);
}

int StopSignals::received() { return received_signal; }

int exit_code_of_signal(int signal_number) { return signal_number == 0 ? 0 : 128 + signal_number; }

void ignore_write_signals() {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

}  // namespace gem
