// Rebuilds each contact point from the bodies as they stood and weighs the impulse that the engine kept for it.
#include "validation/hard/contact_residuals.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gem/engine/contact_stages.h"
#include "gem/engine/moment_constants.h"

namespace gem::hard {
namespace {

/// The geometry of one pair at the start of the moment.
bool touching(const FieldState& field, std::int32_t a, std::int32_t b, Contact& contact) {
  SeparatingAxes unknown;
  return find_contact(field, a, b, unknown, 0.0, contact);
}

ContactResiduals residuals_of(const FieldState& field, const Bodies& after, const Contact& contact, int k,
                              ContactImpulse impulse) {
  const MomentConstants& c = field.constants;
  const ContactSlot& slot = contact.slot[k];
  const ContactCompliance compliance = contact_compliance(collision_mass(after, contact.a), slot.arm_a,
                                                          collision_mass(after, contact.b), slot.arm_b, contact.normal);
  const double target = slot.separation > 0.0 ? -slot.separation / c.dt : 0.0;
  const Vec2 velocity = relative_velocity(after, contact, slot);
  const double u_n = dot(velocity, contact.normal) - target, u_t = dot(velocity, turned_left(contact.normal));
  const double friction = contact.a == 0 ? c.friction_structure : c.friction_ice;
  const double push = compliance.nn * impulse.normal, rub = compliance.tt * impulse.tangential;
  const double bound = compliance.tt * friction * std::max(0.0, impulse.normal);

  ContactResiduals found;
  found.points = 1;
  found.pull = std::max(0.0, -push);
  found.closing = std::max(0.0, -u_n);
  found.complementarity = std::fabs(std::min(push, u_n));
  found.cone = std::max(0.0, std::fabs(rub) - bound);
  found.slip = std::fabs(rub - std::clamp(rub - u_t, -bound, bound));
  return found;
}

}  // namespace

void ContactResiduals::merge(const ContactResiduals& other) {
  points += other.points;
  pull = std::max(pull, other.pull);
  closing = std::max(closing, other.closing);
  complementarity = std::max(complementarity, other.complementarity);
  cone = std::max(cone, other.cone);
  slip = std::max(slip, other.slip);
}

double ContactResiduals::worst() const { return std::max({pull, closing, complementarity, cone, slip}); }

ContactResiduals contact_residuals(const SceneDef& scene, const EngineState& before, const EngineState& after) {
  const FieldState field = make_field_state(before.bodies, moment_constants(scene, before.bodies));
  ContactResiduals worst;
  Contact contact;
  std::uint64_t pair = ~std::uint64_t{0};
  bool found = false;
  for (std::size_t i = 0; i < after.impulse_key.size(); ++i) {
    const std::uint64_t key = after.impulse_key[i];
    if (key >> feature_bits != pair) {
      pair = key >> feature_bits;
      const auto a = static_cast<std::int32_t>(pair >> 26), b = static_cast<std::int32_t>(pair & ((1u << 26) - 1));
      found = touching(field, a, b, contact);
    }
    if (!found) continue;
    for (int k = 0; k < contact.count; ++k)
      if (contact_key(contact.a, contact.b, contact.slot[k].feature) == key)
        worst.merge(residuals_of(field, after.bodies, contact, k,
                                 {after.impulse_value[i].normal, after.impulse_value[i].tangential}));
  }
  return worst;
}

}  // namespace gem::hard
