// Batches of scenes on a GPU: one cluster of blocks moves each scene through many moments in one launch.
#include "gem/engine/cuda_engine.h"

#include <algorithm>
#include <exception>

#include "gem/engine/cuda_scene.cuh"
#include "gem/engine/device_crew.cuh"
#include "gem/engine/device_moments.h"

namespace gem {
namespace {

constexpr int most_threads = 512;  // leaves 128 registers for each

/// What a launch works on: scene k with `blocks` blocks, moved on by moments[k] moments.
struct Launch {
  const DeviceScene* scenes;
  const std::int32_t* moments;
  CrewGate* gates;
  int blocks;
  std::size_t room_bytes;
};

template <class Crew>
__global__ void __launch_bounds__(most_threads, 1) advance_scenes(const Launch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  __shared__ StageClock clock;
  extern __shared__ __align__(128) std::byte room[];
  const int k = static_cast<int>(blockIdx.x) / launch.blocks;
  if (threadIdx.x == 0) {
    clock = {};
    clock.last = clock64();
  }
  const auto* from = reinterpret_cast<const std::uint64_t*>(launch.scenes + k);
  auto* to = reinterpret_cast<std::uint64_t*>(&scene);
  for (unsigned w = threadIdx.x; w < sizeof(DeviceScene) / sizeof(std::uint64_t); w += blockDim.x) to[w] = from[w];
  __syncthreads();
  Crew crew(BlockRoom{cell, clock, room, launch.room_bytes}, launch.blocks, launch.gates + k);
  advance_scene(scene, crew, launch.moments[k]);
  crew.barrier();  // no block leaves while another may still raise an alarm in it
}

constexpr int largest_cluster = 16;

/// How a batch is spread over the device.
struct Spread {
  int scenes = 1, blocks = 1, threads = most_threads;
  bool gated() const { return blocks > largest_cluster; }
  /// Gated blocks stand in clusters too, for the first of them; where their number does not divide, in smaller ones.
  int cluster() const {
    int size = largest_cluster;
    while (gated() && blocks % size != 0) size /= 2;
    return gated() ? size : blocks;
  }
  auto kernel() const { return gated() ? advance_scenes<GateCrew> : advance_scenes<ClusterCrew>; }
};

/// The fast memory that a block may have besides what the kernel takes itself; the kernel is allowed to take it
/// [bytes].
std::size_t room_of_block(const Spread& spread) {
  int device = 0, most = 0;
  cudaFuncAttributes attributes{};
  check_cuda(cudaGetDevice(&device), "be set up");
  check_cuda(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "be set up");
  check_cuda(cudaFuncGetAttributes(&attributes, spread.kernel()), "be set up");
  const std::size_t left = (static_cast<std::size_t>(most) - attributes.sharedSizeBytes) / 128 * 128;
  check_cuda(cudaFuncSetAttribute(spread.kernel(), cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(left)),
             "be set up");
  check_cuda(cudaFuncSetAttribute(spread.kernel(), cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "be set up");
  return left;
}

/// A launch and the attributes that it points to.
struct LaunchConfig {
  cudaLaunchConfig_t config{};
  cudaLaunchAttribute attribute[2];

  LaunchConfig(const Spread& spread, std::size_t room, cudaStream_t stream) {
    attribute[0].id = cudaLaunchAttributeClusterDimension;
    attribute[0].val.clusterDim = {static_cast<unsigned>(spread.cluster()), 1, 1};
    attribute[1].id = cudaLaunchAttributeCooperative;
    attribute[1].val.cooperative = 1;
    config.gridDim = dim3(static_cast<unsigned>(spread.scenes * spread.blocks));
    config.blockDim = dim3(static_cast<unsigned>(spread.threads));
    config.dynamicSmemBytes = room;
    config.stream = stream;
    config.attrs = attribute;
    config.numAttrs = spread.gated() ? 2 : 1;
  }
  LaunchConfig(const LaunchConfig&) = delete;
  LaunchConfig& operator=(const LaunchConfig&) = delete;

  /// Clusters that run at the same time.
  int clusters(const Spread& spread) {
    int most = 0;
    config.numAttrs = 1;
    if (cudaOccupancyMaxActiveClusters(&most, spread.kernel(), &config) != cudaSuccess) most = 0;
    cudaGetLastError();
    config.numAttrs = spread.gated() ? 2 : 1;
    return most;
  }
};

/// The most blocks for each scene with which all scenes run at the same time; no more than `useful`.
int most_blocks(int scenes, int threads, int multiprocessors, int useful) {
  const int share = std::min(multiprocessors / scenes, useful) / largest_cluster * largest_cluster;
  for (int blocks = share; blocks > largest_cluster; blocks -= largest_cluster) {
    const Spread spread{scenes, blocks, threads};
    if (LaunchConfig(spread, room_of_block(spread), nullptr).clusters(spread) >= scenes * blocks / largest_cluster)
      return blocks;
  }
  for (int blocks = largest_cluster; blocks > 1; blocks /= 2) {
    const Spread spread{scenes, blocks, threads};
    if (blocks <= useful && LaunchConfig(spread, room_of_block(spread), nullptr).clusters(spread) >= scenes)
      return blocks;
  }
  return 1;
}

/// A stream and two marks in its time.
class Timeline {
 public:
  Timeline() {
    check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "make a stream");
    check_cuda(cudaEventCreate(&begin_), "make a stream");
    check_cuda(cudaEventCreate(&end_), "make a stream");
  }
  ~Timeline() {
    cudaEventDestroy(begin_);
    cudaEventDestroy(end_);
    cudaStreamDestroy(stream_);
  }
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  cudaStream_t stream() const { return stream_; }
  void begin() { check_cuda(cudaEventRecord(begin_, stream_), "be timed"); }
  void end() { check_cuda(cudaEventRecord(end_, stream_), "be timed"); }
  double seconds() const {
    float milliseconds = 0.0F;
    check_cuda(cudaEventElapsedTime(&milliseconds, begin_, end_), "be timed");
    return 1e-3 * static_cast<double>(milliseconds);
  }

 private:
  cudaStream_t stream_ = nullptr;
  cudaEvent_t begin_ = nullptr, end_ = nullptr;
};

CudaDevice chosen_device(int index) {
  if (index < 0) return usable_cuda_device();
  std::string reason;
  for (CudaDevice& device : cuda_devices(reason))
    if (device.index == index && device.fault.empty()) return device;
  throw Error(ExitCode::device, "GPU " + std::to_string(index) + " cannot be used (see gem devices) use another");
}

}  // namespace

class CudaBatch::Work {
 public:
  Work(std::vector<BatchScene> scenes, const CudaOptions& options)
      : device_(on_device(options)),
        threads_(options.threads > 0 ? options.threads : most_threads),
        blocks_(options.blocks > 0 ? options.blocks
                                   : most_blocks(static_cast<int>(scenes.size()), threads_, device_.multiprocessors,
                                                 useful_blocks(scenes))),
        ring_moments_(options.ring_moments),
        status_memory_(sizeof(DeviceStatus) * scenes.size()),
        scene_memory_(sizeof(DeviceScene) * scenes.size()),
        wanted_memory_(sizeof(std::int32_t) * scenes.size()),
        gate_memory_(sizeof(CrewGate) * scenes.size()),
        status_(sizeof(DeviceStatus) * scenes.size()),
        scene_(sizeof(DeviceScene) * scenes.size()),
        wanted_(sizeof(std::int32_t) * scenes.size()) {
    scenes_.reserve(scenes.size());
    auto* status = reinterpret_cast<DeviceStatus*>(status_memory_.data());
    for (BatchScene& scene : scenes) scenes_.emplace_back(std::move(scene), options, blocks_, status++);
  }

