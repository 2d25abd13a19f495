// Finds the option of a key, and writes numbers into documents.
#include "gem/scene/sweep/draw_target.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gem/base/number_text.h"
#include "gem/scene/problems.h"
#include "gem/scene/sweep/reject_key.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

bool is_number(OptionType type) { return type == OptionType::number || type == OptionType::integer; }

double number_of(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::get<double>(value);
}

template <class T>
const Option<T>* number_option(const std::vector<Option<T>>& options, const std::string& path) {
  const auto found = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.path == path; });
  return found == options.end() ? nullptr : &*found;
}

DrawTarget target_of(const OptionInfo& info, const std::string& key, const std::string& path, double usual) {
  DrawTarget target;
  target.key = key;
  target.path = path;
  target.unit = info.unit;
  target.range = info.range;
  target.whole = info.type == OptionType::integer;
  target.usual = usual;
  return target;
}

template <class T>
void append_keys(std::vector<std::string>& keys, const std::vector<Option<T>>& options, const std::string& prefix) {
  for (const auto& option : options) {
    if (is_number(option.type)) keys.push_back(prefix + option.path);
    if (option.type == OptionType::pair && prefix.empty())
      keys.insert(keys.end(), {option.path + ".x", option.path + ".y"});
  }
}

std::vector<std::string> numbers_of_cases() {
  std::vector<std::string> keys;
  append_keys(keys, scene_options(), "");
  append_keys(keys, ice_class_options(), "ice.class.");
  append_keys(keys, platform_piece_options(), "platform.piece.");
  append_keys(keys, thruster_options(), "dp.thruster.");
  append_keys(keys, floe_options(), "floe.");
  append_keys(keys, fixed_options(), "fixed.");
  return keys;
}

template <class T>
std::optional<DrawTarget> in_list(const std::string& list, const std::vector<Option<T>>& options,
                                  const std::string& key) {
  if (!key.starts_with(list + ".")) return std::nullopt;
  const Option<T>* option = number_option(options, key.substr(list.size() + 1));
  if (option == nullptr || !is_number(option->type)) return std::nullopt;
  DrawTarget target = target_of(*option, key, list, number_of(option->get(T{})));
  target.entry = option->path;
  return target;
}

std::optional<DrawTarget> in_pair(const std::string& key) {
  if (!key.ends_with(".x") && !key.ends_with(".y")) return std::nullopt;
  const auto* pair = number_option(scene_options(), key.substr(0, key.size() - 2));
  if (pair == nullptr || pair->type != OptionType::pair) return std::nullopt;
  const Vec2 usual = std::get<Vec2>(pair->get(SceneDef{}));
  const bool is_y = key.ends_with(".y");
  DrawTarget target = target_of(*pair, key, pair->path, is_y ? usual.y : usual.x);
  target.component = is_y ? 1 : 0;
  return target;
}

TomlNode number_node(double value, const DrawTarget& target, const TomlPlace& place) {
  const bool whole = target.whole;
  constexpr double largest_whole = 9007199254740992.0;  // 2^53: beyond it not every whole number is a double
  if (!std::isfinite(value) || (whole && std::abs(value) > largest_whole))
    reject_key(place, target.key,
               "a draw is no number that the key can hold (value " + number_text(value) +
                   "); choose a law or a factor with smaller numbers");
  TomlNode node;
  node.kind = whole ? TomlKind::integer : TomlKind::number;
  if (whole)
    node.integer = static_cast<std::int64_t>(std::floor(value + 0.5));
  else
    node.number = value + 0.0;  // -0 becomes 0
  node.place = node.key_place = place;
  return node;
}

/// The number that a node holds, or `usual` without a node.
double held(const TomlNode* node, const DrawTarget& target) {
  if (node == nullptr) return target.usual;
  if (node->kind == TomlKind::integer) return static_cast<double>(node->integer);
  if (node->kind == TomlKind::number) return node->number;
  reject_key(node->place, target.key, "wrong type (value " + describe(*node) + ", expected a number)");
}

TomlNode drawn_node(const TomlNode* old, const DrawTarget& target, double value, bool is_factor,
                    const TomlPlace& place) {
  return number_node(is_factor ? value * held(old, target) : value, target, place);
}

void write_in_list(TomlNode& list, const DrawTarget& target, double value, bool is_factor, const TomlPlace& place) {
  for (TomlNode& item : list.items) {
    const TomlNode node = drawn_node(item.find(target.entry), target, value, is_factor, place);
    if (TomlNode* old = item.find(target.entry))
      *old = node;
    else
      item.entries.emplace_back(target.entry, node);
  }
}

}  // namespace

DrawTarget draw_target(const TomlNode& node, const std::string& what) {
  const std::string& key = node.text;
  if (const auto* option = number_option(scene_options(), key)) {
    if (is_number(option->type)) return target_of(*option, key, key, number_of(option->get(SceneDef{})));
    if (option->type == OptionType::pair)
      reject_key(node.place, what, quoted_text(key) + " is a pair; draw " + key + ".x or " + key + ".y");
    reject_key(node.place, what,
               "only numbers can be drawn (" + quoted_text(key) + " is a " + type_name(option->type) +
                   "); use an axis of the sweep for it");
  }
  if (auto target = in_pair(key)) return *target;
  if (auto target = in_list("ice.class", ice_class_options(), key)) return *target;
  if (auto target = in_list("platform.piece", platform_piece_options(), key)) return *target;
  if (auto target = in_list("dp.thruster", thruster_options(), key)) return *target;
  if (auto target = in_list("floe", floe_options(), key)) return *target;
  if (auto target = in_list("fixed", fixed_options(), key)) return *target;
  reject_key(node.place, what,
             "no number of a case has this key (value " + quoted_text(key) + ")" + suggestion(key, numbers_of_cases()));
}

void write_draw(TomlNode& document, const DrawTarget& target, double value, bool is_factor, const TomlPlace& place) {
  const TomlNode* found = find_path(document, target.path);
  if (!target.entry.empty()) {
    if (found == nullptr || found->kind != TomlKind::list || found->items.empty())
      reject_key(place, target.key, "the case has no [[" + target.path + "]] of its own; write out its entries");
    TomlNode list = *found;
    write_in_list(list, target, value, is_factor, place);
    merge_toml(document, nested_toml(target.path, list));
  } else if (target.component < 0) {
    merge_toml(document, nested_toml(target.path, drawn_node(found, target, value, is_factor, place)));
  } else {
    if (found == nullptr || found->kind != TomlKind::list || found->items.size() != 2)
      reject_key(place, target.key, "the case has no pair " + target.path + " of its own; write out both components");
    TomlNode pair = *found;
    TomlNode& part = pair.items[static_cast<std::size_t>(target.component)];
    part = drawn_node(&part, target, value, is_factor, place);
    merge_toml(document, nested_toml(target.path, pair));
  }
}

bool sets_target(const TomlNode& document, const DrawTarget& target) {
  const TomlNode* found = find_path(document, target.path);
  if (found == nullptr || target.entry.empty()) return found != nullptr;
  return std::any_of(found->items.begin(), found->items.end(),
                     [&](const TomlNode& item) { return item.find(target.entry) != nullptr; });
}

}  // namespace gem
