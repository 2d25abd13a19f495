// Makes the engine `box2d` known by name.
#pragma once

namespace gem::baseline {

/// After this, make_engine accepts "box2d". Without Box2D in the build it does nothing.
void register_box2d();

}  // namespace gem::baseline
