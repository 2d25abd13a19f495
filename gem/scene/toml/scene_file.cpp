// Reads whole scenes from documents and writes their resolved text.
#include "gem/scene/toml/scene_file.h"

#include "gem/base/sha256.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_tree.h"

namespace gem {
namespace {

template <class T>
void append_entries(std::string& text, const std::string& name, const std::vector<T>& entries,
                    const std::vector<Option<T>>& options) {
  for (const T& entry : entries) {
    text += "\n[[" + name + "]]\n";
    for (const auto& option : options) text += option.path + " = " + value_text(option.get(entry)) + "\n";
  }
}

}  // namespace

SceneDef read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  TomlNode document = load_document(path);
  apply_overrides(document, overrides);
  return checked_scene(document);
}

SceneDef parse_scene(const std::string& text, const std::string& origin, const std::vector<std::string>& overrides) {
  TomlNode document = load_text(text, origin);
  apply_overrides(document, overrides);
  return checked_scene(document);
}

std::string resolved_toml(const SceneDef& scene) {
  std::string text;
  std::string open_section;
  for (const auto& option : scene_options()) {
    const std::size_t dot = option.path.find('.');
    const std::string section = option.path.substr(0, dot);
    if (section != open_section) {
      text += (text.empty() ? "[" : "\n[") + section + "]\n";
      // If left out, an empty list would be read as the default.
      if (section == "ice" && scene.floes.classes.empty()) text += "class = []\n";
      open_section = section;
    }
    text += option.path.substr(dot + 1) + " = " + value_text(option.get(scene)) + "\n";
  }
  append_entries(text, "ice.class", scene.floes.classes, ice_class_options());
  append_entries(text, "floe", scene.floe, floe_options());
  append_entries(text, "fixed", scene.fixed, fixed_options());
  return text;
}

std::string scene_hash(const SceneDef& scene) { return sha256_hex(resolved_toml(scene)); }

}  // namespace gem
