// The null model of one run's platform: the linear oscillator of the paper's dilute limit, hit at random times.
#pragma once

#include <optional>

#include "gem/scene/scene_def.h"
#include "validation/paper/analysis/chaos/impulse_oscillator.h"

namespace gem {

/// Natural period of the mooring, impulses at the rate `touches_per_s`, damping by the ice alone: floes that hit once
/// and leave give c = (4/3) rho_ice h cover D U, so zeta = c / (2 sqrt(k M)). h is the mean thickness of the classes,
/// weighted by their shares. Empty without mooring, ice or touches.
std::optional<ImpulseOscillator> null_model(const SceneDef& scene, double touches_per_s);

}  // namespace gem
