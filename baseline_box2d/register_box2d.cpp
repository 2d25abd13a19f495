#include "baseline_box2d/register_box2d.h"

#include <utility>

#include "baseline_box2d/box2d_engine.h"

namespace gem::baseline {

void register_box2d() {
  register_baseline("box2d", [](const SceneDef& scene, Bodies bodies, const EngineOptions& options) {
    return std::unique_ptr<Engine>(std::make_unique<Box2dEngine>(scene, std::move(bodies), options.baseline));
  });
}

}  // namespace gem::baseline
