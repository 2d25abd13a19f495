// Chooses the steps by the smallest floe and the time between frames.
#include "gem/view/pack/rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gem::view {

namespace {

double width_of(const std::vector<Vec2>& outline) {
  double radius = 0.0;
  for (const Vec2 corner : outline) radius = std::max(radius, length(corner));
  return 2.0 * radius;
}

/// The largest power of ten that is not above `value`.
double power_below(double value) { return std::pow(10.0, std::floor(std::log10(value) + 1e-9)); }

}  // namespace

Rounding rounding_for(const std::vector<std::vector<Vec2>>& outlines, double interval_s) {
  double smallest = 10.0;
  for (const auto& outline : outlines)
    if (const double width = width_of(outline); width > 0.0) smallest = std::min(smallest, width);
  const double interval = std::isfinite(interval_s) && interval_s > 0.0 ? interval_s : 1.0;
  Rounding steps;
  steps.place_m = std::clamp(power_below(smallest / 1000.0), 1e-5, 0.01);
  steps.angle_rad = 2.0 * std::numbers::pi / turn_steps;
  steps.speed_m_per_s = std::min(0.001, power_below(steps.place_m / interval));
  steps.spin_rad_per_s = std::min(1e-4, power_below(steps.angle_rad / interval));
  return steps;
}

}  // namespace gem::view
