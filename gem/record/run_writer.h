// Writes one run file on its own thread; the simulation waits only when the queue of slabs is full.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gem/record/schema.h"

namespace gem {

/// What happened since the last slab.
struct Slab {
  std::vector<PlatformRow> platform;
  std::vector<ContactEvent> events;
  std::vector<StatsRow> stats;
  FloeFrames floes;
  double time = 0.0;  // up to where this slab tells the story [s]
  bool empty() const { return platform.empty() && events.empty() && stats.empty() && floes.time.empty(); }
};

/// Who wrote the file and from what.
struct Provenance {
  std::string title;
  std::string case_toml;
  std::string case_sha256;
  std::string command_line;
  std::string engine;
  std::string solver;
  int threads = 0;
  std::string arithmetic = "strict";  // no contraction, ordered sums: the same bits on every engine
  std::string device = "";            // that the engine ran on besides the processor; empty: none
};

/// A run file. The file exists from construction on; it is removed again if nothing was written when this is destroyed.
class RunWriter {
 public:
  /// Throws Error(file_system) if the file exists (and not overwrite), another process writes it, or its folder takes
  /// no files. `scene` and `bodies` are copied: what the file says of them is written meanwhile.
  RunWriter(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
            const Provenance& provenance);
  ~RunWriter();
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;

  /// Hands over a slab. Throws Error(file_system), or Error(resource_limit) where memory was too small, if an earlier
  /// one could not be written.
  void write(Slab slab);
  /// Throws the writer's Error, if any; cheap.
  void check() const;
  /// Waits for the queue, sets the status ("complete" or "stopped:<reason>") and the state hash, and closes.
  /// After a failed write the status is set as well as the file allows, and the failure is thrown.
  void finish(const std::string& status, std::uint64_t state_hash);

 private:
  class Thread;
  std::unique_ptr<Thread> thread_;
};

/// Identity of this build: version, commit, build type and compiler.
std::string build_text();

/// A state hash as it stands in files and summaries: 16 hex digits.
std::string hash_text(std::uint64_t hash);

}  // namespace gem
