// What an ensemble comparison runs and how it judges, read from validation/baseline/ensembles.txt.
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
  int index = 0;                    // of the sweep
  double from_s = 0.0, to_s = 0.0;  // what is judged
};

struct PlannedSetting {
  std::string label, part;
  double step_factor = 1.0;  // of the case's own time step
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
  double map_margin = 0.0;  // of the share of one cell

  const PlannedPart& part_of(const PlannedSetting& setting) const;
  /// 0 where the setting's part leaves the case out.
  int members_of(const PlannedSetting& setting, const PlannedCase& chosen) const;
  const PlannedCase& case_named(const std::string& name) const;
  const PlannedSetting& setting_labelled(const std::string& label) const;
};

/// Fields of a line of a plan, settings file or CSV, trimmed of blanks.
std::vector<std::string> fields_of(const std::string& line, char separator);

/// A field as a number. Throws Error(usage) that names `what`.
double number_field(const std::string& field, const std::string& what);

/// Throws Error(file_system) if the file does not open and Error(usage) with its line for what is no plan.
EnsemblePlan read_plan(const std::string& path);

/// One name for a member run, fit for a file name.
std::string member_name(const PlannedCase& chosen, const PlannedSetting& setting, int seed);

}  // namespace gem::baseline
