// Which statements hold under which modelling choice, judged with the runs of cases/sensitivity.toml.
#pragma once

#include <string>
#include <vector>

#include "validation/paper/statements/evaluation.h"

namespace gem {

struct ChoiceRow {
  std::string choice;
  std::vector<JudgedRow> statements;  // those with `choice` set, in the order of the catalogue
};

/// One row for each choice that has runs ("CHOICE__RUN"), `as_is` first.
std::vector<ChoiceRow> sensitivity(const PaperFolder& folder, const Catalogue& catalogue);

}  // namespace gem
