// Makes the field of a scene: platform, boundary, obstacles and floes, checked before anything runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Builds body 0 (the platform), the fixed bodies and the floes of a scene. The same scene gives the same bits on every
/// machine. The centroid of the platform's outline stands at anchor + start offset; without platform, body 0 is
/// inactive. Throws Error(scene_rejected) if the floes do not fit, overlap or lie outside the channel.
Bodies make_field(const SceneDef& scene);

/// Statistics of the floes for `gem case check` and the tests.
struct FieldSummary {
  std::int64_t floe_count = 0;
  double size_mean = 0.0;       // size = sqrt(area) [m]
  double size_deviation = 0.0;  // [m]
  double size_minimum = 0.0;
  double size_maximum = 0.0;
  double cover = 0.0;         // floe area over the area of the field rectangle [-]
  double smallest_gap = 0.0;  // between any two bodies [m]; infinity with fewer than two bodies
  double ice_mass = 0.0;      // [kg]
  double thickness_minimum = 0.0, thickness_maximum = 0.0;  // of the ice [m]
  std::vector<std::int64_t> sides;                          // sides[n]: floes with n sides
  std::vector<double> class_share;                          // share of the floe area in each ice class [-]
  std::int64_t clockwise_outlines = 0;  // listed or read floes that were given clockwise and were reversed
  double asked_cover = 0.0;             // sum of the classes' tenths / 10, to compare with `cover` [-]
  std::string concave;                  // what was done to outlines that are not convex; empty: nothing
  std::string concentration;            // what was reached, in words; empty if no concentration was asked
};

FieldSummary summarise(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
