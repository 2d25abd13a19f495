// The page of a run that goes on: a process of its own serves it, so that nothing in it can touch the run.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "gem/run/run_log.h"
#include "gem/run/run_scene.h"
#include "gem/view/server/live_control.h"
#include "gem/view/server/open_browser.h"

namespace gem {

class LiveView {
 public:
  /// Starts the server for `run_file`, says its address in the log, and opens a browser if asked. Call it before the
  /// process has threads or open run files. Throws Error(device) if the server does not begin.
  LiveView(const std::string& run_file, bool open_browser, RunLog& log);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// Lets the page pause and stop the run. A pause only waits between two blocks of time steps.
  void join(RunOptions& options, double duration_s);
  /// Tells the page that the run is over, and waits until the page has read all of it; at most until nobody asks any
  /// more, or a signal comes.
  void end();

 private:
  void stop_server();
  void serve(const std::string& run_file, const std::string& token);

  view::LiveControl* control_;  // in memory shared with the server
  pid_t server_ = -1;
  std::atomic<int> stop_signal_ = 0;
  std::unique_ptr<view::OpenedBrowser> browser_;
};

}  // namespace gem
