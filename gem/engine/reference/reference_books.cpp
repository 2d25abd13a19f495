#include "gem/engine/reference/reference_books.h"

#include <algorithm>
#include <cmath>

#include "gem/events/mass_reduction.h"

namespace gem::reference {
namespace {

/// Books an external impulse at a world point.
void enter(Quantity& book, Vec2 point, Vec2 impulse) {
  book.momentum += impulse;
  book.angular_momentum += cross(point, impulse);
}

/// Impulse of the fixed body of a pair on the other body.
void book_fixed(State& s, const Touch& touch, const TouchPoint& p) {
  const Bodies& b = s.bodies;
  const bool a_fixed = b.kind[touch.a] == BodyKind::fixed, b_fixed = b.kind[touch.b] == BodyKind::fixed;
  if (!a_fixed && !b_fixed) return;
  const double sign = b_fixed ? -1.0 : 1.0;
  const Vec2 point = b.position[touch.b] + p.arm_b;
  enter(s.ledger[Channel::impact], point, sign * (p.impulse.normal - p.elastic) * touch.normal);
  enter(s.ledger[Channel::elastic], point, sign * p.elastic * touch.normal);
  enter(s.ledger[Channel::friction], point, sign * p.impulse.tangential * turned_left(touch.normal));
}

void book_point(State& s, const Touch& touch, const TouchPoint& p) {
  const Vec2 after = relative_velocity(s.bodies, touch, p);
  const double after_n = dot(after, touch.normal), after_t = dot(after, turned_left(touch.normal));
  s.ledger[Channel::impact].energy += impulse_work(p.impulse.normal - p.elastic, p.normal_before, after_n);
  s.ledger[Channel::elastic].energy += impulse_work(p.elastic, p.normal_before, after_n);
  s.ledger[Channel::friction].energy += impulse_work(p.impulse.tangential, p.tangential_before, after_t);
  book_fixed(s, touch, p);
  // the yaw lock of the platform takes this moment
  const bool on_platform = s.bodies.kind[touch.a] == BodyKind::platform;
  if (on_platform && s.bodies.inverse_inertia[0] == 0.0)
    s.ledger.mooring_force.angular_momentum += cross(p.arm_a, world_impulse(touch, p));
  if (!on_platform || s.bodies.inverse_mass[0] > 0.0) return;
  // a fixed platform hands everything on to the ground
  const Vec2 impulse = world_impulse(touch, p);
  s.mooring_impulse += impulse;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum += cross(s.bodies.position[0], impulse);
}

/// Largest violation of the normal contact law, as a speed [m/s]. A point without impulse may part; a point at
/// its cap may close.
double complementarity(const Bodies& b, const Touch& touch, const TouchPoint& p) {
  const double excess = dot(relative_velocity(b, touch, p), touch.normal) - p.target;
  if (p.impulse.normal == 0.0 && p.impulse.tangential == 0.0) return std::max(-excess, 0.0);
  const double own = inverse_effective_mass(mass_of(b, touch.a), p.arm_a, touch.normal) +
                     inverse_effective_mass(mass_of(b, touch.b), p.arm_b, touch.normal);
  return std::fabs(std::clamp(excess, own * (p.impulse.normal - p.cap), own * p.impulse.normal));
}

double work_of(const Bodies& b, const Touch& touch, const TouchPoint& p) {
  const Vec2 after = relative_velocity(b, touch, p);
  return impulse_work(p.impulse.normal, p.normal_before, dot(after, touch.normal)) +
         impulse_work(p.impulse.tangential, p.tangential_before, dot(after, turned_left(touch.normal)));
}

double sum_of_energies(const Ledger& ledger) {
  double sum = std::fabs(ledger.now.energy) + std::fabs(ledger.start.energy);
  for (const Quantity& q : ledger.channel) sum += std::fabs(q.energy);
  return sum;
}

/// Whether the pair is the platform and a floe; a wall is not ice.
bool is_ice_on_platform(const Bodies& b, const Touch& touch) {
  return b.kind[touch.a] == BodyKind::platform && b.kind[touch.b] == BodyKind::floe;
}

}  // namespace

Quantity quantity_of(const Bodies& b, std::size_t i) {
  const Vec2 momentum = b.mass[i] * b.velocity[i];
  return {momentum, cross(b.position[i], momentum) + b.inertia[i] * b.spin[i],
          0.5 * b.mass[i] * dot(b.velocity[i], b.velocity[i]) + 0.5 * b.inertia[i] * b.spin[i] * b.spin[i]};
}

Quantity total_of(const Rules& rules, const State& s) {
  const Bodies& b = s.bodies;
  Quantity sum;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (!b.active[i]) continue;
    const Quantity q = quantity_of(b, i);
    sum.momentum += q.momentum;
    sum.angular_momentum += q.angular_momentum;
    sum.energy += q.energy;
  }
  const MooringLaws& moored = rules.events.moored;
  const Vec2 offset = b.position[0] - rules.scene.platform.anchor_m;
  if (moored.present)
    sum.energy += mooring_pull(moored, b.position[0], b.rotation[0], s.broken).energy;
  else if (rules.stiffness > 0.0)
    sum.energy += 0.5 * rules.stiffness * dot(offset, offset);
  return sum;
}

