// What the paper says, as data: the rows of its tables and its statements, each with the rule that judges it.
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
  std::string says;       // in our words
  std::string condition;  // of the runs; empty for a number of the whole folder
  std::string against;    // the number is the ratio to this condition's, if not empty
  std::string metric;
  Over over = Over::mean;
  Rule rule;
  double share = 0.5;   // of the runs that must obey a statement about each run
  bool alike = false;   // set by the case or its generator, so that every seed tells the same: one run decides
  std::string why;      // this rule and this tolerance
  bool choice = false;  // is asked again for every modelling choice
};

struct Catalogue {
  std::vector<TableRow> rows;
  std::vector<Statement> statements;
};

/// Reads validation/paper/paper.json. Throws Error(file_system) that names what is missing or wrong.
Catalogue read_catalogue(const std::string& path);
/// The same from text.
Catalogue parse_catalogue(const std::string& text, const std::string& origin);

}  // namespace gem
