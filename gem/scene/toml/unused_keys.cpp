// Asks the option table which choice each stated key needs.
#include "gem/scene/toml/unused_keys.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

using Options = std::vector<const Option<SceneDef>*>;

/// "a", "a and b", "a, b and c".
std::string listed(const Options& options, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < options.size(); ++i)
    text += (i == first ? "" : i + 1 == options.size() ? " and " : ", ") + options[i]->path;
  return text;
}

/// The stated keys that do not count, by the choice that they need.
std::map<std::pair<std::string, std::string>, Options> unused_options(const TomlNode& document, const SceneDef& scene) {
  std::map<std::pair<std::string, std::string>, Options> unused;
  for (const auto& option : scene_options())
    if (!counts(option, scene) && find_path(document, option.path) != nullptr)
      unused[{option.counts_with.key, option.counts_with.choice}].push_back(&option);
  return unused;
}

/// The keys that count instead, because of the choice that is made.
Options options_instead(const std::string& key, const SceneDef& scene) {
  Options instead;
  for (const auto& option : scene_options())
    if (option.counts_with.key == key && counts(option, scene)) instead.push_back(&option);
  return instead;
}

}  // namespace

void check_unused_keys(const TomlNode& document, const SceneDef& scene, Problems& problems) {
  for (const auto& [needed, options] : unused_options(document, scene)) {
    const std::string choice = needed.first + " = \"" + needed.second + "\"";
    const std::string them = options.size() == 1 ? "it" : "them";
    const Options instead = options_instead(needed.first, scene);
    std::string advice = "; set " + choice + ", or remove " + them;
    if (find_path(document, needed.first) != nullptr)
      advice =
          "; remove " + them +
          (instead.empty() ? ""
                           : "; " + listed(instead, 0) + (instead.size() == 1 ? " counts" : " count") + " instead") +
          ", or set " + choice;
    const TomlNode& first = *find_path(document, options.front()->path);
    problems.add(first.place, options.front()->path,
                 "has no effect (value " + describe(first) + ", allowed only with " + choice +
                     (options.size() == 1 ? "" : "; the same holds for " + listed(options, 1)) + ")" + advice);
  }
}

}  // namespace gem
