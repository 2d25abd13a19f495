#include "baseline_box2d/register_box2d.h"

#include <utility>

#include "baseline_box2d/box2d_engine.h"

namespace gem::baseline {

void register_box2d() {
  const BaselineMaker make = [](const SceneDef& scene, Bodies bodies, const EngineOptions& options) {
    const Box2dOptions chosen = box2d_options(options.baseline_settings);
    return std::unique_ptr<Engine>(std::make_unique<Box2dEngine>(scene, std::move(bodies), chosen));
  };
  register_baseline("box2d", make, box2d_settings());
}

}  // namespace gem::baseline
