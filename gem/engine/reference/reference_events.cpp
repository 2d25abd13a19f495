// The events on the platform: one per pair, at the impulse-weighted mean of its points.
#include <algorithm>

#include "gem/engine/reference/reference_books.h"
#include "gem/events/crushing.h"
#include "gem/events/mass_reduction.h"
#include "gem/geometry/tilted_faces.h"

namespace gem::reference {
namespace {

/// Growth of the chord with depth [-].
double growth_of(const Touch& touch, const Outline& a, const Outline& b) {
  if (touch.points.size() < 2) return touch.growth;
  const auto end = [&](int k) { return ContactPoint{{}, touch.points[k].separation, touch.points[k].feature}; };
  return tilted_faces_growth(a, b, end(0), end(1), touch.width);
}

/// Longest chord that crushing can reach [m].
double longest_chord(const Touch& touch, double growth, const Outline& a, const Outline& b, Vec2 offset) {
  if (touch.points.size() == 2 || !(growth > 0.0)) return touch.width;
  return facing_length(a, b, offset, turned_left(touch.normal));
}

/// Event of a touch with the total normal impulse `pressed` [N s].
ContactEvent event_of(const Rules& rules, const State& s, const Touch& touch, double pressed) {
  const Bodies& b = s.bodies;
  ContactEvent e;
  e.time = static_cast<double>(s.steps) * rules.dt;
  e.body_a = touch.a;
  e.body_b = touch.b;
  e.normal = touch.normal;
  e.width = touch.width;
  e.impulse_normal = pressed;
  e.largest_force = touch.largest_force;
  Vec2 arm_a, arm_b;
  for (const TouchPoint& p : touch.points) {
    const double share = p.impulse.normal / pressed;
    e.impulse_tangential += p.impulse.tangential;
    e.closing_speed -= share * p.normal_before;
    e.depth = std::max(e.depth, -p.separation);
    arm_a += share * p.arm_a;
    arm_b += share * p.arm_b;
  }
  e.point = b.position[touch.b] + arm_b;
  const CollisionMass mass_a{b.inverse_mass[touch.a], b.inverse_inertia[touch.a]};
  const CollisionMass mass_b{b.inverse_mass[touch.b], b.inverse_inertia[touch.b]};
  e.effective_mass = 1.0 / contact_compliance(mass_a, arm_a, mass_b, arm_b, touch.normal).nn;

  const TurnedOutline a_turned = turned_outline(b, touch.a), b_turned = turned_outline(b, touch.b);
  const Outline outline_a = a_turned.view(), outline_b = b_turned.view();
  e.growth = growth_of(touch, outline_a, outline_b);
  const double longest = longest_chord(touch, e.growth, outline_a, outline_b, b.position[touch.b] - s.platform_start);
  const CrushingIce ice{rules.scene.ice.crushing_pressure_Pa, rules.scene.ice.pressure_area_exponent,
                        crushed_thickness(b, touch.a, touch.b)};
  const double energy = 0.5 * e.effective_mass * e.closing_speed * e.closing_speed;
  e.peak_force = crushing_peak(ice, e.growth, longest, energy).force;
  return e;
}

}  // namespace

void log_platform_events(const Rules& rules, const State& s, const std::vector<Touch>& touches, StepLog& log) {
  if (!log.wants_events) return;
  for (const Touch& touch : touches) {
    if (s.bodies.kind[touch.a] != BodyKind::platform || s.bodies.kind[touch.b] != BodyKind::floe) continue;
    double pressed = 0.0;
    for (const TouchPoint& p : touch.points) pressed += p.impulse.normal;
    if (pressed > 0.0) log.events.push_back(event_of(rules, s, touch, pressed));
  }
}

}  // namespace gem::reference
