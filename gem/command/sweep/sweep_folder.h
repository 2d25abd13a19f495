// The folder of a sweep: its run files, the manifest that lists them, and the locks that keep processes apart.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gem {

/// One run of a sweep as the manifest lists it.
struct SweepRow {
  std::int64_t index = 0;  // from 1, in the order of the sweep file
  std::string name;
  std::string case_sha256;
  std::string status = "missing";  // done | running | stopped | failed | other | missing
  std::string state_hash;
  std::string engine;
  double duration_s = 0.0;   // asked for
  double time_s = 0.0;       // simulated
  double wall_time_s = 0.0;  // that it took
  std::string error;         // why it is not done; empty: nothing is known
};

/// A lock that ends with the object, and with the process however that ends. It is a lock of the operating system on
/// one byte of FOLDER/.lock, so nothing is left behind to be cleaned up, also on a network file system.
class SweepLock {
 public:
  /// Nothing if another process holds it. Throws Error(file_system) if the file system has no locks.
  static std::optional<SweepLock> try_run(const std::string& folder, const std::string& run_name);
  /// Whether a process holds it now.
  static bool is_held(const std::string& folder, const std::string& run_name);
  /// The share of a sweep in its folder, for as long as it runs; nothing if `alone` and other sweeps run there.
  static std::optional<SweepLock> try_folder(const std::string& folder, bool alone);
  /// The manifest's lock, waited for.
  static SweepLock wait_manifest(const std::string& folder);
  ~SweepLock();
  SweepLock(SweepLock&& other) noexcept;
  SweepLock& operator=(SweepLock&& other) noexcept;

 private:
  explicit SweepLock(int file) : file_(file) {}
  int file_;
};

std::string run_path(const std::string& folder, const std::string& run_name);

/// Rows of FOLDER/manifest.json by index; none if there is no manifest. Throws Error(file_system) if it is damaged.
std::vector<SweepRow> read_manifest(const std::string& folder);

/// Puts these rows into the manifest in place of those with the same names; under its lock, and written at one stroke,
/// so that any number of processes may do it. Throws Error(file_system).
void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

/// The same at a sweep's start, but a row that the manifest has of the same name and case stays as it is. Returns the
/// sweep's share in the folder, to be kept while it runs. Throws Error(file_system) if another sweep that runs there
/// has other cases under these names.
SweepLock enter_folder(const std::string& folder, const std::vector<SweepRow>& rows);

/// The rows as JSON objects in a list.
std::string rows_json(const std::vector<SweepRow>& rows);

/// What is known of a run now: the lock tells whether it is running, else the run file is the truth, whatever the
/// manifest says. A failure without a file is taken from `row`. `engine`: what is asked for; a run of another program's
/// physics is another run. Empty: any.
SweepRow look_at_run(const std::string& folder, SweepRow row, const std::string& engine = "");

/// The same for the holder of the run's lock.
SweepRow look_at_file(const std::string& folder, SweepRow row, const std::string& engine);

}  // namespace gem
