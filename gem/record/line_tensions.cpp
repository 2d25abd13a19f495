#include "gem/record/line_tensions.h"

#include <algorithm>

namespace gem {

bool has_lines(const SceneDef& scene) {
  return scene.platform.present && !scene.platform.fixed && scene.mooring.law == MooringLaw::catenary;
}

LineTensions::LineTensions(const SceneDef& scene)
    : tables_(has_lines(scene) ? mooring_tables(scene.mooring.law, scene.mooring_design) : MooringTables{}),
      keeps_tensions_(scene.output.line_tensions) {
  sums_.break_time.assign(lines(), 0.0);
  if (keeps_tensions_) sums_.tension.assign(lines(), 0.0);
}

void LineTensions::add(const PlatformStep& step, double time) {
  for (std::size_t k = 0; k < lines(); ++k) {
    if (sums_.break_time[k] > 0.0) continue;
    const auto line = static_cast<std::int32_t>(k);
    // a line that breaks in this time step had its tension until the end
    if (keeps_tensions_)
      sums_.tension[k] = std::max(sums_.tension[k], line_tension(tables_.view(), line, step.position, step.rotation));
    if (is_broken(step.broken, line)) sums_.break_time[k] = time;
  }
}

void LineTensions::take(std::vector<double>& tension, std::vector<double>& break_time) {
  tension.insert(tension.end(), sums_.tension.begin(), sums_.tension.end());
  break_time.insert(break_time.end(), sums_.break_time.begin(), sums_.break_time.end());
  std::fill(sums_.tension.begin(), sums_.tension.end(), 0.0);
}

}  // namespace gem