  void advance(std::int64_t moments, std::vector<MomentLog>* logs) {
    use();
    device_time_ = 0.0;
    fault_ = nullptr;
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
      scenes_[k].check_start();
      scenes_[k].want_events(logs && (*logs)[k].wants_events);
    }
    std::vector<std::int64_t> left(scenes_.size(), moments);
    while (std::any_of(left.begin(), left.end(), [](std::int64_t some) { return some > 0; })) {
      launch(left);
      for (std::size_t k = 0; k < scenes_.size(); ++k)
        if (left[k] > 0) collect(k, left[k], logs ? &(*logs)[k] : nullptr);
    }
    if (fault_) std::rethrow_exception(fault_);
  }

  CudaScene& scene(std::size_t k) {
    use();
    return scenes_[k];
  }
  std::size_t size() const { return scenes_.size(); }
  const CudaDevice& device() const { return device_; }
  int blocks() const { return blocks_; }
  int threads() const { return threads_; }
  double device_time() const { return device_time_; }
  const std::vector<double>& stage_clocks() const { return stage_clocks_; }

 private:
  static CudaDevice on_device(const CudaOptions& options) {
    CudaDevice device = chosen_device(options.device);
    check_cuda(cudaSetDevice(device.index), "be chosen");
    return device;
  }

