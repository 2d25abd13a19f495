// Writes all checks as rows of a CSV file.
#include <cmath>

#include "gem/base/number_text.h"
#include "validation/paper/page/paper_page.h"

namespace gem {
namespace {

std::string quoted_field(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string number_field(double value) { return std::isfinite(value) ? number_text(value, 9) : ""; }

std::string kind_text(const Rule& rule) {
  switch (rule.kind) {
    case RuleKind::within:
      return "within";
    case RuleKind::above:
      return "above";
    case RuleKind::below:
      return "below";
    case RuleKind::significant:
      return "significant";
  }
  return "";
}

std::string row_text(const JudgedRow& row) {
  const bool within = row.rule.kind == RuleKind::within;
  std::string text = row.id + "," + quoted_field(row.condition.empty() ? "all" : row.condition) + "," + row.metric +
                     "," + number_field(row.rule.expected) + "," + quoted_field(row.source) + "," +
                     (within ? number_field(row.rule.tolerance) : "") + "," + kind_text(row.rule) + ",";
  if (row.measured)
    text += number_field(row.measured->value) + "," + number_field(row.measured->low) + "," +
            number_field(row.measured->high) + "," + quoted_field(row.measured->interval);
  else
    text += ",,," + quoted_field(row.note);
  return text + "," + verdict_text(row.verdict) + "\n";
}

std::string row_text(const JudgedSettings& settings) {
  std::string differences;
  for (const std::string& difference : settings.differences)
    differences += (differences.empty() ? "" : "; ") + difference;
  if (settings.runs == 0) differences = "no run";
  return "T" + settings.row.table + "." + settings.row.number + "," + quoted_field(settings.row.run) +
         ",settings,,\"Table " + settings.row.table + ", row " + settings.row.number + "\",,exact," +
         std::to_string(settings.runs) + ",,," + quoted_field(differences) + "," + verdict_text(settings.verdict) +
         "\n";
}

std::string row_text(const Candidate& candidate, const Prediction& prediction) {
  std::string text = "Q," + quoted_field(prediction.condition) + "," + prediction.metric + "," +
                     number_field(prediction.period_s) + "," + quoted_field("72 s: " + candidate.name) + ",,holds,";
  if (prediction.measured)
    text += number_field(prediction.measured->value) + "," + number_field(prediction.measured->low) + "," +
            number_field(prediction.measured->high) + "," + quoted_field(prediction.measured->interval);
  else
    text += ",,,\"no run, or too few swings\"";
  return text + "," + verdict_text(prediction.verdict) + "\n";
}

}  // namespace

std::string rows_text(const Reproduction& result) {
  std::string text = "id,case,metric,expected,source,tolerance,kind,result,low,high,interval,verdict\n";
  for (const JudgedRow& row : result.statements) text += row_text(row);
  for (const JudgedSettings& settings : result.settings) text += row_text(settings);
  for (const Candidate& candidate : result.period)
    for (const Prediction& prediction : candidate.predictions) text += row_text(candidate, prediction);
  for (const ChoiceRow& choice : result.choices)
    for (const JudgedRow& row : choice.statements) text += row_text(row);
  return text;
}

}  // namespace gem
