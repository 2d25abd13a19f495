// Compares the options of several scenes.
#include "gem/command/sweep/sweep_settings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gem/base/vec2.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

using Scenes = std::vector<SceneDef>;

SummaryColumn numbers(const std::string& name, const std::string& units, const std::string& long_name,
                      const Scenes& scenes, const std::function<double(const SceneDef&)>& value) {
  SummaryColumn column{name, units.empty() ? "1" : units, long_name, true};
  for (const SceneDef& scene : scenes) column.numbers.push_back(value(scene));
  return column;
}

double mean_thickness(const SceneDef& scene) {
  double sum = 0.0, tenths = 0.0;
  if (scene.floes.source == FloeSource::listed) {
    for (const FloeDef& floe : scene.floe) sum += floe.thickness_m;
    tenths = static_cast<double>(scene.floe.size());
  } else if (scene.floes.source != FloeSource::file) {
    for (const IceClassDef& entry : scene.floes.classes) {
      sum += entry.thickness_m * entry.tenths;
      tenths += entry.tenths;
    }
  }
  return tenths > 0.0 ? sum / tenths : std::numeric_limits<double>::quiet_NaN();
}

bool varies(const Option<SceneDef>& option, const Scenes& scenes) {
  const std::string first = value_text(option.get(scenes.front()));
  return std::any_of(scenes.begin(), scenes.end(),
                     [&](const SceneDef& scene) { return value_text(option.get(scene)) != first; });
}

void add(std::vector<SummaryColumn>& columns, const Option<SceneDef>& option, const Scenes& scenes) {
  const auto number = [&](const std::string& part, const std::function<double(const OptionValue&)>& of) {
    columns.push_back(numbers(option.path + part, option.unit, option.doc, scenes,
                              [&](const SceneDef& scene) { return of(option.get(scene)); }));
  };
  switch (option.type) {
    case OptionType::number:
      return number("", [](const OptionValue& value) { return std::get<double>(value); });
    case OptionType::integer:
      return number("", [](const OptionValue& value) { return static_cast<double>(std::get<std::int64_t>(value)); });
    case OptionType::flag:
      return number("", [](const OptionValue& value) { return std::get<bool>(value) ? 1.0 : 0.0; });
    case OptionType::pair:
      number(".x", [](const OptionValue& value) { return std::get<Vec2>(value).x; });
      return number(".y", [](const OptionValue& value) { return std::get<Vec2>(value).y; });
    case OptionType::text:
    case OptionType::choice: {
      SummaryColumn column{option.path, "", option.doc, true};
      for (const SceneDef& scene : scenes) column.texts.push_back(std::get<std::string>(option.get(scene)));
      columns.push_back(column);
      return;
    }
    case OptionType::table:  // many numbers of one run, as an outline
    case OptionType::outline:
      return;
  }
}

}  // namespace

std::vector<SummaryColumn> setting_columns(const Scenes& scenes) {
  std::vector<SummaryColumn> columns = {
      numbers("seed", "", "seed of the generated field", scenes,
              [](const SceneDef& scene) { return static_cast<double>(scene.run.seed); }),
      numbers("current_speed_m_per_s", "m s-1", "largest speed of the current", scenes,
              [](const SceneDef& scene) { return largest_current(scene); }),
      numbers("gap_m", "m", "gap between the boundaries at the platform; NaN without boundaries", scenes,
              [](const SceneDef& scene) {
                return scene.boundary.present ? scene.boundary.gap_m : std::numeric_limits<double>::quiet_NaN();
              }),
      numbers("ice_thickness_m", "m", "mean ice thickness, weighted by the tenths of the classes", scenes,
              mean_thickness)};
  for (const auto& option : scene_options())
    if (option.path != "run.name" && varies(option, scenes)) add(columns, option, scenes);
  return columns;
}

}  // namespace gem
