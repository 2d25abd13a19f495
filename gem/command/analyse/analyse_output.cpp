// Findings as aligned text and as JSON. The verdict comes first: it says whether the rest can be believed.
#include "gem/command/analyse/analyse_output.h"

#include <map>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/number_text.h"
#include "gem/command/verdict_output.h"
#include "gem/record/output/output_path.h"
#include "gem/report/contact_energy_record.h"
#include "gem/report/run/run_findings.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const IntervalEstimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

Json json_of(const Finding& finding) {
  if (!finding.value) return nullptr;
  return finding.interval ? json_of(*finding.interval) : Json{{"value", *finding.value}};
}

Json json_of(const ContactEnergy& energy) {
  return {{"stored_J", energy.stored},     {"crushed_J", energy.crushed}, {"damped_J", energy.damped},
          {"friction_J", energy.friction}, {"left_J", energy.left()},     {"softened_share", softened_share(energy)}};
}

Json json_of(const LineFinding& line) {
  Json object = {{"strength_N", line.strength}, {"break_time_s", line.break_time}};
  if (line.largest) object["tension_largest_N"] = *line.largest, object["tension_largest_at_s"] = line.at;
  return object;
}

std::string row_text(const std::string& name, const std::vector<std::string>& cells) {
  std::string line = "  " + name;
  std::size_t end = 34;
  for (const std::string& cell : cells) {
    line += std::string(line.size() < end ? end - line.size() : 1, ' ') + cell;
    end += 14;
  }
  return line + "\n";
}

std::string short_text(double value) { return number_text(value, 5); }

std::string interval_text(const IntervalEstimate& estimate) {
  return short_text(estimate.low) + " to " + short_text(estimate.high);
}

bool is_length_or_force(const std::string& name) { return name.ends_with("_m") || name.ends_with("_N"); }

/// Of a ship in transit, which goes its way without ice too, of water and wind, or of bodies beside the platform.
bool stands_alone(const std::string& name) {
  for (const char* beginning : {"transit_", "thrust_", "tow_", "hold_", "drag_", "fixed_"})
    if (name.starts_with(beginning)) return true;
  return false;
}

/// Whether no ice touched the platform and it did not move. Then its numbers are rounding.
bool untouched(const std::vector<Finding>& findings) {
  return finding_of(findings, "contact_fraction").value.value_or(0.0) == 0.0 &&
         finding_of(findings, "ice_force_window_largest_N").value.value_or(0.0) == 0.0 &&
         finding_of(findings, "orbit_largest_m").value.value_or(0.0) < kLeastMotion;
}

/// A finding as people read it.
struct FindingText {
  std::string value, interval;
  bool not_resolved = false;
};

/// `without_contact`: lengths and forces are rounding, but for those that stand alone.
FindingText words_of(const Finding& finding, bool without_contact) {
  if (without_contact && is_length_or_force(finding.name) && !stands_alone(finding.name)) return {"no contact", "-"};
  const std::string interval = finding.interval ? interval_text(*finding.interval) : "-";
  if (!is_resolved(finding)) return {"not resolved", interval, true};
  return {short_text(*finding.value), interval};
}

std::string text_of(const std::vector<LineFinding>& lines) {
  if (lines.empty()) return "";
  std::string text = row_text("mooring line", {"largest N", "at s", "of strength", "broke at s"});
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineFinding& line = lines[k];
    const bool has_share = line.largest && line.strength > 0.0;
    text +=
        row_text("line " + std::to_string(k + 1),
                 {line.largest ? short_text(*line.largest) : "not recorded", line.largest ? short_text(line.at) : "-",
                  has_share ? number_text(100.0 * *line.largest / line.strength, 3) + " %" : "-",
                  line.break_time > 0.0 ? short_text(line.break_time) : "no"});
  }
  return text;
}

/// The verdict of one run with its reasons.
std::string verdict_lines(const AnalysedRun& run) {
  return std::string("  verdict") + std::string(25, ' ') + grade_name(run.verdict.grade) + "\n" +
         (run.verdict.grade == Grade::good ? "" : reasons_text(run.verdict, "    "));
}

std::string contact_lines(const AnalysedRun& run) {
  if (!run.contact_energy) return "";
  const auto line = [](std::string name, const std::string& value) {
    name.resize(32, ' ');
    return "  " + name + value + "\n";
  };
  return line("contact energy", contact_energy_text(*run.contact_energy)) +
         line("softened", softened_text(*run.contact_energy));
}

