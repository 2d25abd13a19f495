// Ranges, columns and values of options as text.
#include <limits>

#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::string range_text(const Range& range, const std::string& unit) {
  std::string text = range.low_open || range.low == -infinity ? "(" : "[";
  text += plain_number_text(range.low) + ", " + plain_number_text(range.high);
  text += range.high_open || range.high == infinity ? ")" : "]";
  return unit.empty() ? text : text + " " + unit;
}

std::string columns_text(const std::vector<OptionColumn>& columns) {
  std::string text;
  for (const OptionColumn& column : columns) text += (text.empty() ? "[" : ", ") + column.name + " " + column.unit;
  return text + "]";
}

std::string value_text(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return toml_number_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&value)) return quoted_text(*text);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* pair = std::get_if<Vec2>(&value)) return pair_text(*pair);
  if (const auto* rows = std::get_if<OptionRows>(&value)) return rows_text(*rows);
  return outline_text(std::get<std::vector<Vec2>>(value));
}

std::string type_name(OptionType type) {
  switch (type) {
    case OptionType::number:
      return "number";
    case OptionType::integer:
      return "integer";
    case OptionType::text:
      return "text";
    case OptionType::choice:
      return "choice";
    case OptionType::flag:
      return "flag";
    case OptionType::pair:
      return "pair";
    case OptionType::outline:
      return "outline";
    case OptionType::table:
      return "table";
  }
  return "";
}

}  // namespace gem
