// The settings of the engine `box2d`.
#pragma once

#include <string>
#include <vector>

#include "gem/engine/engine.h"

namespace gem::baseline {

struct Box2dOptions {
  int velocity_iterations = 8;
  int position_iterations = 3;
  double skin_m = 0.01;          // radius around every outline within which two bodies are kept apart [m]
  bool measures_quality = true;  // false: overlap and residual of StepQuality are NaN and cost nothing

  // Experiments: each changes one setting, to explain a difference from gem.
  int substeps = 1;           // Box2D steps per time step; drag and mooring act once per time step
  bool warm_starting = true;  // start from the impulses of the last step
  bool continuous = false;    // floes are bullets: stopped at their first contact within a step
  bool mixes_friction =
      false;  // friction is the root of the product of the two bodies' coefficients, not the pair's own
  double restitution_threshold_m_per_s = 0.0;  // slower impacts do not rebound; restitution is 0, so none do
};

/// Reads EngineOptions::baseline_settings: the members above by name, flags as 0 or 1. If a key occurs twice, the last
/// one counts. Throws Error(usage) for an unknown key or a value out of range.
Box2dOptions box2d_options(const std::vector<std::string>& settings);

/// The settings that the command line offers.
std::vector<BaselineSetting> box2d_settings();

}  // namespace gem::baseline
