// Numbers and names of a sensitivity study as text.
#include <algorithm>
#include <cmath>
#include <map>

#include "gem/report/display.h"
#include "gem/report/plain_text.h"
#include "gem/report/sweep/sensitivity_page.h"

namespace gem {
namespace {

Unit unit_of_output(const std::string& name, double size) {
  if (name.ends_with("_N")) return force_unit(size);
  if (name.ends_with("_m")) return length_unit(size);
  if (name.ends_with("_m_per_s")) return {"m/s", 1.0};
  if (name.ends_with("_s")) return {"s", 1.0};
  if (name.ends_with("_rad")) return {"rad", 1.0};
  return {"", 1.0};
}

std::string in_brackets(const IntervalEstimate& estimate, const Unit& unit) {
  std::string text = rounded_text(estimate.value / unit.size) + " [" + rounded_text(estimate.low / unit.size) + ", " +
                     rounded_text(estimate.high / unit.size) + "]";
  return unit.name.empty() ? text : text + " " + unit.name;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size() + 2), ' ');
  return text;
}

std::string effect_line(const StudyInput& input, const InputEffect& effect) {
  const auto share = [](const std::optional<TrendShare>& trend) {
    return padded(share_text(trend ? std::optional(trend->share) : std::nullopt), 18);
  };
  std::string text = "    " + padded(plain_text(input.name), 18) + share(effect.linear) + share(effect.monotone) +
                     padded(share_text(effect.first), 18) + share_text(effect.total);
  return text + "\n";
}

}  // namespace

std::string output_words(const std::string& name) {
  static const std::map<std::string, std::string> words = {
      {"ice_force_x_mean_N", "mean ice force along x"},
      {"ice_force_window_largest_N", "largest ice force, averaged over output.force_window_s"},
      {"ice_sample_largest_N", "largest ice force in one sample of the platform"},
      {"mooring_force_largest_N", "largest force of mooring or thrusters"},
      {"orbit_largest_m", "largest excursion"},
      {"x_offset_m", "mean offset along x"},
      {"contact_fraction", "share of the time with contact"}};
  const auto found = words.find(name);
  return found == words.end() ? name : found->second;
}

std::string output_text(const std::string& name, double value) {
  const Unit unit = unit_of_output(name, std::abs(value));
  return unit.name.empty() ? rounded_text(value) : with_unit(value, unit);
}

std::string output_text(const std::string& name, const IntervalEstimate& estimate) {
  return in_brackets(estimate, unit_of_output(name, std::abs(estimate.value)));
}

std::string share_text(const std::optional<IntervalEstimate>& share) {
  if (!share) return "-";
  const auto percent = [](double value) { return decimal_text(100.0 * value, 0); };
  return percent(share->value) + " [" + percent(share->low) + ", " + percent(share->high) + "] %";
}

std::optional<IntervalEstimate> leading_share(const StudyInput& input, const InputEffect& effect) {
  if (input.is_seed) return effect.total;
  if (effect.total) return effect.first;  // a Saltelli design
  if (effect.monotone) return effect.monotone->share;
  return effect.first;
}

std::string sensitivity_text(const SensitivityPage& page) {
  std::string text = std::to_string(page.study.runs.size()) + " of " + std::to_string(page.listed) +
                     " runs; shares of the variance, brackets: 95 %\n";
  for (const ConditionEffects& condition : page.effects) {
    if (!condition.condition.empty()) text += plain_text(condition.condition) + "\n";
    for (const OutputEffects& effects : condition.outputs) {
      text += "  " + plain_text(effects.output) + ", " + std::to_string(effects.draws) + " draws, " +
              std::to_string(effects.runs) + " runs\n";
      if (effects.mean)
        text += "    mean " + output_text(effects.output, *effects.mean) + ", deviation " +
                output_text(effects.output, *effects.deviation) + ", 90 % quantile " +
                output_text(effects.output, *effects.p90) + "\n";
      text += "    " + padded("input", 18) + padded("linear", 18) + padded("monotone", 18) + padded("first order", 18) +
              "total\n";
      for (std::size_t k = 0; k < effects.inputs.size(); ++k)
        text += effect_line(page.study.inputs[k], effects.inputs[k]);
    }
  }
  return text;
}

}  // namespace gem
