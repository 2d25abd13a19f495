#include "gem/engine/step/books.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/geometry/tilted_faces.h"

namespace gem {
namespace {

Quantity& operator+=(Quantity& sum, const Quantity& q) {
  sum.momentum += q.momentum;
  sum.angular_momentum += q.angular_momentum;
  sum.energy += q.energy;
  return sum;
}

Quantity of_body(const Bodies& b, std::size_t i) {
  return quantity_of(b.mass[i], b.inertia[i], b.position[i], b.velocity[i], b.spin[i]);
}

EventBodies event_bodies(const FieldState& f, const Contact& contact) {
  const Bodies& b = f.bodies;
  return {collision_mass(b, contact.a),
          collision_mass(b, contact.b),
          b.position[contact.b],
          b.position[contact.b] - f.platform_position,
          f.outline(contact.a),
          f.outline(contact.b),
          crushing_ice(f.constants.events, crushed_thickness(f, contact))};
}

ContactPoint point_of(const ContactSlot& slot) { return {{}, slot.separation, slot.feature}; }

/// Chord growth of a contact. Two points may lie within the contact margin although their faces are tilted.
double growth_of(const Contact& contact, const EventBodies& bodies) {
  if (contact.count < 2) return contact.growth;
  return tilted_faces_growth(bodies.outline_a, bodies.outline_b, point_of(contact.slot[0]), point_of(contact.slot[1]),
                             contact.width);
}

/// Longest chord that crushing can reach [m].
double longest_chord(const Contact& contact, const EventBodies& bodies) {
  if (contact.count == 2 || !(contact.growth > 0.0)) return contact.width;
  return facing_length(bodies.outline_a, bodies.outline_b, bodies.offset, turned_left(contact.normal));
}

}  // namespace

ContactEvent event_of(const Contact& contact, const EventBodies& bodies, double time) {
  ContactEvent e;
  e.time = time;
  e.body_a = contact.a;
  e.body_b = contact.b;
  e.normal = contact.normal;
  e.width = contact.width;
  e.growth = growth_of(contact, bodies);
  Vec2 arm_a, arm_b;
  for (int k = 0; k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    e.impulse_normal += slot.impulse.normal;
    e.impulse_tangential += slot.impulse.tangential;
    arm_a += slot.impulse.normal * slot.arm_a;
    arm_b += slot.impulse.normal * slot.arm_b;
    e.closing_speed -= slot.impulse.normal * slot.normal_before;
    e.depth = std::max(e.depth, -slot.separation);
  }
  const double share = 1.0 / e.impulse_normal;
  arm_a = share * arm_a;
  arm_b = share * arm_b;
  e.closing_speed *= share;
  e.point = bodies.position_b + arm_b;
  e.effective_mass = 1.0 / contact_compliance(bodies.mass_a, arm_a, bodies.mass_b, arm_b, contact.normal).nn;
  const double energy = 0.5 * e.effective_mass * e.closing_speed * e.closing_speed;
  e.peak_force = crushing_peak(bodies.ice, e.growth, longest_chord(contact, bodies), energy).force;
  return e;
}

Quantity total(const FieldState& f) {
  Quantity sum;
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.active[i]) sum += of_body(f.bodies, i);
  const Events& e = f.constants.events;
  if (e.platform_present) sum.energy += mooring_energy(e, f.bodies.position[0], f.bodies.rotation[0], f.broken);
  return sum;
}

void open_books(FieldState& f, const EngineState& state) {
  const Ledger& ledger = state.ledger;
  f.mooring_force = ledger.mooring_force;
  f.broken = state.broken;
  f.dp = state.dp;
  if (state.books.size() == f.books.size()) {
    f.books = state.books;
    return;
  }
  for (std::size_t c = 0; c < ledger.channel.size(); ++c) f.book(static_cast<Channel>(c), 0) = ledger.channel[c];
}

