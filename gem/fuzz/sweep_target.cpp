// Fuzz target: a sweep file. Every run must have a number, a name of its own and a case that can be written and read.
#include <set>

#include "gem/command/sweep/sweep_settings.h"
#include "gem/fuzz/target.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/case_text.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<gem::SweepMember> members;
  if (!gem::fuzz::accepted([&] { members = gem::expand_sweep_text(gem::fuzz::text_of(data, size), "input"); }))
    return 0;
  std::set<std::string> names;
  std::vector<gem::SceneDef> scenes;
  for (const gem::SweepMember& member : members) {
    scenes.push_back(member.scene);
    gem::fuzz::expect(member.index == static_cast<std::int64_t>(scenes.size()), "runs are not numbered in order");
    gem::fuzz::expect(names.insert(member.name).second, "two runs have one name");
    gem::fuzz::check_round_trip(member.scene);
  }
  gem::sweep_list_text(members);
  gem::sweep_list_json(members);
  gem::setting_columns(scenes);
  return 0;
}
