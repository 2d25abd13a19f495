// The cuda engine of one scene: a batch of one.
#include <utility>

#include "gem/engine/cuda/cuda_engine.h"

namespace gem {

namespace {

/// A batch of one scene behind the Engine interface.
class CudaEngine : public Engine {
 public:
  CudaEngine(const SceneDef& scene, Bodies bodies, const CudaOptions& options)
      : batch_(one(scene, std::move(bodies)), options), logs_(1) {}

  std::string name() const override { return "cuda"; }
  std::string device() const override { return batch_.device().name + ", " + batch_.device().driver; }
  double asked_residual() const override { return batch_.asked_residual(0); }
  void advance(std::int64_t steps, StepLog& log) override {
    std::swap(logs_[0], log);
    try {
      batch_.advance(steps, &logs_);
    } catch (...) {
      std::swap(logs_[0], log);
      throw;
    }
    std::swap(logs_[0], log);
  }
  std::int64_t step() const override { return batch_.step(0); }
  const Bodies& bodies() override { return batch_.bodies(0); }
  Ledger ledger() override { return batch_.ledger(0); }
  LineSet broken_lines() const override { return batch_.broken_lines(0); }
  const DpState* dp_state() const override { return batch_.dp_state(0); }
  bool has_contact_forces() const override { return batch_.has_contact_forces(0); }
  std::vector<ContactForce> contact_forces() override { return batch_.contact_forces(0); }
  EngineState save() override { return batch_.save(0); }
  void restore(const EngineState& state) override { batch_.restore(0, state); }

 private:
  static std::vector<BatchScene> one(const SceneDef& scene, Bodies bodies) {
    std::vector<BatchScene> scenes;
    scenes.push_back({scene, std::move(bodies)});
    return scenes;
  }

  CudaBatch batch_;
  std::vector<StepLog> logs_;
};

}  // namespace

std::unique_ptr<Engine> make_cuda_engine(const SceneDef& scene, Bodies bodies, const CudaOptions& options) {
  return std::make_unique<CudaEngine>(scene, std::move(bodies), options);
}

}  // namespace gem
