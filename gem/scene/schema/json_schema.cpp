// Writes the option table as a JSON Schema for editors. Draft 4: exclusive bounds are flags.
#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/case_text.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

Json bounded(Json schema, const Range& range) {
  if (std::isfinite(range.low)) {
    schema["minimum"] = range.low;
    if (range.low_open) schema["exclusiveMinimum"] = true;
  }
  if (std::isfinite(range.high)) {
    schema["maximum"] = range.high;
    if (range.high_open) schema["exclusiveMaximum"] = true;
  }
  return schema;
}

Json list_of(Json items, std::size_t least, std::size_t most) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", least}, {"maxItems", most}};
}

Json table_row(const std::vector<OptionColumn>& columns) {
  Json row = {{"type", "array"}, {"items", Json::array()}};
  for (const OptionColumn& column : columns) {
    Json cell = bounded({{"type", "number"}}, column.range);
    cell["description"] = column.name + " [" + column.unit + "]";
    row["items"].push_back(std::move(cell));
  }
  row["additionalItems"] = false;
  row["minItems"] = columns.size();
  return row;
}

Json type_schema(const OptionInfo& info) {
  const Json number = bounded({{"type", "number"}}, info.range);
  switch (info.type) {
    case OptionType::number:
      return number;
    case OptionType::integer:
      return bounded({{"type", "integer"}}, info.range);
    case OptionType::text:
      return {{"type", "string"}};
    case OptionType::choice:
      return {{"type", "string"}, {"enum", info.choices}};
    case OptionType::flag:
      return {{"type", "boolean"}};
    case OptionType::pair:
      return list_of(number, 2, 2);
    case OptionType::outline:
      return list_of(list_of(number, 2, 2), listed_corners_minimum, info.corners_maximum);
    case OptionType::table:
      return list_of(table_row(info.columns), 0, table_rows_maximum);
  }
  return {};
}

Json default_json(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* pair = std::get_if<Vec2>(&value)) return Json::array({pair->x, pair->y});
  if (std::holds_alternative<OptionRows>(value)) return Json::array();
  return nullptr;
}

template <class T>
Json option_schema(const Option<T>& option) {
  Json schema = type_schema(option);
  schema["description"] = option.doc + (option.unit.empty() ? "" : " [" + option.unit + "]");
  if (option.type != OptionType::outline) schema["default"] = default_json(option.get(T{}));
  return schema;
}

Json object() { return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}}; }

template <class T>
Json list_schema(const std::vector<Option<T>>& options) {
  Json item = object();
  for (const auto& option : options) {
    item["properties"][option.path] = option_schema(option);
    if (option.type == OptionType::outline) item["required"].push_back(option.path);
  }
  return {{"type", "array"}, {"items", item}};
}

}  // namespace

std::string json_schema() {
  Json root = object();
  root["$schema"] = "http://json-schema.org/draft-04/schema#";
  root["title"] = "gem case file";
  Json& sections = root["properties"];
  for (const auto& option : scene_options()) {
    const std::size_t dot = option.path.find('.');
    const std::string section = option.path.substr(0, dot);
    if (!sections.contains(section)) sections[section] = object();
    sections[section]["properties"][option.path.substr(dot + 1)] = option_schema(option);
  }
  sections["ice"]["properties"]["class"] = list_schema(ice_class_options());
  sections["platform"]["properties"]["piece"] = list_schema(platform_piece_options());
  sections["dp"]["properties"]["thruster"] = list_schema(thruster_options());
  sections["floe"] = list_schema(floe_options());
  sections["fixed"] = list_schema(fixed_options());
  sections["include"] = {{"type", "array"}, {"items", {{"type", "string"}}}};
  sections["sweep"] = {{"type", "object"}};
  return root.dump(2) + "\n";
}

}  // namespace gem
