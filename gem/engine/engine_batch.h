// Many scenes that are moved on together, where an engine gains by that.
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
  /// Moves scene k on by no more than ahead[k].most, by fewer where that keeps the engine busier, and appends to
  /// logs[k]. Returns what stopped each scene, null for most: Error(numerical_stop) where its state is no number.
  virtual std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) = 0;
  /// One scene as it stands; its own advance() is not to be called.
  virtual Engine& engine(std::size_t scene) = 0;
};

/// Scenes on a GPU for "cuda", else one engine of that name for each, one after another. Throws like make_engine, and
/// Error(resource_limit) where the GPU's memory is too small for so many.
std::unique_ptr<EngineBatch> make_engine_batch(std::vector<BatchScene> scenes, const EngineOptions& options);

}  // namespace gem
