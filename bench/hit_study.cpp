// Do the crushing peaks of hits depend on the time step? Hits of several runs, joined with and without a release.
//
//   hit_study CASE SECONDS SEEDS TIME_STEP_S...
//
// One row for each time step length and release: hits of floes that touch for the first time and of floes that touch
// again, with the median and the 95 % quantile of their crushing peaks, and the median tilt of the faces that touch
// again (1 / chord growth).
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/record/hits.h"
#include "gem/run/run_steps.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

constexpr double releases_s[] = {0.0, 0.5, 3.0};

struct Peaks {
  std::vector<double> first, again;  // crushing peaks [kN]
  std::vector<double> tilt;          // of faces that touch again [-]
};

void add(const std::vector<Hit>& hits, Peaks& peaks) {
  std::set<std::int32_t> seen;
  for (const Hit& hit : hits) {
    const bool fresh = seen.insert(hit.first.body_b).second;
    (fresh ? peaks.first : peaks.again).push_back(1e-3 * hit.first.peak_force);
    if (!fresh && hit.first.growth > 0.0) peaks.tilt.push_back(1.0 / hit.first.growth);
  }
}

/// Rows of one run.
std::vector<ContactEvent> rows_of(const SceneDef& scene) {
  const auto engine = make_engine(scene, make_field(scene), {"cpu", 1});
  StepLog log;
  engine->advance(steps_of(scene), log);
  return log.events;
}

void study(const std::string& file, double seconds, int seeds, const std::string& time_step) {
  Peaks peaks[std::size(releases_s)];
  for (int seed = 1; seed <= seeds; ++seed) {
    const SceneDef scene = read_scene(file, {"numerics.time_step_s=" + time_step, "run.seed=" + std::to_string(seed),
                                             "run.duration_s=" + number_text(seconds)});
    const std::vector<ContactEvent> rows = rows_of(scene);
    for (std::size_t k = 0; k < std::size(releases_s); ++k) {
      Hits hits({releases_s[k], scene.output.event_speed_m_per_s}, scene.numerics.time_step_s);
      std::vector<Hit> ended;
      hits.add(rows, steps_of(scene), ended);
      hits.end_all(ended);
      add(ended, peaks[k]);
    }
  }
  for (std::size_t k = 0; k < std::size(releases_s); ++k) {
    const Peaks& p = peaks[k];
    std::printf("%s,%g,%zu,%.1f,%.1f,%zu,%.1f,%.1f,%.5f\n", time_step.c_str(), releases_s[k], p.first.size(),
                percentile(p.first, 0.5), percentile(p.first, 0.95), p.again.size(), percentile(p.again, 0.5),
                percentile(p.again, 0.95), percentile(p.tilt, 0.5));
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace gem

int main(int count, char** argument) {
  if (count < 5) {
    std::fprintf(stderr, "usage: hit_study CASE SECONDS SEEDS TIME_STEP_S...\n");
    return 2;
  }
  std::printf("time_step_s,release_s,first,median_kN,p95_kN,again,median_kN,p95_kN,tilt\n");
  for (int k = 4; k < count; ++k)
    gem::study(argument[1], gem::bench::number_of(argument[2], "SECONDS"),
               static_cast<int>(gem::bench::number_of(argument[3], "SEEDS")), argument[k]);
}
