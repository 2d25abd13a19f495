// A field of any number of floes, to measure how the cost of a time step grows with it.
#pragma once

#include <cmath>
#include <cstdint>

#include "gem/base/random.h"
#include "gem/field/field.h"
#include "gem/scene/scene_def.h"

namespace gem {

struct GrowthField {
  SceneDef scene;
  Bodies bodies;
};

/// `count` floes of a few shapes on open water, at the concentration of the main case, that drift through each other.
inline GrowthField growth_field(std::int64_t count) {
  GrowthField field;
  SceneDef& scene = field.scene;
  scene.boundary.present = scene.platform.present = false;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.floes.source = FloeSource::copied;
  scene.floes.placement = Placement::tiled;
  scene.floes.count = count;
  const double area_per_floe = 1500.0 * 400.0 / 4008.0;  // [m2]
  scene.floes.length_m = scene.floes.width_m = std::sqrt(area_per_floe * double(count));
  scene.floes.start_x_m = -scene.floes.length_m - 100.0;
  field.bodies = make_field(scene);
  RandomSequence random(Random(8, 0));
  for (Vec2& velocity : field.bodies.velocity) velocity = {0.25 + random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
  return field;
}

}  // namespace gem
