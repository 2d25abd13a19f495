// Judges the catalogue with the runs of each modelling choice.
#include "validation/paper/studies/sensitivity.h"

#include <algorithm>
#include <set>

namespace gem {

std::vector<ChoiceRow> sensitivity(const PaperFolder& folder, const Catalogue& catalogue) {
  constexpr const char* kBetween = "__";
  std::set<std::string> choices;
  for (const auto& [condition, runs] : folder.conditions)
    if (const auto end = condition.find(kBetween); end != std::string::npos) choices.insert(condition.substr(0, end));
  std::vector<ChoiceRow> rows;
  for (const std::string& choice : choices) {
    ChoiceRow row{choice, {}};
    for (const Statement& statement : catalogue.statements)
      if (statement.choice) row.statements.push_back(evaluate(statement, folder, {}, choice + kBetween));
    rows.push_back(row);
  }
  std::stable_partition(rows.begin(), rows.end(), [](const ChoiceRow& row) { return row.choice == "as_is"; });
  return rows;
}

}  // namespace gem
