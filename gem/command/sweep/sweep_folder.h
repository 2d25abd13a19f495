// The folder of a sweep: its run files, the manifest that lists them, and the locks that keep processes apart.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gem/scene/sweep/sweep.h"

namespace gem {

/// One run of a sweep as the manifest lists it.
struct SweepRow {
  std::int64_t index = 0;  // from 1, in the order of the sweep file
  std::string name;
  std::string case_sha256;
  std::string status = "missing";  // done | running | stopped | failed | other | missing
  std::string state_hash;
  std::string engine;
  double duration_s = 0.0;   // requested
  double time_s = 0.0;       // simulated
  double wall_time_s = 0.0;  // wall time of the run
  std::string error;         // why it is not done; empty if unknown
  std::string verdict;       // good | doubtful | bad | not judged; empty: no file
  SweepDraw draw = {};       // what was drawn for it
  std::string doubts = {};   // the criteria that gave a doubtful or bad verdict: "overlap, unfinished_steps"
};

/// A lock that ends with the object, or with the process. It is a lock of the operating system on one byte of
/// FOLDER/.lock. It needs no clean-up and works on network file systems.
class SweepLock {
 public:
  /// Locks a run; empty if another process holds the lock. Throws Error(file_system) if the file system has no locks.
  static std::optional<SweepLock> try_run(const std::string& folder, const std::string& run_name);
  /// Whether a process holds the run's lock now.
  static bool is_held(const std::string& folder, const std::string& run_name);
  /// Locks the folder for one sweep, shared with other sweeps unless `alone`. Empty if `alone` and another sweep runs
  /// there.
  static std::optional<SweepLock> try_folder(const std::string& folder, bool alone);
  /// Locks the manifest; waits until it is free.
  static SweepLock wait_manifest(const std::string& folder);
  ~SweepLock();
  SweepLock(SweepLock&& other) noexcept;
  SweepLock& operator=(SweepLock&& other) noexcept;

 private:
  explicit SweepLock(int file) : file_(file) {}
  int file_;
};

std::string run_path(const std::string& folder, const std::string& run_name);

/// Rows of FOLDER/manifest.json by index; empty without a manifest. Throws Error(file_system) if it is damaged.
std::vector<SweepRow> read_manifest(const std::string& folder);

/// Replaces the rows of the manifest that have these names. Any number of processes may call this: it takes the
/// manifest's lock and writes atomically. Throws Error(file_system).
void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

/// Called when a sweep starts. Adds the rows; an existing row of the same name and case is kept. Returns the sweep's
/// lock on the folder, to be held while the sweep runs. Throws Error(file_system) if another sweep running there has
/// other cases under these names.
SweepLock enter_folder(const std::string& folder, const std::vector<SweepRow>& rows);

/// The rows as JSON objects in a list.
std::string rows_json(const std::vector<SweepRow>& rows);

/// The state of a run now. The lock tells whether it is running; otherwise the run file decides, whatever the manifest
/// says. Only a failure without a file is taken from `row`. `engine` is the requested engine (empty: any); a run made
/// by an engine with other physics counts as another run.
SweepRow look_at_run(const std::string& folder, SweepRow row, const std::string& engine = "");

/// The state of a run from its file alone, for the process that holds its lock.
SweepRow look_at_file(const std::string& folder, SweepRow row, const std::string& engine);

}  // namespace gem
