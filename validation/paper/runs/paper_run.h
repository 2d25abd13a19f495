// One run as the judge sees it: condition, seed, and a list of named numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/record/run_file/run_file.h"
#include "gem/report/run/run_findings.h"
#include "gem/report/run/run_series.h"
#include "gem/scene/scene_def.h"
#include "validation/paper/statements/judgement.h"

namespace gem {

/// Named numbers; a name ends in its unit. Numbers that are not finite are left out.
class Numbers {
 public:
  /// A single draw: one run gives no interval.
  void add(const std::string& name, double value) { add(name, {value, value, value, false}); }
  void add(const std::string& name, const RunNumber& number) {
    if (std::isfinite(number.value)) numbers_[name] = number;
  }
  std::optional<RunNumber> find(const std::string& name) const {
    const auto found = numbers_.find(name);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  const std::map<std::string, RunNumber>& all() const { return numbers_; }

 private:
  std::map<std::string, RunNumber> numbers_;
};

struct PaperRun : RunSeries {
  std::string file;       // empty for a run known only from a summary
  std::string condition;  // the run's name without its seed
  std::uint64_t seed = 0;
  SceneDef scene;
  std::string case_toml, source, engine, resolution, state_hash;
  Numbers numbers;
};

/// The runs of a folder by condition, ordered by seed.
struct PaperFolder {
  std::map<std::string, std::vector<PaperRun>> conditions;
  std::vector<std::string> refused;  // files and runs that could not be used, with the reason
  std::size_t repeated = 0;          // runs found a second time with the same state hash

  /// The runs of a condition; empty if there are none.
  const std::vector<PaperRun>& of(const std::string& condition) const;
  /// The number with this name for each run of a condition that has it.
  std::vector<RunNumber> numbers(const std::string& condition, const std::string& name) const;
  /// The first run of a condition that has its run file; null if there is none.
  const PaperRun* with_file(const std::string& condition) const;
};

/// "004_400_25_s3" with seed 3 is a run of the condition 004_400_25.
std::string condition_of(const std::string& name, std::uint64_t seed);

/// Whether the record is compared with a hundred records of the null model, which takes most of the time.
enum class NullModel { compared, left_out };

/// Reads one run file. Throws Error(file_system) unless it is a complete run.
PaperRun read_paper_run(const std::string& file, NullModel null_model = NullModel::compared);

/// Makes the run from data already read.
PaperRun paper_run(const RunFile& records, const RunData& data, NullModel null_model);

/// Reads every run file and summary (*.h5) in `folders`, including subfolders; an entry may also be a file. Files that
/// cannot be used are listed in `refused`. A run that is found twice adds what the first lacks if both have the same
/// state hash; otherwise it is refused. Throws Error(file_system) if a folder or file does not exist.
PaperFolder read_paper_folders(const std::vector<std::string>& folders);

/// Path of the platform at an interval [s], or at the longer interval of its summary; empty if no path was kept.
PlatformPath path_of(const PaperRun& run, double interval_s);

/// The path at a longer interval; unchanged if that is not a multiple of its own.
PlatformPath thinned(const PlatformPath& path, double interval_s);

/// The data from which the numbers of one run are computed.
struct NumberSource {
  const RunData& data;
  const SceneDef& scene;
  const PlatformSeries& series;
  const PlatformLoads& loads;
};

// Each function adds its numbers if the record allows them.

/// Motion, periods and loads of the analysis; amplitude, state after an hour, orbit, extremes.
void add_motion_numbers(const NumberSource& source, Numbers& numbers);
/// Peaks against means, work of the ice, correlation of ice and mooring force.
void add_load_numbers(const NumberSource& source, Numbers& numbers);
/// The record against records of the null model: 0-1 test, predictability, changes of amplitude.
void add_chaos_numbers(const NumberSource& source, Numbers& numbers);

}  // namespace gem
