// Reads whole scenes from documents and writes their resolved text.
#include "gem/scene/toml/scene_file.h"

#include "gem/base/error.h"
#include "gem/base/sha256.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_tree.h"
#include "gem/scene/toml/toml_text.h"

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

/// Younger options are not written where they are not given, so that cases without them keep their hash.
bool is_written(const Option<SceneDef>& option, const SceneDef& scene) {
  const std::string& path = option.path;
  if (!option.counts_with.key.empty()) return counts(option, scene);
  if (option.opt_in) return value_text(option.get(scene)) != value_text(option.get(SceneDef{}));
  if (path == "floes.sha256") return !scene.floes.sha256.empty();
  if (path == "floes.time_s") return scene.floes.time_s != 0.0;
  if (path == "output.contact_forces") return scene.output.contact_forces;
  if (path == "platform.start_yaw_rad") return scene.platform.start_yaw_rad != 0.0;
  if (path == "platform.start_spin_rad_per_s") return scene.platform.start_spin_rad_per_s != 0.0;
  return true;
}

}  // namespace

SceneDef scene_of(TomlNode document, const std::vector<std::string>& overrides) {
  apply_overrides(document, overrides);
  return checked_scene(document);
}

SceneDef read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return scene_of(load_document(path), overrides);
}

SceneDef parse_scene(const std::string& text, const std::string& origin, const std::vector<std::string>& overrides) {
  return scene_of(load_text(text, origin), overrides);
}

std::string resolved_toml(const SceneDef& scene) {
  std::string text;
  std::string open_section;
  for (const auto& option : scene_options()) {
    if (!is_written(option, scene)) continue;
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
  append_entries(text, "platform.piece", scene.platform.piece, platform_piece_options());
  append_entries(text, "dp.thruster", scene.dp.thruster, thruster_options());
  append_entries(text, "floe", scene.floe, floe_options());
  append_entries(text, "fixed", scene.fixed, fixed_options());
  return text;
}

std::string case_hash(const std::string& resolved_text) {
  const std::size_t named = resolved_text.find("\nsha256 = ");
  const std::size_t path = resolved_text.rfind("\npath = ", named);
  if (named == std::string::npos || path == std::string::npos) return sha256_hex(resolved_text);
  std::string without_path = resolved_text;
  return sha256_hex(without_path.erase(path, resolved_text.find('\n', path + 1) - path));
}

std::string scene_hash(const SceneDef& scene) { return case_hash(resolved_toml(scene)); }

std::string floes_sha256(const std::vector<FloeDef>& floes) {
  std::string text;
  append_entries(text, "floe", floes, floe_options());
  return sha256_hex(text);
}

void check_same_floes(const SceneDef& scene, const std::vector<FloeDef>& floes) {
  if (scene.floes.sha256.empty()) return;
  const std::string found = floes_sha256(floes);
  if (found == scene.floes.sha256) return;
  throw Error(ExitCode::scene_rejected,
              "floes.sha256: " + quoted_text(scene.floes.path) + " holds other floes than the case names (SHA-256 " +
                  found + ", the case says " + scene.floes.sha256 +
                  "); restore the file, or leave floes.sha256 out to run with the floes that it holds");
}

}  // namespace gem
