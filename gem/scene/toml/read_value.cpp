// Checks one value against one row of the option table.
#include <algorithm>
#include <cmath>

#include "gem/scene/toml/scene_tree.h"
#include "gem/scene/toml/toml_text.h"
#include "gem/scene/toml/value_fault.h"

namespace gem {
namespace {

constexpr std::int64_t exact_integer_maximum = std::int64_t{1} << 53;

/// Reads one value and adds problems with their places.
class ValueReader {
 public:
  ValueReader(const OptionInfo& info, const std::string& key, Problems& problems)
      : info_(info), key_(key), problems_(problems) {}

  std::nullopt_t reject(const TomlNode& node, const std::string& problem) {
    problems_.add(node.place, key_, problem);
    return std::nullopt;
  }

  std::nullopt_t wrong_type(const TomlNode& node) {
    const bool has_unit = node.kind == TomlKind::text && is_number_with_unit(node.text);
    return reject(node, "wrong type (value " + describe(node) + ", expected " + expected_text(info_) + ")" +
                            (has_unit ? "; write the number alone; the unit is in the key's name" : ""));
  }

  std::optional<double> number(const TomlNode& node) {
    double value = node.number;
    if (node.kind == TomlKind::integer) {
      if (std::abs(static_cast<double>(node.integer)) > static_cast<double>(exact_integer_maximum))
        return reject(node, out_of_range(node));
      value = static_cast<double>(node.integer);
    } else if (node.kind != TomlKind::number) {
      return wrong_type(node);
    }
    if (!std::isfinite(value))
      return reject(node, "not finite (value " + describe(node) + ", allowed " + range_text(info_.range, info_.unit) +
                              "); give a finite number");
    if (!info_.range.contains(value)) return reject(node, out_of_range(node));
    return value + 0.0;  // -0 becomes 0, so that one value has one text and one hash
  }

  std::optional<std::int64_t> integer(const TomlNode& node) {
    if (node.kind != TomlKind::integer) return wrong_type(node);
    if (!info_.range.contains(static_cast<double>(node.integer))) return reject(node, out_of_range(node));
    return node.integer;
  }

  std::optional<std::string> choice(const TomlNode& node) {
    if (node.kind != TomlKind::text) return wrong_type(node);
    if (std::find(info_.choices.begin(), info_.choices.end(), node.text) != info_.choices.end()) return node.text;
    std::string allowed;
    for (const std::string& name : info_.choices) allowed += (allowed.empty() ? "" : ", ") + name;
    return reject(node, "unknown choice (value " + describe(node) + ", allowed " + allowed + ")" +
                            suggestion(node.text, info_.choices));
  }

  std::optional<Vec2> pair(const TomlNode& node) {
    if (node.kind != TomlKind::list || node.items.size() != 2) return wrong_type(node);
    const auto x = number(node.items[0]);
    const auto y = number(node.items[1]);
    if (!x || !y) return std::nullopt;
    return Vec2{*x, *y};
  }

  std::optional<std::vector<Vec2>> outline(const TomlNode& node) {
    if (node.kind != TomlKind::list) return wrong_type(node);
    if (node.items.size() < listed_corners_minimum || node.items.size() > info_.corners_maximum)
      return reject(node, "wrong number of corners (value " + std::to_string(node.items.size()) + ", allowed [" +
                              std::to_string(listed_corners_minimum) + ", " + std::to_string(info_.corners_maximum) +
                              "])");
    std::vector<Vec2> corners;
    for (const TomlNode& item : node.items) {
      const auto corner = pair(item);
      if (!corner) return std::nullopt;
      corners.push_back(*corner);
    }
    return corners;
  }

  std::optional<OptionRows> table(const TomlNode& node) {
    if (node.kind != TomlKind::list) return wrong_type(node);
    if (node.items.size() > table_rows_maximum)
      return reject(node, "too many rows (value " + std::to_string(node.items.size()) + ", allowed at most " +
                              std::to_string(table_rows_maximum) + ")");
    OptionRows rows;
    for (const TomlNode& item : node.items) {
      if (item.kind != TomlKind::list || item.items.size() != info_.columns.size()) return wrong_type(item);
      rows.emplace_back();
      for (std::size_t k = 0; k < info_.columns.size(); ++k) {
        const auto value = cell(item.items[k], info_.columns[k]);
        if (!value) return std::nullopt;
        rows.back().push_back(*value);
      }
    }
    return rows;
  }

 private:
  /// A number of a table, read as an option of its own.
  std::optional<double> cell(const TomlNode& node, const OptionColumn& column) {
    const OptionInfo info = {key_, OptionType::number, column.unit, column.range, {}, ""};
    const std::string name = key_ + "." + column.name;
    return ValueReader(info, name, problems_).number(node);
  }

  std::string out_of_range(const TomlNode& node) const {
    const std::string hint = info_.unit.empty() ? "" : "; give it in " + info_.unit;
    return "out of range (value " + describe(node) + ", allowed " + range_text(info_.range, info_.unit) +
           (info_.why.empty() ? "" : ": " + info_.why) + ")" + hint;
  }

  const OptionInfo& info_;
  const std::string& key_;
  Problems& problems_;
};

template <class Value>
std::optional<OptionValue> widened(const std::optional<Value>& value) {
  return value ? std::optional<OptionValue>(OptionValue(*value)) : std::nullopt;
}

}  // namespace

std::string expected_text(const OptionInfo& info) {
  const std::string in_unit = info.unit.empty() ? "" : " in " + info.unit;
  switch (info.type) {
    case OptionType::number:
      return "a number" + in_unit;
    case OptionType::integer:
      return "an integer";
    case OptionType::text:
      return "text in quotes";
    case OptionType::choice:
      return "one of the choices in quotes";
    case OptionType::flag:
      return "true or false";
    case OptionType::pair:
      return "a pair of numbers [x, y]" + in_unit;
    case OptionType::outline:
      return "a list of corners [[x, y], ...]" + in_unit;
    case OptionType::table:
      return "a list of rows " + columns_text(info.columns);
  }
  return "";
}

std::optional<OptionValue> read_value(const OptionInfo& info, const std::string& key, const TomlNode& node,
                                      Problems& problems) {
  ValueReader reader(info, key, problems);
  switch (info.type) {
    case OptionType::number:
      return widened(reader.number(node));
    case OptionType::integer:
      return widened(reader.integer(node));
    case OptionType::choice:
      return widened(reader.choice(node));
    case OptionType::pair:
      return widened(reader.pair(node));
    case OptionType::outline:
      return widened(reader.outline(node));
    case OptionType::table:
      return widened(reader.table(node));
    case OptionType::text:
      if (node.kind != TomlKind::text) return reader.wrong_type(node);
      return OptionValue(node.text);
    case OptionType::flag:
      if (node.kind != TomlKind::flag) return reader.wrong_type(node);
      return OptionValue(node.flag);
  }
  return std::nullopt;
}

}  // namespace gem
