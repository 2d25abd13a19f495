// The engine `box2d`: contact mechanics by Box2D; bodies, drag, mooring, books and output by gem. MAPPING.md lists what
// maps, what cannot, and the reason for each setting.
#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <vector>

#include "baseline_box2d/box2d_options.h"
#include "baseline_box2d/touches.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/field_state.h"

namespace gem::baseline {

/// One time step is one Box2D step between the two halves of gem's own events. Positions and angles are Box2D's floats.
/// Velocities are kept in double and passed to Box2D rounded, so that drag and mooring lose no precision.
class Box2dEngine : public Engine {
 public:
  Box2dEngine(const SceneDef& scene, Bodies bodies, const Box2dOptions& options);

  std::string name() const override { return "box2d"; }
  std::string method() const override;
  void advance(std::int64_t steps, StepLog& log) override;
  std::int64_t step() const override { return step_; }
  const Bodies& bodies() override { return field_.bodies; }
  Ledger ledger() override;
  LineSet broken_lines() const override { return field_.broken; }
  const DpState* dp_state() const override { return field_.constants.events.dp ? &field_.dp : nullptr; }
  EngineState save() override;
  /// Restores the bodies and makes a new world. The impulses that would warm-start Box2D's next step are lost, so the
  /// run does not continue with the same bits.
  void restore(const EngineState& state) override;

 private:
  std::string experiments() const;
  void make_world();
  void one_step(StepLog& log);
  void give_velocities();
  void take_floe(std::size_t i);
  void take_platform();
  void book_fixed_bodies();
  void refresh_outline(std::int32_t i);
  StepQuality quality();
  double closing_speed_left() const;
  void disable_retired();

  Box2dOptions options_;
  FieldState field_;
  DriveSchedule drives_;
  MooringTables mooring_;
  DpLaw dp_;
  Ledger ledger_;
  std::int64_t step_ = 0;
  double platform_angle_ = 0.0;             // [rad]
  std::vector<std::int64_t> outline_made_;  // time step in which a body's outline was last turned
  std::vector<Vec2> place_;                 // of every body before the step [m]
  Touches touches_;
  std::unique_ptr<b2World> world_;  // declared after the listener, which it calls
  std::vector<b2Body*> body_;       // nullptr: takes no part
};

}  // namespace gem::baseline
