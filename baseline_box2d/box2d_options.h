// The settings of the engine `box2d`.
#pragma once

#include <string>
#include <vector>

#include "gem/engine/engine.h"

namespace gem::baseline {

struct Box2dOptions {
  int velocity_iterations = 8;
  int position_iterations = 3;
  double skin_m = 0.01;          // radius round every outline within which two bodies are held apart [m]
  bool measures_quality = true;  // false: overlap and residual of MomentQuality are NaN, and cost nothing

  // experiments: what explains a difference from gem, one at a time
  int substeps = 1;             // steps in one time step; drag and mooring act once
  bool warm_starting = true;    // from the impulses of the last step
  bool continuous = false;      // floes are bullets: stopped at the first touch within a step
  bool mixes_friction = false;  // the root of the product of the two bodies' coefficients, not the pair's
  double restitution_threshold_m_per_s = 0.0;  // slower hits do not rebound; nothing does, as restitution is 0
};

/// Reads EngineOptions::baseline_settings: the members above by name, switches as 0 or 1; the last of a key counts.
/// Throws Error(usage) for another key or a value out of range.
Box2dOptions box2d_options(const std::vector<std::string>& settings);

/// What the command line offers of them.
std::vector<BaselineSetting> box2d_settings();

}  // namespace gem::baseline
