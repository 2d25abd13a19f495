// Reads the sweep table. Every mistake is reported with its place.
#include "gem/scene/sweep/sweep_draft.h"

#include <algorithm>
#include <map>
#include <set>

#include "gem/scene/problems.h"
#include "gem/scene/sweep/reject_key.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr std::size_t name_pattern_maximum = 400;  // bytes; a name may have 200
constexpr std::size_t label_maximum = 200;

using Draft = SweepDraft;

struct Axis {
  std::string name;
  std::vector<TomlNode> values;
};

using Labels = std::map<std::string, std::string>;

const TomlNode& expect(const TomlNode& node, TomlKind kind, const std::string& key, const std::string& expected) {
  if (node.kind != kind)
    reject_key(node.place, key, "wrong type (value " + describe(node) + ", expected " + expected + ")");
  return node;
}

std::string label(const TomlNode& value) {
  switch (value.kind) {
    case TomlKind::text:
      if (value.text.size() > label_maximum)
        reject_key(value.place, "sweep",
                   "a value of an axis is too long (allowed " + std::to_string(label_maximum) + " bytes)");
      return value.text;
    case TomlKind::integer:
      return std::to_string(value.integer);
    case TomlKind::number:
      return plain_number_text(value.number);
    default:
      reject_key(value.place, "sweep", "values of an axis are texts and numbers (value " + describe(value) + ")");
  }
}

TomlNode integer_node(std::int64_t value, const TomlPlace& place) {
  TomlNode node;
  node.kind = TomlKind::integer;
  node.integer = value;
  node.place = node.key_place = place;
  return node;
}

