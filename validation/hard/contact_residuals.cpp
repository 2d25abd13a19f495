// Finds the contact points of all pairs from the bodies at the start of the time step, and computes the residuals of
// the impulse that the engine stored for each (zero if it stored none).
#include "validation/hard/contact_residuals.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gem/engine/cpu/kick_floes.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/step_constants.h"

namespace gem::hard {
namespace {

/// Whether a pair touches at the start of the time step, and its contact geometry.
bool touching(const FieldState& field, std::int32_t a, std::int32_t b, Contact& contact) {
  SeparatingAxes unknown;
  return find_contact(field, a, b, unknown, 0.0, contact);
}

/// Whether the engine may consider the pair: both active, at least one free to move, bounding circles near.
bool may_meet(const Bodies& bodies, std::int32_t a, std::int32_t b) {
  constexpr double near = 1.0;  // more than any contact reach here [m]
  const double reach = bodies.radius[a] + bodies.radius[b] + near;
  const Vec2 apart = bodies.position[b] - bodies.position[a];
  return bodies.active[a] && bodies.active[b] && bodies.inverse_mass[a] + bodies.inverse_mass[b] > 0.0 &&
         dot(apart, apart) < reach * reach;
}

ContactResiduals residuals_of(const FieldState& field, const Bodies& after, const Contact& contact, int k,
                              ContactImpulse impulse, const PointMemory& last) {
  const StepConstants& c = field.constants;
  const ContactSlot& slot = contact.slot[k];
  const ContactCompliance compliance = contact_compliance(collision_mass(after, contact.a), slot.arm_a,
                                                          collision_mass(after, contact.b), slot.arm_b, contact.normal);
  const double target = slot.separation > 0.0 ? -slot.separation / c.dt : 0.0;
  const Vec2 velocity = relative_velocity(after, contact, slot);
  const double u_n = dot(velocity, contact.normal) - target, u_t = dot(velocity, turned_left(contact.normal));
  const double friction = friction_of_pair(c.events, contact.a == 0);
  const double push = compliance.nn * impulse.normal, rub = compliance.tt * impulse.tangential;
  const double closing = target - dot(relative_velocity(field.bodies, contact, slot), contact.normal);
  const SpareFriction spare =
      spare_friction(friction, {last.impulse.normal, last.impulse.tangential}, last.rise, compliance, closing);
  const double cone = friction * std::max(0.0, impulse.normal);
  const double most = compliance.tt * (cone + spare.left), least = -compliance.tt * (cone + spare.right);

  ContactResiduals found;
  found.points = 1;
  found.pull = std::max(0.0, -push);
  found.closing = std::max(0.0, -u_n);
  found.complementarity = std::fabs(std::min(push, u_n));
  found.cone = std::max({0.0, rub - most, least - rub});
  found.slip = std::fabs(rub - std::clamp(rub - u_t, least, most));
  return found;
}

std::map<std::uint64_t, PointMemory> memory_by_key(const EngineState& state) {
  std::map<std::uint64_t, PointMemory> memory;
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i) memory[state.impulse_key[i]] = state.impulse_value[i];
  return memory;
}

}  // namespace

void ContactResiduals::merge(const ContactResiduals& other) {
  points += other.points;
  without_point += other.without_point;
  pull = std::max(pull, other.pull);
  closing = std::max(closing, other.closing);
  complementarity = std::max(complementarity, other.complementarity);
  cone = std::max(cone, other.cone);
  slip = std::max(slip, other.slip);
}

double ContactResiduals::worst() const { return std::max({pull, closing, complementarity, cone, slip}); }

ContactResiduals contact_residuals(const SceneDef& scene, const EngineState& before, const EngineState& after) {
  FieldState field = make_field_state(before.bodies, step_constants(scene, before.bodies));
  const std::map<std::uint64_t, PointMemory> last = memory_by_key(before);
  std::map<std::uint64_t, PointMemory> kept = memory_by_key(after);
  const auto of = [](const std::map<std::uint64_t, PointMemory>& memory, std::uint64_t key) {
    const auto found = memory.find(key);
    return found == memory.end() ? PointMemory{} : found->second;
  };
  ContactResiduals worst;
  const auto count = static_cast<std::int32_t>(before.bodies.count());
  kick_floes(field, 0, count);  // the velocities before the contacts; positions and outlines stay
  Contact contact;
  for (std::int32_t a = 0; a < count; ++a)
    for (std::int32_t b = a + 1; b < count; ++b) {
      if (!may_meet(before.bodies, a, b) || !touching(field, a, b, contact)) continue;
      for (int k = 0; k < contact.count; ++k) {
        const std::uint64_t key = contact_key(contact.a, contact.b, contact.slot[k].feature);
        const PointImpulse<double> now = of(kept, key).impulse;
        worst.merge(residuals_of(field, after.bodies, contact, k, {now.normal, now.tangential}, of(last, key)));
        kept.erase(key);
      }
    }
  worst.without_point = static_cast<std::int64_t>(kept.size());
  return worst;
}

}  // namespace gem::hard
