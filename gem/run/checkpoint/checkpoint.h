// All that a run needs to go on to the same bits as if it had never stopped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/record/recorder.h"
#include "gem/run/run_scene.h"
#include "gem/run/run_watch.h"

namespace gem {

/// The state of a run between two time steps. Its run file holds all rows up to then, but for those in
/// `position.waiting`.
struct Checkpoint {
  std::uint64_t serial = 0;  // counts the checkpoints of a run
  std::string build;         // of the program that wrote it, see build_text()
  std::string case_sha256;   // attribute gem_case_sha256 of the run file
  std::string engine_name;
  EngineState engine;
  std::vector<FloeDef> floes;  // listed floes that the engine was made with, where the case names a run file for them
  RecorderState recorder;
  RunWatch::State watch;
  RunTotals totals;
  FilePosition position;
};

/// The checkpoint as bytes, with its version, and a checksum for each part.
std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint);

/// Throws ByteFault if the bytes are damaged, of another version, or do not fit together.
Checkpoint checkpoint_of(const std::vector<std::byte>& bytes);

}  // namespace gem
