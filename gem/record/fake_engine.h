// A fake engine for tests of record and time loop: every floe drifts, and a known impulse acts on the platform.
#pragma once

#include <cmath>

#include "gem/base/error.h"
#include "gem/engine/engine.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// A square floe, platform or wall with side 2.
inline BodyDef square_body(BodyKind kind, Vec2 at) {
  BodyDef def;
  def.kind = kind;
  def.outline = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  def.origin = at;
  return def;
}

/// A platform, one wall and `floes` floes in a row.
inline Bodies fake_field(int floes, bool platform = true) {
  Bodies bodies;
  BodyDef first = square_body(BodyKind::platform, {0.0, 0.0});
  if (!platform) first.outline.clear();
  append(bodies, first);
  append(bodies, square_body(BodyKind::fixed, {0.0, -50.0}));
  for (int i = 0; i < floes; ++i) append(bodies, square_body(BodyKind::floe, {10.0 + 3.0 * i, 5.0}));
  return bodies;
}

class FakeEngine : public Engine {
 public:
  FakeEngine(const SceneDef& scene, Bodies bodies) : dt_(scene.numerics.time_step_s), bodies_(std::move(bodies)) {}
  std::string name() const override { return "fake"; }
  double asked_residual() const override { return asked; }
  std::int64_t step() const override { return step_; }
  const Bodies& bodies() override { return bodies_; }
  EngineState save() override { return {}; }
  void restore(const EngineState&) override {}
  Ledger ledger() override {
    Ledger books;
    books.start.energy = books.now.energy = 1.0;
    books.energy_scale = books.momentum_scale = books.angular_scale = 1.0;
    if (step_ >= lose_energy_at) books.now.energy = 0.5;
    return books;
  }

  void advance(std::int64_t steps, StepLog& log) override {
    for (std::int64_t n = 0; n < steps; ++n) {
      if (++step_ == stop_at) throw Error(ExitCode::numerical_stop, "floe 3 has a speed that is not finite");
      for (std::size_t i = 2; i < bodies_.count(); ++i) bodies_.position[i].x += dt_;
      PlatformStep now;
      now.rotation = {std::cos(0.3 * double(step_)), std::sin(0.3 * double(step_))};
      now.ice_impulse = {double(step_), 0.0};
      now.contacts = 2;
      log.platform.push_back(now);
      log.quality.push_back({7, 3, 1e-4, 1e-3, 2e-2, 2e-4, 3e-6, 4e-9, 5e-2});
      log.overlap.add(1e-3);
      if (log.wants_events && step_ % 10 == 0) {
        ContactEvent event;
        event.time = dt_ * double(step_ - 1);
        event.body_b = 2;
        event.closing_speed = 0.1;
        event.impulse_normal = 4.5;
        log.events.push_back(event);
      }
    }
  }

  double asked = std::nan("");  // residual [m/s]
  std::int64_t stop_at = -1;
  std::int64_t lose_energy_at = 1LL << 60;

 private:
  double dt_;
  Bodies bodies_;
  std::int64_t step_ = 0;
};

}  // namespace gem
