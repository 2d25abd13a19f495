#include "gem/engine/contact/substep_count.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gem/events/compliant_contact.h"

namespace gem {
namespace {

/// Longest substep of a floe [s].
double longest_substep(const ContactDef& contact, double mass, double thickness) {
  constexpr double compliances = 12.0;
  return stable_kappa * std::sqrt(mass / (compliances * corner_stiffness(contact, thickness, true)));
}

}  // namespace

std::int64_t substep_count(const SceneDef& scene, const Bodies& bodies) {
  constexpr double left_out = 0.01;  // share of the area
  if (scene.numerics.substeps > 0) return scene.numerics.substeps;
  std::vector<std::pair<double, double>> floes;  // longest substep, area
  double area = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.kind[i] != BodyKind::floe || !(bodies.mass[i] > 0.0)) continue;
    floes.emplace_back(longest_substep(scene.contact, bodies.mass[i], bodies.thickness[i]), bodies.area[i]);
    area += bodies.area[i];
  }
  if (floes.empty()) return 1;
  std::sort(floes.begin(), floes.end());
  double skipped = 0.0;
  std::size_t first = 0;
  while (first + 1 < floes.size() && skipped + floes[first].second <= left_out * area) skipped += floes[first++].second;
  return std::max<std::int64_t>(1, std::llround(std::ceil(scene.numerics.time_step_s / floes[first].first)));
}

}  // namespace gem
