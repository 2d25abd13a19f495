// Ensembles of gem and of Box2D: lists the runs, extracts their numbers and compares them. scripts/ensembles.sh calls
// it.
//
//   gem_ensembles members PLAN [PART...]
//       one line per run: name, case, setting, seed, arguments of gem run, separated by tabs; the runs of gem's first
//       settings come first for all cases
//   gem_ensembles rows PLAN CASE SETTING RUN.h5 ROWS.csv MAP.csv
//       the numbers of one run, without headers
//   gem_ensembles touches RUN.h5 FROM_S TO_S GAP_S...
//       how often a floe touches after a gap without contact, by gap and smallest closing speed
//   gem_ensembles compare PLAN ROWS.csv MAPS.csv ENSEMBLES.csv MAP_MEANS.csv
//       means, intervals and verdicts
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "gem/analysis/statistics/equivalence.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "validation/baseline/ensemble_compare.h"
#include "validation/baseline/ensemble_plan.h"
#include "validation/baseline/ensemble_rows.h"
#include "validation/baseline/platform_events.h"

namespace gem::baseline {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* rows_head = "case,setting,seed,moment_s,quantity,value\n";
constexpr const char* map_head = "case,setting,seed,column,row,share\n";

std::ofstream created(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw Error(ExitCode::file_system, "cannot write " + path + " (it does not open); name another place");
  return file;
}

int members(const Texts& a) {
  const EnsemblePlan plan = read_plan(a.at(0));
  int largest = 0;
  for (const PlannedPart& part : plan.parts) largest = std::max(largest, part.members);
  // Ordered by seed, so that a stopped ensemble is a complete smaller one.
  for (int seed = 1; seed <= largest; ++seed)
    for (const PlannedCase& chosen : plan.cases) {
      const double step = read_case({chosen.path, {}, static_cast<long long>(chosen.index)}).numerics.time_step_s;
      for (const PlannedSetting& setting : plan.settings) {
        const bool wanted = a.size() == 1 || std::find(a.begin() + 1, a.end(), setting.part) != a.end();
        if (!wanted || seed > plan.members_of(setting, chosen)) continue;
        std::cout << member_name(chosen, setting, seed) << '\t' << chosen.name << '\t' << setting.label << '\t' << seed
                  << '\t' << chosen.path << " --index " << chosen.index << " --until " << number_text(chosen.to_s)
                  << " --set run.seed=" << seed << " --set numerics.time_step_s="
                  << number_text(setting.step_s > 0.0 ? setting.step_s : setting.step_factor * step) << ' '
                  << setting.arguments << '\n';
      }
    }
  return 0;
}

int rows(const Texts& a) {
  const EnsemblePlan plan = read_plan(a.at(0));
  const PlannedCase& chosen = plan.case_named(a.at(1));
  const PlannedSetting& setting = plan.setting_labelled(a.at(2));
  const MemberRows member = member_rows(a.at(3), chosen, plan.map);
  std::ofstream values = created(a.at(4)), map = created(a.at(5));
  const std::string who = chosen.name + "," + setting.label + "," + std::to_string(member.seed) + ",";
  for (const MemberValue& value : member.values)
    values << who << number_text(member.time_step_s) << ',' << value.name << ',' << number_text(value.value, 9) << '\n';
  for (std::size_t c = 0; c < member.share.size(); ++c)
    map << who << c % plan.map.columns << ',' << c / plan.map.columns << ',' << number_text(member.share[c], 4) << '\n';
  return 0;
}

int touches(const Texts& a) {
  const PlatformEvents all = platform_events(RunFile(a.at(0)));
  const double from = number_field(a.at(1), "FROM_S"), to = number_field(a.at(2), "TO_S");
  for (const double speed : {0.0, OutputDef{}.event_speed_m_per_s})
    for (std::size_t k = 3; k < a.size(); ++k) {
      const double gap = number_field(a[k], "GAP_S");
      std::cout << number_text(speed) << ',' << number_text(gap) << ','
                << number_text(first_after(gap, faster_than(speed, all), from, to) / (to - from), 5) << '\n';
    }
  return 0;
}

/// Lines of a CSV with the header `head`, as fields.
std::vector<Texts> table_in(const std::string& path, const std::string& head) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line) || line + "\n" != head)
    throw Error(ExitCode::usage, path + " is no such table (its first line is not '" + head.substr(0, head.size() - 1) +
                                     "'); name what scripts/ensembles.sh wrote");
  std::vector<Texts> lines;
  while (std::getline(file, line)) {
    lines.push_back(fields_of(line, ','));
    if (lines.back().size() != 6)
      throw Error(ExitCode::usage, path + ": '" + line + "' has not 6 fields (cut off?); run the member again");
  }
  return lines;
}

/// case -> setting -> quantity -> seed -> value
using Values = std::map<std::string, std::map<std::string, std::map<std::string, BySeed>>>;

