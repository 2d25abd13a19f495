#include "gem/engine/reference/reference_engine.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_outcome.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/ordered_sum.h"
#include "gem/engine/step/solo_stages.h"

namespace gem {

ReferenceEngine::ReferenceEngine(const SceneDef& scene, Bodies bodies)
    : event_speed_(scene.output.event_speed_m_per_s) {
  const StepConstants constants = step_constants(scene, bodies);
  field_ = make_field_state(std::move(bodies), constants);
  ledger_.start = total(field_);
}

std::vector<Contact> ReferenceEngine::all_contacts() const {
  const Bodies& b = field_.bodies;
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.count()); ++i)
    for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(b.count()); ++j) {
      if (!b.active[i] || !b.active[j] || (b.inverse_mass[i] == 0.0 && b.inverse_mass[j] == 0.0)) continue;
      SeparatingAxes unknown;
      Contact contact;
      if (find_contact(field_, i, j, unknown, 0.0, contact)) contacts.push_back(contact);
    }
  return contacts;
}

void ReferenceEngine::advance(std::int64_t steps, StepLog& log) {
  FieldState& f = field_;
  check_finite(f, step_);
  for (std::int64_t m = 0; m < steps; ++m) {
    const PlatformImpulses before = platform_impulses(f);
    std::vector<Contact> contacts = all_contacts();
    std::vector<Contact*> view;
    for (Contact& contact : contacts) view.push_back(&contact);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
    platform_first_half(f);
    StepQuality quality;
    if (f.constants.solver == ContactSolver::coupled) {
      resolve_coupled(contacts, quality);
    } else {
      for (Contact& contact : contacts) prepare_contact(f, contact);
      for (Contact& contact : contacts) resolve_alone(f, contact);
      for (Contact& contact : contacts) apply_impulses(f.bodies, contact);
    }
    std::vector<ContactOutcome> outcomes(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      find_outcome(f, contacts[c], outcomes[c]);
      book_contact(f, contacts[c], outcomes[c]);
    }
    note_outcomes(f, outcomes, quality, log);
    log_events(f, view, step_, event_speed_, log);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) drift_floe(f, i);
    platform_second_half(f);
    ++step_;
    check_finite(f, step_);
    retire(f);
    log_step(f, view, before, quality, log);
  }
}

std::vector<Motion<double>> ReferenceEngine::motions(const std::vector<Point>& points) const {
  const Bodies& b = field_.bodies;
  std::vector<Push<double>> given(b.count(), Push<double>{});
  for (const Point& point : points) {
    const PointGeometry<double>& g = point.geometry;
    add(given[point.contact->a], -1.0, push_of(g, point.impulse, g.lever_a_n, g.lever_a_t));
    add(given[point.contact->b], 1.0, push_of(g, point.impulse, g.lever_b_n, g.lever_b_t));
  }
  std::vector<Motion<double>> motion;
  for (std::size_t i = 0; i < b.count(); ++i)
    motion.push_back(
        moved_by(given[i], b.velocity[i].x, b.velocity[i].y, b.spin[i], b.inverse_mass[i], b.inverse_inertia[i]));
  return motion;
}

/// What the carried-ahead additions of a round move: a body's points as B are summed apart from those as A.
std::vector<Motion<float>> ReferenceEngine::added_motions(const std::vector<Point>& points) const {
  const Bodies& b = field_.bodies;
  std::vector<Push<float>> to_a(b.count(), Push<float>{}), to_b(b.count(), Push<float>{});
  for (const Point& point : points) {
    const PointPush<float> p = push_of(point.frame, point.carried);
    add(to_a[point.contact->a], 1.0F, {p.x, p.y, p.twist_a, p.shift_x, p.shift_y, p.turn_a});
    add(to_b[point.contact->b], 1.0F, {p.x, p.y, p.twist_b, p.shift_x, p.shift_y, p.turn_b});
  }
  std::vector<Motion<float>> motion;
  for (std::size_t i = 0; i < b.count(); ++i) {
    add(to_b[i], -1.0F, to_a[i]);
    motion.push_back(moved_by(to_b[i], 0.0F, 0.0F, 0.0F, static_cast<float>(b.inverse_mass[i]),
                              static_cast<float>(b.inverse_inertia[i])));
  }
  return motion;
}

template <PointFriction law>
float ReferenceEngine::visit(Point& point, const Approach<float>& w, StepLength<float> pace,
                             float momentum_coefficient) {
  const PointImpulse<float> step =
      visit_point<law>(point.frame, w, pace, momentum_coefficient, point.at, point.carried);
  return speed_asked<law>(point.frame, step, pace);
}

float ReferenceEngine::visit(Point& point, const std::vector<Motion<float>>& motion, float momentum_coefficient) const {
  const StepConstants& c = field_.constants;
  const StepLength<float> pace{static_cast<float>(c.dt), static_cast<float>(1.0 / c.dt)};
  const Motion<float>&a = motion[point.contact->a], &b = motion[point.contact->b];
  const Approach<float> w{b.x - a.x, b.y - a.y, b.shift_x - a.shift_x, b.shift_y - a.shift_y, a.spin, a.turn,
                          b.spin,    b.turn};
  switch (c.point_friction) {
    case PointFriction::none:
      return visit<PointFriction::none>(point, w, pace, momentum_coefficient);
    case PointFriction::coulomb:
      return visit<PointFriction::coulomb>(point, w, pace, momentum_coefficient);
    default:
      return visit<PointFriction::fixed_direction>(point, w, pace, momentum_coefficient);
  }
}