std::string filled(const std::string& pattern, const Labels& labels) {
  std::string out = pattern;
  for (const auto& [axis, text] : labels) {
    const std::string slot = "{" + axis + "}";
    for (std::size_t at = out.find(slot); at != std::string::npos; at = out.find(slot, at + text.size()))
      out.replace(at, slot.size(), text);
  }
  return out;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Reads and checks the table of a product sweep.
class ProductSweep {
 public:
  explicit ProductSweep(const TomlNode& sweep) : sweep_(sweep) {
    static const std::set<std::string> reserved = {"mode", "name", "map", "set", "seeds", "draw"};
    for (const auto& [key, value] : sweep.entries) {
      if (reserved.contains(key)) continue;
      expect(value, TomlKind::list, "sweep." + key, "an axis: a list of values");
      if (value.items.empty()) reject_key(value.place, "sweep." + key, "the axis is empty");
      axes_.push_back({key, value.items});
    }
    if (axes_.empty()) reject_key(sweep.key_place, "sweep", "no axis; give a list of values");
    const TomlNode* name = sweep.find("name");
    if (name == nullptr)
      reject_key(sweep.key_place, "sweep.name", "missing; give a pattern such as \"{" + axes_[0].name + "}\"");
    pattern_ = expect(*name, TomlKind::text, "sweep.name", "text").text;
    if (pattern_.size() > name_pattern_maximum)
      reject_key(name->place, "sweep.name", "too long (allowed " + std::to_string(name_pattern_maximum) + " bytes)");
    check_axis_names();
  }

  std::vector<Draft> drafts() {
    std::size_t count = 1;
    for (const Axis& axis : axes_) {
      count *= axis.values.size();
      if (count > members_maximum)
        reject_key(sweep_.key_place, "sweep", "too many runs (allowed " + std::to_string(members_maximum) + ")");
    }
    std::vector<Draft> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(draft(i));
    check_all_used();
    return out;
  }

 private:
  void check_axis(const TomlPlace& place, const std::string& key, const std::string& axis) const {
    std::vector<std::string> names;
    for (const Axis& a : axes_) names.push_back(a.name);
    if (std::find(names.begin(), names.end(), axis) == names.end())
      reject_key(place, key, "no axis has this name (value " + quoted_text(axis) + ")" + suggestion(axis, names));
  }

  void check_axis_names() const {
    if (const TomlNode* map = sweep_.find("map"))
      for (const auto& [axis, target] : expect(*map, TomlKind::table, "sweep.map", "a table").entries) {
        check_axis(target.key_place, "sweep.map", axis);
        expect(target, TomlKind::text, "sweep.map." + axis, "the path of an option in quotes");
        check_no_list(axis, target);
      }
    if (const TomlNode* set = sweep_.find("set"))
      for (const auto& [axes, table] : expect(*set, TomlKind::table, "sweep.set", "a table").entries) {
        for (const std::string& axis : split(axes)) check_axis(table.key_place, "sweep.set", axis);
        expect(table, TomlKind::table, "sweep.set." + axes, "a table");
      }
    for (const Axis& axis : axes_)
      if (!sets_something(axis.name))
        reject_key(axis.values.front().place, "sweep." + axis.name,
                   "the axis has no effect; add map = { " + axis.name + " = \"section.key\" }");
  }

  /// A list of tables has no single key that an axis could set.
  void check_no_list(const std::string& axis, const TomlNode& target) const {
    for (const char* list : {"ice.class", "platform.piece", "dp.thruster", "floe", "fixed"})
      if (target.text == list || target.text.starts_with(std::string(list) + "."))
        reject_key(target.place, "sweep.map." + axis,
                   "map cannot address a list (value " + quoted_text(target.text) +
                       "); give the list for each value: [sweep.set." + axis + "] with \"" + label(first_value(axis)) +
                       "\"." + list + " = [{ ... }]");
  }

  const TomlNode& first_value(const std::string& axis) const {
    return std::find_if(axes_.begin(), axes_.end(), [&](const Axis& a) { return a.name == axis; })->values.front();
  }

  bool sets_something(const std::string& axis) const {
    if (const TomlNode* map = sweep_.find("map"); map != nullptr && map->find(axis) != nullptr) return true;
    const TomlNode* set = sweep_.find("set");
    if (set == nullptr) return false;
    return std::any_of(set->entries.begin(), set->entries.end(), [&](const auto& entry) {
      const std::vector<std::string> names = split(entry.first);
      return std::find(names.begin(), names.end(), axis) != names.end();
    });
  }

  Draft draft(std::size_t number) {
    std::vector<const TomlNode*> chosen(axes_.size());
    for (std::size_t a = axes_.size(); a-- > 0;) {
      chosen[a] = &axes_[a].values[number % axes_[a].values.size()];
      number /= axes_[a].values.size();
    }
    Labels labels;
    for (std::size_t a = 0; a < axes_.size(); ++a) labels[axes_[a].name] = label(*chosen[a]);
    Draft out;
    out.name = filled(pattern_, labels);
    out.settings.place = sweep_.place;
    if (const TomlNode* map = sweep_.find("map"))
      for (std::size_t a = 0; a < axes_.size(); ++a)
        if (const TomlNode* target = map->find(axes_[a].name))
          merge_toml(out.settings, nested_toml(target->text, *chosen[a]));
    if (const TomlNode* set = sweep_.find("set"))
      for (const auto& [axes, table] : set->entries) merge_toml(out.settings, settings_for(axes, table, labels));
    return out;
  }

  const TomlNode& settings_for(const std::string& axes, const TomlNode& table, const Labels& labels) {
    std::string values;
    for (const std::string& axis : split(axes)) values += (values.empty() ? "" : ",") + labels.at(axis);
    const TomlNode* found = table.find(values);
    if (found == nullptr) reject_key(table.key_place, "sweep.set." + axes, "no settings for " + quoted_text(values));
    used_.insert(found);
    return expect(*found, TomlKind::table, "sweep.set." + axes, "a table of settings");
  }

  void check_all_used() const {
    const TomlNode* set = sweep_.find("set");
    if (set == nullptr) return;
    for (const auto& [axes, table] : set->entries)
      for (const auto& [values, settings] : table.entries)
        if (!used_.contains(&settings))
          reject_key(settings.key_place, "sweep.set." + axes, "no run has the value " + quoted_text(values));
  }

  const TomlNode& sweep_;
  std::vector<Axis> axes_;
  std::string pattern_;
  std::set<const TomlNode*> used_;
};

std::vector<Draft> list_drafts(const TomlNode& sweep) {
  for (const auto& [key, value] : sweep.entries)
    if (key != "mode" && key != "run" && key != "seeds" && key != "draw")
      reject_key(
          value.key_place, "sweep." + key,
          "unknown key (known are mode, run, seeds and draw)" + suggestion(key, {"mode", "run", "seeds", "draw"}));
  const TomlNode* runs = sweep.find("run");
  if (runs == nullptr) reject_key(sweep.key_place, "sweep.run", "missing; give [[sweep.run]]");
  std::vector<Draft> out;
  for (const TomlNode& run : expect(*runs, TomlKind::list, "sweep.run", "[[sweep.run]]").items) {
    Draft draft;
    draft.settings = expect(run, TomlKind::table, "sweep.run", "a table");
    const TomlNode* name = run.find("name");
    if (name == nullptr) reject_key(run.place, "sweep.run.name", "missing");
    draft.name = expect(*name, TomlKind::text, "sweep.run.name", "text").text;
    std::erase_if(draft.settings.entries, [](const auto& entry) { return entry.first == "name"; });
    out.push_back(std::move(draft));
  }
  return out;
}

/// The case itself; its draws make the runs. The name may be left out.
std::vector<Draft> draw_drafts(const TomlNode& sweep) {
  for (const auto& [key, value] : sweep.entries)
    if (key != "mode" && key != "name" && key != "draw")
      reject_key(value.key_place, "sweep." + key,
                 "unknown key (known are mode, name and draw)" + suggestion(key, {"mode", "name", "draw"}));
  if (sweep.find("draw") == nullptr) reject_key(sweep.key_place, "sweep.draw", "missing; give [sweep.draw]");
  Draft draft;
  draft.settings.place = sweep.place;
  if (const TomlNode* name = sweep.find("name")) draft.name = expect(*name, TomlKind::text, "sweep.name", "text").text;
  return {draft};
}

std::int64_t seed_number(const TomlNode& seeds, const std::string& key, std::int64_t low, std::int64_t high,
                         std::int64_t otherwise) {
  const TomlNode* node = seeds.find(key);
  if (node == nullptr) return otherwise;
  expect(*node, TomlKind::integer, "sweep.seeds." + key, "an integer");
  if (node->integer < low || node->integer > high)
    reject_key(node->place, "sweep.seeds." + key,
               "out of range (value " + describe(*node) + ", allowed [" + std::to_string(low) + ", " +
                   std::to_string(high) + "])");
  return node->integer;
}

/// Repeats every draft for each seed; with several seeds the name gets the seed.
std::vector<Draft> with_seeds(std::vector<Draft> drafts, const TomlNode& sweep) {
  const TomlNode* seeds = sweep.find("seeds");
  if (seeds == nullptr) return drafts;
  if (sweep.find("draw") != nullptr)
    reject_key(
        seeds->place, "sweep.seeds",
        "not together with sweep.draw; draw run.seed as a variable, and set sweep.draw.repeats for several seeds "
        "of each draw");
  expect(*seeds, TomlKind::table, "sweep.seeds", "{ count, first }");
  for (const auto& [key, value] : seeds->entries)
    if (key != "count" && key != "first")
      reject_key(value.key_place, "sweep.seeds." + key,
                 "unknown key (known are count and first)" + suggestion(key, {"count", "first"}));
  const auto most = static_cast<std::int64_t>(members_maximum / std::max<std::size_t>(1, drafts.size()));
  const std::int64_t count = seed_number(*seeds, "count", 1, most, 1);
  const std::int64_t first = seed_number(*seeds, "first", 0, std::int64_t{1} << 52, 1);
  std::vector<Draft> out;
  for (const Draft& draft : drafts)
    for (std::int64_t seed = first; seed < first + count; ++seed) {
      out.push_back(draft);
      if (count > 1) out.back().name += "_s" + std::to_string(seed);
      merge_toml(out.back().settings, nested_toml("run.seed", integer_node(seed, seeds->place)));
    }
  return out;
}

}  // namespace

std::vector<SweepDraft> make_sweep_drafts(const TomlNode& sweep) {
  expect(sweep, TomlKind::table, "sweep", "[sweep]");
  const TomlNode* mode = sweep.find("mode");
  if (mode == nullptr) reject_key(sweep.key_place, "sweep.mode", "missing (allowed product, list, draw)");
  const std::string name = expect(*mode, TomlKind::text, "sweep.mode", "\"product\", \"list\" or \"draw\"").text;
  if (name == "product") return with_seeds(ProductSweep(sweep).drafts(), sweep);
  if (name == "list") return with_seeds(list_drafts(sweep), sweep);
  if (name == "draw") return draw_drafts(sweep);
  reject_key(mode->place, "sweep.mode",
             "unknown choice (value " + describe(*mode) + ", allowed product, list, draw)" +
                 suggestion(name, {"product", "list", "draw"}));
}

}  // namespace gem
