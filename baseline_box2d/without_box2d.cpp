// Replaces register_box2d.cpp in a build without Box2D.
#include "baseline_box2d/register_box2d.h"

namespace gem::baseline {

void register_box2d() {}

}  // namespace gem::baseline
