// Random sequential placement with a grid.
#include "gem/field/generator/placement.h"

#include <algorithm>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/base/random.h"
#include "gem/field/generator/floe_set.h"
#include "gem/field/generator/separating_axis.h"
#include "gem/field/generator/shapes.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr int trials_maximum = 20000;
constexpr double cell_size = 8.0;

std::vector<Vec2> moved(const std::vector<Vec2>& outline, Vec2 by) {
  std::vector<Vec2> result = outline;
  for (Vec2& p : result) p += by;
  return result;
}

std::vector<double> areas_of(const std::vector<std::vector<Vec2>>& outlines) {
  std::vector<double> areas;
  for (const auto& outline : outlines) areas.push_back(polygon_moments(outline).area);
  return areas;
}

/// Everything placed so far, obstacles first.
class Placed {
 public:
  explicit Placed(const PlacementTask& task) : gap_(task.gap), grid_(task.region, cell_size) {
    for (const auto& obstacle : task.obstacles) add(obstacle);
  }
  void add(const std::vector<Vec2>& outline) {
    Box box = box_of(outline);
    box.grow(gap_);
    grid_.insert(outlines_.size(), box);
    outlines_.push_back(outline);
  }
  bool has_room_for(const std::vector<Vec2>& outline) const {
    return grid_.for_each_near(box_of(outline), [&](std::size_t id) {
      return separating_axis(outlines_[id], outline, gap_).separation >= gap_;
    });
  }

 private:
  double gap_;
  OutlineGrid grid_;
  std::vector<std::vector<Vec2>> outlines_;
};

/// True if an obstacle's box reaches into the region, not only to its edge.
bool reaches_into(const Box& region, const std::vector<Vec2>& obstacle) {
  constexpr double touch = 1e-6;
  Box box = box_of(obstacle);
  box.grow(-touch);
  return box.meets(region);
}

}  // namespace

std::optional<std::vector<Pose>> place_at_random(const PlacementTask& task) {
  std::vector<Pose> poses(task.outlines.size());
  Placed placed(task);
  for (const std::size_t floe : largest_first(areas_of(task.outlines))) {
    RandomSequence numbers(
        Random(task.seed, static_cast<std::uint32_t>(FieldStream::position), static_cast<std::uint32_t>(floe)));
    const Box own = box_of(task.outlines[floe]);
    const Vec2 low = task.region.low - own.low;
    const Vec2 high = task.region.high - own.high;
    if (!(low.x <= high.x && low.y <= high.y)) return std::nullopt;
    bool found = false;
    for (int trial = 0; trial < trials_maximum && !found; ++trial) {
      const double x = numbers.uniform(low.x, high.x);
      const Vec2 position = {x, numbers.uniform(low.y, high.y)};
      const std::vector<Vec2> outline = moved(task.outlines[floe], position);
      if (!placed.has_room_for(outline)) continue;
      placed.add(outline);
      poses[floe].position = position;
      found = true;
    }
    if (!found) return std::nullopt;
  }
  return poses;
}

std::vector<Pose> place(const PlacementTask& task) {
  if (auto poses = place_at_random(task)) return *poses;
  if (auto poses = pack(task)) return *poses;
  double floe_area = 0.0;
  for (const double area : areas_of(task.outlines)) floe_area += area;
  const Vec2 size = task.region.high - task.region.low;
  const bool taken = std::any_of(task.obstacles.begin(), task.obstacles.end(),
                                 [&](const auto& obstacle) { return reaches_into(task.region, obstacle); });
  throw Error(
      ExitCode::scene_rejected,
      "floes: " + std::to_string(task.outlines.size()) + " floes do not fit (they cover " +
          number_text(floe_area / (size.x * size.y), 3) + " of the field rectangle" +
          (taken ? ", part of which the boundary or an obstacle takes; about 0.8 of the free water is the limit)"
                 : "; about 0.8 is the limit)") +
          " lower floes.count or enlarge floes.length_m or floes.width_m");
}

}  // namespace gem
