#include "validation/verification/baselines.h"

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "baseline_box2d/register_box2d.h"

namespace gem::verification {
namespace {

/// Box2D with its usual iterations and skin; with so many iterations that more change nothing; with a skin that lets
/// the true outlines rest on each other.
const struct {
  const char* name;
  std::vector<std::string> settings;
} variants[] = {{"box2d_8_3", {}},
                {"box2d_200_50", {"velocity_iterations=200", "position_iterations=50"}},
                {"box2d_thin_skin", {"skin_m=0.0025"}}};

void register_variants() {
  baseline::register_box2d();
  for (const auto& variant : variants)
    register_baseline(variant.name, [&variant](const SceneDef& scene, Bodies bodies, const EngineOptions& options) {
      EngineOptions chosen = options;
      chosen.name = "box2d";
      chosen.baseline_settings = variant.settings;
      return make_engine(scene, std::move(bodies), chosen);
    });
}

}  // namespace

std::vector<Setting> surveyed_baselines() {
  if (std::getenv("GEM_BASELINES") == nullptr) return {};
  [[maybe_unused]] static const bool once = [] {
    register_variants();
    return true;
  }();
  std::vector<Setting> settings;
  for (const auto& variant : variants) settings.push_back({variant.name, ContactSolver::coupled});
  return settings;
}

}  // namespace gem::verification
