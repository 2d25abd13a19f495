// Many scenes that are moved on together, where an engine gains by that.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gem/engine/cuda_engine.h"
#include "gem/engine/engine.h"

namespace gem {

class EngineBatch {
 public:
  virtual ~EngineBatch() = default;
  virtual std::size_t size() const = 0;
  /// Moves scene k on by moments[k], which may be 0, and appends to logs[k]. Throws Error(numerical_stop) where a
  /// scene's state is no number; that scene stays short of its moments, the others are at the end of theirs.
  virtual void advance(const std::vector<std::int64_t>& moments, std::vector<MomentLog>& logs) = 0;
  /// One scene as it stands; its own advance() is not to be called.
  virtual Engine& engine(std::size_t scene) = 0;
};

/// Scenes on a GPU for "cuda", else one engine of that name for each, one after another. Throws like make_engine, and
/// Error(resource_limit) where the GPU's memory is too small for so many.
std::unique_ptr<EngineBatch> make_engine_batch(std::vector<BatchScene> scenes, const EngineOptions& options);

}  // namespace gem
