// What stands under each path of the server: the page and the packets that it asks for.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "gem/record/run_file/run_file.h"
#include "gem/view/pack/pack_run.h"
#include "gem/view/server/live_control.h"

namespace gem::view {

struct Reply {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Paths: "" the page, "description", "shapes", "frames?first=N", "contacts?first=N", "rows?group=G&first=N"; of a live
/// run also "state", "wait" (the state, after a second or at the end of the run), and by POST "pause", "go_on", "stop",
/// "has_all", "leave". Anything else does not exist.
class Site {
 public:
  /// `control` is null for a file that nobody writes. With `control`, what stands in the place of the file now is of an
  /// earlier run: it is never opened, so that the run can take its place.
  Site(std::string run_file, bool allow_incomplete, LiveControl* control);

  /// `query`: by name. Status 503: the run has no file yet. May be called by several threads.
  Reply answer(const std::string& method, const std::string& place, const std::map<std::string, std::string>& query);

 private:
  /// Device and index of a file in its file system; 0, 0: there is none.
  using FileIdentity = std::pair<std::uint64_t, std::uint64_t>;

  static FileIdentity identity_of(const std::string& path);
  bool has_own_file() const;
  Reply wait() const;
  Reply read(const std::string& place, const std::map<std::string, std::string>& query);
  Reply state() const;
  bool command(const std::string& name);
  const RunFile& file();

  std::string path_;
  bool allow_incomplete_;
  LiveControl* control_;
  FileIdentity former_;  // what stood in the place of the file before the run
  std::mutex mutex_;     // the HDF5 library serves one thread at a time
  std::optional<RunFile> file_;
  std::chrono::steady_clock::time_point opened_;
  bool opened_running_ = false;
};

}  // namespace gem::view
