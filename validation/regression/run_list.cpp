// Reads runs.txt.
#include "validation/regression/run_list.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/scene_file.h"
#include "validation/regression/table.h"

namespace gem::regression {
namespace {

Touches touches_of(const std::string& word) {
  if (word == "nothing") return Touches::nothing;
  if (word == "floes") return Touches::floes;
  if (word == "platform") return Touches::platform;
  throw std::runtime_error("touches is nothing, floes or platform, not `" + word + "`");
}

/// Reads one indented line: a keyword and its value.
void take_line(ListedRun& run, const std::string& word, const std::string& rest) {
  if (rest.empty()) throw std::runtime_error("`" + word + "` needs a value");
  if (word == "case") {
    run.case_file = rest;
  } else if (word == "member") {
    run.member = rest;
  } else if (word == "touches") {
    run.touches = touches_of(rest);
  } else if (word == "set") {
    run.settings.push_back(rest);
  } else {
    throw std::runtime_error("unknown word `" + word + "`, known are case, member, touches and set");
  }
}

void start_run(std::vector<ListedRun>& runs, const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (!std::all_of(name.begin(), name.end(), plain))
    throw std::runtime_error("a name has letters, digits and _ only: `" + name + "`");
  for (const ListedRun& run : runs)
    if (run.name == name) throw std::runtime_error("a second run `" + name + "`");
  runs.push_back({name, {}, {}, Touches::platform, {}});
}

/// `line` without blanks at its ends.
std::string trimmed(const std::string& line) {
  const auto begin = line.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

void parse_line(std::vector<ListedRun>& runs, const std::string& line) {
  const std::string text = trimmed(line);
  if (text.empty() || text[0] == '#') return;
  if (line[0] != ' ') return start_run(runs, text);
  if (runs.empty()) throw std::runtime_error("an indented line before the first run");
  const auto blank = std::min(text.find(' '), text.size());
  take_line(runs.back(), text.substr(0, blank), trimmed(text.substr(blank)));
}

}  // namespace

std::vector<ListedRun> parse_runs(const std::string& text, const std::string& origin) {
  std::vector<ListedRun> runs;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      parse_line(runs, line);
    } catch (const std::runtime_error& fault) {
      throw std::runtime_error(origin + ":" + std::to_string(number) + ": " + fault.what());
    }
  }
  for (const ListedRun& run : runs)
    if (run.case_file.empty()) throw std::runtime_error(origin + ": run `" + run.name + "` has no case");
  return runs;
}

std::vector<ListedRun> listed_runs() {
  const std::string path = folder() + "/runs.txt";
  return parse_runs(text_of(path), path);
}

SceneDef scene_of(const ListedRun& run) {
  const std::string path = std::string(GEM_SOURCE_DIR) + "/" + run.case_file;
  if (run.member.empty()) return read_scene(path, run.settings);
  for (const SweepMember& member : expand_sweep(path, run.settings))
    if (member.name == run.member) return member.scene;
  throw std::runtime_error(run.case_file + " has no run `" + run.member + "`");
}

}  // namespace gem::regression
