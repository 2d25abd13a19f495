// Reads the condition and the numbers of a run file.
#include "validation/paper/runs/paper_run.h"

#include "gem/analysis/statistics/moments.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "gem/report/run/run_findings.h"
#include "validation/paper/runs/field_numbers.h"

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

PlatformPath thinned(const PlatformPath& path, double interval_s) {
  if (!(path.interval_s > 0.0)) return path;
  const auto step = static_cast<std::size_t>(std::llround(interval_s / path.interval_s));
  if (step < 2 || std::abs(static_cast<double>(step) * path.interval_s - interval_s) > 1e-9 * interval_s) return path;
  PlatformPath result{interval_s, path.exact, {}, {}, {}, {}};
  for (const auto& [from, to] : {std::pair(&path.x, &result.x), std::pair(&path.y, &result.y),
                                 std::pair(&path.vx, &result.vx), std::pair(&path.vy, &result.vy)})
    for (std::size_t i = 0; i < from->size(); i += step) to->push_back((*from)[i]);
  return result;
}

PaperRun paper_run(const RunFile& records, const RunData& data, NullModel null_model) {
  PaperRun run;
  run.file = records.path();
  run.case_toml = stored_case(records);
  run.scene = stored_scene(records);
  run.seed = run.scene.run.seed;
  run.condition = condition_of(run.scene.run.name, run.seed);
  run.source = data.identity.source;
  run.engine = data.identity.engine;
  run.resolution = data.identity.solver;
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
  static_cast<RunSeries&>(run) = run_series(series);
  return run;
}

PaperRun read_paper_run(const std::string& file, NullModel null_model) {
  const RunData data = load_run(file, false);
  return paper_run(RunFile(file), data, null_model);
}

}  // namespace gem
