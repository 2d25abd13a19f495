// Cuts the concave outlines of a floe file or replaces them by their hulls.
#include "gem/field/files/floe_outlines.h"

#include <utility>

#include "gem/base/error.h"
#include "gem/field/check_outline.h"
#include "gem/geometry/convex_pieces.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr OutlineRule floe_rule = {listed_corners_maximum,
                                   "split it into convex floes, or set floes.concave = \"cut\" or \"hull\""};

bool is_whole(const std::vector<Vec2>& outline) {
  return outline.size() <= listed_corners_maximum && first_non_convex_vertex(outline) < 0;
}

void add_pieces(ReadFloes& read, const FoundFloe& found, const std::vector<Vec2>& outline) {
  const auto pieces = convex_pieces(outline, listed_corners_maximum);
  if (pieces.empty())
    throw Error(ExitCode::scene_rejected,
                found.where +
                    ": cannot be cut into convex pieces (its corners lie too close to lines through others) " +
                    "simplify it or set floes.concave = \"hull\"");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    check_outline(pieces[i], found.where + ", piece " + std::to_string(i), floe_rule);
    read.floes.push_back(found.floe);
    read.floes.back().outline_m = pieces[i];
  }
  read.made += static_cast<std::int64_t>(pieces.size());
}

void add_hull(ReadFloes& read, const FoundFloe& found, const std::vector<Vec2>& outline) {
  std::vector<Vec2> hull = convex_hull(outline);
  check_outline(hull, found.where + ", hull", floe_rule);
  read.area_added += polygon_moments(hull).area - polygon_moments(outline).area;
  read.floes.push_back(found.floe);
  read.floes.back().outline_m = std::move(hull);
  ++read.made;
}

}  // namespace

ReadFloes convex_floes(const std::vector<FoundFloe>& found, ConcaveFloes concave) {
  ReadFloes read;
  for (const FoundFloe& one : found) {
    if (concave == ConcaveFloes::refuse) check_outline(one.floe.outline_m, one.where, floe_rule);
    if (concave != ConcaveFloes::refuse) {
      const CheckedOutline simple = check_simple_outline(one.floe.outline_m, one.where, concave_corners_maximum);
      if (!is_whole(simple.outline)) {
        ++read.changed;
        (concave == ConcaveFloes::cut ? add_pieces : add_hull)(read, one, simple.outline);
        continue;
      }
      check_outline(one.floe.outline_m, one.where, floe_rule);
    }
    read.floes.push_back(one.floe);
  }
  return read;
}

}  // namespace gem
