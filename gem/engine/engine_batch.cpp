// A batch of scenes on a GPU, and a batch of single engines.
#include "gem/engine/engine_batch.h"

#include <exception>

#include "gem/base/error.h"
#include "gem/engine/breakup/breakup_engine.h"

namespace gem {
namespace {

/// One scene of a batch on a GPU.
class CudaMember : public Engine {
 public:
  CudaMember(CudaBatch& batch, std::size_t scene) : batch_(batch), scene_(scene) {}
  std::string name() const override { return "cuda"; }
  std::string device() const override { return batch_.device().name + ", " + batch_.device().driver; }
  double asked_residual() const override { return batch_.asked_residual(scene_); }
  void advance(std::int64_t, StepLog&) override {
    throw Error(ExitCode::usage, "a scene of a batch cannot be advanced on its own");
  }
  std::int64_t step() const override { return batch_.step(scene_); }
  const Bodies& bodies() override { return batch_.bodies(scene_); }
  Ledger ledger() override { return batch_.ledger(scene_); }
  LineSet broken_lines() const override { return batch_.broken_lines(scene_); }
  const DpState* dp_state() const override { return batch_.dp_state(scene_); }
  bool has_contact_forces() const override { return batch_.has_contact_forces(scene_); }
  std::vector<ContactForce> contact_forces() override { return batch_.contact_forces(scene_); }
  EngineState save() override { return batch_.save(scene_); }
  void restore(const EngineState& state) override { batch_.restore(scene_, state); }

 private:
  CudaBatch& batch_;
  std::size_t scene_;
};

/// One scene of a batch; `splits` is set if its floes may split.
struct Member {
  std::unique_ptr<Engine> engine;
  BreakupEngine* splits = nullptr;
};

class CudaEngines : public EngineBatch {
 public:
  CudaEngines(const std::vector<BatchScene>& scenes, int device) : batch_(scenes, {.device = device}) {
    for (std::size_t k = 0; k < batch_.size(); ++k) add_member(scenes[k].scene, k);
  }
  std::size_t size() const override { return members_.size(); }
  std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) override {
    std::vector<StepsAhead> next = ahead;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (BreakupEngine* const splits = members_[k].splits) next[k].most = splits->begin(ahead[k].most, logs[k]);
    std::vector<std::exception_ptr> faults = batch_.advance_some(next, logs);
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (members_[k].splits && !faults[k]) faults[k] = fault_of_splits(*members_[k].splits, logs[k]);
    return faults;
  }
  Engine& engine(std::size_t scene) override { return *members_[scene].engine; }

 private:
  void add_member(const SceneDef& scene, std::size_t k) {
    Member& member = members_.emplace_back(Member{std::make_unique<CudaMember>(batch_, k)});
    if (scene.breakup.maximum_pieces == 0) return;
    auto splits = std::make_unique<BreakupEngine>(scene, std::move(member.engine));
    member.splits = splits.get();
    member.engine = std::move(splits);
  }

  static std::exception_ptr fault_of_splits(BreakupEngine& splits, StepLog& log) {
    try {
      splits.look_at(log);
    } catch (const std::exception&) {
      return std::current_exception();
    }
    return nullptr;
  }

  CudaBatch batch_;
  std::vector<Member> members_;
};

class SingleEngines : public EngineBatch {
 public:
  SingleEngines(std::vector<BatchScene> scenes, const EngineOptions& options) {
    for (BatchScene& scene : scenes) engines_.push_back(make_engine(scene.scene, std::move(scene.bodies), options));
  }
  std::size_t size() const override { return engines_.size(); }
  std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) override {
    std::vector<std::exception_ptr> faults(engines_.size());
    for (std::size_t k = 0; k < engines_.size(); ++k) {
      try {
        if (ahead[k].most > 0) engines_[k]->advance(ahead[k].most, logs[k]);
      } catch (const std::exception&) {
        faults[k] = std::current_exception();
      }
    }
    return faults;
  }
  Engine& engine(std::size_t scene) override { return *engines_[scene]; }

 private:
  std::vector<std::unique_ptr<Engine>> engines_;
};

}  // namespace

std::unique_ptr<EngineBatch> make_engine_batch(std::vector<BatchScene> scenes, const EngineOptions& options) {
  if (options.name == "cuda") return std::make_unique<CudaEngines>(scenes, options.device);
  return std::make_unique<SingleEngines>(std::move(scenes), options);
}

}  // namespace gem
