#include "gem/engine/reference_engine.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gem/engine/books.h"
#include "gem/engine/contact_stages.h"
#include "gem/engine/ordered_sum.h"
#include "gem/engine/solo_stages.h"

namespace gem {

ReferenceEngine::ReferenceEngine(const SceneDef& scene, Bodies bodies)
    : event_speed_(scene.output.event_speed_m_per_s) {
  const MomentConstants constants = moment_constants(scene, bodies);
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

void ReferenceEngine::advance(std::int64_t moments, MomentLog& log) {
  FieldState& f = field_;
  check_finite(f, moment_);
  for (std::int64_t m = 0; m < moments; ++m) {
    const PlatformImpulses before = platform_impulses(f);
    std::vector<Contact> contacts = all_contacts();
    std::vector<Contact*> view;
    for (Contact& contact : contacts) view.push_back(&contact);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
    platform_first_half(f);
    MomentQuality quality;
    if (f.constants.resolution == Resolution::coupled) {
      resolve_coupled(contacts, quality);
    } else {
      for (Contact& contact : contacts) prepare_contact(f, contact);
      for (Contact& contact : contacts) resolve_alone(f, contact);
      for (Contact& contact : contacts) apply_impulses(f.bodies, contact);
    }
    for (const Contact& contact : contacts) book_contact(f, contact);
    note_contacts(f, view, quality, log);
    log_events(f, view, moment_, event_speed_, log);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) drift_floe(f, i);
    platform_second_half(f);
    ++moment_;
    check_finite(f, moment_);
    retire(f);
    log_moment(f, view, before, quality, log);
  }
}

std::vector<Motion<double>> ReferenceEngine::motions(const std::vector<Point>& points, bool carried) const {
  const Bodies& b = field_.bodies;
  std::vector<Push<double>> given(b.count(), Push<double>{});
  for (const Point& point : points) {
    const PointGeometry<double>& g = point.geometry;
    const PointImpulse<double>& p = carried ? point.carried : point.impulse;
    const auto add = [&](std::int32_t body, double sign, const Push<double>& push) {
      given[body].x += sign * push.x;
      given[body].y += sign * push.y;
      given[body].twist += sign * push.twist;
      given[body].shift_x += sign * push.shift_x;
      given[body].shift_y += sign * push.shift_y;
      given[body].turn += sign * push.turn;
    };
    add(point.contact->a, -1.0, push_of(g, p, g.lever_a_n, g.lever_a_t));
    add(point.contact->b, 1.0, push_of(g, p, g.lever_b_n, g.lever_b_t));
  }
  std::vector<Motion<double>> motion;
  for (std::size_t i = 0; i < b.count(); ++i)
    motion.push_back(
        moved_by(given[i], b.velocity[i].x, b.velocity[i].y, b.spin[i], b.inverse_mass[i], b.inverse_inertia[i]));
  return motion;
}

PointResidual<double> ReferenceEngine::visit(Point& point, const std::vector<Motion<double>>& motion, double ahead) {
  const MomentConstants& c = field_.constants;
  const Motion<double>&a = motion[point.contact->a], &b = motion[point.contact->b];
  switch (c.point_friction) {
    case PointFriction::none:
      return visit_point<PointFriction::none>(point.geometry, a, b, c.dt, 1.0 / c.dt, ahead, point.impulse,
                                              point.carried);
    case PointFriction::coulomb:
      return visit_point<PointFriction::coulomb>(point.geometry, a, b, c.dt, 1.0 / c.dt, ahead, point.impulse,
                                                 point.carried);
    default:
      return visit_point<PointFriction::fixed_direction>(point.geometry, a, b, c.dt, 1.0 / c.dt, ahead, point.impulse,
                                                         point.carried);
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
      Point point{&contact, &contact.slot[k], {}, {}, {}};
      const auto last = last_.find(contact_key(contact.a, contact.b, contact.slot[k].feature));
      if (last != last_.end()) point.impulse = last->second;
      point.impulse.repair *= repair_memory;
      point.geometry =
          point_of_contact(field_, contact, contact.slot[k], count[contact.a], count[contact.b], point.impulse.normal);
      points.push_back(point);
    }
  }
  return points;
}

void ReferenceEngine::keep_best_share(std::vector<Point>& points, double limit) const {
  const Bodies& b = field_.bodies;
  const std::vector<Motion<double>> motion = motions(points, false);
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

void ReferenceEngine::resolve_coupled(std::vector<Contact>& contacts, MomentQuality& quality) {
  FieldState& f = field_;
  std::vector<Point> points = points_of(contacts);
  last_.clear();
  if (points.empty()) return;
  keep_best_share(points, 1.0);
  for (Point& point : points) point.carried = point.impulse;
  std::vector<Motion<double>> motion = motions(points, true);
  Acceleration acceleration;
  bool restart = false;
  do {
    const double ahead = acceleration.next(restart);
    quality.residual = 0.0;
    std::vector<double> climb;
    for (Point& point : points) {
      const PointResidual<double> residual = visit(point, motion, ahead);
      quality.residual = larger(quality.residual, residual.speed);
      climb.push_back(residual.climb);
    }
    climb.resize(climb.size() + sum_width);
    restart = ordered_sum(climb.data(), points.size()) > 0.0;
    motion = motions(points, true);
    ++quality.iterations;
  } while (quality.residual > f.constants.residual_speed && quality.iterations < f.constants.iterations_maximum);

  keep_best_share(points, 0.5);
  motion = motions(points, false);
  for (std::size_t i = 0; i < f.bodies.count(); ++i) {
    if (!(f.bodies.inverse_mass[i] > 0.0)) continue;
    f.bodies.velocity[i] = {motion[i].x, motion[i].y};
    f.bodies.spin[i] = motion[i].spin;
    f.repair_shift[i] = {motion[i].shift_x, motion[i].shift_y};
    f.repair_turn[i] = motion[i].turn;
  }
  for (const Point& point : points) {
    point.slot->impulse = {point.impulse.normal, point.impulse.tangential};
    point.slot->repair = point.impulse.repair;
    last_[contact_key(point.contact->a, point.contact->b, point.slot->feature)] = point.impulse;
  }
}

Ledger ReferenceEngine::ledger() { return closed_books(field_, ledger_); }

EngineState ReferenceEngine::save() {
  EngineState state{moment_, field_.bodies, closed_books(field_, ledger_), {}, {}};
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
  moment_ = state.moment;
  last_.clear();
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i) last_[state.impulse_key[i]] = state.impulse_value[i];
}

}  // namespace gem
