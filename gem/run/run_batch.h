// The time loop for many scenes together, for engines that are faster with a batch.
#pragma once

#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/engine_batch.h"
#include "gem/run/run_scene.h"

namespace gem {

/// The end of one scene of a batch: its summary, or the reason of its failure.
struct BatchEnd {
  RunSummary summary;
  std::string fault;  // empty: none
  ExitCode code = ExitCode::done;
};

/// Runs scenes to their ends, each into its own file, with the same bits as a run of its own. A scene that fails does
/// not stop the others. `options[k]` belongs to `scenes[k]` and to scene k of the batch. The results are recorded by as
/// many threads as the options ask for.
std::vector<BatchEnd> run_batch(const std::vector<SceneDef>& scenes, EngineBatch& batch,
                                const std::vector<RunOptions>& options, int recorders = 1);

}  // namespace gem
