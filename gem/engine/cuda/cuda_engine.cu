// Batches of scenes on a GPU, by one of two routes. Resident: blocks stay with their scenes through many time steps and
// meet at grid barriers. Phases: one kernel makes one stage of a time step of all scenes; this is for more work than
// resident blocks can hold.
#include "gem/engine/cuda/cuda_engine.h"

#include <algorithm>
#include <exception>
#include <tuple>

#include "gem/engine/cuda/cuda_phase_launch.cuh"
#include "gem/engine/cuda/cuda_recorders.h"
#include "gem/engine/cuda/cuda_scene.cuh"
#include "gem/engine/device/block_share.h"

namespace gem {
namespace {

CudaDevice chosen_device(int index) {
  if (index < 0) return usable_cuda_device();
  std::string reason;
  for (CudaDevice& device : cuda_devices(reason))
    if (device.index == index && device.fault.empty()) return device;
  throw Error(ExitCode::device, "GPU " + std::to_string(index) + " cannot be used (see gem devices); use another");
}

int chosen_threads(int threads) {
  if (threads == 0) return most_threads;
  if (threads < 32 || threads > most_threads || threads % 32 != 0)
    throw Error(ExitCode::usage, "a block cannot have " + std::to_string(threads) + " threads (allowed 32 to " +
                                     std::to_string(most_threads) + ", a multiple of 32); choose another number");
  return threads;
}

}  // namespace

class CudaBatch::Work {
  /// The phases route is faster from this many phase blocks per multiprocessor on. The threshold is highest for one
  /// scene, to which the resident route gives the whole GPU. It is lower for several scenes, which share the GPU, and
  /// lowest for several coupled ones.
  static constexpr double phase_blocks_of_one = 5.0, phase_blocks_of_several = 3.5, phase_blocks_that_iterate = 1.75;

 public:
  Work(std::vector<BatchScene> scenes, const CudaOptions& options)
      : device_(on_device(options)),
        ring_steps_(options.ring_steps),
        chosen_blocks_(options.blocks),
        route_(options.route),
        resident_(chosen_threads(options.threads), device_.multiprocessors),
        blocks_(scenes.size(), 1),
        visits_(scenes.size(), 0.0),
        status_memory_(sizeof(DeviceStatus) * scenes.size()),
        scene_memory_(sizeof(DeviceScene) * scenes.size()),
        wanted_memory_(sizeof(std::int32_t) * scenes.size()),
        barrier_memory_(2 * sizeof(GridBarrier) * scenes.size()),
        status_(sizeof(DeviceStatus) * scenes.size()),
        scene_(sizeof(DeviceScene) * scenes.size()),
        wanted_(sizeof(std::int32_t) * scenes.size()),
        recorders_(scenes.size()) {
    scenes_.reserve(scenes.size());
    auto* status = reinterpret_cast<DeviceStatus*>(status_memory_.data());
    for (BatchScene& scene : scenes) {
      const int most = std::min(useful(scene.bodies.count()), resident_.blocks());
      scenes_.emplace_back(std::move(scene), options, most, status++);
    }
  }

  void advance(const std::vector<std::int64_t>& steps, std::vector<StepLog>* logs) {
    std::vector<StepsAhead> ahead;
    for (const std::int64_t some : steps) ahead.push_back({some, some});
    begin(ahead, logs);
    while (std::any_of(ahead.begin(), ahead.end(), [](const StepsAhead& one) { return one.most > 0; }))
      launch(ahead, logs);
    for (const std::exception_ptr& fault : faults_)
      if (fault) std::rethrow_exception(fault);
  }

  std::vector<std::exception_ptr> advance_some(std::vector<StepsAhead> ahead, std::vector<StepLog>& logs) {
    begin(ahead, &logs);
    launch(ahead, &logs);
    return faults_;
  }

  CudaScene& scene(std::size_t k) {
    use();
    return scenes_[k];
  }
  std::size_t size() const { return scenes_.size(); }
  const CudaDevice& device() const { return device_; }
  Route route() const { return phases_steps_ > resident_steps_ ? Route::phases : Route::resident; }
  int blocks() const { return route() == Route::phases ? scenes_.front().device().phase_blocks : blocks_[0]; }
  int threads() const { return route() == Route::phases ? phase_threads : resident_.threads(); }
  double device_time() const { return device_time_; }
  double barriers() const { return barriers_ / std::max(1.0, counted_steps_); }

 private:
  static CudaDevice on_device(const CudaOptions& options) {
    CudaDevice device = chosen_device(options.device);
    check_cuda(cudaSetDevice(device.index), "select the device");
    return device;
  }

