// Ice that floats, and friction that may jam.
#include <string>

#include "gem/scene/checks/checks.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

// Below this friction no pair of compact rigid bodies can jam (smallest bound over all polygons: 1.118, equilateral
// triangle).
constexpr double jamming_friction = 1.1;

}  // namespace

void check_ice(const SceneDef& s, SceneProblems& out) {
  const bool drafts = s.water.drag_law == DragLaw::quadratic && s.water.form_coefficient > 0.0;
  if (drafts && s.ice.density_kg_per_m3 >= s.water.density_kg_per_m3)
    out.push_back({"ice.density_kg_per_m3",
                   "the ice does not float (value " + plain_number_text(s.ice.density_kg_per_m3) +
                       ", allowed below water.density_kg_per_m3 = " + plain_number_text(s.water.density_kg_per_m3) +
                       " kg/m3)"});
}

void warn_of_ice(const SceneDef& scene, SceneWarnings& warnings) {
  const auto friction = [&](const char* key, double value) {
    if (value >= jamming_friction)
      warnings.push_back(std::string(key) + ": above the Painleve bound of compact floes (value " +
                         plain_number_text(value) + ", limit " + plain_number_text(jamming_friction) +
                         "); a sliding corner may jam; then it sticks instead");
  };
  friction("ice.friction_ice", scene.ice.friction_ice);
  friction("ice.friction_structure", scene.ice.friction_structure);
}

}  // namespace gem
