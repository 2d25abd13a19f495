#include "baseline_box2d/platform_record.h"

#include <algorithm>
#include <cmath>

#include "gem/events/events.h"
#include "gem/geometry/tilted_faces.h"

namespace gem::baseline {
namespace {

Vec2 arm_on_platform(const FieldState& f, Vec2 point) { return point - f.bodies.position[0]; }

void add(const FieldState& f, const Touch& touch, PlatformImpulse& sum) {
  for (int k = 0; k < touch.count; ++k) {
    sum.impulse -= touch.impulse(k);
    sum.yaw -= cross(arm_on_platform(f, touch.point[k]), touch.impulse(k));
  }
}

/// Merges the touches of one floe with the platform into one event, without chord, depth and peak force.
ContactEvent merged(const FieldState& f, const Touch* begin, const Touch* end) {
  ContactEvent e;
  e.body_b = begin->b;
  double pressed = 0.0;
  Vec2 normal, impulse;
  for (const Touch* t = begin; t != end; ++t)
    for (int k = 0; k < t->count; ++k) {
      const double weight = t->normal_impulse[k];
      const Vec2 slip = f.bodies.velocity[t->b] + cross(f.bodies.spin[t->b], t->point[k] - f.bodies.position[t->b]) -
                        f.bodies.velocity[0] - cross(f.bodies.spin[0], arm_on_platform(f, t->point[k]));
      pressed += weight;
      normal += weight * t->normal;
      e.point += weight * t->point[k];
      e.closing_speed -= weight * dot(slip, t->normal);
      impulse += t->impulse(k);
    }
  if (!(pressed > 0.0)) return e;
  e.normal = (1.0 / length(normal)) * normal;
  e.point = (1.0 / pressed) * e.point;
  e.closing_speed /= pressed;
  e.impulse_normal = dot(impulse, e.normal);
  e.impulse_tangential = dot(impulse, turned_left(e.normal));
  return e;
}

/// Adds chord, depth and crushing peak from the true outlines, as gem's own engines compute them.
void add_crushing(const FieldState& f, ContactEvent& e) {
  const Bodies& b = f.bodies;
  const Outline platform = f.outline(0), floe = f.outline(static_cast<std::size_t>(e.body_b));
  const Vec2 offset = b.position[e.body_b] - f.platform_position;
  const Separation axis = find_axes(platform, floe, offset).first;
  // Box2D stops the floe up to two skins early. Outlines that would touch if the floe stood closer by that distance
  // count.
  const double reach = f.constants.contact_margin + std::max(0.0, axis.distance);
  const ContactGeometry shape = face_contact(platform, floe, offset, axis, reach);
  e.width = shape.width;
  const bool faces = shape.count == 2;
  e.growth = faces ? tilted_faces_growth(platform, floe, shape.point[0], shape.point[1], shape.width) : shape.growth;
  e.depth = std::max(0.0, -axis.distance);
  e.effective_mass = 1.0 / contact_compliance({b.inverse_mass[0], b.inverse_inertia[0]}, arm_on_platform(f, e.point),
                                              {b.inverse_mass[e.body_b], b.inverse_inertia[e.body_b]},
                                              e.point - b.position[e.body_b], e.normal)
                               .nn;
  const CrushingIce ice = crushing_ice(f.constants.events, b.thickness[e.body_b]);
  const bool corner = !faces && e.growth > 0.0;
  const double longest = corner ? facing_length(platform, floe, offset, turned_left(e.normal)) : e.width;
  e.peak_force =
      crushing_peak(ice, e.growth, longest, 0.5 * e.effective_mass * e.closing_speed * e.closing_speed).force;
}

}  // namespace

PlatformImpulse platform_impulse(const FieldState& f, const std::vector<Touch>& touches) {
  PlatformImpulse sum;
  for (const Touch& touch : touches)
    if (touch.a == 0) add(f, touch, sum);
  return sum;
}

void log_events(const FieldState& f, const std::vector<Touch>& touches, double time,
                std::vector<ContactEvent>& events) {
  const Touch* touch = touches.data();
  const Touch* const last = touch + touches.size();
  while (touch != last && touch->a == 0) {
    const Touch* next = touch;
    while (next != last && next->a == 0 && next->b == touch->b) ++next;
    if (f.bodies.kind[touch->b] == BodyKind::floe) {  // fixed bodies are not ice
      ContactEvent event = merged(f, touch, next);
      if (event.impulse_normal > 0.0) {
        event.time = time;
        add_crushing(f, event);
        events.push_back(event);
      }
    }
    touch = next;
  }
}

PlatformStep ice_row(const FieldState& f, const std::vector<Touch>& touches) {
  PlatformStep row;
  PlatformImpulse ice;
  std::int32_t last = -1;
  for (const Touch& touch : touches) {
    if (touch.a != 0) break;
    if (f.bodies.kind[touch.b] != BodyKind::floe) continue;
    add(f, touch, ice);
    const bool pressed = touch.normal_impulse[0] > 0.0 || touch.normal_impulse[1] > 0.0;
    if (pressed && touch.b != last) {
      ++row.contacts;
      last = touch.b;
    }
  }
  row.ice_impulse = ice.impulse;
  row.ice_yaw_impulse = ice.yaw;
  return row;
}

}  // namespace gem::baseline
