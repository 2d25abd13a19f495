// The outlines of the side boundaries, and the tests whether an outline lies between them.
#include "gem/field/channel.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem {
namespace {

constexpr double side_thickness = 50.0;
constexpr double rounding = 1e-6;  // a floe may touch a side [m]

double taper_start(const BoundaryDef& b) { return std::min(0.0, std::max(b.inlet_x_m, b.taper_start_x_m)); }

void check(const BoundaryDef& b) {
  const auto refuse = [](const std::string& text) { throw Error(ExitCode::scene_rejected, "boundary: " + text); };
  if (!(b.inlet_x_m < 0.0 && b.outlet_x_m >= 0.0))
    refuse("inlet_x_m " + number_text(b.inlet_x_m) + " and outlet_x_m " + number_text(b.outlet_x_m) +
           " do not enclose the platform (the gap is at x = 0); choose inlet_x_m < 0 and outlet_x_m >= 0");
  if (!(b.inlet_width_m > 0.0 && b.gap_m > 0.0))
    refuse("inlet_width_m " + number_text(b.inlet_width_m) + " and gap_m " + number_text(b.gap_m) +
           " must both be positive (the channel would be closed); increase them");
  if (b.gap_m != b.inlet_width_m && taper_start(b) >= 0.0)
    refuse("taper_start_x_m " + number_text(b.taper_start_x_m) +
           " leaves no room for the taper (it ends at x = 0); move it upstream");
}

/// Where the upper side's inner line starts, bends and ends; points in a straight line are left out.
std::vector<Vec2> inner_line(const BoundaryDef& b) {
  const double inlet = 0.5 * b.inlet_width_m;
  const double gap = 0.5 * b.gap_m;
  std::vector<Vec2> line = {{b.inlet_x_m, inlet}};
  if (gap != inlet) {
    if (taper_start(b) > b.inlet_x_m) line.push_back({taper_start(b), inlet});
    if (b.outlet_x_m > 0.0) line.push_back({0.0, gap});
  }
  line.push_back({b.outlet_x_m, gap});
  return line;
}

double slope(Vec2 a, Vec2 b) { return (b.y - a.y) / (b.x - a.x); }

/// The body above an inner line, counter-clockwise.
std::vector<Vec2> upper_side(std::vector<Vec2> line, double outer_y) {
  line.push_back({line.back().x, outer_y});
  line.push_back({line.front().x, outer_y});
  return line;
}

std::vector<Vec2> mirrored(const std::vector<Vec2>& outline) {
  std::vector<Vec2> result;
  for (auto p = outline.rbegin(); p != outline.rend(); ++p) result.push_back({p->x, -p->y});
  return result;
}

}  // namespace

std::vector<std::vector<Vec2>> boundary_outlines(const BoundaryDef& boundary) {
  if (!boundary.present) return {};
  check(boundary);
  const std::vector<Vec2> line = inner_line(boundary);
  const double outer_y = 0.5 * std::max(boundary.inlet_width_m, boundary.gap_m) + side_thickness;
  std::vector<std::vector<Vec2>> outlines;
  std::vector<Vec2> part = {line[0]};
  for (std::size_t i = 1; i < line.size(); ++i) {
    part.push_back(line[i]);
    const bool last = i + 1 == line.size();
    // At a bend towards the axis the side would not be convex, so a new body starts.
    if (!last && slope(line[i], line[i + 1]) > slope(line[i - 1], line[i])) continue;
    outlines.push_back(upper_side(part, outer_y));
    part = {line[i]};
  }
  const std::size_t upper = outlines.size();
  for (std::size_t i = 0; i < upper; ++i) outlines.push_back(mirrored(outlines[i]));
  return outlines;
}

double channel_half_width(const BoundaryDef& boundary, double x) {
  const double start = taper_start(boundary);
  if (x <= start || start == 0.0) return 0.5 * (x <= start ? boundary.inlet_width_m : boundary.gap_m);
  if (x >= 0.0) return 0.5 * boundary.gap_m;
  return 0.5 * (boundary.inlet_width_m + (boundary.gap_m - boundary.inlet_width_m) * (x - start) / -start);
}

bool inside_channel(const BoundaryDef& boundary, const std::vector<Vec2>& outline, double overlap) {
  const double slack = rounding + overlap;
  if (!boundary.present) return true;
  return std::all_of(outline.begin(), outline.end(), [&](Vec2 p) {
    if (p.x > boundary.outlet_x_m) return true;
    return p.x >= boundary.inlet_x_m - slack && std::fabs(p.y) <= channel_half_width(boundary, p.x) + slack;
  });
}

}  // namespace gem
