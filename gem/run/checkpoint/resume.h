// Finds out whether a run can go on, and from where.
#pragma once

#include <memory>
#include <string>

#include "gem/run/checkpoint/checkpoint.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// A run that can go on: run_scene(scene, ENGINE, {.output = the run file, .from = from}).
struct Resumable {
  SceneDef scene;                          // as the run file holds it
  SceneDef engine_scene;                   // the same with listed floes: make the engine from it and from.engine.bodies
  std::shared_ptr<const Checkpoint> from;  // the newest that is whole and whose rows the run file holds
  std::string note;                        // what the user should know; may be empty
};

/// Throws Error(file_system) if the run file cannot be read, is complete, or has no checkpoint to go on from. Changes
/// nothing, but see finish_killed_end() for a complete one.
Resumable resumable(const std::string& run_file);

/// Does what is left of a complete run that was killed before it closed its file: closes it and removes the
/// checkpoints.
void finish_killed_end(const std::string& run_file);

/// The options that make a run go on.
void go_on(RunOptions& options, const Resumable& run);

}  // namespace gem
