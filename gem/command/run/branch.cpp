// gem run --from: a case that begins with the floes and the platform of another run.
#include <algorithm>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/time_option.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/scene/toml/document.h"

namespace gem {
namespace {

struct From {
  std::string path;
  double time = last_frame;
};

[[noreturn]] void refuse(const std::string& text, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::usage, "--from " + shown(text) + ": " + why + " " + hint);
}

From from_of(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || is_run_file(text)) return {text};
  return {text.substr(0, at), time_of_option("--from " + shown(text) + ": after @,", text.substr(at + 1))};
}

bool is_set(const CaseChoice& choice, const char* key) {
  for (const std::string& text : choice.overrides)
    if (find_path(parse_override(text), key) != nullptr) return true;
  return false;
}

/// Describes the ice as the case of the run does, because the floes come from there: the stored case, and `gem
/// compare`, then show what the run really has. A note says what of the case counts for nothing. floes.moved_by_m
/// stays: the floes of the run have been moved already.
void take_ice(const CaseChoice& choice, const FloesDef& theirs, SceneDef& scene) {
  std::string different;
  const auto take = [&](const char* key, auto FloesDef::*member, bool is_same) {
    if (is_set(choice, key))
      refuse(choice.from, std::string("--set ") + key + " has no effect",
             "(the floes come from the run); leave it out");
    if (!is_same) different += (different.empty() ? "" : ", ") + std::string(key);
    scene.floes.*member = theirs.*member;
  };
  const auto take_value = [&](const char* key, auto FloesDef::*member) {
    take(key, member, scene.floes.*member == theirs.*member);
  };
  take("ice.class", &FloesDef::classes,
       std::equal(theirs.classes.begin(), theirs.classes.end(), scene.floes.classes.begin(), scene.floes.classes.end(),
                  [](const IceClassDef& a, const IceClassDef& b) {
                    return a.name == b.name && a.thickness_m == b.thickness_m && a.tenths == b.tenths;
                  }));
  take_value("floes.length_m", &FloesDef::length_m);
  take_value("floes.width_m", &FloesDef::width_m);
  take_value("floes.start_x_m", &FloesDef::start_x_m);
  take_value("floes.size_law", &FloesDef::size_law);
  take_value("floes.size_minimum_m", &FloesDef::size_minimum_m);
  take_value("floes.size_maximum_m", &FloesDef::size_maximum_m);
  take_value("floes.size_mean_m", &FloesDef::size_mean_m);
  take_value("floes.size_deviation_m", &FloesDef::size_deviation_m);
  take_value("floes.gap_m", &FloesDef::gap_m);
  take_value("floes.placement", &FloesDef::placement);
  take_value("floes.shape_count", &FloesDef::shape_count);
  take_value("floes.tile_length_m", &FloesDef::tile_length_m);
  if (!different.empty())
    scene.notes.push_back("--from " + shown(choice.from) + ": the floes come from the run, so of the case count for " +
                          "nothing: " + different + " (the stored case has those of the run)");
}

/// Only what both the run and the case have. The user's --set goes before.
void place_platform(const CaseChoice& choice, const From& from, PlatformDef& platform) {
  if (!platform.present) return;
  const std::optional<PlatformStart> start = platform_of_run_file(from.path, from.time);
  if (!start) return;
  const auto take = [&](const char* key, auto& mine, const auto& theirs) {
    if (!is_set(choice, key)) mine = theirs;
  };
  take("platform.start_offset_m", platform.start_offset_m, start->position - platform.anchor_m);
  take("platform.start_velocity_m_per_s", platform.start_velocity_m_per_s, platform.fixed ? Vec2{} : start->velocity);
  take("platform.start_yaw_rad", platform.start_yaw_rad, start->yaw);
  take("platform.start_spin_rad_per_s", platform.start_spin_rad_per_s,
       platform.fixed || platform.yaw == Yaw::locked ? 0.0 : start->spin);
}

}  // namespace

SceneDef begun_from(const CaseChoice& choice, SceneDef scene) {
  if (choice.from.empty()) return named_floes(std::move(scene));
  for (const char* key : {"floes.source", "floes.path", "floes.time_s", "floes.sha256"})
    if (is_set(choice, key))
      refuse(choice.from, std::string("so does --set ") + key, "(both choose floes); give only one");
  From from = from_of(choice.from);
  tried_in_child({{from.path}}, [&] {
    floes_of_run_file(from.path, from.time);
    platform_of_run_file(from.path, from.time);
  });
  const FloesStart start = floes_of_run_file(from.path, from.time);
  if (start.floes.empty()) refuse(choice.from, "no floes (the run had none)", "name another run");
  const FloesDef usual;
  from.time = start.time;
  scene.floe.clear();
  scene.floes.source = FloeSource::file;
  scene.floes.path = from.path;
  scene.floes.time_s = from.time;
  scene.floes.sha256.clear();
  scene.floes.count = usual.count;  // the run counts them
  scene.floes.concentration = usual.concentration;
  scene.floes.concave = usual.concave;
  take_ice(choice, stored_scene(RunFile(from.path, true)).floes, scene);
  place_platform(choice, from, scene.platform);
  return named_floes(std::move(scene));
}

}  // namespace gem
