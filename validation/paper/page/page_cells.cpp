// Cells of tables: numbers and intervals.
#include <cmath>

#include "gem/report/display.h"
#include "validation/paper/page/page_parts.h"

namespace gem {

std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string end_text(double value) { return std::isfinite(value) ? rounded_text(value, 4) : (value < 0 ? "-∞" : "∞"); }

std::string result_text(const std::optional<Measured>& measured, const std::string& note) {
  if (!measured) return "- (" + note + ")";
  const std::string value = end_text(measured->value);
  if (measured->low == measured->high) return value + " (" + measured->interval + ")";
  return value + " (" + end_text(measured->low) + " … " + end_text(measured->high) + "; " + measured->interval + ")";
}

std::string mean_text(const PaperFolder& folder, const std::string& run, const std::string& name, double unit) {
  const auto measured = over_runs(folder.numbers(run, name), Over::mean);
  if (!measured) return "-";
  const std::string value = rounded_text(measured->value / unit, 3);
  if (!std::isfinite(measured->low)) return value;
  return value + " (" + rounded_text(measured->low / unit, 3) + " … " + rounded_text(measured->high / unit, 3) + ")";
}

std::string chance_text(const PaperFolder& folder, const std::string& run, const std::string& name) {
  const auto measured = over_runs(folder.numbers(run, name), Over::chances);
  return measured ? rounded_text(measured->value, 3) : "-";
}

}  // namespace gem
