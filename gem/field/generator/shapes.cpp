// Random floe shapes: a jittered ring of corners, stretched, turned and scaled to area 1.
#include "gem/field/generator/shapes.h"

#include <algorithm>
#include <cmath>

#include "gem/geometry/polygon.h"

namespace gem {
namespace {

std::size_t random_side_count(RandomSequence& numbers) {
  const double u = numbers.uniform();
  if (u < 0.25) return 4;
  if (u < 0.60) return 5;
  if (u < 0.85) return 6;
  if (u < 0.99) return 7;
  return 8 + numbers.below(5);
}

/// Corners at jittered angles and distances, before the stretch. `jitter` 0 is the regular polygon.
std::vector<Vec2> ring(std::size_t sides, double jitter, RandomSequence& numbers) {
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < sides; ++i) {
    const double turns =
        (static_cast<double>(i) + 0.45 * jitter * numbers.uniform(-1.0, 1.0)) / static_cast<double>(sides);
    const double distance = 1.0 - 0.3 * jitter * numbers.uniform();
    outline.push_back(rotate(strict::rotation_of_turns(turns), {distance, 0.0}));
  }
  return outline;
}

std::vector<Vec2> stretched_and_turned(const std::vector<Vec2>& outline, RandomSequence& numbers) {
  const double stretch = numbers.uniform(1.0, 1.7);
  const Rotation before = strict::rotation_of_turns(numbers.uniform());
  const Rotation after = strict::rotation_of_turns(numbers.uniform());
  std::vector<Vec2> result;
  for (const Vec2 p : outline) {
    const Vec2 q = rotate(before, p);
    result.push_back(rotate(after, {stretch * q.x, q.y}));
  }
  return result;
}

std::vector<Vec2> centred_with_area_one(const std::vector<Vec2>& outline) {
  const PolygonMoments moments = polygon_moments(outline);
  std::vector<Vec2> centred;
  for (const Vec2 p : outline) centred.push_back(p - moments.centroid);
  return scaled(centred, 1.0);
}

/// Every corner turns by at least about 10 degrees and no edge is shorter than 0.2 sqrt(area).
bool well_shaped(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[i] - outline[(i + n - 1) % n];
    const Vec2 after = outline[(i + 1) % n] - outline[i];
    if (length(after) < 0.2) return false;
    if (cross(before, after) < 0.17 * length(before) * length(after)) return false;
  }
  return first_non_convex_vertex(outline) < 0;
}

}  // namespace

std::vector<Vec2> random_shape(RandomSequence& numbers) {
  const std::size_t sides = random_side_count(numbers);
  // Strong jitter seldom gives a convex ring with many sides, so each failed try reduces the jitter a little.
  for (double jitter = 1.0;; jitter *= 0.95) {
    const auto outline = centred_with_area_one(stretched_and_turned(ring(sides, jitter, numbers), numbers));
    if (well_shaped(outline)) return outline;
  }
}

std::vector<Vec2> scaled(const std::vector<Vec2>& outline, double size) {
  const double factor = size / std::sqrt(polygon_moments(outline).area);
  std::vector<Vec2> result;
  for (const Vec2 p : outline) result.push_back(factor * p);
  return result;
}

}  // namespace gem