  /// More blocks than one for so many bodies would only wait for each other.
  static int useful_blocks(const std::vector<BatchScene>& scenes) {
    constexpr std::size_t bodies_worth_a_block = 24;
    std::size_t most = 1;
    for (const BatchScene& scene : scenes) most = std::max(most, scene.bodies.count());
    return static_cast<int>(std::max<std::size_t>(1, std::min<std::size_t>(4096, most / bodies_worth_a_block)));
  }

  void use() const { check_cuda(cudaSetDevice(device_.index), "be chosen"); }

  /// Moves each scene on by as much as its ring holds.
  void launch(const std::vector<std::int64_t>& left) {
    auto* scene = reinterpret_cast<DeviceScene*>(scene_.data());
    auto* wanted = reinterpret_cast<std::int32_t*>(wanted_.data());
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
      scene[k] = scenes_[k].device();
      wanted[k] = static_cast<std::int32_t>(std::min<std::int64_t>(left[k], ring_moments_));
    }
    const cudaStream_t stream = time_.stream();
    check_cuda(cudaMemcpyAsync(scene_memory_.data(), scene, scene_.bytes(), cudaMemcpyHostToDevice, stream), "start");
    check_cuda(cudaMemcpyAsync(wanted_memory_.data(), wanted, wanted_.bytes(), cudaMemcpyHostToDevice, stream),
               "start");
    check_cuda(cudaMemsetAsync(gate_memory_.data(), 0, gate_memory_.bytes(), stream), "start");
    const Spread spread{static_cast<int>(scenes_.size()), blocks_, threads_};
    const std::size_t room = room_of_block(spread);
    const LaunchConfig config(spread, room, stream);
    const Launch work{reinterpret_cast<const DeviceScene*>(scene_memory_.data()),
                      reinterpret_cast<const std::int32_t*>(wanted_memory_.data()),
                      reinterpret_cast<CrewGate*>(gate_memory_.data()), blocks_, room};
    time_.begin();
    check_cuda(cudaLaunchKernelEx(&config.config, spread.kernel(), work), "start");
    time_.end();
    check_cuda(cudaMemcpyAsync(status_.data(), status_memory_.data(), status_.bytes(), cudaMemcpyDeviceToHost, stream),
               "answer");
    check_cuda(cudaStreamSynchronize(stream), "move the scenes");
    device_time_ += time_.seconds();
  }

  /// Takes what a call left and removes what stopped it.
  void collect(std::size_t k, std::int64_t& left, MomentLog* log) {
    DeviceStatus status = reinterpret_cast<const DeviceStatus*>(status_.data())[k];
    CudaScene& scene = scenes_[k];
    scene.note(status);
    for (std::size_t stage = 0; k == 0 && stage < stage_clocks_.size(); ++stage)
      stage_clocks_[stage] += static_cast<double>(status.stage_clocks[stage]);
    left -= status.samples;
    const bool failed = status.stop == DeviceStop::not_finite;
    if (failed && status.samples > 0) --status.samples;  // the moment that failed is not logged
    if (log) scene.append(status, time_.stream(), *log);
    if (status.stop == DeviceStop::list_full) scene.grow(status);
    if (!failed) return;
    left = 0;
    try {
      scene.bodies();
      check_finite(scene.field(), status.moment);
    } catch (const Error&) {
      if (!fault_) fault_ = std::current_exception();
    }
  }

  CudaDevice device_;
  int threads_, blocks_, ring_moments_;
  Timeline time_;
  DeviceMemory status_memory_, scene_memory_, wanted_memory_, gate_memory_;
  PinnedMemory status_, scene_, wanted_;
  std::vector<CudaScene> scenes_;
  double device_time_ = 0.0;
  std::vector<double> stage_clocks_ = std::vector<double>(stage_count);
  std::exception_ptr fault_;
};

