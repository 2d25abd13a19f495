// Sorts run files and summaries by condition.
#include <algorithm>
#include <filesystem>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "validation/paper/runs/paper_run.h"
#include "validation/paper/runs/paper_summary.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& name) {
  std::vector<fs::path> files;
  std::error_code failed;
  if (fs::is_regular_file(name, failed)) return {name};
  for (fs::recursive_directory_iterator entry(name, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry->path().extension() == ".h5") files.push_back(entry->path());
  if (failed)
    throw Error(ExitCode::file_system, "cannot read the folder " + shown(name) + " (" + failed.message() +
                                           "); name the folder of the run files or summaries");
  std::sort(files.begin(), files.end());
  return files;
}

/// One run recorded twice: adds to the first what only the other has.
void complete(PaperRun& run, PaperRun other) {
  for (const auto& [name, number] : other.numbers.all())
    if (!run.numbers.find(name)) run.numbers.add(name, number);
  if (run.file.empty()) run.file = std::move(other.file);
  if (run.excursion_peaks.empty()) run.excursion_peaks = std::move(other.excursion_peaks);
  if (run.blocks.count() == 0) run.blocks = std::move(other.blocks);
  if (!run.path || (other.path && other.path->exact && !run.path->exact)) run.path = std::move(other.path);
}

void insert(PaperFolder& folder, PaperRun run, const std::string& origin) {
  std::vector<PaperRun>& runs = folder.conditions[run.condition];
  const auto place = std::lower_bound(runs.begin(), runs.end(), run.seed,
                                      [](const PaperRun& other, std::uint64_t seed) { return other.seed < seed; });
  if (place == runs.end() || place->seed != run.seed) {
    runs.insert(place, std::move(run));
  } else if (place->state_hash == run.state_hash) {
    complete(*place, std::move(run));
    ++folder.repeated;
  } else {
    folder.refused.push_back(shown(origin) + ": " + run.scene.run.name + " has the seed of another run of " +
                             run.condition + ", but not its state hash (" + run.state_hash + ", not " +
                             place->state_hash + ")");
  }
}

void add_file(PaperFolder& folder, const std::string& file) {
  if (!is_summary(file)) return insert(folder, read_paper_run(file), file);
  for (PaperRun& run : paper_runs(read_summary(file), file)) insert(folder, std::move(run), file);
}

}  // namespace

PaperFolder read_paper_folders(const std::vector<std::string>& folders) {
  PaperFolder result;
  for (const std::string& folder : folders)
    for (const fs::path& file : files_of(folder)) {
      try {
        add_file(result, file.string());
      } catch (const Error& error) {
        result.refused.emplace_back(error.what());
      }
    }
  return result;
}

}  // namespace gem
