// Checks a whole field before anything runs.
#include "gem/field/check_field.h"

#include <algorithm>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/channel.h"
#include "gem/field/generator/outline_grid.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr std::size_t listed_maximum = 10;

std::string body_name(const Bodies& bodies, std::size_t i) {
  if (bodies.kind[i] == BodyKind::platform)
    return platform_bodies(bodies) == 1 ? "platform" : "platform piece " + std::to_string(i);
  const auto first = std::find(bodies.kind.begin(), bodies.kind.end(), bodies.kind[i]) - bodies.kind.begin();
  const std::string number = std::to_string(i - static_cast<std::size_t>(first));
  return (bodies.kind[i] == BodyKind::fixed ? "fixed body " : "floe ") + number;
}

std::string place_text(const Bodies& bodies, std::size_t i) {
  return "(" + number_text(bodies.position[i].x, 6) + ", " + number_text(bodies.position[i].y, 6) + ")";
}

void check_overlaps(const Bodies& bodies, double allowed) {
  std::string listed, place;
  std::size_t count = 0;
  for (const NearPair& pair : near_pairs(bodies, 0.0)) {
    if (pair.separation > -allowed) continue;
    if (bodies.kind[pair.b] == BodyKind::platform) continue;  // check_platform_pieces() looks at pieces
    if (count++ >= listed_maximum) continue;
    if (place.empty()) place = body_name(bodies, pair.b) + " is at " + place_text(bodies, pair.b);
    listed += (listed.empty() ? "" : ", ") + body_name(bodies, pair.a) + " and " + body_name(bodies, pair.b) + " by " +
              number_text(-pair.separation, 4) + " m";
  }
  if (count == 0) return;
  const std::string more = count > listed_maximum ? ", and " + std::to_string(count - listed_maximum) + " more" : "";
  throw Error(ExitCode::scene_rejected, "field: " + std::to_string(count) +
                                            (count == 1 ? " pair of bodies overlaps" : " pairs of bodies overlap") +
                                            " at the start (" + listed + more + "; " + place + "); move them apart");
}

void check_channel(const SceneDef& scene, const Bodies& bodies) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.kind[i] != BodyKind::floe ||
        inside_channel(scene.boundary, world_outline(bodies, i), scene.floes.overlap))
      continue;
    throw Error(ExitCode::scene_rejected, "field: " + body_name(bodies, i) + " at " + place_text(bodies, i) +
                                              " m lies outside the channel (upstream of the inlet or beyond a side) " +
                                              "move it inside or set boundary.present = false");
  }
}

}  // namespace

std::vector<NearPair> near_pairs(const Bodies& bodies, double distance) {
  std::vector<std::vector<Vec2>> outlines;
  Box domain;
  double width = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    outlines.push_back(world_outline(bodies, i));
    if (bodies.kind[i] == BodyKind::fixed || outlines[i].empty()) continue;
    domain.add(bodies.position[i]);
    width += 2.0 * bodies.radius[i] / static_cast<double>(bodies.count());
  }
  if (!(domain.low.x <= domain.high.x)) return {};
  OutlineGrid grid(domain, std::max(width, 1e-3));
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (!outlines[i].empty()) grid.insert(i, box_of(outlines[i]));
  std::vector<NearPair> pairs;
  std::vector<std::size_t> near;
  for (std::size_t a = 0; a < outlines.size(); ++a) {
    if (bodies.kind[a] == BodyKind::fixed || outlines[a].empty()) continue;
    near.clear();
    Box box = box_of(outlines[a]);
    box.grow(distance);
    grid.for_each_near(box, [&](std::size_t b) {
      if (b > a || bodies.kind[b] == BodyKind::fixed) near.push_back(b);
      return true;
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t b : near) {
      const double separation = convex_separation(outlines[a], outlines[b]);
      if (separation <= distance) pairs.push_back({std::min(a, b), std::max(a, b), separation});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const NearPair& p, const NearPair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  // A platform and a fixed body are found once: the search starts from moving bodies only.
  return pairs;
}

void check_field(const SceneDef& scene, const Bodies& bodies) {
  check_channel(scene, bodies);
  check_overlaps(bodies, overlap_tolerance + scene.floes.overlap);
}

}  // namespace gem
