// One pass over the quality of every time step, and a look at the floes at every frame.
#include "gem/run/run_watch.h"

#include <algorithm>
#include <cmath>

#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_drive.h"

namespace gem {
namespace {

/// Largest of the drift in current and wind, the floes' speeds at the start (with their spin) and the platform's free
/// swing [m/s].
double speed_scale_of(const SceneDef& scene, const Bodies& bodies) {
  double scale = std::max(drive_speed(scene), platform_speed_bound(scene));
  for (std::size_t i = 1; i < bodies.count(); ++i)
    scale = std::max(scale, length(bodies.velocity[i]) + bodies.radius[i] * std::abs(bodies.spin[i]));
  return scale;
}

double contact_energy(const Ledger& ledger) {
  double sum = ledger.crack_energy;
  for (const Channel channel : {Channel::impact, Channel::friction, Channel::elastic, Channel::repair})
    sum += ledger[channel].energy;
  return sum;
}

}  // namespace

RunWatch::RunWatch(const SceneDef& scene, Engine& engine)
    : time_step_(scene.numerics.time_step_s),
      has_platform_(scene.platform.present),
      asked_residual_(engine.asked_residual()) {
  now_.measures.speed_scale = speed_scale_of(scene, engine.bodies());
  const IceDef& ice = scene.ice;
  const double other_side =
      scene.platform.present ? std::min(ice.friction_ice, ice.friction_structure) : ice.friction_ice;
  now_.measures.compliant = is_compliant(scene);
  now_.measures.squeeze_friction = 0.5 * (ice.friction_ice + other_side);
}

void RunWatch::add(const StepLog& log) {
  for (std::size_t i = 0; i < log.quality.size(); ++i) {
    add(log.quality[i], time_step_ * static_cast<double>(++now_.step));
    if (has_platform_) now_.force.add(log.platform[i].ice_impulse);
  }
}

void RunWatch::add(const StepQuality& quality, double time) {
  now_.measures.overlap_share.raise(quality.maximum_share, time);
  now_.energy_created += quality.energy_created;
  if (std::isnan(asked_residual_) || quality.contacts == 0) return;
  ++now_.contact_steps;
  now_.residuals.add(quality.residual);
  now_.measures.residual.raise(quality.residual, time);
  now_.unfinished += quality.residual > asked_residual_;
}

void RunWatch::look_at(const Bodies& bodies, const StatsRow& books) {
  for (std::size_t i = first_floe(bodies); i < bodies.count(); ++i)
    if (bodies.active[i] != 0) now_.measures.floe_speed.raise(length(bodies.velocity[i]), books.time);
  now_.measures.energy_largest = std::max(now_.measures.energy_largest, books.kinetic_energy);
  if (now_.measures.compliant) return look_at_contacts(books.ledger.contact);
  now_.measures.energy_created = now_.energy_created;
  now_.measures.energy_lost = now_.energy_created - contact_energy(books.ledger);
}

void RunWatch::look_at_contacts(const ContactEnergy& contact) {
  RunMeasures& m = now_.measures;
  m.energy_created = std::fmax(m.energy_created, std::fabs(contact.left()));
  m.energy_lost = contact.crushed + contact.damped + contact.friction;
  m.softened_share = contact.load > 0.0 ? contact.softened / contact.load : 0.0;
}

RunMeasures RunWatch::measures() const {
  RunMeasures m = now_.measures;
  m.nyquist_share = now_.force.value();
  m.loaded_steps = now_.force.loaded();
  if (std::isnan(asked_residual_) || now_.step == 0) return m;
  const auto steps = static_cast<double>(std::max<std::int64_t>(now_.contact_steps, 1));
  m.unfinished_share = static_cast<double>(now_.unfinished) / steps;
  // the upper edge of a class of the histogram may exceed the largest value
  const double worst = now_.contact_steps > 0 ? m.residual.value : 0.0;
  m.residual_median = std::min(now_.residuals.quantile(0.5), worst);
  m.residual_most = std::min(now_.residuals.quantile(0.9), worst);
  return m;
}

}  // namespace gem
