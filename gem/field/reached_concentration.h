// The concentration that a generated field has reached, beside the one that was asked for.
#pragma once

#include <string>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Shares of the free water in the field's rectangle: the rectangle less boundary and obstacles [-].
struct ReachedConcentration {
  double asked = 0.0;
  double reached = 0.0;
  double tolerance = 0.0;  ///< the number of floes is whole: half a floe of mean area
};

/// Measured on the exact areas of the floes, cut at the rectangle. `scene` asks for a concentration.
ReachedConcentration reached_concentration(const SceneDef& scene, const Bodies& bodies);

/// "0.9001 of the free water (asked 0.9, within 0.0005)".
std::string concentration_text(const ReachedConcentration& concentration);

}  // namespace gem
