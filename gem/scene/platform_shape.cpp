// Makes the outlines of platforms.
#include "gem/scene/platform_shape.h"

#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

std::vector<Vec2> regular_outline(const PlatformDef& platform) {
  std::vector<Vec2> outline;
  for (int i = 0; i < platform.sides; ++i)
    outline.push_back(
        rotate(strict::rotation_of_turns(static_cast<double>(i) / platform.sides), {0.5 * platform.diameter_m, 0.0}));
  return outline;
}

/// Corners nearer than this are one: an outline may not have shorter sides [m].
constexpr double shortest_side = 1e-3;

/// One side of a ship from stem to stern, half a beam wide; origin amidships, stem at -x.
//
// The bow is a parabola that meets the parallel sides without an angle, as three straight sides. The stern narrows
// straight to a transom of half the beam.
std::vector<Vec2> half_ship(const PlatformDef& ship) {
  const double half_length = 0.5 * ship.length_m, half_beam = 0.5 * ship.beam_m;
  std::vector<Vec2> half;
  const auto add = [&half](Vec2 corner) {
    if (half.empty() || length(corner - half.back()) >= shortest_side) half.push_back(corner);
  };
  constexpr int bow_sides = 3;
  for (int i = ship.bow_length_m > 0.0 ? 0 : bow_sides; i <= bow_sides; ++i) {
    const double ahead = 1.0 - static_cast<double>(i) / bow_sides;
    add({-half_length + (1.0 - ahead) * ship.bow_length_m, half_beam * (1.0 - ahead * ahead)});
  }
  add({half_length - ship.stern_length_m, half_beam});
  if (ship.stern_length_m > 0.0) add({half_length, 0.5 * half_beam});
  return half;
}

/// Counter-clockwise from the stem: port side first, which is at -y, since the bow points to -x.
std::vector<Vec2> ship_outline(const PlatformDef& ship) {
  const std::vector<Vec2> half = half_ship(ship);
  std::vector<Vec2> outline;
  for (const Vec2 corner : half) outline.push_back({corner.x, corner.y > 0.0 ? -corner.y : 0.0});
  for (auto corner = half.rbegin(); corner != half.rend(); ++corner)
    if (corner->y > 0.0) outline.push_back(*corner);
  return outline;
}

/// The same corners in counter-clockwise order, with the first one kept.
std::vector<Vec2> counter_clockwise(std::vector<Vec2> outline) {
  if (polygon_moments(outline).area < 0.0) std::reverse(outline.begin() + 1, outline.end());
  return outline;
}

std::vector<std::vector<Vec2>> centred_pieces(const PlatformDef& platform) {
  std::vector<std::vector<Vec2>> pieces;
  for (const PlatformPieceDef& piece : platform.piece)
    if (!piece.outline_m.empty()) pieces.push_back(counter_clockwise(piece.outline_m));
  const PolygonMoments moments = pieces.empty() ? PolygonMoments{} : moments_of_all(pieces);
  if (!(moments.area > 0.0)) return pieces;
  for (std::vector<Vec2>& piece : pieces)
    for (Vec2& corner : piece) corner -= moments.centroid;
  return pieces;
}

std::vector<Vec2> joined(const std::vector<std::vector<Vec2>>& pieces) {
  std::vector<Vec2> corners;
  for (const std::vector<Vec2>& piece : pieces) corners.insert(corners.end(), piece.begin(), piece.end());
  return corners;
}

std::vector<Vec2> centred(std::vector<Vec2> outline) {
  const PolygonMoments moments = polygon_moments(outline);
  if (!(moments.area > 0.0)) return outline;
  for (Vec2& corner : outline) corner -= moments.centroid;
  return outline;
}

}  // namespace

