// Finds overlapping pairs with a grid and parts them.
#include "gem/export/floe_scale.h"

#include <algorithm>
#include <limits>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/generator/outline_grid.h"

namespace gem {
namespace {

// Room for rounding: a floe file may overlap by 1e-6 m.
constexpr double parting_margin = 1e-6;
constexpr double smallest_scale = 0.5;

using Outline_m = std::vector<Vec2>;

/// How far the corners reach along a direction.
double reach(const Outline_m& outline, Vec2 direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec2 corner : outline) most = std::max(most, dot(corner, direction));
  return most;
}

struct Overlap {
  double depth = std::numeric_limits<double>::infinity();  // negative: apart [m]
  Vec2 axis;                                               // from a to b
};

/// Offers the outward normals of `a`, whose sign is +1 if a is the first outline of the pair.
void offer_normals(const Outline_m& a, const Outline_m& b, double sign, Overlap& least) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    if (length(edge) == 0.0) continue;
    const Vec2 normal = (1.0 / length(edge)) * turned_right(edge);
    const double depth = dot(a[i], normal) + reach(b, -normal);
    if (depth < least.depth) least = {depth, sign * normal};
  }
}

Overlap overlap_of(const Outline_m& a, const Outline_m& b) {
  Overlap least;
  offer_normals(a, b, 1.0, least);
  offer_normals(b, a, -1.0, least);
  return least;
}

class Parting {
 public:
  Parting(const std::vector<FrameFloe>& floes, const std::vector<Outline_m>& obstacles)
      : floes_(floes), obstacles_(obstacles), scales_(floes.size(), 1.0) {
    for (const FrameFloe& floe : floes) world_.push_back(placed(floe.outline, floe.position, 0.0));
  }

  std::vector<double> scales() {
    if (floes_.empty()) return {};
    Box domain;
    double width = 0.0;
    for (const Outline_m& outline : world_) {
      const Box box = box_of(outline);
      domain.add(box.low);
      domain.add(box.high);
      width = std::max({width, box.high.x - box.low.x, box.high.y - box.low.y});
    }
    OutlineGrid grid(domain, std::max(width, 1e-3));
    for (std::size_t i = 0; i < world_.size(); ++i) {
      const Box box = box_of(world_[i]);
      grid.for_each_near(box, [&](std::size_t other) {
        part(other, i);
        return true;
      });
      grid.insert(i, box);
    }
    for (const Outline_m& obstacle : obstacles_)
      grid.for_each_near(box_of(obstacle), [&](std::size_t floe) {
        part_from(floe, obstacle);
        return true;
      });
    check();
    return scales_;
  }

 private:
  void shrink(std::size_t floe, double share) { scales_[floe] = std::min(scales_[floe], 1.0 - share); }

  void part(std::size_t a, std::size_t b) {
    const Overlap overlap = overlap_of(world_[a], world_[b]);
    if (overlap.depth <= 0.0) return;
    const double both = reach(floes_[a].outline, overlap.axis) + reach(floes_[b].outline, -overlap.axis);
    shrink(a, (overlap.depth + parting_margin) / both);
    shrink(b, (overlap.depth + parting_margin) / both);
  }

  void part_from(std::size_t floe, const Outline_m& obstacle) {
    const Overlap overlap = overlap_of(world_[floe], obstacle);
    if (overlap.depth > 0.0) shrink(floe, (overlap.depth + parting_margin) / reach(floes_[floe].outline, overlap.axis));
  }

  void check() const {
    for (std::size_t i = 0; i < scales_.size(); ++i)
      if (!(scales_[i] > smallest_scale))
        throw Error(ExitCode::usage, "floe " + std::to_string(floes_[i].index) + " at (" +
                                         number_text(floes_[i].position.x, 6) + ", " +
                                         number_text(floes_[i].position.y, 6) +
                                         ") m overlaps its neighbours too deeply (parted from them it would lose half "
                                         "its size or more); choose another time, or look at the run with gem report");
  }

  const std::vector<FrameFloe>& floes_;
  const std::vector<Outline_m>& obstacles_;
  std::vector<Outline_m> world_;
  std::vector<double> scales_;
};

}  // namespace

std::vector<double> parting_scales(const std::vector<FrameFloe>& floes, const std::vector<Outline_m>& obstacles) {
  return Parting(floes, obstacles).scales();
}

}  // namespace gem
