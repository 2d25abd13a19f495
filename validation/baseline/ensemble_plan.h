// The plan of an ensemble comparison: its runs and its margins, read from validation/baseline/ensembles.txt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/concentration.h"

namespace gem::baseline {

struct PlannedPart {
  std::string name;
  int members = 0;
  std::vector<std::string> cases;
};

struct PlannedCase {
  std::string name, path;
  int index = 0;                    // position in the sweep
  double from_s = 0.0, to_s = 0.0;  // judged time
};

struct PlannedSetting {
  std::string label, part;
  double step_factor = 1.0;  // factor on the time step of the case
  double step_s = 0.0;       // time step [s]; 0: by the factor
  std::string arguments;     // of gem run; @slop stands for another program
};

struct PlannedQuantity {
  std::string name;
  double margin = 0.0;
  std::string of;  // margin is a share of this quantity's mean in the first setting; "absolute": it is the margin
};

struct EnsemblePlan {
  std::vector<PlannedPart> parts;
  std::vector<PlannedCase> cases;
  std::vector<PlannedSetting> settings;
  std::vector<PlannedQuantity> quantities;
  Grid map;
  double map_margin = 0.0;  // on the share of one cell

  const PlannedPart& part_of(const PlannedSetting& setting) const;
  /// Number of seeds; 0 if the setting leaves the case out.
  int members_of(const PlannedSetting& setting, const PlannedCase& chosen) const;
  const PlannedCase& case_named(const std::string& name) const;
  const PlannedSetting& setting_labelled(const std::string& label) const;
};

/// Fields of a line of a plan, settings file or CSV, without surrounding blanks.
std::vector<std::string> fields_of(const std::string& line, char separator);

/// A field as a number. Throws Error(usage) that names `what`.
double number_field(const std::string& field, const std::string& what);

/// Reads a plan. Throws Error(file_system) if the file cannot be opened, and Error(usage) with the line of a mistake.
EnsemblePlan read_plan(const std::string& path);

/// Name of a member run, usable as a file name.
std::string member_name(const PlannedCase& chosen, const PlannedSetting& setting, int seed);

}  // namespace gem::baseline
