// Checks the text against its hash, then parses it.
#include "gem/record/run_file/stored_case.h"

#include <algorithm>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

[[noreturn]] void refuse_stored_case(const RunFile& file, const std::string& why) {
  throw Error(ExitCode::file_system,
              "cannot read " + shown(file.path()) + " (" + why + "); the file is damaged or was changed by hand");
}

}  // namespace

std::string stored_case(const RunFile& file) {
  std::string text = file.attribute("gem_case_toml");
  if (text.empty()) refuse_stored_case(file, "it holds no case");
  if (std::any_of(text.begin(), text.end(),
                  [](unsigned char c) { return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f; }))
    refuse_stored_case(file, "its case holds control characters");
  if (case_hash(text) != file.attribute("gem_case_sha256"))
    refuse_stored_case(file, "its case does not have the SHA-256 that the file states");
  return text;
}

SceneDef stored_scene(const RunFile& file) { return parse_scene(stored_case(file), file.path()); }

}  // namespace gem
