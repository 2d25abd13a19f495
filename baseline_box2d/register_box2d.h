// Registers the engine `box2d` by name.
#pragma once

namespace gem::baseline {

/// Afterwards make_engine accepts "box2d". In a build without Box2D it does nothing.
void register_box2d();

}  // namespace gem::baseline
