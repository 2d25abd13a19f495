// The paper's content as data: the rows of its tables and its statements, each with the rule that judges it.
#pragma once

#include <string>
#include <vector>

#include "validation/paper/statements/judgement.h"

namespace gem {

/// One row of Table 1 or 2.
struct TableRow {
  std::string table;   // "1" or "2"
  std::string number;  // as printed: "24", "1c"
  std::string run;
  double thick = 0.0, medium = 0.0, thin = 0.0;  // [tenths]
  double gap_m = 0.0;
  double current_m_per_s = 0.0;
  double stiffness_N_per_m = 0.0;
  bool drag = false;
};

struct Statement {
  std::string id;
  std::string source;     // "p. 5, Fig. 9"
  std::string says;       // the statement in our words
  std::string condition;  // of the runs; empty for a number of all runs together
  std::string against;    // if not empty, the number is the ratio to that of this condition
  std::string metric;
  Over over = Over::mean;
  Rule rule;
  double share = 0.5;   // for a statement about each run: smallest share of runs that must obey it
  bool alike = false;   // determined by the case or its generator and equal for every seed: one run decides
  std::string why;      // reason for this rule and this tolerance
  bool choice = false;  // judged again for every modelling choice
};

struct Catalogue {
  std::vector<TableRow> rows;
  std::vector<Statement> statements;
};

/// Reads validation/paper/paper.json. Throws Error(file_system) that says what is missing or wrong.
Catalogue read_catalogue(const std::string& path);
/// Reads a catalogue from text; `origin` is its name in messages.
Catalogue parse_catalogue(const std::string& text, const std::string& origin);

}  // namespace gem
