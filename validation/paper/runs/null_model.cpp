// Computes the parameters of the oscillator from the scene.
#include "validation/paper/runs/null_model.h"

#include <cmath>
#include <numbers>

namespace gem {

std::optional<ImpulseOscillator> null_model(const SceneDef& scene, double touches_per_s) {
  double depth = 0.0;  // equivalent thickness: thickness times cover [m]
  for (const IceClassDef& ice : scene.floes.classes) depth += ice.thickness_m * ice.tenths / 10.0;
  const double stiffness = scene.mooring.stiffness_N_per_m;
  if (!(stiffness > 0.0) || !(depth > 0.0) || !(touches_per_s > 0.0)) return std::nullopt;
  const double damping = 4.0 / 3.0 * scene.ice.density_kg_per_m3 * depth * scene.platform.diameter_m *
                         length(scene.current.velocity_m_per_s);
  ImpulseOscillator model;
  model.natural_period = 2.0 * std::numbers::pi * std::sqrt(scene.platform.mass_kg / stiffness);
  model.damping_ratio = damping / (2.0 * std::sqrt(stiffness * scene.platform.mass_kg));
  model.impulse_rate = touches_per_s;
  return model;
}

}  // namespace gem
