// Several scenes that advance together, on a GPU side by side.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "gem/engine/cuda/cuda_engine.h"
#include "gem/engine/engine.h"

namespace gem {

class EngineBatch {
 public:
  virtual ~EngineBatch() = default;
  virtual std::size_t size() const = 0;
  /// Advances scene k by at most ahead[k].most time steps and appends to logs[k]. It may do fewer steps where that
  /// keeps the GPU busier. Returns one exception per scene: null, or what ended it, e.g. Error(numerical_stop) if its
  /// state is not finite.
  virtual std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) = 0;
  /// One scene in its current state. Do not call its advance().
  virtual Engine& engine(std::size_t scene) = 0;
};

/// For "cuda": all scenes on one GPU. For other engines: one engine per scene, run one after another. Throws like
/// make_engine(), and Error(resource_limit) if the scenes do not fit in the memory of the GPU.
std::unique_ptr<EngineBatch> make_engine_batch(std::vector<BatchScene> scenes, const EngineOptions& options);

}  // namespace gem