Values values_in(const std::string& path) {
  Values values;
  for (const Texts& f : table_in(path, rows_head))
    values[f[0]][f[1]][f[4]][static_cast<int>(number_field(f[2], path))] =
        f[5] == "nan" ? std::nan("") : number_field(f[5], path);
  return values;
}

/// case -> setting -> cell -> share of each run
using Maps = std::map<std::string, std::map<std::string, std::vector<std::vector<double>>>>;

Maps maps_in(const std::string& path, const Grid& grid) {
  Maps maps;
  for (const Texts& f : table_in(path, map_head)) {
    auto& cells = maps[f[0]][f[1]];
    cells.resize(grid.columns * grid.rows);
    const auto cell = static_cast<std::size_t>(number_field(f[4], path)) * grid.columns +
                      static_cast<std::size_t>(number_field(f[3], path));
    if (cell >= cells.size()) throw Error(ExitCode::usage, path + ": a cell beyond the plan's map (another plan?)");
    cells[cell].push_back(number_field(f[5], path));
  }
  return maps;
}

std::string text_of(const IntervalEstimate& estimate) {
  return number_text(estimate.value, 7) + "," + number_text(estimate.low, 7) + "," + number_text(estimate.high, 7);
}

void write_compared(std::ostream& out, const std::string& who, const Compared& row) {
  out << who << row.quantity << ',' << row.runs_first << ',' << row.runs << ',' << text_of(row.first) << ','
      << text_of(row.other) << ',' << number_text(row.deviation_first, 7) << ',' << number_text(row.deviation, 7) << ','
      << text_of(row.difference) << ',' << text_of(row.paired_difference) << ',' << number_text(row.margin, 7) << ','
      << number_text(row.p, 4) << ',' << number_text(row.p_holm, 4) << ',' << row.verdict << '\n';
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// For each cell: means, the interval of their difference, and whether it lies within the margin.
void write_map(std::ostream& out, const std::string& who, const EnsemblePlan& plan,
               const std::vector<std::vector<double>>& first, const std::vector<std::vector<double>>& other) {
  for (std::size_t c = 0; c < std::min(first.size(), other.size()); ++c) {
    if (first[c].size() < 3 || other[c].size() < 3) continue;
    const Equivalence test = equivalence_test(first[c], other[c], plan.map_margin);
    out << who << c % plan.map.columns << ',' << c / plan.map.columns << ',' << number_text(mean_of(first[c]), 4) << ','
        << number_text(mean_of(other[c]), 4) << ',' << number_text(test.difference.low, 4) << ','
        << number_text(test.difference.high, 4) << ',' << (test.equivalent ? 1 : 0) << '\n';
  }
}

int compare_all(const Texts& a) {
  const EnsemblePlan plan = read_plan(a.at(0));
  const Values values = values_in(a.at(1));
  const Maps maps = maps_in(a.at(2), plan.map);
  std::ofstream out = created(a.at(3)), map_out = created(a.at(4));
  out << "case,setting,part,quantity,runs_first,runs,first_mean,first_low,first_high,mean,low,high,deviation_first,"
         "deviation,difference,difference_low,difference_high,paired_difference,paired_low,paired_high,margin,p,p_holm,"
         "verdict\n";
  map_out << "case,setting,column,row,first_share,share,difference_low,difference_high,equivalent\n";
  const std::string& first = plan.settings.front().label;
  for (const auto& [name, settings] : values) {
    const auto base = settings.find(first);
    if (base == settings.end()) continue;
    for (const PlannedSetting& setting : plan.settings) {
      const auto other = settings.find(setting.label);
      if (other == settings.end() || setting.label == first) continue;
      const std::string who = name + "," + setting.label + ",";
      for (const Compared& row : compare(plan, base->second, other->second))
        write_compared(out, who + setting.part + ",", row);
      if (maps.count(name) != 0 && maps.at(name).count(first) != 0 && maps.at(name).count(setting.label) != 0)
        write_map(map_out, who, plan, maps.at(name).at(first), maps.at(name).at(setting.label));
    }
  }
  return 0;
}

int run(const Texts& arguments) {
  const auto with = [&](const std::string& command, std::size_t least) {
    return !arguments.empty() && arguments[0] == command && arguments.size() > least;
  };
  const Texts rest(arguments.begin() + (arguments.empty() ? 0 : 1), arguments.end());
  if (with("members", 1)) return members(rest);
  if (with("rows", 6)) return rows(rest);
  if (with("touches", 4)) return touches(rest);
  if (with("compare", 5)) return compare_all(rest);
  throw Error(ExitCode::usage,
              "no such command (members, rows, touches or compare with their files); see the head of the source");
}

}  // namespace
}  // namespace gem::baseline

int main(int argc, char** argv) {
  try {
    return gem::baseline::run({argv + 1, argv + argc});
  } catch (const gem::Error& error) {
    std::cerr << "gem_ensembles: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
