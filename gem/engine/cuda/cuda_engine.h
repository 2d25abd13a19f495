// The CUDA engine and its batches: scenes that stay on a GPU for many time steps, with the bits of the cpu engine.
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
  std::string fault;  // why it cannot be used; empty: it can be
};

/// All GPUs of this machine. If there is none, `reason` says why.
std::vector<CudaDevice> cuda_devices(std::string& reason);

/// Most time steps of a scene in one launch.
constexpr int most_launch_steps = 512;

/// How scenes are advanced on the GPU.
///   resident   one launch makes many time steps; its blocks stay with their scenes. For few scenes
///   phases     one launch makes one stage of one time step of all scenes. For many scenes, and for large independent
///              ones
///   automatic  the faster of the two
/// Scenes with the iteration "splitting" always take phases. Of the others the resident route is always used for a
/// batch that has a coupled scene of more bodies than a cluster has threads, or if CudaOptions::blocks is given.
enum class Route { automatic, resident, phases };

/// How the scenes of a batch are placed on the GPU. No option changes a result.
struct CudaOptions {
  int device = -1;  // index of the GPU; -1: the first that can be used
  int blocks = 0;   // most blocks that stay with a scene, all on the device at a time; 0: as many as help
  int threads = 0;  // threads of a block: 32 to 256, a multiple of 32; 0: chosen
  int ring_steps = most_launch_steps;  // most time steps of one launch
  int list_rows = 0;                   // entries of the list of near bodies at first; it grows on demand; 0: chosen
  bool samples = true;                 // record platform, quality and overlaps; else a log gets events only
  Route route = Route::automatic;
};

/// A scene of a batch.
struct BatchScene {
  SceneDef scene;
  Bodies bodies;
};

/// Time steps that a scene of a batch still has to make.
struct StepsAhead {
  std::int64_t most = 0;  // most in the next call; 0: the scene stays as it is
  std::int64_t all = 0;   // to the end of its run; scenes with more ahead get more of the GPU
};

/// Many scenes on one GPU, moved on together. Each gets the same bits as alone. No other batch of the process may move
/// scenes on the same GPU at the same time. Throws Error(device) if no GPU answers or a call fails,
/// Error(resource_limit) if its memory is too small, and Error(usage) if a run has more than device_steps_maximum time
/// steps.
class CudaBatch {
 public:
  CudaBatch(std::vector<BatchScene> scenes, const CudaOptions& options);
  ~CudaBatch();
  CudaBatch(const CudaBatch&) = delete;
  CudaBatch& operator=(const CudaBatch&) = delete;

  std::size_t size() const;
  /// Moves scene k on by steps[k] time steps and appends to logs[k]; a null `logs` records nothing. Throws
  /// Error(numerical_stop) if the state of a scene is not finite; the other scenes have then made all their time steps.
  void advance(const std::vector<std::int64_t>& steps, std::vector<StepLog>* logs);
  /// Moves all scenes on by `steps` time steps.
  void advance(std::int64_t steps, std::vector<StepLog>* logs);
  /// Moves scene k on by at most ahead[k].most time steps and appends to logs[k]. Scenes with more ahead advance more,
  /// so that the GPU stays busy until all end. Returns for each scene what stopped it, mostly null:
  /// Error(numerical_stop) if its state is not finite, Error(usage) if it would pass device_steps_maximum.
  std::vector<std::exception_ptr> advance_some(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs);
  std::int64_t step(std::size_t scene) const;
  const Bodies& bodies(std::size_t scene);
  Ledger ledger(std::size_t scene);
  EngineState save(std::size_t scene);
  void restore(std::size_t scene, const EngineState& state);
  std::uint64_t state_hash(std::size_t scene);
  double asked_residual(std::size_t scene) const;
  LineSet broken_lines(std::size_t scene) const;
  const DpState* dp_state(std::size_t scene) const;
  /// As those of Engine; known if the case asks for them, or its floes may split. A batch splits no floes by itself.
  bool has_contact_forces(std::size_t scene) const;
  std::vector<ContactForce> contact_forces(std::size_t scene) const;
  /// The GPU that the scenes run on.
  const CudaDevice& device() const;
  /// Blocks of the first scene in the last launch; other scenes may have another number.
  int blocks() const;
  /// Threads of a block in the last launch.
  int threads() const;
  /// The route of most time steps of the last call: resident or phases.
  Route route() const;
  /// Time that the GPU spent in kernels in the last advance [s].
  double device_time() const;
  /// Grid barriers that the first scene passed in a time step, mean since construction. Barriers within a block are not
  /// counted.
  double barriers() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// Makes the engine of one scene: a batch of one. Throws as CudaBatch does.
std::unique_ptr<Engine> make_cuda_engine(const SceneDef& scene, Bodies bodies, const CudaOptions& options = {});

/// The first GPU that can be used. Throws Error(device) with the reason if there is none.
CudaDevice usable_cuda_device();

}  // namespace gem
