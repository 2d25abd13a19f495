// Many scenes over time together: the loop of run_scene for engines that gain by a batch.
#pragma once

#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/engine_batch.h"
#include "gem/run/run_scene.h"

namespace gem {

/// How one scene of a batch ended: its summary, or why it failed.
struct BatchEnd {
  RunSummary summary;
  std::string fault;  // empty: none
  ExitCode code = ExitCode::done;
};

/// Runs scenes to their ends, each into its own file with the same bits that it has alone. A
/// scene that fails stops no other. `options[k]` belongs to `scenes[k]` and to scene k of the batch. What the scenes
/// left is recorded by as many threads.
std::vector<BatchEnd> run_batch(const std::vector<SceneDef>& scenes, EngineBatch& batch,
                                const std::vector<RunOptions>& options, int recorders = 1);

}  // namespace gem
