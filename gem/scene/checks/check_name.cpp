// The name of a run becomes that of its file.
#include <algorithm>
#include <string>

#include "gem/scene/checks/checks.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

constexpr std::size_t name_bytes_maximum = 200;

}  // namespace

void check_name(const SceneDef& s, SceneProblems& out) {
  const std::string& name = s.run.name;
  bool printable = std::none_of(name.begin(), name.end(),
                                [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/'; });
  for (std::size_t at = name.find('\xc2'); at != std::string::npos; at = name.find('\xc2', at + 1))
    printable = printable && at + 1 < name.size() && static_cast<unsigned char>(name[at + 1]) >= 0xa0;  // U+0080...
  if (name.empty() || name.size() > name_bytes_maximum || name.front() == '.' || !printable)
    out.push_back({"run.name", "not fit for a file name (value " + quoted_text(name) + ", allowed 1 to " +
                                   std::to_string(name_bytes_maximum) +
                                   " bytes without '/' and control characters, not starting with '.')"});
}

}  // namespace gem
