// Reads a file of distances into pairs of runs and computes growth rates.
#include "validation/paper/studies/ice_study.h"

#include "validation/paper/studies/row_file.h"

namespace gem {
namespace {

/// A column "contacts:moved:seed".
struct Column {
  std::string contacts;
  DivergingPair pair;
};

Column column_of(const std::string& name, const RowFile& rows) {
  const auto first = name.find(':'), second = name.rfind(':');
  if (first == std::string::npos || first == second) throw rows.fault("'" + name + "' names no pair");
  const double moved = rows.number(name.substr(first + 1, second - first - 1));
  const double seed = rows.number(name.substr(second + 1));
  return {name.substr(0, first), {moved, static_cast<std::uint64_t>(seed), {}}};
}

}  // namespace

IceStudy read_ice_study(const std::filesystem::path& folder) {
  IceStudy study;
  const auto path = folder / "ice_distances.csv";
  if (!std::filesystem::exists(path)) return study;
  RowFile rows(path, "build/ice_distances");
  std::vector<std::string> f;
  rows.next(f);
  std::vector<Column> columns;
  for (std::size_t c = 1; c < f.size(); ++c) columns.push_back(column_of(f[c], rows));
  double interval_s = 0.0, count = 0.0;
  while (rows.next(f)) {
    if (f.size() == 2 && f[0] == "commit") {
      study.commit = f[1];
      break;
    }
    if (f.size() != columns.size() + 1) throw rows.fault("not a field for every pair");
    const double time = rows.number(f[0]);
    if (count == 1.0) interval_s = time;
    if (time != count * interval_s) throw rows.fault("times that are not evenly spaced from 0");
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].pair.distance.push_back(rows.number(f[c + 1]));
    ++count;
  }
  if (study.commit.empty()) throw rows.fault("no commit at the end");
  for (Column& column : columns) {
    DivergenceStudy& own = study.of_contacts[column.contacts];
    own.interval_s = interval_s;
    own.swing_m = kIceApart;
    own.pairs.push_back(std::move(column.pair));
  }
  for (auto& [contacts, own] : study.of_contacts) find_growth(own);
  return study;
}

void add_ice_numbers(const IceStudy& study, FolderNumbers& numbers) {
  for (const auto& [contacts, own] : study.of_contacts) {
    FolderNumbers of_ice;
    add_divergence_numbers(own, of_ice);
    for (const auto& [name, as] : {std::pair{"divergence_rate_per_s", "ice_divergence_rate_" + contacts + "_per_s"},
                                   std::pair{"onset_shift_over_growth", "ice_onset_shift_" + contacts}})
      if (const auto found = of_ice.find(name); found != of_ice.end()) numbers[as] = found->second;
  }
}

}  // namespace gem
