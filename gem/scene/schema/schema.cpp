// The table of options, put together from its sections.
#include "gem/scene/schema/schema.h"

#include <algorithm>

#include "gem/scene/schema/sections/sections.h"

namespace gem {
namespace {

std::vector<Option<SceneDef>> make_scene_options() {
  OptionTable<SceneDef> t;
  for (const auto add_section : sections::in_order) {
    t.opt_in = false;
    t.counts_with = {};
    add_section(t);
  }
  return t.options;
}

}  // namespace

const std::vector<Option<SceneDef>>& scene_options() {
  static const auto options = make_scene_options();
  return options;
}

bool counts(const OptionInfo& option, const SceneDef& scene) {
  const NeededChoice& needed = option.counts_with;
  return std::all_of(scene_options().begin(), scene_options().end(), [&](const Option<SceneDef>& other) {
    return other.path != needed.key || std::get<std::string>(other.get(scene)) == needed.choice;
  });
}

const std::vector<Option<IceClassDef>>& ice_class_options() {
  static const auto options = sections::ice_class_keys();
  return options;
}

const std::vector<Option<PlatformPieceDef>>& platform_piece_options() {
  static const auto options = sections::platform_piece_keys();
  return options;
}

const std::vector<Option<ThrusterDef>>& thruster_options() {
  static const auto options = sections::thruster_keys();
  return options;
}

const std::vector<Option<FloeDef>>& floe_options() {
  static const auto options = sections::floe_keys();
  return options;
}

const std::vector<Option<FixedDef>>& fixed_options() {
  static const auto options = sections::fixed_keys();
  return options;
}

const std::vector<RenamedKey>& renamed_keys() {
  static const std::vector<RenamedKey> keys = {{"numerics", "moment_s", "time_step_s"},
                                               {"contact", "resolution", "solver"}};
  return keys;
}

}  // namespace gem
