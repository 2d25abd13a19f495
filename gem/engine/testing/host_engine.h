// For tests: a device scene in host memory behind the Engine interface.
#pragma once

#include "gem/engine/testing/host_scene.h"

namespace gem::test {

class HostEngine : public Engine {
 public:
  HostEngine(const SceneDef& scene, const Bodies& bodies, int blocks, int threads)
      : scene_(scene, bodies, blocks, threads) {}

  HostScene& scene() { return scene_; }
  std::string name() const override { return "device"; }
  double asked_residual() const override { return scene_.asked_residual(); }
  void advance(std::int64_t steps, StepLog& log) override { scene_.advance(steps, log); }
  std::int64_t step() const override { return scene_.status().step; }
  const Bodies& bodies() override { return scene_.bodies(); }
  Ledger ledger() override { return scene_.ledger(scene_.save().ledger); }
  bool has_contact_forces() const override { return scene_.has_contact_forces(); }
  std::vector<ContactForce> contact_forces() override { return scene_.contact_forces(); }
  EngineState save() override { return scene_.save(); }
  void restore(const EngineState& state) override { scene_.restore(state); }

 private:
  HostScene scene_;
};

}  // namespace gem::test
