// Compares the resolved texts line by line.
#include "gem/command/sweep/case_difference.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "gem/base/error.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::string case_difference(const std::string& run_file, const SceneDef& scene) {
  constexpr std::size_t named_maximum = 3, length_maximum = 80;
  std::vector<std::string> there;
  try {
    there = lines_of(stored_case(RunFile(run_file, true)));
  } catch (const Error&) {
    return "";  // the caller has its own reason
  }
  const std::vector<std::string> here = lines_of(resolved_toml(scene));
  std::string text;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < std::min(there.size(), here.size()); ++i)
    if (there[i] != here[i] && ++differ <= named_maximum)
      text += "; " + there[i].substr(0, length_maximum) + " there, " + here[i].substr(0, length_maximum) + " here";
  if (differ > named_maximum) text += "; and " + std::to_string(differ - named_maximum) + " more";
  return text + (there.size() != here.size() ? "; other keys or floes" : "");
}

}  // namespace gem
