// The reference engine: all pairs, one thread, no list, no memory of the last time step but its impulses. The oracle.
#pragma once

#include <map>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/solver/coupled_visit.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

class ReferenceEngine : public Engine {
 public:
  ReferenceEngine(const SceneDef& scene, Bodies bodies);

  std::string name() const override { return "reference"; }
  void advance(std::int64_t steps, StepLog& log) override;
  std::int64_t step() const override { return step_; }
  const Bodies& bodies() override { return field_.bodies; }
  Ledger ledger() override;
  EngineState save() override;
  void restore(const EngineState& state) override;

 private:
  std::vector<Contact> all_contacts() const;
  struct Point {
    Contact* contact;
    ContactSlot* slot;
    PointGeometry<double> geometry;
    PointImpulse<double> impulse;
    PointFrame<float> frame;
    PointImpulse<float> at, carried;  // added to `impulse` in a round
  };

  void resolve_coupled(std::vector<Contact>& contacts, StepQuality& quality);
  std::vector<Point> points_of(std::vector<Contact>& contacts);
  std::vector<Motion<double>> motions(const std::vector<Point>& points) const;
  std::vector<Motion<float>> added_motions(const std::vector<Point>& points) const;
  void keep_best_share(std::vector<Point>& points, double limit) const;
  void begin_round(std::vector<Point>& points) const;
  void iterate(std::vector<Point>& points, StepQuality& quality) const;
  template <PointFriction law>
  static float visit(Point& point, const Approach<float>& w, StepLength<float> pace, float momentum_coefficient);
  float visit(Point& point, const std::vector<Motion<float>>& motion, float momentum_coefficient) const;

  FieldState field_;
  double event_speed_;
  Ledger ledger_;  // start and scales; the sums are with the bodies
  std::int64_t step_ = 0;
  std::map<std::uint64_t, PointImpulse<double>> last_;  // by contact key
};

}  // namespace gem
