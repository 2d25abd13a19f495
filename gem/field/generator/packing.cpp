// Packing by growth: shrunk floes grow in steps while overlapping floes push each other apart.
//
//   place the floes, shrunk to a cover at which random placement is easy
//   for each growth step up to full size:
//     sweep until every pair keeps the gap: move and turn the pairs that do not
//     from time to time move a floe that stays squeezed to the best of some random positions
//   fail if the last step leaves a pair closer than the gap
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gem/base/random.h"
#include "gem/field/generator/placement.h"
#include "gem/field/generator/separating_axis.h"
#include "gem/field/generator/shapes.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr double starting_cover = 0.35;
constexpr int growth_steps = 40;
constexpr int sweeps_per_step = 30;
constexpr int sweeps_at_end = 6000;
constexpr int sweeps_per_jump = 30;
constexpr int places_per_jump = 400;
constexpr double squeezed = 0.1;  // overlap over size from which a floe may jump [-]
constexpr int sweeps_per_list = 6;
constexpr double list_margin = 0.6;
constexpr double largest_move =
    0.05;  // largest displacement per correction [m]: the pair list stays valid for its sweeps

struct PackedBody {
  std::vector<Vec2> shape;    // at full size, centred
  std::vector<Vec2> outline;  // at the current size and pose, world
  Pose pose;
  Box box;
  double size = 0.0;  // sqrt(area) at full size [m]
  double inverse_weight = 0.0;
  double inverse_inertia = 0.0;
};

void place_outline(PackedBody& body, double scale) {
  for (std::size_t v = 0; v < body.shape.size(); ++v)
    body.outline[v] = body.pose.position + rotate(body.pose.rotation, scale * body.shape[v]);
  body.box = box_of(body.outline);
}

/// Turns by about `angle` without trigonometry: the exact rotation whose half-angle tangent is angle / 2.
Rotation turned_by(Rotation q, double angle) {
  const double t = 0.5 * angle;
  const double scale = 1.0 / (1.0 + t * t);
  const double c = (1.0 - t * t) * scale;
  const double s = 2.0 * t * scale;
  const Rotation r = {c * q.cosine - s * q.sine, s * q.cosine + c * q.sine};
  const double size = std::sqrt(r.cosine * r.cosine + r.sine * r.sine);
  return {r.cosine / size, r.sine / size};
}

class Packing {
 public:
  Packing(const PlacementTask& task, const std::vector<Pose>& poses)
      : gap_(task.gap),
        target_(1.2 * task.gap + 1e-4),
        numbers_(Random(task.seed, static_cast<std::uint32_t>(FieldStream::packing))) {
    for (std::size_t i = 0; i < task.outlines.size(); ++i) add_floe(task.outlines[i], poses[i]);
    floe_count_ = bodies_.size();
    for (const auto& obstacle : task.obstacles) add_obstacle(obstacle);
    add_region_walls(task.region);
    domain_ = task.region;
  }

