// Compares the resolved texts key by key.
#include "gem/report/compare/case_differences.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

constexpr std::size_t kRowsOfOneList = 12;  // more differing keys of one list become one row

struct CaseKeys {
  std::vector<std::string> order;
  std::map<std::string, std::string> value;
};

/// The keys of a resolved text: "section.key", in a list "section[2].key".
CaseKeys keys_of(const SceneDef& scene) {
  CaseKeys keys;
  std::map<std::string, int> entries;
  std::string section;
  std::istringstream text(resolved_toml(scene));
  for (std::string line; std::getline(text, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("[[")) {
      const std::string list = line.substr(2, line.find(']') - 2);
      section = list + "[" + std::to_string(++entries[list]) + "].";
    } else if (line.starts_with("[")) {
      section = line.substr(1, line.find(']') - 1) + ".";
    } else if (equals != std::string::npos) {
      keys.order.push_back(section + line.substr(0, equals));
      keys.value[keys.order.back()] = line.substr(equals + 3);
    }
  }
  return keys;
}

std::string list_of(const std::string& key) {
  const std::size_t bracket = key.find('[');
  return bracket == std::string::npos ? "" : key.substr(0, bracket);
}

/// Replaces the rows of each long list by one.
std::vector<CaseDifference> shortened(const std::vector<CaseDifference>& rows, std::size_t cases) {
  std::map<std::string, std::size_t> count;
  for (const CaseDifference& row : rows) ++count[list_of(row.key)];
  std::vector<CaseDifference> kept;
  std::set<std::string> named;
  for (const CaseDifference& row : rows) {
    const std::string list = list_of(row.key);
    if (list.empty() || count[list] <= kRowsOfOneList)
      kept.push_back(row);
    else if (named.insert(list).second)
      kept.push_back({list, std::vector<std::string>(cases, std::to_string(count[list]) + " values differ")});
  }
  return kept;
}

}  // namespace

std::vector<CaseDifference> case_differences(const std::vector<SceneDef>& cases) {
  std::vector<CaseKeys> all;
  for (const SceneDef& scene : cases) all.push_back(keys_of(scene));
  std::vector<std::string> order;
  std::set<std::string> seen = {"run.name"};
  for (const CaseKeys& keys : all)
    for (const std::string& key : keys.order)
      if (seen.insert(key).second) order.push_back(key);
  std::vector<CaseDifference> rows;
  for (const std::string& key : order) {
    CaseDifference row{key, {}};
    for (const CaseKeys& keys : all) {
      const auto found = keys.value.find(key);
      row.values.push_back(found == keys.value.end() ? "-" : found->second);
    }
    const bool same = std::all_of(row.values.begin(), row.values.end(),
                                  [&](const std::string& value) { return value == row.values.front(); });
    if (!same) rows.push_back(row);
  }
  return shortened(rows, cases.size());
}

}  // namespace gem