Ledger closed_books(const FieldState& f, Ledger& running) {
  Ledger ledger = running;
  ledger.channel = {};
  for (std::size_t c = 0; c < ledger.channel.size(); ++c)
    for (std::size_t i = 0; i < f.bodies.count(); ++i) ledger.channel[c] += f.book(static_cast<Channel>(c), i);
  ledger.mooring_force = f.mooring_force;
  double momentum = 0.0, angular = 0.0, reach = 0.0;
  for (std::size_t i = 0; i < f.bodies.count(); ++i) {
    if (f.bodies.active[i] && f.bodies.inverse_mass[i] > 0.0)
      reach = std::max(reach, length(f.bodies.position[i]) + f.bodies.radius[i]);
    const Vec2 p = f.bodies.mass[i] * f.bodies.velocity[i];
    momentum += length(p);
    angular += length(f.bodies.position[i]) * length(p) + f.bodies.inertia[i] * std::fabs(f.bodies.spin[i]);
  }
  ledger.now = total(f);
  double energy = std::fabs(ledger.now.energy) + std::fabs(ledger.start.energy);
  for (const Quantity& q : ledger.channel) {
    momentum = std::max(momentum, length(q.momentum));
    angular = std::max(angular, std::fabs(q.angular_momentum));
    energy += std::fabs(q.energy);
  }
  running.momentum_scale = std::max({running.momentum_scale, momentum, length(ledger.mooring_force.momentum)});
  // rounding of the angular momentum scales with the momentum at the body's position, also where the terms cancel, as
  // for a floe held at the origin
  running.angular_scale = std::max({running.angular_scale, angular, std::fabs(ledger.mooring_force.angular_momentum),
                                    reach * running.momentum_scale});
  running.energy_scale = std::max(running.energy_scale, energy);
  ledger.momentum_scale = running.momentum_scale;
  ledger.angular_scale = running.angular_scale;
  ledger.energy_scale = running.energy_scale;
  return ledger;
}

Ledger saved_books(const FieldState& f, const Ledger& running) {
  Ledger closed = running;
  closed = closed_books(f, closed);
  closed.momentum_scale = running.momentum_scale;
  closed.angular_scale = running.angular_scale;
  closed.energy_scale = running.energy_scale;
  return closed;
}

void check_finite(const FieldState& f, std::int64_t step) {
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (!finite_or_inactive(f.bodies, i))
      throw Error(ExitCode::numerical_stop, "body " + std::to_string(i) + " has a non-finite state after time step " +
                                                std::to_string(step) +
                                                " (t = " + number_text(static_cast<double>(step) * f.constants.dt, 9) +
                                                " s); try a smaller numerics.time_step_s");
}

void retire(FieldState& f) {
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.kind[i] == BodyKind::floe) retire_floe(f, i);
}

void log_events(const FieldState& f, Contacts contacts, std::int64_t step, StepLog& log) {
  if (!log.wants_events) return;
  const double time = static_cast<double>(step) * f.constants.dt;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (!f.constants.is_platform(contact.a)) break;
    if (f.bodies.kind[contact.b] != BodyKind::floe) continue;  // a wall is not ice
    if (!presses(contact)) continue;
    log.events.push_back(event_of(contact, event_bodies(f, contact), time));
    log.events.back().largest_force = contact.largest_force;
  }
}

PlatformImpulses platform_impulses(const FieldState& f) {
  return {f.mooring_force.momentum, f.book(Channel::platform_drag, 0).momentum};
}

void log_step(const FieldState& f, Contacts contacts, const PlatformImpulses& before, const StepQuality& quality,
              StepLog& log) {
  PlatformStep p;
  p.position = f.bodies.position[0];
  p.rotation = f.bodies.rotation[0];
  p.velocity = f.bodies.velocity[0];
  p.spin = f.bodies.spin[0];
  p.broken = f.broken;
  const PlatformImpulses after = platform_impulses(f);
  p.mooring_impulse = after.mooring - before.mooring;
  p.drag_impulse = after.drag - before.drag;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (!f.constants.is_platform(contact.a)) break;
    if (f.bodies.kind[contact.b] != BodyKind::floe) continue;  // a wall is not ice
    bool pressed = false;
    for (int k = 0; k < contact.count; ++k) {
      const ContactSlot& slot = contact.slot[k];
      const Vec2 impulse = world_impulse(contact, slot.impulse);
      p.ice_impulse -= impulse;
      p.ice_yaw_impulse -= cross(slot.arm_a, impulse);
      pressed = pressed || slot.impulse.normal > 0.0;
    }
    if (pressed) ++p.contacts;
  }
  log.platform.push_back(p);
  if (f.constants.events.dp) log.dp.push_back(f.dp);
  log.quality.push_back(quality);
}

LedgerResidual residual(const Ledger& ledger) {
  Quantity explained = ledger.start;
  for (const Quantity& q : ledger.channel) explained += q;
  explained += ledger.mooring_force;
  explained.energy += ledger.crack_energy;
  auto relative = [](double difference, double scale) { return scale > 0.0 ? std::fabs(difference) / scale : 0.0; };
  return {relative(length(ledger.now.momentum - explained.momentum), ledger.momentum_scale),
          relative(ledger.now.angular_momentum - explained.angular_momentum, ledger.angular_scale),
          relative(ledger.now.energy - explained.energy, ledger.energy_scale)};
}

}  // namespace gem
