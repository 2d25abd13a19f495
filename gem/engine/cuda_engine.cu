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

/// Moves scene k on by moments[k] moments.
__global__ void __launch_bounds__(most_threads, 1)
    advance_scenes(const DeviceScene* scenes, const std::int32_t* moments) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  ClusterCrew crew(cell);
  const int k = static_cast<int>(blockIdx.x) / crew.blocks();
  const auto* from = reinterpret_cast<const std::uint64_t*>(scenes + k);
  auto* to = reinterpret_cast<std::uint64_t*>(&scene);
  for (unsigned w = threadIdx.x; w < sizeof(DeviceScene) / sizeof(std::uint64_t); w += blockDim.x) to[w] = from[w];
  __syncthreads();
  advance_scene(scene, crew, moments[k]);
  crew.barrier();  // no block leaves while another may still raise an alarm in it
}

cudaLaunchConfig_t launch_config(int scenes, int blocks, int threads, cudaLaunchAttribute& cluster,
                                 cudaStream_t stream) {
  cluster.id = cudaLaunchAttributeClusterDimension;
  cluster.val.clusterDim = {static_cast<unsigned>(blocks), 1, 1};
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(static_cast<unsigned>(scenes * blocks));
  config.blockDim = dim3(static_cast<unsigned>(threads));
  config.stream = stream;
  config.attrs = &cluster;
  config.numAttrs = 1;
  return config;
}

/// The most blocks for each scene with which all scenes run at the same time.
int most_blocks(int scenes, int threads) {
  check_cuda(cudaFuncSetAttribute(advance_scenes, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "be set up");
  for (int blocks = 16; blocks > 1; blocks /= 2) {
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t config = launch_config(scenes, blocks, threads, cluster, nullptr);
    int clusters = 0;
    if (cudaOccupancyMaxActiveClusters(&clusters, advance_scenes, &config) == cudaSuccess && clusters >= scenes)
      return blocks;
    cudaGetLastError();
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
        blocks_(options.blocks > 0 ? options.blocks : most_blocks(static_cast<int>(scenes.size()), threads_)),
        ring_moments_(options.ring_moments),
        status_memory_(sizeof(DeviceStatus) * scenes.size()),
        scene_memory_(sizeof(DeviceScene) * scenes.size()),
        wanted_memory_(sizeof(std::int32_t) * scenes.size()),
        status_(sizeof(DeviceStatus) * scenes.size()),
        scene_(sizeof(DeviceScene) * scenes.size()),
        wanted_(sizeof(std::int32_t) * scenes.size()) {
    check_cuda(cudaFuncSetAttribute(advance_scenes, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "be set up");
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

 private:
  static CudaDevice on_device(const CudaOptions& options) {
    CudaDevice device = chosen_device(options.device);
    check_cuda(cudaSetDevice(device.index), "be chosen");
    return device;
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
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t config =
        launch_config(static_cast<int>(scenes_.size()), blocks_, threads_, cluster, stream);
    time_.begin();
    check_cuda(cudaLaunchKernelEx(&config, advance_scenes, reinterpret_cast<const DeviceScene*>(scene_memory_.data()),
                                  reinterpret_cast<const std::int32_t*>(wanted_memory_.data())),
               "start");
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
  DeviceMemory status_memory_, scene_memory_, wanted_memory_;
  PinnedMemory status_, scene_, wanted_;
  std::vector<CudaScene> scenes_;
  double device_time_ = 0.0;
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
