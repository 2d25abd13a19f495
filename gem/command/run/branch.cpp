// gem run --from: a case that begins with the floes and the platform of another run.
#include <charconv>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"
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
  From from{text.substr(0, at), 0.0};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + at + 1, end, from.time);
  if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(from.time) || from.time < 0.0)
    refuse(text, "no time (after @ come seconds)", "give e.g. --from run.h5@3600");
  return from;
}

bool is_set(const CaseChoice& choice, const char* key) {
  for (const std::string& text : choice.overrides)
    if (find_path(parse_override(text), key) != nullptr) return true;
  return false;
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
  take("platform.start_velocity_m_per_s", platform.start_velocity_m_per_s, start->velocity);
  take("platform.start_yaw_rad", platform.start_yaw_rad, start->yaw);
  take("platform.start_spin_rad_per_s", platform.start_spin_rad_per_s, platform.yaw == Yaw::locked ? 0.0 : start->spin);
}

}  // namespace

SceneDef begun_from(const CaseChoice& choice, SceneDef scene) {
  if (choice.from.empty()) return named_floes(std::move(scene));
  for (const char* key : {"floes.source", "floes.path", "floes.time_s", "floes.sha256"})
    if (is_set(choice, key))
      refuse(choice.from, std::string("so does --set ") + key, "(both choose floes) give only one");
  From from = from_of(choice.from);
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
  place_platform(choice, from, scene.platform);
  return named_floes(std::move(scene));
}

}  // namespace gem
