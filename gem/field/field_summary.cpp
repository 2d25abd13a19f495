// Statistics of the floes of a field.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/field/check_field.h"
#include "gem/field/field.h"
#include "gem/field/files/floe_file.h"
#include "gem/field/floe_reserve.h"
#include "gem/field/reached_concentration.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

/// Widens the search until a pair is found, so that a dense field needs only one short search.
double smallest_gap(const Bodies& bodies) {
  constexpr double everywhere = 1e7;
  for (double distance = 0.25; distance < everywhere; distance *= 8.0) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const NearPair& pair : near_pairs(bodies, distance)) smallest = std::min(smallest, pair.separation);
    if (std::isfinite(smallest)) return smallest;
    if (bodies.count() < 2) break;
  }
  return std::numeric_limits<double>::infinity();
}

void add_floe(FieldSummary& summary, const Bodies& bodies, std::size_t i) {
  const double size = std::sqrt(bodies.area[i]);
  const auto sides = static_cast<std::size_t>(bodies.vertex_count(i));
  ++summary.floe_count;
  summary.size_mean += size;
  summary.size_minimum = std::min(summary.size_minimum, size);
  summary.size_maximum = std::max(summary.size_maximum, size);
  summary.cover += bodies.area[i];
  summary.ice_mass += bodies.mass[i];
  summary.thickness_minimum =
      summary.floe_count == 1 ? bodies.thickness[i] : std::min(summary.thickness_minimum, bodies.thickness[i]);
  summary.thickness_maximum = std::max(summary.thickness_maximum, bodies.thickness[i]);
  if (summary.sides.size() <= sides) summary.sides.resize(sides + 1, 0);
  ++summary.sides[sides];
  if (summary.class_share.size() <= bodies.ice_class[i]) summary.class_share.resize(bodies.ice_class[i] + 1U, 0.0);
  summary.class_share[bodies.ice_class[i]] += bodies.area[i];
}

double size_deviation(const Bodies& bodies, double mean, double count) {
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.kind[i] != BodyKind::floe || is_unborn(bodies, i)) continue;
    const double offset = std::sqrt(bodies.area[i]) - mean;
    sum += offset * offset;
  }
  return std::sqrt(sum / count);
}

std::int64_t clockwise_outlines(const std::vector<FloeDef>& given) {
  return std::count_if(given.begin(), given.end(),
                       [](const FloeDef& floe) { return polygon_moments(floe.outline_m).area < 0.0; });
}

}  // namespace

FieldSummary summarise(const SceneDef& scene, const Bodies& bodies) {
  FieldSummary summary;
  summary.smallest_gap = smallest_gap(bodies);
  if (scene.floes.concentration > 0.0) summary.concentration = concentration_text(reached_concentration(scene, bodies));
  ReadFloes given;
  if (scene.floes.source == FloeSource::listed) given.floes = scene.floe;
  if (scene.floes.source == FloeSource::file) given = read_floe_file(scene.floes.path, scene.floes.concave);
  summary.clockwise_outlines = clockwise_outlines(given.floes);
  summary.concave = concave_text(given, scene.floes.concave);
  for (const IceClassDef& c : scene.floes.classes) summary.asked_cover += 0.1 * c.tenths;
  summary.class_share.resize(scene.floes.classes.size(), 0.0);
  summary.size_minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.kind[i] == BodyKind::floe && !is_unborn(bodies, i)) add_floe(summary, bodies, i);
  if (summary.floe_count == 0) {
    summary.size_minimum = 0.0;
    return summary;
  }
  const auto count = static_cast<double>(summary.floe_count);
  summary.size_mean /= count;
  summary.size_deviation = size_deviation(bodies, summary.size_mean, count);
  for (double& share : summary.class_share) share /= summary.cover;
  summary.cover /= scene.floes.length_m * scene.floes.width_m;
  return summary;
}

}  // namespace gem
