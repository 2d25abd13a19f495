// The CUDA engine and its batches: scenes that stay on a GPU for many time steps; the same bits as the cpu engine.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// A GPU of this machine.
struct CudaDevice {
  int index = 0;
  std::string name;
  std::string driver;                       // version
  std::size_t memory = 0, free_memory = 0;  // [bytes]
  int multiprocessors = 0;
  std::string fault;  // why it cannot be used; empty: it can
};

/// All GPUs; where there is none, `reason` says why.
std::vector<CudaDevice> cuda_devices(std::string& reason);

/// Time steps that a scene makes in one launch, at most.
constexpr int most_launch_steps = 512;

/// What a launch does. time steps: many time steps of all scenes, by blocks that stay with them; for few scenes.
/// phases: one phase of a time step of all scenes; for scenes that are many, and for independent ones of many bodies.
/// chosen: what is faster. Batches with a coupled scene of more bodies than a cluster has threads, and those for which
/// a number of blocks is given, are moved by time steps in any case.
enum class Launches { chosen, steps, phases };

/// How the scenes of a batch are laid out on the GPU. No choice changes a result.
struct CudaOptions {
  int device = -1;                     // -1: the first that can be used
  int blocks = 0;                      // that stay with each scene, at most: all run at a time; 0: as help most
  int threads = 0;                     // of a block: 32 to 256, a multiple of 32; 0: chosen
  int ring_steps = most_launch_steps;  // of one launch, at most
  int list_rows = 0;                   // places of the list of near bodies to begin with; it grows on demand; 0: chosen
  bool samples = true;                 // keep what the platform felt
  Launches launches = Launches::chosen;
};

/// A scene of a batch.
struct BatchScene {
  SceneDef scene;
  Bodies bodies;
};

/// What a scene of a batch still has to do.
struct StepsAhead {
  std::int64_t most = 0;  // in the next call; 0: the scene stays as it is
  std::int64_t all = 0;   // to its end: scenes that have much ahead get more of the GPU
};

/// Many scenes on one GPU, moved on together; no other batch of the process moves scenes on the same GPU meanwhile.
/// Each has the bits that it has alone. Throws Error(device) where no GPU answers or a call
/// fails, Error(resource_limit) where its memory is too small.
class CudaBatch {
 public:
  CudaBatch(std::vector<BatchScene> scenes, const CudaOptions& options);
  ~CudaBatch();
  CudaBatch(const CudaBatch&) = delete;
  CudaBatch& operator=(const CudaBatch&) = delete;

  std::size_t size() const;
  /// Moves scene k on by time steps[k] and appends to logs[k]; a null `logs` keeps nothing. Throws
  /// Error(numerical_stop) where a scene's state is no number; the others are then at the end of their time steps.
  void advance(const std::vector<std::int64_t>& steps, std::vector<StepLog>* logs);
  /// Moves all scenes on by `steps`.
  void advance(std::int64_t steps, std::vector<StepLog>* logs);
  /// Moves scene k on by no more than ahead[k].most, one that has more ahead by more, so that the GPU is busy to the
  /// end of all, and appends to logs[k]. Returns what stopped each scene, null for most: Error(numerical_stop) where
  /// its state is no number.
  std::vector<std::exception_ptr> advance_some(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs);
  std::int64_t step(std::size_t scene) const;
  const Bodies& bodies(std::size_t scene);
  Ledger ledger(std::size_t scene);
  EngineState save(std::size_t scene);
  void restore(std::size_t scene, const EngineState& state);
  std::uint64_t state_hash(std::size_t scene);
  /// What the scenes run on: device name and driver.
  const CudaDevice& device() const;
  /// Blocks of the first scene in the last launch; others may have had another number.
  int blocks() const;
  int threads() const;
  /// What the launches of the last call did by which most of its time steps were made: time steps or phases.
  Launches launches() const;
  /// Time that the GPU spent in the kernels of the last advance [s].
  double device_time() const;
  /// Barriers between blocks that the first scene passed in one time step, mean since construction. What one block
  /// waits for by itself is not counted.
  double barriers() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// The engine of one scene.
std::unique_ptr<Engine> make_cuda_engine(const SceneDef& scene, Bodies bodies, const CudaOptions& options = {});

/// The first GPU that can be used. Throws Error(device) with the reason where there is none.
CudaDevice usable_cuda_device();

}  // namespace gem