  /// Begins a call. A scene that cannot go on gets a fault and stays as it is.
  void begin(std::vector<StepsAhead>& ahead, const std::vector<StepLog>* logs) {
    use();
    device_time_ = 0.0;
    resident_steps_ = phases_steps_ = 0;
    faults_.assign(scenes_.size(), nullptr);
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
      if (ahead[k].most == 0) continue;
      scenes_[k].want(logs ? &(*logs)[k] : nullptr);
      guarded(k, ahead[k], [&] { scenes_[k].check_start(ahead[k].most); });
    }
  }

  /// Runs `action` for a scene. An error of the scene ends its time steps only; a GPU that does not answer ends all.
  template <class Action>
  void guarded(std::size_t k, StepsAhead& ahead, Action action) {
    try {
      action();
    } catch (const Error& error) {
      if (error.code() == ExitCode::device) throw;
      end_scene(k, ahead);
    } catch (const std::exception&) {  // e.g. no memory for its log
      end_scene(k, ahead);
    }
  }

  /// Keeps the exception that ends the time steps of a scene.
  void end_scene(std::size_t k, StepsAhead& ahead) {
    faults_[k] = std::current_exception();
    ahead.most = 0;
  }

  void use() const { check_cuda(cudaSetDevice(device_.index), "select the device"); }

  /// Moves each scene that has time steps ahead on by some of them, in about the same time for all. Takes what was done
  /// off `ahead`. Scenes with operator splitting have only the phases route, so others are launched by themselves.
  void launch(std::vector<StepsAhead>& ahead, std::vector<StepLog>* logs) {
    for (const bool splitting : {false, true}) launch_those(splitting, ahead, logs);
  }

  void launch_those(bool splitting, std::vector<StepsAhead>& ahead, std::vector<StepLog>* logs) {
    std::vector<std::size_t> active;
    for (std::size_t k = 0; k < ahead.size(); ++k)
      if (ahead[k].most > 0 && is_splitting(scenes_[k].device()) == splitting) active.push_back(k);
    if (active.empty()) return;
    if (splitting && !phases_.can_solve())
      throw Error(ExitCode::device,
                  "the GPU cannot run numerics.iteration = \"splitting\" (it lacks clusters of blocks, or shared "
                  "memory); use --engine cpu, or \"gradient\"");
    const bool phases = splitting || takes_phases_route(active);
    if (phases)
      advance_phases(active, ahead);
    else
      advance_resident(active, ahead);
    for (const std::size_t k : active) (phases ? phases_steps_ : resident_steps_) += status_of(k).samples;
    collect(active, ahead, logs);
  }

  /// Most blocks that help a scene, or as many as the options ask for.
  int useful(std::size_t bodies) const {
    return chosen_blocks_ > 0 ? std::min(chosen_blocks_, static_cast<int>(bodies)) : useful_blocks(bodies);
  }

  /// Advances scenes on the resident route.
  void advance_resident(const std::vector<std::size_t>& active, const std::vector<StepsAhead>& ahead) {
    std::vector<double> work;
    std::vector<int> most;
    for (const std::size_t k : active) {
      const std::size_t bodies = scenes_[k].field().bodies.count();
      work.push_back(static_cast<double>(bodies) * static_cast<double>(ahead[k].all));
      most.push_back(useful(bodies));
    }
    const std::vector<int> blocks = share_blocks(work, most, resident_.blocks());
    for (std::size_t at = 0; at < active.size(); ++at) blocks_[active[at]] = blocks[at];
    send(active, steps_of(active, ahead));
    time_.begin();
    resident_.start({device_scenes(), device_steps(), device_barriers(), nullptr, 0}, blocks, time_.stream());
    finish();
  }

  /// Time steps that each scene makes in one call.
  std::vector<std::int64_t> steps_of(const std::vector<std::size_t>& active,
                                     const std::vector<StepsAhead>& ahead) const {
    std::vector<std::int64_t> all, next;
    for (const std::size_t k : active) {
      all.push_back(ahead[k].all);
      next.push_back(ahead[k].most);
    }
    return share_steps(all, next, ring_steps_);
  }

  /// Whether these scenes take the phases route: if they need more blocks than the device runs at a time.
  bool takes_phases_route(const std::vector<std::size_t>& active) {
    if (route_ == Route::resident || chosen_blocks_ > 0) return false;
    std::int64_t blocks = 0;
    double worth_it = active.size() == 1 ? phase_blocks_of_one : phase_blocks_of_several;
    for (const std::size_t k : active) {
      const DeviceScene& scene = scenes_[k].device();
      blocks += scene.phase_blocks;
      if (!scene.wake) return false;  // its memory has no arrays for the phases route
      if (scene.constants.solver != ContactSolver::coupled) continue;
      if (!phases_.can_solve()) return false;
      if (active.size() > 1) worth_it = phase_blocks_that_iterate;
    }
    return route_ == Route::phases || static_cast<double>(blocks) >= worth_it * device_.multiprocessors;
  }

