// What stands under each path of the server: the page and the packets that it asks for.
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "gem/record/run_file/run_file.h"
#include "gem/view/pack/pack_run.h"
#include "gem/view/server/live_control.h"

namespace gem::view {

struct Reply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Paths: "" the page, "description", "shapes", "frames?first=N", "rows?group=G&first=N"; of a live run also "state",
/// and by POST "pause", "go_on", "stop", "has_all". Anything else does not exist.
class Site {
 public:
  /// `control` is null for a file that nobody writes.
  Site(std::string run_file, bool allow_incomplete, LiveControl* control)
      : path_(std::move(run_file)), allow_incomplete_(allow_incomplete), control_(control) {}

  /// `query`: by name. Status 503: the run has no file yet. May be called by several threads.
  Reply answer(const std::string& method, const std::string& place, const std::map<std::string, std::string>& query);

 private:
  Reply read(const std::string& place, const std::map<std::string, std::string>& query);
  Reply state() const;
  bool command(const std::string& name);
  const RunFile& file();

  std::string path_;
  bool allow_incomplete_;
  LiveControl* control_;
  std::mutex mutex_;  // the HDF5 library serves one thread at a time
  std::optional<RunFile> file_;
  std::chrono::steady_clock::time_point opened_;
};

}  // namespace gem::view