/// How many runs have which verdict, and a line for each run that is not good.
std::string verdict_lines(const std::vector<AnalysedRun>& runs) {
  std::map<Grade, int> count;
  std::string doubts;
  for (const AnalysedRun& run : runs) {
    ++count[run.verdict.grade];
    if (run.verdict.grade != Grade::good) doubts += "    " + shown(run.path) + ": " + verdict_text(run.verdict) + "\n";
  }
  std::string text;
  for (const auto& [grade, number] : count)
    text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + grade_name(grade);
  return "  verdict" + std::string(25, ' ') + text + "\n" + doubts;
}

}  // namespace

Json json_of(const AnalysedRun& run) {
  Json object = {{"file", run.path}, {"name", run.name}, {"duration_s", run.duration_s}};
  object["verdict"] = grade_name(run.verdict.grade);
  object["verdict_criteria"] = criteria_json(run.verdict);
  if (run.contact_energy) object["contact_energy"] = json_of(*run.contact_energy);
  for (const Finding& finding : run.findings) object["findings"][finding.name] = json_of(finding);
  for (const LineFinding& line : run.lines) object["mooring_lines"].push_back(json_of(line));
  return object;
}

std::string text_of(const AnalysedRun& run) {
  std::string text = shown(run.path) + ": " + run.name + ", " + short_text(run.duration_s) + " s\n" +
                     verdict_lines(run) + contact_lines(run) + row_text("", {"value", "95 % interval"});
  const bool without_contact = untouched(run.findings);
  bool some_not_resolved = false, mean_without_interval = false;
  for (const Finding& finding : run.findings) {
    const FindingText words = words_of(finding, without_contact);
    text += row_text(finding.name, {words.value, words.interval});
    some_not_resolved = some_not_resolved || words.not_resolved;
    mean_without_interval = mean_without_interval || (finding.name == "x_offset_m" && words.interval == "-");
  }
  if (mean_without_interval && !without_contact)
    text +=
        "-: no interval; that of a mean needs a record of 16 natural periods, and a largest value is a single draw\n";
  if (some_not_resolved)
    text +=
        "not resolved: the record has too few cycles or spells for it (a period by spectrum needs 5 cycles and an "
        "interval within a\nfactor of two, one by crossings 20), or nothing moved; a longer run may have it\n";
  if (!finding_of(run.findings, "contact_fraction").value) return text;
  return text + text_of(run.lines) +
         "spells and gaps cut by an end of the record count with their observed part: mean = total time over "
         "the\n"
         "observed ends (exponential), median by Kaplan-Meier, the longest is a lower bound\n";
}

Json json_of(const std::vector<AnalysedRun>& runs, const CombinedRuns& all) {
  Json object = {{"runs", Json::array()}, {"over_runs", Json::object()}, {"extremes", Json::object()}};
  for (const AnalysedRun& run : runs) object["runs"].push_back(json_of(run));
  for (const RunsFinding& row : all.means) {
    Json& entry = object["over_runs"][row.name] = {{"runs", row.runs}};
    if (!row.mean) continue;
    entry["mean"] = json_of(*row.mean);
    entry["deviation"] = row.deviation;
    entry["smallest"] = row.smallest;
    entry["largest"] = row.largest;
  }
  for (const RunsExtreme& extreme : all.extremes)
    object["extremes"][extreme.name] = {
        {"most_probable", json_of(extreme.most_probable)},
        {"p90", json_of(extreme.p90)},
        {"gumbel_by_likelihood", {{"mode", extreme.by_likelihood.mode}, {"scale", extreme.by_likelihood.scale}}},
        {"gumbel_by_moments", {{"mode", extreme.by_moments.mode}, {"scale", extreme.by_moments.scale}}}};
  return object;
}

std::string text_of(const std::vector<AnalysedRun>& runs, const CombinedRuns& all) {
  std::string text = std::to_string(runs.size()) + " runs of " + short_text(runs.front().duration_s) + " s\n" +
                     verdict_lines(runs) + row_text("", {"mean", "deviation", "runs", "95 % interval of the mean"});
  for (const RunsFinding& row : all.means)
    text += row.mean ? row_text(row.name, {short_text(row.mean->value), short_text(row.deviation),
                                           std::to_string(row.runs), interval_text(*row.mean)})
                     : row_text(row.name, {"not resolved"});
  if (all.extremes.empty()) return text + "extremes need at least five runs\n";
  text += "largest of one exposure (Gumbel)\n" + row_text("", {"most probable", "90 % quantile", "its 95 % interval"});
  for (const RunsExtreme& extreme : all.extremes)
    text += row_text(extreme.name, {short_text(extreme.most_probable.value), short_text(extreme.p90.value),
                                    interval_text(extreme.p90)});
  return text;
}

}  // namespace gem
