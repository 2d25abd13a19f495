// Run files to conditions and numbers.
#include "gem/report/paper/paper_run.h"

#include <algorithm>
#include <filesystem>

#include "gem/analysis/moments.h"
#include "gem/base/error.h"
#include "gem/record/output_path.h"
#include "gem/record/run_file.h"
#include "gem/report/load_run.h"
#include "gem/report/paper/field_numbers.h"
#include "gem/report/platform_series.h"
#include "gem/report/run_findings.h"
#include "gem/scene/scene_file.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

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

std::vector<fs::path> run_files(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry->path().extension() == ".h5") files.push_back(entry->path());
  if (failed)
    throw Error(ExitCode::file_system, "cannot read the folder " + shown(folder) + " (" + failed.message() +
                                           ") name the folder of the run files");
  std::sort(files.begin(), files.end());
  return files;
}

/// True if the condition has no run of this seed yet.
bool insert(std::vector<PaperRun>& runs, PaperRun run) {
  const auto place = std::lower_bound(runs.begin(), runs.end(), run.seed,
                                      [](const PaperRun& other, std::uint64_t seed) { return other.seed < seed; });
  if (place != runs.end() && place->seed == run.seed) return false;
  runs.insert(place, std::move(run));
  return true;
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

PaperRun read_paper_run(const std::string& file) {
  const RunData data = load_run(file, false);
  const RunFile records(file);
  PaperRun run;
  run.file = file;
  run.scene = parse_scene(records.attribute("gem_case_toml"), file);
  run.seed = run.scene.run.seed;
  run.condition = condition_of(run.scene.run.name, run.seed);
  run.source = data.identity.source;
  run.engine = data.identity.engine;
  run.resolution = data.identity.resolution;
  run.state_hash = data.identity.state_hash;
  add_run_numbers(data, run_findings(data).quality, run.numbers);
  add_field_numbers(records, run.scene, run.numbers);
  if (data.platform.time.size() < kSamplesForStatistics) return run;
  const PlatformSeries series = platform_series(data);
  const NumberSource source{data, run.scene, series};
  add_motion_numbers(source, run.numbers);
  add_load_numbers(source, run.numbers);
  add_chaos_numbers(source, run.numbers);
  run.excursion_peaks = excursion_peaks(series);
  return run;
}

PaperFolder read_paper_folder(const std::string& folder) {
  PaperFolder result;
  for (const fs::path& file : run_files(folder)) {
    try {
      PaperRun run = read_paper_run(file.string());
      std::vector<PaperRun>& runs = result.conditions[run.condition];
      if (!insert(runs, std::move(run)))
        result.refused.push_back(shown(file.string()) + ": the same condition and seed as another file");
    } catch (const Error& error) {
      result.refused.emplace_back(error.what());
    }
  }
  return result;
}

}  // namespace gem
