// Makes a mosaic:
//
//   place shrunk octagons of the asked areas at random; their centres are the sites
//   a few times: step the weights towards the asked areas, move the sites to the centroids (rounds the cells)
//   until every floe has room: give more to cells whose usable part is too small, and step the weights
//   shrink every usable part to the floe's exact area
#include "gem/field/generator/mosaic.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "gem/field/generator/cell_areas.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr int rounding_rounds = 4;
constexpr int evening_rounds = 2;
constexpr int correction_rounds = 40;
constexpr double shortest_edge = 0.1;  // over sqrt(area) [-]
constexpr double flattest_turn = 0.1;  // sine of the turn at a corner [-]
constexpr std::size_t sides_maximum = 12;
constexpr double pi = 3.14159265358979323846;

using Outline = std::vector<Vec2>;

double area_of(const Outline& outline) { return outline.size() < 3 ? 0.0 : polygon_moments(outline).area; }

/// The octagon around a circle of this area.
Outline octagon_around(double area) {
  const double radius = std::sqrt(area / pi);
  Outline outline;
  for (int i = 0; i < 8; ++i) {
    // tan(pi / 8) = sqrt(2) - 1 gives the corners of an octagon with an inner radius of 1.
    const double t = std::sqrt(2.0) - 1.0;
    const Vec2 corner = i % 2 == 0 ? Vec2{1.0, -t} : Vec2{1.0, t};
    Rotation turn = {1.0, 0.0};
    if (i / 2 == 1) turn = {0.0, 1.0};
    if (i / 2 == 2) turn = {-1.0, 0.0};
    if (i / 2 == 3) turn = {0.0, -1.0};
    outline.push_back(radius * rotate(turn, corner));
  }
  return outline;
}

/// Centres of octagons that were placed at random. Their inner circles do not overlap, so that a power diagram with the
/// circles' squared radii as weights has no empty cell.
std::optional<PowerSites> first_sites(const PlacementTask& task, const std::vector<double>& area) {
  for (double share = 0.3; share > 0.02; share *= 0.7) {
    PlacementTask shrunk = task;
    PowerSites sites;
    for (std::size_t i = 0; i < area.size(); ++i) {
      shrunk.outlines[i] = octagon_around(share * area[i]);
      sites.weight.push_back(share * area[i] / pi);
    }
    const auto poses = place_at_random(shrunk);
    if (!poses) continue;
    for (const Pose& pose : *poses) sites.position.push_back(pose.position);
    return sites;
  }
  return std::nullopt;
}

/// The part of a cell at least `distance` from all its edges.
Outline inset(const Outline& cell, double distance) {
  LabelledPolygon rest{cell, std::vector<int>(cell.size(), 0)};
  for (std::size_t e = 0; e < cell.size() && !rest.corner.empty(); ++e) {
    const Vec2 edge = cell[(e + 1) % cell.size()] - cell[e];
    const double size = length(edge);
    if (size == 0.0) continue;
    const Vec2 outward = (1.0 / size) * turned_right(edge);
    cut(rest, outward, dot(outward, cell[e]) - distance, 0);
  }
  return rest.corner;
}

/// Area that is lost without corner i.
double corner_area(const Outline& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2 before = outline[i] - outline[(i + n - 1) % n];
  return 0.5 * cross(before, outline[(i + 1) % n] - outline[i]);
}

bool poor_corner(const Outline& outline, std::size_t i, double edge) {
  const std::size_t n = outline.size();
  const Vec2 before = outline[i] - outline[(i + n - 1) % n];
  const Vec2 after = outline[(i + 1) % n] - outline[i];
  if (length(before) < edge || length(after) < edge) return true;
  return cross(before, after) < flattest_turn * length(before) * length(after);
}

