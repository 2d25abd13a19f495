// A run file to a condition and numbers.
#include "gem/report/paper/paper_run.h"

#include "gem/analysis/statistics/moments.h"
#include "gem/report/load_run.h"
#include "gem/report/paper/field_numbers.h"
#include "gem/report/platform_series.h"
#include "gem/report/run_findings.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

void add_run_numbers(const RunData& data, const RunQuality& quality, Numbers& numbers) {
  numbers.add("duration_s", data.duration_s);
  if (!data.stats.wall_time.empty()) {
    numbers.add("wall_s", data.stats.wall_time.back());
    numbers.add("real_time_factor", quality.speed);
  }
  numbers.add("maximum_overlap_m", quality.maximum_overlap);
  numbers.add("residual_momentum", quality.residual_momentum);
  numbers.add("residual_energy", quality.residual_energy);
}

/// The largest distance from rest in each natural period.
std::vector<double> excursion_peaks(const PlatformSeries& series) {
  const auto period = static_cast<std::size_t>(series.natural_period / series.interval);
  std::vector<double> peaks;
  for (std::size_t begin = 0; period > 0 && begin + period <= series.x.size(); begin += period)
    peaks.push_back(
        maximum_radial_excursion(std::span(series.x).subspan(begin, period), std::span(series.y).subspan(begin, period))
            .value);
  return peaks;
}

}  // namespace

std::string condition_of(const std::string& name, std::uint64_t seed) {
  const std::string ending = "_s" + std::to_string(seed);
  return name.size() > ending.size() && name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

const std::vector<PaperRun>& PaperFolder::of(const std::string& condition) const {
  static const std::vector<PaperRun> none;
  const auto found = conditions.find(condition);
  return found == conditions.end() ? none : found->second;
}

std::vector<RunNumber> PaperFolder::numbers(const std::string& condition, const std::string& name) const {
  std::vector<RunNumber> values;
  for (const PaperRun& run : of(condition))
    if (const auto number = run.numbers.find(name)) values.push_back(*number);
  return values;
}

const PaperRun* PaperFolder::with_file(const std::string& condition) const {
  for (const PaperRun& run : of(condition))
    if (!run.file.empty()) return &run;
  return nullptr;
}

PlatformPath path_of(const PaperRun& run, double interval_s) {
  if (run.path && (run.path->exact || run.file.empty())) return thinned(*run.path, interval_s);
  return run.file.empty() ? PlatformPath{} : read_path(run.file, interval_s);
}

PaperRun paper_run(const RunFile& records, const RunData& data, NullModel null_model) {
  PaperRun run;
  run.file = records.path();
  run.case_toml = records.attribute("gem_case_toml");
  run.scene = parse_scene(run.case_toml, run.file);
  run.seed = run.scene.run.seed;
  run.condition = condition_of(run.scene.run.name, run.seed);
  run.source = data.identity.source;
  run.engine = data.identity.engine;
  run.resolution = data.identity.resolution;
  run.state_hash = data.identity.state_hash;
  const RunFindings findings = run_findings(data);
  add_run_numbers(data, findings.quality, run.numbers);
  add_field_numbers(records, run.scene, run.numbers);
  if (data.platform.time.size() < kSamplesForStatistics) return run;
  const PlatformSeries series = platform_series(data);
  const NumberSource source{data, run.scene, series, findings.loads};
  add_motion_numbers(source, run.numbers);
  add_load_numbers(source, run.numbers);
  if (null_model == NullModel::compared) add_chaos_numbers(source, run.numbers);
  run.excursion_peaks = excursion_peaks(series);
  run.blocks = run_blocks(series);
  return run;
}

PaperRun read_paper_run(const std::string& file, NullModel null_model) {
  const RunData data = load_run(file, false);
  return paper_run(RunFile(file), data, null_model);
}

}  // namespace gem
