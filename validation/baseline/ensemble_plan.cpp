#include "validation/baseline/ensemble_plan.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem::baseline {
namespace {

void add_line(EnsemblePlan& plan, const std::vector<std::string>& f, const std::string& where) {
  const auto needs = [&](std::size_t count) {
    if (f.size() != count)
      throw Error(ExitCode::usage, where + ": " + std::to_string(f.size()) + " fields (a line '" + f[0] + "' has " +
                                       std::to_string(count) + "); see the comments of the file");
  };
  const auto number = [&](std::size_t k) { return number_field(f[k], where); };
  if (f[0] == "part") {
    needs(4);
    plan.parts.push_back({f[1], static_cast<int>(number(2)), fields_of(f[3], ' ')});
  } else if (f[0] == "case") {
    needs(6);
    plan.cases.push_back({f[1], f[2], static_cast<int>(number(3)), number(4), number(5)});
  } else if (f[0] == "setting") {
    needs(5);
    const std::vector<std::string> step = fields_of(f[3], ' ');
    const bool in_seconds = step.size() == 2 && step[1] == "s";
    plan.settings.push_back(
        {f[1], f[2], in_seconds ? 0.0 : number(3), in_seconds ? number_field(step[0], where) : 0.0, f[4]});
  } else if (f[0] == "quantity") {
    needs(4);
    plan.quantities.push_back({f[1], number(2), f[3]});
  } else if (f[0] == "map") {
    needs(7);
    plan.map = {
        {number(2), number(3)}, number(1), static_cast<std::size_t>(number(4)), static_cast<std::size_t>(number(5))};
    plan.map_margin = number(6);
  } else {
    throw Error(ExitCode::usage,
                where + ": unknown kind '" + f[0] + "' (part, case, setting, quantity or map); use one");
  }
}

template <class List, class Of>
const auto& found(const List& list, const std::string& wanted, Of of, const char* what) {
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return of(entry) == wanted; });
  if (at == list.end())
    throw Error(ExitCode::usage,
                std::string("the plan has no ") + what + " '" + wanted + "' (misspelt?); name another");
  return *at;
}

}  // namespace

std::vector<std::string> fields_of(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, separator);) {
    const auto begin = field.find_first_not_of(" \t\r");
    fields.push_back(begin == std::string::npos ? ""
                                                : field.substr(begin, field.find_last_not_of(" \t\r") - begin + 1));
  }
  return fields;
}

double number_field(const std::string& field, const std::string& what) {
  const auto value = parse_number(field);
  if (!value) throw Error(ExitCode::usage, what + ": '" + field + "' is no number (one stands there); correct it");
  return *value;
}

EnsemblePlan read_plan(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::file_system, "cannot read " + path + " (it does not open); name a plan");
  EnsemblePlan plan;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    add_line(plan, fields_of(line, '|'), path + ":" + std::to_string(number));
  }
  if (plan.cases.empty() || plan.settings.empty() || plan.quantities.empty())
    throw Error(ExitCode::usage, path + " is no plan (it lacks a case, a setting or a quantity); add them");
  for (const PlannedSetting& setting : plan.settings)
    for (const std::string& name : plan.part_of(setting).cases) plan.case_named(name);
  return plan;
}

const PlannedPart& EnsemblePlan::part_of(const PlannedSetting& setting) const {
  return found(
      parts, setting.part, [](const PlannedPart& p) { return p.name; }, "part");
}

int EnsemblePlan::members_of(const PlannedSetting& setting, const PlannedCase& chosen) const {
  const PlannedPart& part = part_of(setting);
  return std::find(part.cases.begin(), part.cases.end(), chosen.name) == part.cases.end() ? 0 : part.members;
}

const PlannedCase& EnsemblePlan::case_named(const std::string& name) const {
  return found(
      cases, name, [](const PlannedCase& c) { return c.name; }, "case");
}

const PlannedSetting& EnsemblePlan::setting_labelled(const std::string& label) const {
  return found(
      settings, label, [](const PlannedSetting& s) { return s.label; }, "setting");
}

std::string member_name(const PlannedCase& chosen, const PlannedSetting& setting, int seed) {
  std::string name = chosen.name + "." + setting.label + ".s" + std::to_string(seed);
  for (char& c : name)
    if (c == ' ' || c == '/') c = '_';
  return name;
}

}  // namespace gem::baseline
