// Compares options as text, in the form of a case file.
#include "validation/paper/statements/settings_check.h"

#include <algorithm>
#include <set>

#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

/// The options in which the rows of the tables differ, and the lengths that depend on them.
const std::set<std::string>& varied_by_tables() {
  static const std::set<std::string> options = {
      "boundary.gap_m",        "current.velocity_m_per_s", "mooring.stiffness_N_per_m",
      "platform_drag.present", "numerics.time_step_s",     "run.duration_s"};
  return options;
}

bool is_label(const std::string& option) {
  return option == "run.name" || option == "run.seed" || option.starts_with("output.");
}

}  // namespace

std::vector<std::string> differing_options(const SceneDef& a, const SceneDef& b) {
  std::vector<std::string> differing;
  for (const auto& option : scene_options())
    if (!is_label(option.path) && value_text(option.get(a)) != value_text(option.get(b)))
      differing.push_back(option.path);
  const auto same_class = [](const IceClassDef& one, const IceClassDef& other) {
    return one.thickness_m == other.thickness_m && one.tenths == other.tenths;
  };
  if (!std::equal(a.floes.classes.begin(), a.floes.classes.end(), b.floes.classes.begin(), b.floes.classes.end(),
                  same_class))
    differing.emplace_back("ice.class");
  return differing;
}

std::vector<std::string> mixed_settings(const PaperFolder& folder, const std::vector<TableRow>& rows) {
  std::vector<std::string> sentences;
  std::set<std::string> between;
  const SceneDef* first = nullptr;
  std::set<std::string> tables;
  for (const TableRow& row : rows) tables.insert(row.run);
  for (const auto& [condition, runs] : folder.conditions) {
    std::set<std::string> within;
    for (const PaperRun& run : runs)
      for (const std::string& option : differing_options(runs.front().scene, run.scene)) within.insert(option);
    for (const std::string& option : within) sentences.push_back("the runs of " + condition + " differ in " + option);
    if (!tables.contains(condition)) continue;
    if (first == nullptr) first = &runs.front().scene;
    for (const std::string& option : differing_options(*first, runs.front().scene))
      if (option != "ice.class" && !varied_by_tables().contains(option)) between.insert(option);
  }
  for (const std::string& option : between) sentences.push_back("the runs of the tables differ in " + option);
  return sentences;
}

}  // namespace gem
