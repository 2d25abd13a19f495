// Reads two files of rows into pairs of runs.
#include "validation/paper/studies/unordered_study.h"

#include "validation/paper/studies/divergence_study.h"
#include "validation/paper/studies/row_file.h"

namespace gem {
namespace {

constexpr std::size_t kRunFields = 15;
constexpr const char* kMaker = "build/unordered_sums";

std::vector<UnorderedRun> read_runs(const std::filesystem::path& path) {
  RowFile rows(path, kMaker);
  std::vector<UnorderedRun> runs;
  std::vector<std::string> f;
  for (rows.next(f); rows.next(f);) {
    if (f.size() != kRunFields) throw rows.fault("not " + std::to_string(kRunFields) + " fields");
    runs.push_back({f[0], f[1], static_cast<int>(rows.number(f[2])), f[3], rows.number(f[4]), rows.number(f[5]),
                    rows.number(f[6]), rows.number(f[7]), rows.number(f[8]), rows.number(f[9]), rows.number(f[10]),
                    rows.number(f[11]), rows.number(f[13]), f[14]});
  }
  return runs;
}

double swing_in_order(const std::vector<UnorderedRun>& runs, const std::string& contacts) {
  for (const UnorderedRun& run : runs)
    if (run.contacts == contacts && run.sums == "ordered") return run.swing_m;
  return 0.0;
}

/// Index of the pairs of a column "contacts:sums:run-run".
std::size_t pairs_of_column(const std::string& column, const RowFile& rows, UnorderedStudy& study) {
  const auto first = column.find(':'), second = column.rfind(':');
  if (first == std::string::npos || first == second) throw rows.fault("'" + column + "' names no pair");
  const std::string contacts = column.substr(0, first), sums = column.substr(first + 1, second - first - 1);
  const bool repeats = !column.ends_with("-0");
  std::size_t i = 0;
  while (i < study.pairs.size() &&
         (study.pairs[i].contacts != contacts || study.pairs[i].sums != sums || study.pairs[i].repeats != repeats))
    ++i;
  if (i == study.pairs.size())
    study.pairs.push_back({contacts, sums, repeats, swing_in_order(study.runs, contacts), {}, {}});
  return i;
}

void read_distances(const std::filesystem::path& path, UnorderedStudy& study) {
  RowFile rows(path, kMaker);
  std::vector<std::string> f;
  rows.next(f);
  struct Place {
    std::size_t pairs, own;
  };
  std::vector<Place> places;
  for (std::size_t c = 1; c < f.size(); ++c) {
    const std::size_t i = pairs_of_column(f[c], rows, study);
    places.push_back({i, study.pairs[i].distances.size()});
    study.pairs[i].distances.emplace_back();
  }
  double count = 0.0;
  while (rows.next(f)) {
    if (f.size() != places.size() + 1) throw rows.fault("not a field for every pair");
    const double time = rows.number(f[0]);
    if (count == 1.0) study.interval_s = time;
    if (time != count * study.interval_s) throw rows.fault("times that are not evenly spaced from 0");
    for (std::size_t c = 0; c < places.size(); ++c)
      study.pairs[places[c].pairs].distances[places[c].own].push_back(rows.number(f[c + 1]));
    ++count;
  }
}

}  // namespace

UnorderedStudy read_unordered_study(const std::filesystem::path& folder) {
  UnorderedStudy study;
  const auto runs = folder / "unordered_runs.csv", distances = folder / "unordered_distances.csv";
  if (!std::filesystem::exists(runs) && !std::filesystem::exists(distances)) return study;
  study.runs = read_runs(runs);
  read_distances(distances, study);
  for (UnorderedPairs& pairs : study.pairs) pairs.growth = growth_of(pairs.distances, study.interval_s, pairs.swing_m);
  return study;
}

void add_unordered_numbers(const UnorderedStudy& study, FolderNumbers& numbers) {
  std::vector<RunNumber> times;
  for (const UnorderedPairs& pairs : study.pairs) {
    if (pairs.contacts != "independent" || !pairs.repeats) continue;
    for (const std::vector<double>& distance : pairs.distances) {
      const double time = parting_time(distance, study.interval_s, pairs.swing_m);
      times.push_back({time, time, time, false});
    }
  }
  if (const auto found = over_runs(times, Over::every)) numbers["unordered_parting_s"] = *found;
}

}  // namespace gem
