// The checks that the fuzz targets share.
#include "gem/fuzz/target.h"

#include <cstdio>
#include <cstdlib>

#include "gem/field/field.h"
#include "gem/record/testing/described_file.h"
#include "gem/scene/toml/scene_file.h"

namespace gem::fuzz {

void expect(bool condition, const char* message) {
  if (condition) return;
  std::fprintf(stderr, "fault: %s\n", message);
  std::abort();
}

void check_round_trip(const SceneDef& scene) {
  const std::string written = resolved_toml(scene);
  expect(resolved_toml(parse_scene(written, "written case")) == written, "a written case reads as another case");
}

void make_listed_field(const SceneDef& scene) {
  if (scene.floes.source == FloeSource::listed) accepted([&] { make_field(scene); });
}

std::string input_file(const std::string& name, const std::string& content) {
  static const ScratchFolder folder("gem-fuzz");
  return folder.write(name, content);
}

std::string hdf5_input(const std::string& name, const std::string& input) {
  expect(test::open_hdf5_objects() == 0, "the reader left something of the input before this one open");
  const std::string path = input_file(name, input);
  if (!input.starts_with("\x89HDF")) test::write_described_file(input, path);
  if (test::open_hdf5_objects() != 0)
    test::close_hdf5_objects();  // the library may leave things open when it refuses a call
  return path;
}

}  // namespace gem::fuzz