void close_ledger(const Rules& rules, State& s) {
  const Bodies& b = s.bodies;
  Ledger& ledger = s.ledger;
  double momentum = 0.0, angular = 0.0, reach = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i) {
    const double p = b.mass[i] * length(b.velocity[i]);
    momentum += p;
    angular += length(b.position[i]) * p + b.inertia[i] * std::fabs(b.spin[i]);
    if (b.active[i] && b.inverse_mass[i] > 0.0) reach = std::max(reach, length(b.position[i]) + b.radius[i]);
  }
  ledger.now = total_of(rules, s);
  for (const Quantity& q : ledger.channel) {
    momentum = std::max(momentum, length(q.momentum));
    angular = std::max(angular, std::fabs(q.angular_momentum));
  }
  ledger.momentum_scale = std::max({ledger.momentum_scale, momentum, length(ledger.mooring_force.momentum)});
  // rounding of the angular momentum scales with the momentum at the farthest position, also where the terms cancel
  ledger.angular_scale = std::max(
      {ledger.angular_scale, angular, std::fabs(ledger.mooring_force.angular_momentum), reach * ledger.momentum_scale});
  ledger.energy_scale = std::max(ledger.energy_scale, sum_of_energies(ledger));
}

double crushed_thickness(const Bodies& bodies, std::int32_t a, std::int32_t b) {
  const double of_b = bodies.thickness[b];
  return bodies.kind[a] == BodyKind::floe ? std::min(bodies.thickness[a], of_b) : of_b;
}

Vec2 relative_velocity(const Bodies& b, const Touch& touch, const TouchPoint& p) {
  return b.velocity[touch.b] + cross(b.spin[touch.b], p.arm_b) - b.velocity[touch.a] - cross(b.spin[touch.a], p.arm_a);
}

Vec2 world_impulse(const Touch& touch, const TouchPoint& p) {
  return p.impulse.normal * touch.normal + p.impulse.tangential * turned_left(touch.normal);
}

void book_touches(State& s, const std::vector<Touch>& touches) {
  for (const Touch& touch : touches)
    for (const TouchPoint& point : touch.points)
      if (point.acted()) book_point(s, touch, point);
}

void judge_touches(const Bodies& b, const std::vector<Touch>& touches, StepQuality& quality, StepLog& log) {
  double work = 0.0;
  for (const Touch& touch : touches) {
    const double size = std::sqrt(std::min(b.area[touch.a], b.area[touch.b]));
    for (const TouchPoint& p : touch.points) {
      quality.complementarity = std::max(quality.complementarity, complementarity(b, touch, p));
      quality.cone_excess = std::max(quality.cone_excess, beyond_friction(touch.friction, p.impulse, p.spare));
      work += work_of(b, touch, p);
      if (p.separation <= 0.0 || p.impulse.normal > 0.0) ++quality.contacts;
      if (!(p.separation < 0.0)) continue;
      log.overlap.add(-p.separation);
      log.overlap_share.add(-p.separation / size);
      quality.maximum_overlap = std::max(quality.maximum_overlap, -p.separation);
      quality.maximum_share = std::max(quality.maximum_share, -p.separation / size);
    }
  }
  quality.energy_created = std::max(0.0, work);
}

PlatformStep platform_sample(const State& s, const std::vector<Touch>& touches) {
  const Bodies& b = s.bodies;
  PlatformStep sample;
  sample.position = b.position[0];
  sample.rotation = b.rotation[0];
  sample.velocity = b.velocity[0];
  sample.spin = b.spin[0];
  sample.broken = s.broken;
  sample.mooring_impulse = s.mooring_impulse;
  sample.drag_impulse = s.drag_impulse;
  for (const Touch& touch : touches) {
    if (!is_ice_on_platform(b, touch)) continue;
    bool pressed = false;
    for (const TouchPoint& point : touch.points) {
      sample.ice_impulse -= world_impulse(touch, point);
      sample.ice_yaw_impulse -= cross(point.arm_a, world_impulse(touch, point));
      pressed = pressed || point.impulse.normal > 0.0;
    }
    if (pressed) ++sample.contacts;
  }
  return sample;
}

}  // namespace gem::reference
