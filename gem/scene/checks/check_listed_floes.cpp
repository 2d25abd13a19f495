// Place and size of listed floes, and of those that a file gave.
#include <cmath>
#include <string>

#include "gem/geometry/polygon.h"
#include "gem/scene/checks/checks.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

void check_places(const SceneDef& s, SceneProblems& out) {
  for (std::size_t i = 0; i < s.floe.size(); ++i) {
    const FloeDef& floe = s.floe[i];
    const double cosine = std::cos(floe.angle_rad), sine = std::sin(floe.angle_rad);
    const PolygonMoments outline = polygon_moments(floe.outline_m);
    if (!(std::abs(outline.area) > 0.0)) continue;  // reported with its corners when the field is made
    // The centre: the origin of an outline may be anywhere, and is far away for floes of a file.
    const Vec2 c = outline.centroid;
    const Vec2 centre = floe.position_m + Vec2{cosine * c.x - sine * c.y, sine * c.x + cosine * c.y};
    const std::string name = "floe[" + std::to_string(i) + "]";
    if (!place_range.contains(centre.x) || !place_range.contains(centre.y))
      out.push_back({"floe", name + ": its centre is out of range (value " + plain_number_text(centre.x) + ", " +
                                 plain_number_text(centre.y) + ", allowed " + range_text(place_range, "m") +
                                 "); give it in m"});
    else if (centre.x > s.output.retire_x_m)
      out.push_back({"output.retire_x_m", name + " starts downstream of the line (value " +
                                              plain_number_text(s.output.retire_x_m) + ", allowed at least " +
                                              plain_number_text(centre.x) + " m)"});
  }
}

/// Catches mistaken units, mostly mm for m. Floes of a file need it too, because no range table has checked them.
void check_listed_sizes(const SceneDef& s, SceneProblems& out) {
  const auto check = [&](std::size_t i, const char* what, double value, const Range& range) {
    if (range.contains(value)) return;
    out.push_back({"floe", "floe[" + std::to_string(i) + "]: " + what + " out of range (value " +
                               plain_number_text(value) + ", allowed " + range_text(range, "m") + "); give it in m"});
  };
  for (std::size_t i = 0; i < s.floe.size(); ++i) {
    const double area = std::abs(polygon_moments(s.floe[i].outline_m).area);
    // an invalid outline is reported with its corners when the field is made
    if (area > 0.0) check(i, "size (root of the area)", std::sqrt(area), floe_size_range);
    if (s.floe[i].thickness_m > 0.0) check(i, "thickness", s.floe[i].thickness_m, thickness_range);
  }
}

}  // namespace

void check_listed_floes(const SceneDef& s, SceneProblems& out) {
  if (s.floes.source != FloeSource::listed) return;
  check_places(s, out);
  check_listed_sizes(s, out);
}

}  // namespace gem
