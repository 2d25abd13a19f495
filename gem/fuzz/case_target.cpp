// Fuzz target: the text of a case. What is read, written and read again must be equal.
#include "gem/fuzz/target.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/toml/scene_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gem::SceneDef scene;
  if (!gem::fuzz::accepted([&] { scene = gem::parse_scene(gem::fuzz::text_of(data, size), "input"); })) return 0;
  gem::scene_warnings(scene);
  gem::fuzz::check_round_trip(scene);
  gem::fuzz::make_listed_field(scene);
  return 0;
}