CudaBatch::CudaBatch(std::vector<BatchScene> scenes, const CudaOptions& options)
    : work_(std::make_unique<Work>(std::move(scenes), options)) {}
CudaBatch::~CudaBatch() = default;

std::size_t CudaBatch::size() const { return work_->size(); }
void CudaBatch::advance(std::int64_t moments, std::vector<MomentLog>* logs) { work_->advance(moments, logs); }
std::int64_t CudaBatch::moment(std::size_t scene) const { return work_->scene(scene).moment(); }
const Bodies& CudaBatch::bodies(std::size_t scene) { return work_->scene(scene).bodies(); }
Ledger CudaBatch::ledger(std::size_t scene) { return work_->scene(scene).ledger(); }
EngineState CudaBatch::save(std::size_t scene) { return work_->scene(scene).save(); }
void CudaBatch::restore(std::size_t scene, const EngineState& state) { work_->scene(scene).restore(state); }
std::uint64_t CudaBatch::state_hash(std::size_t scene) { return hash_of(moment(scene), bodies(scene)); }
const CudaDevice& CudaBatch::device() const { return work_->device(); }
int CudaBatch::blocks() const { return work_->blocks(); }
int CudaBatch::threads() const { return work_->threads(); }
double CudaBatch::device_time() const { return work_->device_time(); }
std::vector<double> CudaBatch::stage_clocks() const { return work_->stage_clocks(); }

std::vector<std::string> cuda_stage_names() {
  return {"choose",     "look", "resolve", "pairs_wait",  "rows",   "points",      "frames",
          "iterations", "base", "shares",  "solver_wait", "bodies", "bodies_wait", "list"};
}

namespace {

/// A batch of one as an engine.
class CudaEngine : public Engine {
 public:
  CudaEngine(const SceneDef& scene, Bodies bodies, const CudaOptions& options)
      : batch_(one(scene, std::move(bodies)), options), logs_(1) {}

  std::string name() const override { return "cuda"; }
  std::string device() const override { return batch_.device().name + ", " + batch_.device().driver; }
  void advance(std::int64_t moments, MomentLog& log) override {
    std::swap(logs_[0], log);
    try {
      batch_.advance(moments, &logs_);
    } catch (...) {
      std::swap(logs_[0], log);
      throw;
    }
    std::swap(logs_[0], log);
  }
  std::int64_t moment() const override { return batch_.moment(0); }
  const Bodies& bodies() override { return batch_.bodies(0); }
  Ledger ledger() override { return batch_.ledger(0); }
  EngineState save() override { return batch_.save(0); }
  void restore(const EngineState& state) override { batch_.restore(0, state); }

 private:
  static std::vector<BatchScene> one(const SceneDef& scene, Bodies bodies) {
    std::vector<BatchScene> scenes;
    scenes.push_back({scene, std::move(bodies)});
    return scenes;
  }

  CudaBatch batch_;
  std::vector<MomentLog> logs_;
};

}  // namespace

std::unique_ptr<Engine> make_cuda_engine(const SceneDef& scene, Bodies bodies, const CudaOptions& options) {
  return std::make_unique<CudaEngine>(scene, std::move(bodies), options);
}

}  // namespace gem
