// Writes one run file on a thread of its own. The simulation waits only when the queue of slabs is full.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gem/record/piece_shapes.h"
#include "gem/record/schema.h"
#include "gem/record/verdict.h"

namespace gem {

/// The recorded rows since the last slab.
struct Slab {
  std::vector<PlatformRow> platform;
  std::vector<Hit> events;
  std::vector<StatsRow> stats;
  std::vector<ContactRow> contacts;
  std::vector<SplitEvent> splits;
  PieceShapes pieces;                                 // made since the last slab
  std::vector<float> side_normal, side_friction;      // a row for each of `platform`; empty unless they are recorded
  std::vector<double> line_tension, line_break_time;  // likewise, with a value for each mooring line
  std::vector<double> thruster_x, thruster_y, thruster_limit;          // likewise, with a value for each thruster
  std::vector<double> dp_demand_surge, dp_demand_sway, dp_demand_yaw;  // likewise, with one value
  std::vector<double> dp_offset_surge, dp_offset_sway, dp_offset_yaw;
  FloeFrames floes;
  double time = 0.0;  // end of the recorded time [s]
  bool empty() const {
    return platform.empty() && events.empty() && stats.empty() && floes.time.empty() && splits.empty();
  }
};

/// How far a run file is written: its rows in whole chunks, and those behind them.
struct FilePosition {
  std::uint64_t platform = 0, events = 0, stats = 0, frames = 0, contacts = 0, splits = 0;
  double last_time = 0.0;  // of the last of these floe frames [s]
  Slab waiting;
};

/// Origin of the file: program, command and engine.
struct Provenance {
  std::string title;
  std::string case_toml;
  std::string case_sha256;
  std::string command_line;
  std::string engine;
  std::string solver;
  int threads = 0;
  std::string arithmetic = "strict";  // strict: no contraction, ordered sums, the same bits on every engine
  std::string device = "";            // accelerator of the engine; empty: none
};

struct RowCount;

/// A run file. It gets its name with the first flush. The destructor removes it if nothing was written.
class RunWriter {
 public:
  /// Throws Error(file_system) if the file exists (and not overwrite), another process writes it, or its folder does
  /// not accept files. Copies `scene` and `bodies`, which the thread writes later.
  RunWriter(const std::string& path, bool overwrite, const SceneDef& scene, const Bodies& bodies,
            const Provenance& provenance);
  /// Goes on with the run file at `path` from `from`: rows behind it are cut off. The history gains a line. It works on
  /// a copy, which takes the file's place with the first flush. Throws like the other constructor; a file that lacks
  /// rows of `from`, and any other failure, comes with the first write.
  RunWriter(const std::string& path, FilePosition from, const SceneDef& scene, const Bodies& bodies,
            const Provenance& provenance);
  ~RunWriter();
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;

  /// Queues a slab. With `flush` readers see all rows so far when it is written; without, only some of them. If an
  /// earlier slab could not be written, throws Error(file_system), or Error(resource_limit) if memory was too small.
  void write(Slab slab, bool flush = false);
  /// Queues a slab. When it is on the disk and readers see all rows so far, calls `then` on the writer's thread with
  /// the rows that are written for good, and those that readers see but that wait for their chunk to fill. After a
  /// failure `then` is not called. It must not throw, and what it uses must outlive this object. Throws like the other
  /// one.
  void write(Slab slab, std::function<void(FilePosition)> then);
  /// Whether the next write() would not wait.
  bool has_room() const;
  /// Waits until all rows so far are on the disk and readers see them. Returns how many there are. Throws like write().
  RowCount flush();
  /// Throws the Error of the writer thread, if there is one. Cheap.
  void check() const;
  /// Waits for the queue, sets the status ("complete" or "stopped:<reason>"), the state hash and the verdict (none if
  /// it has no judgements), and closes the file. After a failed write it sets them if the file allows it, and throws
  /// the failure.
  void finish(const std::string& status, std::uint64_t state_hash, const RunVerdict& verdict = {});

 private:
  class Thread;
  std::unique_ptr<Thread> thread_;
};

/// Version, commit, build type and compiler of this build.
std::string build_text();

/// A state hash as in files and summaries: 16 hex digits.
std::string hash_text(std::uint64_t hash);

}  // namespace gem
