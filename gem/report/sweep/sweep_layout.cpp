// Splits each name at an underscore, counted from its end.
#include "gem/report/sweep/sweep_layout.h"

#include <algorithm>

namespace gem {
namespace {

std::size_t place_of(std::vector<std::string>& list, const std::string& text) {
  const auto found = std::find(list.begin(), list.end(), text);
  if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
  list.push_back(text);
  return list.size() - 1;
}

SweepLayout one_column(const std::vector<std::string>& names) {
  SweepLayout layout{names, {""}, {}};
  for (std::size_t i = 0; i < names.size(); ++i) layout.cell.push_back({i});
  return layout;
}

/// Where the last `parts` parts of a name begin; npos if it has no more than these.
std::size_t start_of_last(const std::string& name, int parts) {
  std::size_t at = name.size();
  for (int i = 0; i < parts && at != std::string::npos; ++i) at = at == 0 ? std::string::npos : name.rfind('_', at - 1);
  return at == 0 ? std::string::npos : at;
}

/// The matrix with `parts` parts as the column; empty if a name has too few, or it is too wide or one column.
std::optional<SweepLayout> matrix(const std::vector<std::string>& names, int parts) {
  SweepLayout layout;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const std::string& name : names) {
    const std::size_t end = start_of_last(name, parts);
    if (end == std::string::npos) return {};
    places.emplace_back(place_of(layout.rows, name.substr(0, end)), place_of(layout.columns, name.substr(end + 1)));
  }
  if (layout.columns.size() > kSweepColumns || layout.columns.size() < 2) return {};
  layout.cell.assign(layout.rows.size(), std::vector<std::optional<std::size_t>>(layout.columns.size()));
  for (std::size_t i = 0; i < names.size(); ++i) layout.cell[places[i].first][places[i].second] = i;
  return layout;
}

}  // namespace

SweepLayout sweep_layout(const std::vector<std::string>& names) {
  for (const int parts : {2, 1})
    if (auto layout = matrix(names, parts)) return *layout;
  return one_column(names);
}

}  // namespace gem
