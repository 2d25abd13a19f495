// Explanations and listings, all generated from the option table.
#include "gem/scene/toml/case_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/scene/problems.h"
#include "gem/scene/toml/scene_file.h"
#include "gem/scene/toml/scene_tree.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

/// One row of the table with its default, for any struct.
struct Row {
  OptionInfo info;
  std::string default_text;
};

template <class T>
void append_rows(std::vector<Row>& rows, const std::vector<Option<T>>& options, const std::string& prefix) {
  const T defaults;
  for (const auto& option : options) {
    const bool needed = option.type == OptionType::outline && !option.opt_in;
    Row row{option, needed ? "" : value_text(option.get(defaults))};
    row.info.path = prefix + option.path;
    rows.push_back(std::move(row));
  }
}

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  append_rows(rows, scene_options(), "");
  append_rows(rows, ice_class_options(), "ice.class.");
  append_rows(rows, platform_piece_options(), "platform.piece.");
  append_rows(rows, thruster_options(), "dp.thruster.");
  append_rows(rows, floe_options(), "floe.");
  append_rows(rows, fixed_options(), "fixed.");
  return rows;
}

std::string section_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

std::vector<Row> rows_of(const std::string& key) {
  const std::vector<Row> rows = all_rows();
  if (key.empty()) return rows;
  std::vector<Row> found;
  std::vector<std::string> names;
  for (const Row& row : rows) {
    names.push_back(row.info.path);
    const std::string section = section_of(row.info.path);
    if (std::find(names.begin(), names.end(), section) == names.end()) names.push_back(section);
    if (row.info.path == key || row.info.path.starts_with(key + ".")) found.push_back(row);
  }
  if (found.empty())
    throw Error(ExitCode::usage,
                "unknown key " + value_text(key) + " (no option has this name)" + suggestion_or_list(key, names));
  return found;
}

/// The columns of a table with their ranges.
std::string table_text(const OptionInfo& info) {
  std::string text;
  for (const OptionColumn& column : info.columns)
    text += (text.empty() ? "rows of " : ", ") + column.name + " " + range_text(column.range, "");
  return text;
}

std::string allowed_text(const OptionInfo& info) {
  if (info.type == OptionType::choice) {
    std::string text;
    for (const std::string& name : info.choices) text += (text.empty() ? "" : " | ") + name;
    return text;
  }
  if (info.type == OptionType::text || info.type == OptionType::flag) return "";
  if (info.type == OptionType::table) return table_text(info);
  return range_text(info.range, "");
}

/// The allowed values as a cell of a Markdown table, with | escaped.
std::string markdown_range(const OptionInfo& info) {
  if (info.type == OptionType::flag) return "`true`, `false`";
  if (info.type == OptionType::text) return "any text";
  if (info.type == OptionType::pair) return "two numbers in " + range_text(info.range, "");
  if (info.type == OptionType::table) return table_text(info);
  if (info.type == OptionType::outline) return "pairs of numbers in " + range_text(info.range, "");
  if (info.type != OptionType::choice) return range_text(info.range, "");
  std::string text;
  for (const std::string& name : info.choices) text += (text.empty() ? "`" : ", `") + name + "`";
  return text;
}

std::string heading(const std::string& section) {
  for (const char* list : {"ice.class", "platform.piece", "dp.thruster", "floe", "fixed"})
    if (section == list) return "[[" + section + "]]";
  return "[" + section + "]";
}

}  // namespace

std::string explain(const std::string& key) {
  std::string text;
  std::string open;
  for (const Row& row : rows_of(key)) {
    const std::string section = section_of(row.info.path);
    if (section != open) {
      if (!text.empty()) text += '\n';
      text += heading(section) + "\n";
      open = section;
    }
    text += row.info.path.substr(section.size() + 1) + " = " +
            (row.default_text.empty() ? "(must be given)" : row.default_text) + "\n";
    text += "    " + row.info.doc + "\n    " + type_name(row.info.type);
    if (!row.info.unit.empty()) text += ", " + row.info.unit;
    const std::string allowed = allowed_text(row.info);
    text += allowed.empty() ? "\n" : ", allowed " + allowed + "\n";
  }
  return text;
}

std::string explain_json(const std::string& key) {
  Json list = Json::array();
  for (const Row& row : rows_of(key)) {
    Json entry = {{"key", row.info.path}, {"type", type_name(row.info.type)}, {"unit", row.info.unit}};
    entry["default"] = row.default_text;
    entry["allowed"] = allowed_text(row.info);
    entry["doc"] = row.info.doc;
    list.push_back(std::move(entry));
  }
  return list.dump(2) + "\n";
}

std::string explain_markdown(const std::string& key) {
  std::string text =
      "# Keys of a case file\n\n"
      "Made by `gem case explain --markdown` from the table that reads case files. Do not edit it by hand.\n"
      "A key that is left out has its default. In a range, `[` and `]` include the bound, `(` and `)` exclude it.\n";
  std::string open;
  for (const Row& row : rows_of(key)) {
    const std::string section = section_of(row.info.path);
    if (section != open) {
      text += "\n## `" + heading(section) + "`\n\n| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
      open = section;
    }
    text += "| `" + row.info.path.substr(section.size() + 1) + "` | " + row.info.unit + " | " +
            (row.default_text.empty() ? "must be given" : "`" + row.default_text + "`") + " | " +
            markdown_range(row.info) + " | " + row.info.doc + " |\n";
  }
  return text;
}

std::string sweep_list_text(const std::vector<SweepMember>& members) {
  std::size_t width = 4;
  for (const SweepMember& member : members) width = std::max(width, member.name.size());
  std::string text = "index  name" + std::string(width - 4, ' ') + "  differences\n";
  for (const SweepMember& member : members) {
    const std::string index = std::to_string(member.index);
    text += std::string(5 - std::min<std::size_t>(5, index.size()), ' ') + index + "  " + member.name +
            std::string(width - member.name.size(), ' ');
    for (const std::string& difference : member.differences) text += "  " + difference;
    text += "\n";
  }
  return text;
}

namespace {

Json drawn_json(const SweepDraw& draw) {
  Json values = Json::array();
  for (const DrawnValue& one : draw.values)
    values.push_back({{"variable", one.variable}, {"key", one.key}, {"law", one.law}, {"value", one.value}});
  return values;
}

}  // namespace

std::string sweep_list_json(const std::vector<SweepMember>& members) {
  Json list = Json::array();
  for (const SweepMember& member : members) {
    Json entry = {{"index", member.index},
                  {"name", member.name},
                  {"duration_s", member.scene.run.duration_s},
                  {"differences", member.differences},
                  {"sha256", scene_hash(member.scene)}};
    if (member.draw.draw > 0) entry["drawn"] = drawn_json(member.draw);
    list.push_back(std::move(entry));
  }
  return list.dump(2) + "\n";
}

}  // namespace gem
