// Fuzz target: the arguments of --set, one per line, on the built-in case.
#include <sstream>
#include <vector>

#include "gem/fuzz/target.h"
#include "gem/scene/toml/scene_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> overrides;
  std::istringstream lines(gem::fuzz::text_of(data, size));
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);
  gem::SceneDef scene;
  if (gem::fuzz::accepted([&] { scene = gem::parse_scene("", "built-in case", overrides); }))
    gem::fuzz::check_round_trip(scene);
  return 0;
}