std::vector<ReferenceEngine::Point> ReferenceEngine::points_of(std::vector<Contact>& contacts) {
  std::vector<std::int32_t> count(field_.bodies.count(), 0);
  for (const Contact& contact : contacts) {
    count[contact.a] += contact.count;
    count[contact.b] += contact.count;
  }
  std::vector<Point> points;
  for (Contact& contact : contacts) {
    prepare_contact(field_, contact);
    for (int k = 0; k < contact.count; ++k) {
      Point point{&contact, &contact.slot[k], {}, {}, {}, {}, {}};
      const auto last = last_.find(contact_key(contact.a, contact.b, contact.slot[k].feature));
      if (last != last_.end()) point.impulse = last->second;
      point.geometry =
          point_of_contact(field_, contact, contact.slot[k], count[contact.a], count[contact.b], point.impulse.normal);
      point.impulse.repair = repair_to_go_on(field_.constants, point.impulse.repair, point.geometry.nn);
      contact.slot[k].cap = point.geometry.cap;
      enter_geometry(point.frame, point.geometry);
      points.push_back(point);
    }
  }
  return points;
}

void ReferenceEngine::keep_best_share(std::vector<Point>& points, double limit) const {
  const Bodies& b = field_.bodies;
  const std::vector<Motion<double>> motion = motions(points);
  std::set<std::int32_t> touched;
  for (const Point& point : points) touched.insert({point.contact->a, point.contact->b});
  std::vector<double> given, answered;
  for (const std::int32_t i : touched) {
    if (!(b.inverse_mass[i] > 0.0)) continue;
    const ImpulseWork work =
        work_on_body(motion[i], b.velocity[i].x, b.velocity[i].y, b.spin[i], b.mass[i], b.inertia[i]);
    given.push_back(work.given);
    answered.push_back(work.answered);
  }
  const std::size_t count = given.size();
  given.resize(count + sum_width);
  answered.resize(count + sum_width);
  const double share = best_share({ordered_sum(given.data(), count), ordered_sum(answered.data(), count)});
  if (!(share < limit)) return;
  for (Point& point : points) {
    point.impulse.normal *= share;
    point.impulse.tangential *= share;
  }
}

void ReferenceEngine::begin_round(std::vector<Point>& points) const {
  const std::vector<Motion<double>> motion = motions(points);
  for (Point& point : points) {
    enter_base(point.frame, point.geometry, point.impulse, motion[point.contact->a], motion[point.contact->b]);
    point.carried.normal -= point.at.normal;
    point.carried.tangential -= point.at.tangential;
    point.carried.repair -= point.at.repair;
    point.at = {};
  }
}

void ReferenceEngine::iterate(std::vector<Point>& points, StepQuality& quality) const {
  const StepConstants& c = field_.constants;
  IterationControl control(c.residual_speed, c.iterations_maximum, c.tight_residual,
                           field_.momentum_coefficients.data());
  auto next = IterationControl::Next::round;
  while (next != IterationControl::Next::end) {
    begin_round(points);
    do {
      const std::vector<Motion<float>> motion = added_motions(points);
      const float momentum_coefficient = control.momentum_coefficient();
      float asked = 0.0F;
      for (Point& point : points) asked = larger(asked, visit(point, motion, momentum_coefficient));
      if (control.judged()) quality.residual = asked;
      next = control.after(static_cast<float>(quality.residual));
    } while (next == IterationControl::Next::iteration);
    for (Point& point : points)
      point.impulse = with_additions(c.point_friction, point.geometry, point.impulse, point.at, point.frame.least,
                                     point.frame.most, point.frame.repair_least);
  }
  quality.iterations = static_cast<std::int32_t>(control.iteration());
}

void ReferenceEngine::resolve_coupled(std::vector<Contact>& contacts, StepQuality& quality) {
  FieldState& f = field_;
  std::vector<Point> points = points_of(contacts);
  last_.clear();
  if (points.empty()) return;
  keep_best_share(points, 1.0);
  iterate(points, quality);
  keep_best_share(points, 0.5);
  const std::vector<Motion<double>> motion = motions(points);
  for (std::size_t i = 0; i < f.bodies.count(); ++i) {
    if (!(f.bodies.inverse_mass[i] > 0.0)) continue;
    f.bodies.velocity[i] = {motion[i].x, motion[i].y};
    f.bodies.spin[i] = motion[i].spin;
    apply_repair(f, i, {{motion[i].shift_x, motion[i].shift_y}, motion[i].turn});
  }
  for (const Point& point : points) {
    point.slot->impulse = {point.impulse.normal, point.impulse.tangential};
    point.slot->repair = point.impulse.repair;
    last_[contact_key(point.contact->a, point.contact->b, point.slot->feature)] = point.impulse;
  }
}

Ledger ReferenceEngine::ledger() { return closed_books(field_, ledger_); }

EngineState ReferenceEngine::save() {
  EngineState state{step_, field_.bodies, closed_books(field_, ledger_), {}, {}};
  for (const auto& [key, impulse] : last_) {
    state.impulse_key.push_back(key);
    state.impulse_value.push_back(impulse);
  }
  return state;
}

void ReferenceEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  open_books(field_, state.ledger);
  ledger_ = state.ledger;
  step_ = state.step;
  last_.clear();
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i) last_[state.impulse_key[i]] = state.impulse_value[i];
}

}  // namespace gem