  /// Advances scenes on the phases route. Scenes of one solver stand together; among them, those with a similar number
  /// of time steps.
  void advance_phases(std::vector<std::size_t>& active, const std::vector<StepsAhead>& ahead) {
    const auto order = [&](std::size_t k) {
      return std::make_tuple(scenes_[k].field().constants.solver, -ahead[k].all, -visits_[k]);
    };
    std::stable_sort(active.begin(), active.end(), [&](std::size_t i, std::size_t j) { return order(i) < order(j); });
    const std::vector<std::int64_t> steps = steps_of(active, ahead);
    std::vector<PhaseScene> scenes;
    for (std::size_t at = 0; at < active.size(); ++at) {
      const std::size_t k = active[at];
      scenes.push_back({scenes_[k].field().constants.solver, is_splitting(scenes_[k].device()),
                        scenes_[k].device().phase_blocks, static_cast<std::int32_t>(steps[at]), visits_[k]});
      blocks_[k] = 1;
    }
    send(active, steps);
    PhaseLaunch work{};
    work.scenes = device_scenes();
    work.steps = device_steps();
    work.grid_barriers = device_barriers();
    work.list_barriers = work.grid_barriers + scenes_.size();
    time_.begin();
    phases_.run(work, scenes, time_);
    finish();
  }

  const DeviceScene* device_scenes() const { return reinterpret_cast<const DeviceScene*>(scene_memory_.data()); }
  const std::int32_t* device_steps() const { return reinterpret_cast<const std::int32_t*>(wanted_memory_.data()); }
  GridBarrier* device_barriers() const { return reinterpret_cast<GridBarrier*>(barrier_memory_.data()); }

  /// Sends what the launches of a call work on: the active scenes in this order, and the time steps wanted of each.
  void send(const std::vector<std::size_t>& active, const std::vector<std::int64_t>& steps) {
    auto* scene = reinterpret_cast<DeviceScene*>(scene_.data());
    auto* wanted = reinterpret_cast<std::int32_t*>(wanted_.data());
    for (std::size_t at = 0; at < active.size(); ++at) {
      scene[at] = scenes_[active[at]].device();
      wanted[at] = static_cast<std::int32_t>(steps[at]);
    }
    const cudaStream_t stream = time_.stream();
    for (std::size_t at = 0; at < active.size(); ++at) scenes_[active[at]].send_drives(steps[at], stream);
    check_cuda(cudaMemcpyAsync(scene_memory_.data(), scene, scene_.bytes(), cudaMemcpyHostToDevice, stream),
               "start the work");
    check_cuda(cudaMemcpyAsync(wanted_memory_.data(), wanted, wanted_.bytes(), cudaMemcpyHostToDevice, stream),
               "start the work");
    check_cuda(cudaMemsetAsync(barrier_memory_.data(), 0, barrier_memory_.bytes(), stream), "start the work");
  }

  /// Waits for the launches of a call and fetches the statuses.
  void finish() {
    const cudaStream_t stream = time_.stream();
    time_.end();
    check_cuda(cudaMemcpyAsync(status_.data(), status_memory_.data(), status_.bytes(), cudaMemcpyDeviceToHost, stream),
               "fetch the status");
    check_cuda(cudaStreamSynchronize(stream), "advance the scenes");
    device_time_ += time_.seconds();
  }

  /// Records what a call did for each scene and removes what stopped it.
  void collect(const std::vector<std::size_t>& active, std::vector<StepsAhead>& ahead, std::vector<StepLog>* logs) {
    for (const std::size_t k : active) {
      note(k, status_of(k));
      ahead[k].most -= status_of(k).samples;
      ahead[k].all -= status_of(k).samples;
    }
    if (logs) record(active, ahead, *logs);
    for (const std::size_t k : active) guarded(k, ahead[k], [&] { go_on(scenes_[k], status_of(k), ahead[k]); });
  }

  const DeviceStatus& status_of(std::size_t k) const {
    return reinterpret_cast<const DeviceStatus*>(status_.data())[k];
  }

  /// Fetches the rings of all scenes and appends them to the logs.
  void record(const std::vector<std::size_t>& active, std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) {
    for (const std::size_t k : active) scenes_[k].fetch(status_of(k), blocks_[k], time_.stream());
    check_cuda(cudaStreamSynchronize(time_.stream()), "fetch the record");
    recorders_.record(active, [&](std::size_t k) {
      DeviceStatus status = status_of(k);
      // the time step that failed is not logged
      if ((status.stop == DeviceStop::not_finite || status.stop == DeviceStop::solver_full) && status.samples > 0)
        --status.samples;
      guarded(k, ahead[k], [&] { scenes_[k].append(status, blocks_[k], logs[k]); });
    });
  }