/// Leaves out poor corners, the one that costs least area first, and then corners beyond the largest number of sides.
Outline without_poor_corners(Outline outline) {
  const double edge = shortest_edge * std::sqrt(area_of(outline));
  while (outline.size() > 3) {
    std::size_t worst = outline.size();
    const bool too_many = outline.size() > sides_maximum;
    for (std::size_t i = 0; i < outline.size(); ++i)
      if ((too_many || poor_corner(outline, i, edge)) &&
          (worst == outline.size() || corner_area(outline, i) < corner_area(outline, worst)))
        worst = i;
    if (worst == outline.size()) break;
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return outline;
}

struct UsableParts {
  std::vector<Outline> outline;
  std::vector<double> area;
  double room = 0.0;   // smallest usable area over floe area
  double share = 0.0;  // of the floe area that has room
};

UsableParts usable_parts(const Diagram& diagram, const std::vector<double>& floe_area, double gap) {
  UsableParts parts;
  double fitting = 0.0;
  parts.room = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < floe_area.size(); ++i) {
    parts.outline.push_back(without_poor_corners(inset(diagram.cells[i].corner, 0.5 * gap)));
    parts.area.push_back(area_of(parts.outline[i]));
    parts.room = std::min(parts.room, parts.area[i] / floe_area[i]);
    fitting += std::min(parts.area[i], floe_area[i]);
  }
  parts.share = fitting / std::accumulate(floe_area.begin(), floe_area.end(), 0.0);
  return parts;
}

MosaicFloe floe_in(const Outline& part, double part_area, double floe_area) {
  const Vec2 centroid = polygon_moments(part).centroid;
  const double scale = std::sqrt(floe_area / part_area);
  MosaicFloe floe{{}, centroid};
  for (const Vec2 p : part) floe.outline.push_back(scale * (p - centroid));
  return floe;
}

/// Wanted areas of the next step. First every usable part shall get the same share of its floe's area. Then only parts
/// that are too small get more: a corner that is left out in one round and not in the next would never come to rest.
void give_more(std::vector<double>& wanted, const Diagram& diagram, const UsableParts& parts,
               const std::vector<double>& area, bool even) {
  const double mean =
      std::accumulate(parts.area.begin(), parts.area.end(), 0.0) / std::accumulate(area.begin(), area.end(), 0.0);
  for (std::size_t i = 0; i < area.size(); ++i) {
    const double has = std::max(parts.area[i] / area[i], 1e-3);
    if (even) wanted[i] = diagram.area[i] * std::clamp(mean / has, 0.7, 1.4);
    if (!even && has < 1.0) wanted[i] *= std::min(1.4, 0.5 * (1.0 + mean) / has);
  }
}

/// The gap is kept by half at every edge of a cell: so walls of the region stand back by half a gap, where no gap is
/// needed, and obstacles are cut half a gap away from them.
MosaicRegion region_of(const PlacementTask& task) {
  MosaicRegion region{task.region, {}};
  region.box.grow(0.5 * task.gap);
  for (const Outline& obstacle : task.obstacles) {
    LabelledPolygon grown;
    Outline moved;
    const std::size_t n = obstacle.size();
    // Corners of the outline whose edges all moved outwards by half a gap.
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 before = obstacle[i] - obstacle[(i + n - 1) % n];
      const Vec2 after = obstacle[(i + 1) % n] - obstacle[i];
      const Vec2 a = (1.0 / length(before)) * turned_right(before);
      const Vec2 b = (1.0 / length(after)) * turned_right(after);
      moved.push_back(obstacle[i] + (0.5 * task.gap / (1.0 + dot(a, b))) * (a + b));
    }
    region.obstacles.push_back(std::move(moved));
  }
  return region;
}

}  // namespace

Mosaic make_mosaic(const PlacementTask& task) {
  std::vector<double> area;
  for (const Outline& outline : task.outlines) area.push_back(area_of(outline));
  const auto sites = first_sites(task, area);
  if (!sites) return {};
  const MosaicRegion region = region_of(task);
  Diagram diagram = make_diagram(*sites, region);
  for (int round = 0; round < rounding_rounds; ++round) {
    step_to_areas(diagram, region, area);
    step_to_areas(diagram, region, area);
    centre_sites(diagram, region);
  }
  std::vector<double> wanted = area;
  UsableParts parts = usable_parts(diagram, area, task.gap);
  for (int round = 0; round < correction_rounds && parts.room < 1.0; ++round) {
    step_to_areas(diagram, region, wanted);
    parts = usable_parts(diagram, area, task.gap);
    give_more(wanted, diagram, parts, area, round < evening_rounds);
  }
  Mosaic mosaic{{}, parts.room, parts.share};
  if (parts.room < 1.0) return mosaic;
  for (std::size_t i = 0; i < area.size(); ++i)
    mosaic.floes.push_back(floe_in(parts.outline[i], parts.area[i], area[i]));
  return mosaic;
}

}  // namespace gem
