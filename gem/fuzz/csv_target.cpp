// Fuzz target: floes in a CSV file.
#include "gem/field/files/floe_file.h"
#include "gem/fuzz/target.h"
#include "gem/scene/check_scene.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = gem::fuzz::input_file("floes.csv", gem::fuzz::text_of(data, size));
  gem::SceneDef scene;
  for (const auto concave : {gem::ConcaveFloes::refuse, gem::ConcaveFloes::cut, gem::ConcaveFloes::hull})
    if (gem::fuzz::accepted([&] { scene = gem::with_listed_floes({}, gem::read_floe_file(path, concave).floes); }))
      gem::fuzz::make_listed_field(scene);
  return 0;
}
