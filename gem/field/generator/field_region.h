// The rectangle of a generated field and the free water in it.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/field/generator/outline_grid.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// The field's rectangle; not wider than the channel at its wider end.
Box field_region(const SceneDef& scene);

/// Area of the part of a convex counter-clockwise outline that lies in the box [m2].
double area_within(const Box& box, const std::vector<Vec2>& outline);

/// Area of the box less that of the obstacles in it, which do not overlap each other [m2].
double free_area(const Box& box, const std::vector<std::vector<Vec2>>& obstacles);

}  // namespace gem
