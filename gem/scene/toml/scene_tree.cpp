// Reads a document with the option table.
#include "gem/scene/toml/scene_tree.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "gem/scene/check_scene.h"
#include "gem/scene/toml/unused_keys.h"

namespace gem {
namespace {

const std::string class_path = "ice.class", piece_path = "platform.piece", thruster_path = "dp.thruster";

std::set<std::string> section_names() {
  std::set<std::string> names;
  for (const auto& option : scene_options()) names.insert(option.path.substr(0, option.path.find('.')));
  return names;
}

template <class T>
std::vector<std::string> paths_of(const std::vector<Option<T>>& options, const std::string& prefix) {
  std::vector<std::string> paths;
  for (const auto& option : options) paths.push_back(prefix + option.path);
  return paths;
}

template <class T>
const Option<T>* find_option(const std::vector<Option<T>>& options, const std::string& path) {
  const auto found = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.path == path; });
  return found == options.end() ? nullptr : &*found;
}

/// Reads one [[list]] entry. `key` is e.g. "floe[0]".
template <class T>
T read_entry(const TomlNode& node, const std::string& key, const std::vector<Option<T>>& options, Problems& problems) {
  T out;
  if (node.kind != TomlKind::table) {
    problems.add(node.place, key, "wrong type (value " + describe(node) + ", expected a table)");
    return out;
  }
  for (const auto& [name, value] : node.entries) {
    const Option<T>* option = find_option(options, name);
    if (option == nullptr)
      problems.add(value.key_place, key + "." + name, "unknown key" + suggestion_or_list(name, paths_of(options, "")));
    else if (const auto read = read_value(*option, key + "." + name, value, problems))
      option->set(out, *read);
  }
  for (const auto& option : options)
    if (option.type == OptionType::outline && node.find(option.path) == nullptr)
      problems.add(node.place, key + "." + option.path, "missing; give the corners [[x, y], ...] in m");
  return out;
}

template <class T>
void read_list(const TomlNode& node, const std::string& key, const std::vector<Option<T>>& options,
               std::vector<T>& target, Problems& problems) {
  if (node.kind != TomlKind::list) {
    problems.add(node.place, key, "wrong type (value " + describe(node) + ", expected [[" + key + "]])");
    return;
  }
  target.clear();
  for (std::size_t i = 0; i < node.items.size(); ++i)
    target.push_back(read_entry(node.items[i], key + "[" + std::to_string(i) + "]", options, problems));
}

void read_section(const std::string& section, const TomlNode& node, SceneDef& scene, Problems& problems) {
  for (const auto& [name, value] : node.entries) {
    const std::string path = section + "." + name;
    if (path == class_path) {
      read_list(value, path, ice_class_options(), scene.floes.classes, problems);
    } else if (path == piece_path) {
      read_list(value, path, platform_piece_options(), scene.platform.piece, problems);
    } else if (path == thruster_path) {
      read_list(value, path, thruster_options(), scene.dp.thruster, problems);
    } else if (const auto* option = find_option(scene_options(), path)) {
      if (const auto read = read_value(*option, path, value, problems)) option->set(scene, *read);
      if (!value.old_key.empty())
        scene.notes.push_back(section + "." + value.old_key + " is now called " + path + "; both names are read");
    } else {
      problems.add(value.key_place, path, "unknown key" + suggestion_or_list(path, known_keys()));
    }
  }
}

/// The smallest multiple of the time step that is at least `least`. Samples of a platform must be even.
double whole_steps(double least, double time_step) {
  constexpr double rounding = 1e-9;
  const double steps = std::ceil(least / time_step * (1.0 - rounding));
  if (steps <= 1.0) return std::max(least, time_step);
  const double interval = steps * time_step;
  if (std::abs(interval - least) <= rounding * least) return least;
  constexpr double digits = 1e12;  // 3 steps of 0.035 s are 0.105 s, not 0.10500000000000001 s
  return std::round(interval * digits) / digits;
}

/// Gives the keys that a document leaves out the default that follows from its other keys.
void follow_other_keys(const TomlNode& document, SceneDef& scene) {
  const auto left_out = [&](const char* path) { return find_path(document, path) == nullptr; };
  const IterationEnd end = default_end(scene.numerics.iteration);
  if (left_out("numerics.residual_tolerance")) scene.numerics.residual_tolerance = end.residual_tolerance;
  if (left_out("numerics.iterations_maximum")) scene.numerics.iterations_maximum = end.iterations_maximum;
  if (left_out("output.platform_interval_s"))
    scene.output.platform_interval_s = whole_steps(scene.output.platform_interval_s, scene.numerics.time_step_s);
}

}  // namespace

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = paths_of(scene_options(), "");
  keys.insert(keys.end(), {class_path, piece_path, thruster_path, "floe", "fixed", "include"});
  return keys;
}

SceneDef scene_from_tree(const TomlNode& document, Problems& problems) {
  SceneDef scene;
  const std::set<std::string> sections = section_names();
  for (const auto& [name, value] : document.entries) {
    if (name == "floe") {
      read_list(value, name, floe_options(), scene.floe, problems);
    } else if (name == "fixed") {
      read_list(value, name, fixed_options(), scene.fixed, problems);
    } else if (name == "sweep") {
      problems.add(value.key_place, name, "the file is a sweep of several runs; choose one with --index");
    } else if (name == "include") {
      problems.add(value.key_place, name, "stands only at the top of a file, before its sections");
    } else if (!sections.contains(name)) {
      const bool table = value.kind == TomlKind::table;
      std::vector<std::string> candidates = known_keys();
      if (table) candidates.assign(sections.begin(), sections.end());
      problems.add(value.key_place, name,
                   (table ? "unknown section" : "unknown key") + suggestion_or_list(name, candidates));
    } else if (value.kind != TomlKind::table) {
      problems.add(value.place, name, "wrong type (value " + describe(value) + ", expected [" + name + "])");
    } else {
      read_section(name, value, scene, problems);
    }
  }
  follow_other_keys(document, scene);
  return scene;
}

SceneDef checked_scene(const TomlNode& document) {
  Problems problems;
  SceneDef scene = scene_from_tree(document, problems);
  // Options that could not be read are not compared: that would repeat the same error in other words.
  problems.throw_if_any();
  check_unused_keys(document, scene, problems);
  for (const SceneProblem& problem : check_scene(scene)) {
    const TomlNode* node = find_path(document, problem.key);
    problems.add(node != nullptr ? node->place : document.place, problem.key, problem.text);
  }
  problems.throw_if_any();
  return scene;
}

}  // namespace gem