  /// True if every pair keeps the gap.
  bool relax(double scale, int sweeps) {
    for (std::size_t i = 0; i < floe_count_; ++i) place_outline(bodies_[i], scale);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (sweep % sweeps_per_list == 0) {
        list_pairs();
        if (settled()) return true;
      }
      for (const auto& [a, b] : pairs_) separate(bodies_[a], bodies_[b], scale);
      if (sweep % sweeps_per_jump == sweeps_per_jump - 1) free_squeezed(scale);
    }
    list_pairs();
    return settled();
  }

  std::vector<Pose> poses() const {
    std::vector<Pose> result;
    for (std::size_t i = 0; i < floe_count_; ++i) result.push_back(bodies_[i].pose);
    return result;
  }

 private:
  void add_floe(const std::vector<Vec2>& shape, const Pose& pose) {
    const PolygonMoments moments = polygon_moments(shape);
    // The weight grows with the size, not the area, so that a small floe between two large ones can still move them.
    const double size = std::sqrt(moments.area);
    bodies_.push_back({shape, shape, pose, {}, size, 1.0 / size, size / moments.second_moment});
  }
  void add_obstacle(const std::vector<Vec2>& outline) {
    bodies_.push_back({{}, outline, {}, box_of(outline), 0.0, 0.0, 0.0});
  }
  /// No gap is needed at the region's edge, so the walls stand back by the gap.
  void add_region_walls(const Box& region) {
    constexpr double depth = 50.0;
    const Vec2 low = region.low - Vec2{gap_, gap_};
    const Vec2 high = region.high + Vec2{gap_, gap_};
    const auto wall = [&](Vec2 a, Vec2 b) { add_obstacle({a, {b.x, a.y}, b, {a.x, b.y}}); };
    wall({low.x - depth, low.y - depth}, {low.x, high.y + depth});
    wall({high.x, low.y - depth}, {high.x + depth, high.y + depth});
    wall({low.x, low.y - depth}, {high.x, low.y});
    wall({low.x, high.y}, {high.x, high.y + depth});
  }

  OutlineGrid filed_bodies() const {
    OutlineGrid grid(domain_, 8.0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) grid.insert(i, bodies_[i].box);
    return grid;
  }

  void list_pairs() {
    const OutlineGrid grid = filed_bodies();
    pairs_.clear();
    for (std::size_t i = 0; i < floe_count_; ++i) {
      Box near = bodies_[i].box;
      near.grow(list_margin);
      grid.for_each_near(near, [&](std::size_t j) {
        if (j > i) pairs_.emplace_back(i, j);
        return true;
      });
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  bool settled() const {
    return std::all_of(pairs_.begin(), pairs_.end(), [&](const auto& pair) {
      return separating_axis(bodies_[pair.first].outline, bodies_[pair.second].outline, gap_).separation >= gap_;
    });
  }

  /// Deepest overlap of floe i with any other body [m]. Stops early above `enough`.
  double overlap(const OutlineGrid& grid, std::size_t i, const PackedBody& body, double enough) const {
    double deepest = 0.0;
    grid.for_each_near(body.box, [&](std::size_t j) {
      if (j != i) deepest = std::max(deepest, -separating_axis(body.outline, bodies_[j].outline, 0.0).separation);
      return deepest < enough;
    });
    return deepest;
  }

  void free_squeezed(double scale) {
    OutlineGrid grid = filed_bodies();
    for (std::size_t i = 0; i < floe_count_; ++i) {
      double best = overlap(grid, i, bodies_[i], std::numeric_limits<double>::infinity());
      if (best < squeezed * scale * bodies_[i].size) continue;
      PackedBody trial = bodies_[i];
      for (int place = 0; place < places_per_jump; ++place) {
        const double x = numbers_.uniform(domain_.low.x, domain_.high.x);
        trial.pose.position = {x, numbers_.uniform(domain_.low.y, domain_.high.y)};
        trial.pose.rotation = strict::rotation_of_turns(numbers_.uniform());
        place_outline(trial, scale);
        const double depth = overlap(grid, i, trial, best);
        if (depth >= best) continue;
        best = depth;
        bodies_[i] = trial;
      }
      grid.insert(i, bodies_[i].box);
    }
  }

  void separate(PackedBody& a, PackedBody& b, double scale) const {
    Box near = a.box;
    near.grow(target_);
    if (!near.meets(b.box)) return;
    const SeparatingAxis axis = separating_axis(a.outline, b.outline, target_);
    if (axis.separation >= target_) return;
    const double arm_a = cross(axis.point - a.pose.position, axis.normal);
    const double arm_b = cross(axis.point - b.pose.position, axis.normal);
    const double give =
        a.inverse_weight + b.inverse_weight + a.inverse_inertia * arm_a * arm_a + b.inverse_inertia * arm_b * arm_b;
    const double push = std::min(target_ - axis.separation, largest_move) / give;
    shift(a, -push, arm_a, axis.normal, scale);
    shift(b, push, arm_b, axis.normal, scale);
  }

  void shift(PackedBody& body, double push, double arm, Vec2 normal, double scale) const {
    if (body.inverse_weight == 0.0) return;
    body.pose.position += (push * body.inverse_weight) * normal;
    body.pose.rotation = turned_by(body.pose.rotation, push * body.inverse_inertia * arm);
    place_outline(body, scale);
  }

  double gap_;
  double target_;
  std::vector<PackedBody> bodies_;
  std::size_t floe_count_ = 0;
  Box domain_;
  RandomSequence numbers_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

/// Shrinks the floes until random placement succeeds. Returns their poses and the scale.
std::optional<std::pair<std::vector<Pose>, double>> place_shrunk(const PlacementTask& task) {
  double floe_area = 0.0;
  for (const auto& outline : task.outlines) floe_area += polygon_moments(outline).area;
  const Vec2 size = task.region.high - task.region.low;
  const double cover = floe_area / (size.x * size.y);
  if (cover > 1.0) return std::nullopt;
  for (double scale = std::min(0.9, std::sqrt(starting_cover / cover)); scale > 0.3; scale *= 0.9) {
    PlacementTask shrunk = task;
    for (auto& outline : shrunk.outlines)
      for (Vec2& p : outline) p = scale * p;
    if (auto poses = place_at_random(shrunk)) return std::pair{*poses, scale};
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Pose>> pack(const PlacementTask& task) {
  const auto start = place_shrunk(task);
  if (!start) return std::nullopt;
  Packing packing(task, start->first);
  for (int step = 1; step < growth_steps; ++step)
    packing.relax(start->second + (1.0 - start->second) * step / growth_steps, sweeps_per_step);
  if (!packing.relax(1.0, sweeps_at_end)) return std::nullopt;
  return packing.poses();
}

}  // namespace gem
