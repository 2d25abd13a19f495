// Forks the server, and waits in the run for the page.
#include "gem/command/run/live_view.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <thread>

#include "gem/base/error.h"
#include "gem/run/run_signals.h"
#include "gem/view/server/gate.h"
#include "gem/view/server/view_server.h"

namespace gem {

namespace {

using namespace std::chrono_literals;

constexpr double flush_interval_s = 1.0;  // how far the page may lag behind
// A page asks every second; in a hidden tab some browsers let it do so only once a minute.
constexpr auto page_is_gone_after = 75s;
// A page that was closed, or that has all, asks no more: another page may still be reading.
constexpr auto last_page_is_gone_after = 2s;
constexpr auto said_after = 5s;
constexpr auto server_begins_within = 10s;

}  // namespace

LiveView::LiveView(const std::string& run_file, bool open_browser, RunLog& log) {
  void* const memory =
      mmap(nullptr, sizeof(view::LiveControl), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  control_ = new (memory) view::LiveControl;
  const std::string token = view::new_token();
  server_ = fork();
  if (server_ == 0) serve(run_file, token);
  const auto start = std::chrono::steady_clock::now();
  while (server_ > 0 && control_->port == 0 && std::chrono::steady_clock::now() - start < server_begins_within)
    std::this_thread::sleep_for(5ms);
  if (control_->port <= 0) {
    stop_server();
    throw Error(ExitCode::device,
                "the page of the run cannot be served (no server began, or the program was built "
                "without libcpp-httplib-dev); leave out --view");
  }
  const std::string address = view::Gate(token, control_->port).address();
  log.message("info", "the run is shown at " + address);
  if (open_browser) browser_ = std::make_unique<view::OpenedBrowser>(address);
}

void LiveView::serve(const std::string& run_file, const std::string& token) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // Ctrl-C in a terminal reaches both processes: the run decides when the page ends
  signal(SIGINT, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  try {
    view::Site site(run_file, true, control_);
    const view::ViewServer server(site, token);
    control_->port = server.port();
    for (;;) pause();
  } catch (const std::exception&) {
    control_->port = -1;
  }
  _exit(1);
}

void LiveView::join(RunOptions& options, double duration_s) {
  control_->duration_s = duration_s;
  options.stop = &stop_signal_;
  options.flush_interval_s = std::min(options.flush_interval_s, flush_interval_s);
  options.on_block = [this, &options](double time) {
    control_->time_s = time;
    while (control_->paused && !control_->stop && stop_signal_of(options) == 0) std::this_thread::sleep_for(20ms);
    if (control_->stop) stop_signal_ = SIGINT;
  };
}

void LiveView::end(RunLog& log) {
  control_->running = false;
  const StopSignals signals;
  long requests = control_->requests;
  auto asked = std::chrono::steady_clock::now();
  bool said = false;
  while (requests > 0 && StopSignals::received() == 0) {
    std::this_thread::sleep_for(50ms);
    const auto now = std::chrono::steady_clock::now();
    if (control_->requests != requests) asked = now;
    requests = control_->requests;
    const bool done = control_->has_all || control_->gone;
    if (now - asked > (done ? last_page_is_gone_after : page_is_gone_after)) break;
    if (said || done || now - asked < said_after) continue;
    log.message("info", "the page has not read the end of the run: waiting for it for a minute (Ctrl-C ends that)");
    said = true;
  }
}

LiveView::~LiveView() { stop_server(); }

void LiveView::stop_server() {
  if (server_ > 0) {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  munmap(control_, sizeof(view::LiveControl));
}

}  // namespace gem
