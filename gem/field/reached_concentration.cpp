// Measures the concentration of a generated field.
#include "gem/field/reached_concentration.h"

#include <vector>

#include "gem/base/number_text.h"
#include "gem/field/generator/field_region.h"
#include "gem/field/generator/floe_count.h"

namespace gem {

ReachedConcentration reached_concentration(const SceneDef& scene, const Bodies& bodies) {
  const Box region = field_region(scene);
  std::vector<std::vector<Vec2>> obstacles;
  double floe_area = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const std::vector<Vec2> outline = world_outline(bodies, i);
    if (bodies.kind[i] == BodyKind::floe) {
      floe_area += area_within(region, outline);
    } else if (!outline.empty()) {
      obstacles.push_back(outline);
    }
  }
  const double water = free_area(region, obstacles);
  return {scene.floes.concentration, floe_area / water, concentration_tolerance(scene.floes, water)};
}

std::string concentration_text(const ReachedConcentration& concentration) {
  return fixed_text(concentration.reached, 4) + " of the free water (asked " + number_text(concentration.asked) +
         ", tolerance " + number_text(concentration.tolerance, 2) + ": half a floe)";
}

}  // namespace gem
