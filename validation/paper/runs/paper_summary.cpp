// Writes runs as columns of a summary, and reads them back.
#include "validation/paper/runs/paper_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/report/run/summary_series.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
using Values = std::vector<double>;

std::string unit_of(const std::string& name) {
  for (const char* unit : {"m", "s", "N", "J", "rad"})
    if (name.ends_with(std::string("_") + unit)) return unit;
  return "1";
}

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void add_numbers(SummaryTable& table, const std::vector<PaperRun>& runs) {
  std::set<std::string> names, with_interval;
  for (const PaperRun& run : runs)
    for (const auto& [name, number] : run.numbers.all()) {
      names.insert(name);
      if (number.interval) with_interval.insert(name);
    }
  const auto column = [&](const std::string& name, const std::string& ending, const std::string& words,
                          double RunNumber::*part) {
    if (table.column(name + ending) != nullptr) return;
    SummaryColumn added{name + ending, unit_of(name), in_words(name) + words};
    for (const PaperRun& run : runs) {
      const auto number = run.numbers.find(name);
      added.numbers.push_back(number && (ending.empty() || number->interval) ? (*number).*part : nothing);
    }
    table.columns.push_back(std::move(added));
  };
  for (const std::string& name : names) {
    column(name, "", "", &RunNumber::value);
    if (!with_interval.contains(name)) continue;
    column(name, "_low", ", lower end of its 95 % interval", &RunNumber::low);
    column(name, "_high", ", upper end of its 95 % interval", &RunNumber::high);
  }
}

void add_cases(SummaryTable& table, const std::vector<PaperRun>& runs) {
  SummaryColumn cases{"case_toml", "", "the case with all that differs from the defaults"};
  for (const PaperRun& run : runs) cases.texts.push_back(run.case_toml);
  table.columns.push_back(std::move(cases));
}

std::vector<Values> rows_of(const SummarySeries& series, std::size_t runs) {
  const std::size_t length = series.values.size() / runs;
  std::vector<Values> rows;
  for (std::size_t run = 0; run < runs; ++run) {
    const auto begin = series.values.begin() + static_cast<std::ptrdiff_t>(run * length);
    rows.emplace_back(begin, std::find_if(begin, begin + static_cast<std::ptrdiff_t>(length),
                                          [](double value) { return std::isnan(value); }));
  }
  return rows;
}

void read_numbers(const SummaryTable& table, std::vector<PaperRun>& runs) {
  for (const SummaryColumn& column : table.columns) {
    if (column.numbers.empty() || column.is_setting) continue;
    const SummaryColumn* low = table.column(column.name + "_low");
    const SummaryColumn* high = table.column(column.name + "_high");
    const bool ends = low != nullptr && high != nullptr && !low->numbers.empty() && !high->numbers.empty();
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const double value = column.numbers[run];
      const bool interval = ends && !std::isnan(low->numbers[run]) && !std::isnan(high->numbers[run]);
      runs[run].numbers.add(column.name, interval ? RunNumber{value, low->numbers[run], high->numbers[run], true}
                                                  : RunNumber{value, value, value, false});
    }
  }
}

[[noreturn]] void reject(const std::string& origin, const std::string& problem) {
  throw Error(ExitCode::file_system, "cannot read " + shown(origin) + " (" + problem + "); collect the runs again");
}

/// Interval of the path; 0 if only one sample was kept.
double interval_of(const SummaryTable& table, const std::string& origin) {
  const SummaryAxis* axis = table.axis("time");
  if (axis == nullptr || axis->values.size() < 2) return 0.0;
  const double interval_s = axis->values[1] - axis->values[0];
  if (!(interval_s > 0.0)) reject(origin, "its times do not increase");
  return interval_s;
}

void check_lengths(PaperRun& run, const std::string& origin) {
  std::map<std::string, std::size_t> length;
  for (const SeriesEntry& entry : summary_series()) {
    if (std::string(entry.axis) == "time" && !run.path) continue;
    const std::size_t own = entry.values(run).size();
    const bool velocity = std::string(entry.name).starts_with("velocity");  // some paths are kept without velocity
    if (velocity && own == 0) continue;
    if (length.insert({entry.axis, own}).first->second != own)
      reject(origin, std::string(entry.name) + " differs in length from the series beside it");
  }
  if (run.path && run.path->vx.size() != run.path->vy.size()) reject(origin, "one velocity of two");
}

void read_series(const SummaryTable& table, std::vector<PaperRun>& runs, const std::string& origin) {
  const double interval_s = interval_of(table, origin);
  for (const SeriesEntry& entry : summary_series()) {
    const SummarySeries* series = table.one_series(entry.name);
    if (series == nullptr) continue;
    if (series->axis != entry.axis) reject(origin, series->name + " does not run along " + entry.axis);
    const std::vector<Values> rows = rows_of(*series, runs.size());
    for (std::size_t run = 0; run < runs.size(); ++run) {
      entry.values(runs[run]) = rows[run];
      if (series->axis != "time") continue;
      runs[run].path->interval_s = interval_s;
      runs[run].path->exact = series->exact;
    }
  }
}

}  // namespace

void add_paper_part(SummaryTable& table, const std::vector<PaperRun>& runs) {
  add_cases(table, runs);
  add_numbers(table, runs);
}

std::vector<PaperRun> paper_runs(const SummaryTable& table, const std::string& origin) {
  const auto texts = [&](const char* name) -> const std::vector<std::string>& {
    const SummaryColumn* column = table.column(name);
    if (column == nullptr || column->texts.size() != table.runs.size())
      reject(origin, std::string("no column ") + name + ": collected by `gem sweep collect`, or by an older program");
    return column->texts;
  };
  std::vector<PaperRun> runs(table.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].case_toml = texts("case_toml")[i];
    runs[i].scene = parse_scene(runs[i].case_toml, origin);
    runs[i].seed = runs[i].scene.run.seed;
    runs[i].condition = condition_of(runs[i].scene.run.name, runs[i].seed);
    runs[i].source = texts("source")[i];
    runs[i].engine = texts("engine")[i];
    runs[i].resolution = texts("resolution")[i];
    runs[i].state_hash = texts("state_hash")[i];
  }
  read_numbers(table, runs);
  read_series(table, runs, origin);
  for (PaperRun& run : runs) {
    if (!run.numbers.find("duration_s")) reject(origin, "a run has no duration_s");
    check_lengths(run, origin);
  }
  return runs;
}

}  // namespace gem
