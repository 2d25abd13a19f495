// Finds the measurement of each statement and judges it.
#include "validation/paper/statements/evaluation.h"

#include <cmath>
#include <limits>

#include "gem/base/number_text.h"

namespace gem {
namespace {

constexpr double kTenth = 1e-6;                             // shares are typed numbers
constexpr double kThick = 1.2, kMedium = 0.7, kThin = 0.5;  // of the paper's classes [m]

/// Ratio of the worst ends of both intervals, for quantities that are not negative: its interval is too wide rather
/// than too narrow.
Measured ratio(const Measured& a, const Measured& b) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!(b.high > 0.0)) return {a.value / b.value, -infinity, infinity, a.interval + " / " + b.interval};
  const bool positive = b.low > 0.0;
  return {a.value / b.value, a.low / b.high, positive ? a.high / b.low : infinity, a.interval + " / " + b.interval};
}

/// Ratio of two conditions, seed by seed; empty without a common seed.
std::optional<Measured> ratio_by_seed(const PaperFolder& folder, const std::string& over, const std::string& under,
                                      const std::string& metric) {
  std::vector<RunNumber> ratios;
  for (const PaperRun& a : folder.of(over))
    for (const PaperRun& b : folder.of(under)) {
      const auto top = a.numbers.find(metric);
      const auto bottom = b.numbers.find(metric);
      if (a.seed != b.seed || !top || !bottom || bottom->value == 0.0) continue;
      const double value = top->value / bottom->value;
      ratios.push_back({value, value, value, false});
    }
  return over_runs(ratios, Over::every);
}

std::string share_text(const HeldShare& share) {
  return "; holds in " + std::to_string(share.holds) + " of " + std::to_string(share.runs) + ", " +
         number_text(std::round(100.0 * share.low), 3) + " … " + number_text(std::round(100.0 * share.high), 3) + " %";
}

std::optional<Measured> measure(const Statement& statement, const PaperFolder& folder, const FolderNumbers& numbers,
                                const std::string& prefix, std::string& note) {
  if (statement.condition.empty()) {
    const auto found = numbers.find(statement.metric);
    if (found == numbers.end()) note = "needs more runs";
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
  }
  const auto of = [&](const std::string& condition) -> std::optional<Measured> {
    const std::string name = prefix + condition;
    const auto measured = over_runs(folder.numbers(name, statement.metric), statement.over);
    if (!measured) note = (folder.of(name).empty() ? "no run " : "not in the record of ") + name;
    return measured;
  };
  const auto measured = of(statement.condition);
  if (!measured || statement.against.empty()) return measured;
  const auto against = of(statement.against);
  if (!against) return std::nullopt;
  if (statement.over != Over::every) return ratio(*measured, *against);
  note = "no seed in common";
  return ratio_by_seed(folder, prefix + statement.condition, prefix + statement.against, statement.metric);
}

double tenths_of(const SceneDef& scene, double thickness) {
  double tenths = 0.0;
  for (const IceClassDef& ice : scene.floes.classes)
    if (std::abs(ice.thickness_m - thickness) < kTenth) tenths += ice.tenths;
  return tenths;
}

void compare(const std::string& what, double ours, double paper, const std::string& unit,
             std::vector<std::string>& differences) {
  if (std::abs(ours - paper) > kTenth * std::max(1.0, std::abs(paper)))
    differences.push_back(what + " " + number_text(ours, 6) + unit + ", not " + number_text(paper, 6) + unit);
}

std::vector<std::string> differences(const SceneDef& scene, const TableRow& row) {
  std::vector<std::string> list;
  compare("thick ice", tenths_of(scene, kThick), row.thick, "/10", list);
  compare("medium ice", tenths_of(scene, kMedium), row.medium, "/10", list);
  compare("thin ice", tenths_of(scene, kThin), row.thin, "/10", list);
  compare("gap", scene.boundary.present ? scene.boundary.gap_m : 0.0, row.gap_m, " m", list);
  compare("current", scene.current.velocity_m_per_s.x, row.current_m_per_s, " m/s", list);
  compare("mooring", scene.mooring.stiffness_N_per_m / 1e3, row.stiffness_N_per_m / 1e3, " kN/m", list);
  if (scene.platform_drag.present != row.drag) list.emplace_back(row.drag ? "no water drag" : "water drag");
  return list;
}

}  // namespace

JudgedRow evaluate(const Statement& statement, const PaperFolder& folder, const FolderNumbers& numbers,
                   const std::string& prefix) {
  JudgedRow row{statement.id,     statement.source, statement.says, prefix + statement.condition,
                statement.metric, statement.why,    statement.rule, {}};
  if (!statement.against.empty()) row.condition += " / " + prefix + statement.against;
  row.measured = measure(statement, folder, numbers, prefix, row.note);
  row.verdict = judge(statement.rule, row.measured);
  if (!row.measured) return row;
  const std::size_t runs = row.measured->each.size();
  row.one_seed = runs == 1 && !statement.alike;
  row.share = held_share(statement.rule, row.measured->each);
  if (row.share) row.measured->interval += share_text(*row.share);
  if (statement.over != Over::every) return row;
  if (row.share)
    row.verdict = judge_share(*row.share, statement.share);
  else if (runs > 0 && !statement.alike)
    row.verdict = Verdict::undecidable;
  return row;
}

JudgedSettings compare_settings(const TableRow& row, const PaperFolder& folder) {
  const std::vector<PaperRun>& runs = folder.of(row.run);
  JudgedSettings result{row, runs.size(), {}, Verdict::undecidable};
  if (runs.empty()) return result;
  for (const PaperRun& run : runs)
    if (result.differences.empty()) result.differences = differences(run.scene, row);
  result.verdict = result.differences.empty() ? Verdict::reproduced : Verdict::not_reproduced;
  return result;
}

}  // namespace gem