  /// Notes the state of a scene after a call.
  void note(std::size_t k, const DeviceStatus& status) {
    scenes_[k].note(status);
    if (k == 0 && status.barriers > 0) {
      barriers_ += status.barriers;
      counted_steps_ += status.samples;
    }
    if (status.samples > 0 && status.visits > 0)
      visits_[k] = static_cast<double>(status.visits) / static_cast<double>(status.samples);
  }

  /// Removes what stopped a scene, if possible; throws Error(numerical_stop) if its state is not finite.
  static void go_on(CudaScene& scene, const DeviceStatus& status, StepsAhead& ahead) {
    if (status.stop == DeviceStop::list_full) scene.grow(status);
    if (status.stop == DeviceStop::solver_full)
      throw Error(ExitCode::resource_limit,
                  "the islands of contacts are too large for the memory that the GPU has set aside for them (floes "
                  "touch very many others); use --engine cpu, or numerics.iteration = \"gradient\"");
    if (status.stop != DeviceStop::not_finite) return;
    ahead.most = 0;
    scene.bodies();
    check_finite(scene.field(), status.step);
  }

  CudaDevice device_;
  int ring_steps_, chosen_blocks_;
  Route route_;
  std::int64_t resident_steps_ = 0, phases_steps_ = 0;  // time steps of all scenes in the last call, by route
  ResidentLaunch resident_;
  /// Blocks of each scene in its last launch. On the phases route 1, as a time step then has one BlockQuality.
  std::vector<int> blocks_;
  std::vector<double> visits_;  // of the points of each scene in a time step, when last on the phases route
  Timeline time_;
  PhaseStreams phases_{device_.multiprocessors};
  DeviceMemory status_memory_, scene_memory_, wanted_memory_, barrier_memory_;
  PinnedMemory status_, scene_, wanted_;
  std::vector<CudaScene> scenes_;
  double device_time_ = 0.0, barriers_ = 0.0, counted_steps_ = 0.0;
  Recorders recorders_;
  std::vector<std::exception_ptr> faults_;  // of each scene in the last call
};

CudaBatch::CudaBatch(std::vector<BatchScene> scenes, const CudaOptions& options)
    : work_(std::make_unique<Work>(std::move(scenes), options)) {}
CudaBatch::~CudaBatch() = default;

std::size_t CudaBatch::size() const { return work_->size(); }
void CudaBatch::advance(const std::vector<std::int64_t>& steps, std::vector<StepLog>* logs) {
  work_->advance(steps, logs);
}
void CudaBatch::advance(std::int64_t steps, std::vector<StepLog>* logs) {
  work_->advance(std::vector<std::int64_t>(size(), steps), logs);
}
std::vector<std::exception_ptr> CudaBatch::advance_some(const std::vector<StepsAhead>& ahead,
                                                        std::vector<StepLog>& logs) {
  return work_->advance_some(ahead, logs);
}
std::int64_t CudaBatch::step(std::size_t scene) const { return work_->scene(scene).step(); }
const Bodies& CudaBatch::bodies(std::size_t scene) { return work_->scene(scene).bodies(); }
Ledger CudaBatch::ledger(std::size_t scene) { return work_->scene(scene).ledger(); }
EngineState CudaBatch::save(std::size_t scene) { return work_->scene(scene).save(); }
void CudaBatch::restore(std::size_t scene, const EngineState& state) { work_->scene(scene).restore(state); }
std::uint64_t CudaBatch::state_hash(std::size_t scene) {
  return hash_of(step(scene), bodies(scene), broken_lines(scene), dp_state(scene));
}
double CudaBatch::asked_residual(std::size_t scene) const {
  return work_->scene(scene).field().constants.asked_residual();
}
LineSet CudaBatch::broken_lines(std::size_t scene) const { return work_->scene(scene).broken_lines(); }
const DpState* CudaBatch::dp_state(std::size_t scene) const { return work_->scene(scene).dp_state(); }
bool CudaBatch::has_contact_forces(std::size_t scene) const { return work_->scene(scene).has_contact_forces(); }
std::vector<ContactForce> CudaBatch::contact_forces(std::size_t scene) const {
  return work_->scene(scene).contact_forces();
}
const CudaDevice& CudaBatch::device() const { return work_->device(); }
int CudaBatch::blocks() const { return work_->blocks(); }
int CudaBatch::threads() const { return work_->threads(); }
Route CudaBatch::route() const { return work_->route(); }
double CudaBatch::device_time() const { return work_->device_time(); }
double CudaBatch::barriers() const { return work_->barriers(); }

}  // namespace gem
