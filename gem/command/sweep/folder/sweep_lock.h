// Locks that keep the processes of a sweep apart.
#pragma once

#include <optional>
#include <string>

namespace gem {

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

}  // namespace gem