std::vector<Vec2> platform_outline(const PlatformDef& platform) {
  switch (platform.outline) {
    case PlatformOutline::ship:
      return centred(ship_outline(platform));
    case PlatformOutline::listed:
      return platform.outline_m.empty() ? platform.outline_m : centred(counter_clockwise(platform.outline_m));
    case PlatformOutline::pieces:
      return joined(centred_pieces(platform));
    case PlatformOutline::regular:
      break;
  }
  return regular_outline(platform);
}

std::vector<std::vector<Vec2>> platform_pieces(const PlatformDef& platform) {
  if (platform.outline == PlatformOutline::pieces) return centred_pieces(platform);
  return {platform_outline(platform)};
}

namespace {

PolygonMoments platform_moments(const PlatformDef& platform) {
  const std::vector<std::vector<Vec2>> pieces = platform_pieces(platform);
  return pieces.empty() || pieces.front().empty() ? PolygonMoments{} : moments_of_all(pieces);
}

}  // namespace

std::vector<std::string> platform_side_names(const PlatformDef& platform) {
  if (platform.outline != PlatformOutline::ship) return {};
  std::vector<std::string> half;
  if (platform.bow_length_m > 0.0) half = {"bow, at the stem", "bow", "bow, at the shoulder"};
  if (platform.length_m - platform.bow_length_m - platform.stern_length_m >= shortest_side) half.push_back("side");
  if (platform.stern_length_m > 0.0) half.push_back("quarter");
  std::vector<std::string> names;
  for (const std::string& name : half) names.push_back("port " + name);
  names.push_back("transom");
  for (auto name = half.rbegin(); name != half.rend(); ++name) names.push_back("starboard " + *name);
  if (!(platform.bow_length_m > 0.0)) names.push_back("bow");
  return names;
}

double platform_area(const PlatformDef& platform) {
  const double area = platform_moments(platform).area;
  return area > 0.0 ? area : 0.0;
}

double platform_inertia(const PlatformDef& platform) {
  if (platform.inertia_kg_m2 > 0.0) return platform.inertia_kg_m2;
  const PolygonMoments moments = platform_moments(platform);
  return moments.area > 0.0 ? platform.mass_kg * (moments.second_moment / moments.area) : 0.0;
}

double platform_radius(const PlatformDef& platform) {
  if (platform.outline == PlatformOutline::regular) return 0.5 * platform.diameter_m;
  double radius = 0.0;
  for (const Vec2 corner : platform_outline(platform)) radius = std::max(radius, length(corner));
  return radius;
}

PlatformReach platform_reach(const PlatformDef& platform) {
  const double radius = platform_radius(platform);
  const bool turns = platform.yaw == Yaw::free && !platform.fixed;
  if (platform.outline == PlatformOutline::regular || turns) return {radius, radius, radius};
  PlatformReach reach;
  const Rotation start = strict::rotation_of_angle(platform.start_yaw_rad);
  for (const Vec2 corner : platform_outline(platform)) {
    const Vec2 p = rotate(start, corner);
    reach.upstream = std::max(reach.upstream, -p.x);
    reach.downstream = std::max(reach.downstream, p.x);
    reach.sideways = std::max(reach.sideways, std::fabs(p.y));
  }
  return reach;
}

double platform_drag_length(const PlatformDef& platform) {
  if (platform.outline == PlatformOutline::regular) return platform.diameter_m;
  if (platform.outline == PlatformOutline::ship) return platform.length_m;
  double low = 0.0, high = 0.0;
  for (const Vec2 corner : platform_outline(platform)) low = std::min(low, corner.x), high = std::max(high, corner.x);
  return high - low;
}

double platform_drag_width(const PlatformDef& platform) {
  if (platform.outline == PlatformOutline::regular) return platform.diameter_m;
  if (platform.outline == PlatformOutline::ship) return platform.beam_m;
  double low = 0.0, high = 0.0;
  for (const Vec2 corner : platform_outline(platform)) low = std::min(low, corner.y), high = std::max(high, corner.y);
  return high - low;
}

}  // namespace gem
